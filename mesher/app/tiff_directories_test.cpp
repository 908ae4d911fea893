#include "mesher/app/tiff_directories.hpp"

#include <gtest/gtest.h>

#include "mesher/app/testing_slices.hpp"
#include "mesher/core/error.hpp"
#include "mesher/testing/temporary_folder.hpp"

namespace cbc3d {
namespace {

class TiffDirectories : public ::testing::Test {
 protected:
  /// Pages of the file; 0 where it is refused.
  [[nodiscard]] std::size_t pages_of(const std::string& bytes) const {
    folder_.write("a.tif", bytes);
    try {
      return require_whole_tiff(folder_.file("a.tif").string());
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      return 0;
    }
  }
  testing::TemporaryFolder folder_{"tiff"};
};

TEST_F(TiffDirectories, PagesAreCountedAndEveryCutIsRefused) {
  for (const int pages : {1, 3}) {
    const std::string bytes = testing::tiff(pages, 16, 1, 1);
    EXPECT_EQ(pages_of(bytes), static_cast<std::size_t>(pages));
    EXPECT_EQ(pages_of(bytes + "more"), static_cast<std::size_t>(pages));
    for (std::size_t length = 0; length < bytes.size(); ++length) {
      EXPECT_EQ(pages_of(bytes.substr(0, length)), 0U) << length;
    }
  }
}

/// A BigTIFF file of the other byte order: its header, one pixel, one directory of two entries.
std::string big_tiff() {
  const auto number = [](std::uint64_t value, int bytes) {
    std::string text;
    for (int n = bytes - 1; n >= 0; --n) text += static_cast<char>(value >> 8 * n & 0xFFU);
    return text;
  };
  const auto entry = [&](std::uint64_t tag, std::uint64_t value) {
    return number(tag, 2) + number(16, 2) + number(1, 8) + number(value, 8);
  };
  return "MM" + number(43, 2) + number(8, 2) + number(0, 2) + number(24, 8) + number(7, 8) + number(2, 8) +
         entry(273, 16) + entry(279, 8) + number(0, 8);
}

TEST_F(TiffDirectories, BigTiffOfTheOtherByteOrderToo) {
  const std::string bytes = big_tiff();
  EXPECT_EQ(pages_of(bytes), 1U);
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    EXPECT_EQ(pages_of(bytes.substr(0, length)), 0U) << length;
  }
}

TEST_F(TiffDirectories, CirclesAndStripsBeyondTheEndAreRefused) {
  std::string circle = big_tiff();
  circle[circle.size() - 1] = 24;  // the next directory is the first
  EXPECT_EQ(pages_of(circle), 0U);
  std::string beyond = big_tiff();
  beyond[24 + 8 + 19] = static_cast<char>(beyond.size());  // the strip begins at the end
  EXPECT_EQ(pages_of(beyond), 0U);
}

}  // namespace
}  // namespace cbc3d
