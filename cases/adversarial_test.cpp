#include "cases/adversarial.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include "mesher/testing/temporary_folder.hpp"

namespace cbc3d::cases {
namespace {

using cbc3d::testing::TemporaryFolder;

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(AdversarialImages, AreSmallFilesOfTheirOwnNamesWithTheSameBytesEveryTime) {
  const TemporaryFolder first("adversarial-1"), second("adversarial-2");
  std::set<std::string> names;
  for (const AdversarialImage& image : adversarial_images()) {
    EXPECT_TRUE(names.insert(std::string(image.name)).second) << image.name;
    const std::string file = std::string(image.name) + std::string(image.extension);
    image.write(first.path() / file);
    image.write(second.path() / file);
    const std::string bytes = bytes_of(first.path() / file);
    EXPECT_LT(bytes.size(), std::size_t{1} << 20U) << file;
    EXPECT_EQ(bytes, bytes_of(second.path() / file)) << file;
  }
  EXPECT_GE(names.size(), 20U);
}

}  // namespace
}  // namespace cbc3d::cases
