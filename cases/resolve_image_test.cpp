// The function stands in manifest.hpp.
#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>

#include "cases/core/sha256.hpp"
#include "cases/derive.hpp"
#include "cases/manifest.hpp"
#include "cases/phantoms/registry.hpp"
#include "cases/testing_two_blocks.hpp"
#include "mesher/core/error.hpp"
#include "mesher/core/image_io.hpp"
#include "mesher/testing/temporary_folder.hpp"

namespace cbc3d::cases {
namespace {

using cbc3d::testing::TemporaryFolder;
using test::clear;
using test::two_blocks;

// FIPS 180-2's test vectors.
constexpr const char* kShaOfAbc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
constexpr const char* kShaOfNothing = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";

Case file_case(const std::string& sha256) {
  Case one;
  one.image_file = "one.bin";
  one.image_sha256 = sha256;
  one.image_source = "somewhere (MIT)";
  return one;
}

bool says(const ResolvedImage& image, const std::string& what) {
  return image.skipped_reason.find(what) != std::string::npos;
}

/// A case of the image, which is written to a data folder.
Case file_case(const LabelImage& image, const std::filesystem::path& folder) {
  write_label_image(image, folder / "one.nrrd");
  Case one;
  one.image_file = "one.nrrd";
  one.image_sha256 = sha256_of_file(folder / "one.nrrd");
  return one;
}

TEST(ResolveImage, FileIsFoundByItsDigest) {
  const TemporaryFolder wrong("wrong"), right("right"), cache("cache");
  wrong.write("one.bin", "abd");
  right.write("one.bin", "abc");
  const auto found = resolve_image(file_case(kShaOfAbc), {wrong.path(), right.path()}, cache.path());
  EXPECT_EQ(found.path, right.path() / "one.bin");
  EXPECT_EQ(found.skipped_reason, "");
}

TEST(ResolveImage, AbsentFileSaysWhatIsWantedAndWhereToGetIt) {
  const TemporaryFolder data("data");
  const auto found = resolve_image(file_case(kShaOfAbc), {data.path()}, data.path());
  EXPECT_TRUE(found.path.empty());
  EXPECT_TRUE(says(found, "'one.bin'"));
  EXPECT_TRUE(says(found, data.path().string()));
  EXPECT_TRUE(says(found, "somewhere (MIT)"));
  EXPECT_TRUE(says(found, "--data"));
  EXPECT_TRUE(says(resolve_image(file_case(kShaOfAbc), {}, data.path()), "none given"));
}

TEST(ResolveImage, AnotherFileOfTheSameNameIsSkipped) {
  const TemporaryFolder data("data");
  data.write("one.bin", "abc");
  const auto found = resolve_image(file_case(kShaOfNothing), {data.path()}, data.path());
  EXPECT_TRUE(found.path.empty());
  EXPECT_TRUE(says(found, "sha256"));
  EXPECT_TRUE(says(found, kShaOfAbc));
  EXPECT_TRUE(says(found, kShaOfNothing));
}

TEST(ResolveImage, PhantomIsGeneratedOnce) {
  const TemporaryFolder folder("cache");
  const auto cache = folder.path() / "new" / "cache";
  Case one;
  one.phantom = Phantom{"organs", {24, 20, 16}, {.7, 1, 1.5}, 4, ""};
  const auto first = resolve_image(one, {}, cache);
  ASSERT_EQ(first.skipped_reason, "");
  const LabelImage image = read_label_image(first.path);
  EXPECT_EQ(image.voxels, make_phantom(*one.phantom).voxels);
  EXPECT_EQ(image.frame.spacing_mm, one.phantom->spacing_mm);
  const auto written = std::filesystem::last_write_time(first.path);
  EXPECT_EQ(resolve_image(one, {}, cache).path, first.path);
  EXPECT_EQ(std::filesystem::last_write_time(first.path), written);
  one.phantom->seed = 5;
  EXPECT_NE(resolve_image(one, {}, cache).path, first.path);
}

TEST(ResolveImage, DerivedImagesOfOneSourceAreTold) {
  const TemporaryFolder data("data"), folder("cache");
  LabelImage image = two_blocks();
  clear(image, {4, 4, 4});
  Case one = file_case(image, data.path());
  one.derive.repeat = {2, 1, 1};
  const auto twice = resolve_image(one, {data.path()}, folder.path());
  EXPECT_EQ(read_label_image(twice.path).voxels, repeated(image, {2, 1, 1}).voxels);
  one.derive.fill_holes = true;
  const auto filled = resolve_image(one, {data.path()}, folder.path());
  EXPECT_EQ(read_label_image(filled.path).voxels, repeated(two_blocks(), {2, 1, 1}).voxels);
}

TEST(ResolveImage, DerivedImageIsWrittenOnceAndItsSourceChecked) {
  const TemporaryFolder data("data"), folder("cache");
  const auto cache = folder.path() / "images";
  LabelImage image = two_blocks();
  clear(image, {4, 4, 4});
  Case one = file_case(image, data.path());
  one.derive.fill_holes = true;
  const auto found = resolve_image(one, {data.path()}, cache);
  ASSERT_EQ(found.skipped_reason, "");
  EXPECT_EQ(found.path.parent_path(), cache);
  EXPECT_EQ(read_label_image(found.path).voxels, two_blocks().voxels);
  const auto written = std::filesystem::last_write_time(found.path);
  EXPECT_EQ(resolve_image(one, {data.path()}, cache).path, found.path);
  EXPECT_EQ(std::filesystem::last_write_time(found.path), written);
  one.image_sha256[0] = one.image_sha256[0] == '0' ? '1' : '0';
  EXPECT_NE(resolve_image(one, {data.path()}, cache).skipped_reason, "");
}

TEST(ResolveImage, NidusHasNinetySixHoleVoxels) {
  const char* variable = std::getenv("CBC3D_DATA");
  std::vector<std::filesystem::path> folders;
  std::istringstream list(variable == nullptr ? "" : variable);
  for (std::string folder; std::getline(list, folder, ':');) {
    folders.emplace_back(folder);
  }
  const TemporaryFolder cache("cache");
  const auto cases = load_cases(CBC3D_MANIFESTS);
  for (const Case& one : cases) {
    if (one.name == "nidus-filled") {
      const auto filled = resolve_image(one, folders, cache.path());
      if (!filled.skipped_reason.empty()) {
        GTEST_SKIP() << filled.skipped_reason;
      }
      EXPECT_EQ(read_label_image(filled.path).voxels_per_material()[1], 67020U + 92 + 3 + 1);
      return;
    }
  }
  FAIL() << "no case nidus-filled";
}

}  // namespace
}  // namespace cbc3d::cases
