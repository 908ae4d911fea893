#include "cases/derive.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>

#include "cases/core/sha256.hpp"
#include "cases/core/testing_folder.hpp"
#include "cases/manifest.hpp"
#include "cases/phantoms/shapes.hpp"
#include "mesher/core/image_io.hpp"

namespace cbc3d::cases {
namespace {

// A block of label 1 with an inner block of label 2 (its low side at x = 7).
LabelImage two_blocks() {
  LabelImage image = box_image({16, 14, 12}, {1, 1, 1}, {2, 2, 2}, {12, 11, 9});
  image.labels.push_back(2);
  for (int k = 2; k <= 9; ++k) {
    for (int j = 2; j <= 11; ++j) {
      for (int i = 7; i <= 12; ++i) {
        image.voxels[image.frame.offset(i, j, k)] = 2;
      }
    }
  }
  return image;
}

void clear(LabelImage& image, const Index3& voxel) {
  image.voxels[image.frame.offset(voxel[0], voxel[1], voxel[2])] = kBackground;
}

/// A case of the image, which is written to a data folder.
Case file_case(const LabelImage& image, const std::filesystem::path& folder) {
  write_label_image(image, folder / "one.nrrd");
  Case one;
  one.image_file = "one.nrrd";
  one.image_sha256 = sha256_of_file(folder / "one.nrrd");
  return one;
}

TEST(FillHoles, TakesTheLabelOfMostFacesAround) {
  LabelImage image = two_blocks();
  clear(image, {4, 4, 4});  // within label 1
  clear(image, {9, 4, 4});  // within label 2
  clear(image, {9, 5, 4});
  clear(image, {7, 7, 5});  // five faces of label 2, one of label 1
  clear(image, {6, 9, 5});  // two voxels across the interface: five faces of each label
  clear(image, {7, 9, 5});
  EXPECT_EQ(fill_holes(image), 6U);
  LabelImage expected = two_blocks();
  expected.voxels[expected.frame.offset(7, 9, 5)] = 1;
  EXPECT_EQ(image.voxels, expected.voxels);
  EXPECT_EQ(fill_holes(image), 0U);
}

TEST(FillHoles, OpenRegionsStay) {
  LabelImage image = two_blocks();
  clear(image, {2, 5, 5});  // a dent
  clear(image, {4, 6, 2});  // a shaft
  clear(image, {4, 6, 3});
  const auto before = image.voxels;
  EXPECT_EQ(fill_holes(image), 0U);
  EXPECT_EQ(image.voxels, before);
  clear(image, {3, 6, 4});  // touches the shaft by an edge only: enclosed by faces
  EXPECT_EQ(fill_holes(image), 1U);
  EXPECT_EQ(image.voxels, before);
}

TEST(FillHoles, RegionsAtTheImageBorderStay) {
  LabelImage image = box_image({9, 9, 9}, {1, 1, 1}, {0, 0, 0}, {8, 8, 8});
  clear(image, {0, 4, 4});
  clear(image, {1, 4, 4});
  EXPECT_EQ(fill_holes(image), 0U);
  clear(image, {4, 4, 4});
  EXPECT_EQ(fill_holes(image), 1U);
}

TEST(Repeated, CopiesLieSideBySide) {
  LabelImage image = two_blocks();
  clear(image, {4, 4, 4});
  image.frame.origin_mm = {5, -3, 2};
  const LabelImage many = repeated(image, {3, 1, 2});
  EXPECT_EQ(many.frame.size, (Index3{48, 14, 24}));
  EXPECT_EQ(many.frame.origin_mm, image.frame.origin_mm);
  EXPECT_EQ(many.labels, image.labels);
  for (std::size_t v = 0; v < many.voxels.size(); ++v) {
    const Index3 at = many.frame.index_of(v);
    ASSERT_EQ(many.voxels[v], image.at(at[0] % 16, at[1], at[2] % 12));
  }
  EXPECT_EQ(repeated(image, {1, 1, 1}).voxels, image.voxels);
}

TEST(ResolveImage, DerivedImagesOfOneSourceAreTold) {
  const test::Folder data("data"), folder("cache");
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
  const test::Folder data("data"), folder("cache");
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
  const test::Folder cache("cache");
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
