#include "mesher/pipeline/work_estimate.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "mesher/core/error.hpp"
#include "mesher/pipeline/mesh_image.hpp"
#include "mesher/pipeline/presets.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

/// A voxel's material from its indices.
LabelImage image_of(int size, int materials, const std::function<int(int, int, int)>& material_at) {
  return testing::make_image({size, size, size}, {1, 1, 1}, materials, [&](const Vec3& p) {
    return material_at(static_cast<int>(p.x), static_cast<int>(p.y), static_cast<int>(p.z));
  });
}

LabelImage boxed(const std::array<int, 3>& box, const Vec3& spacing_mm = {1, 1, 1}) {
  LabelImage image = image_of(9, 1, [&](int i, int j, int k) {
    const auto within = [](int x, int length) { return x >= 2 && x < 2 + length; };
    return within(i, box[0]) && within(j, box[1]) && within(k, box[2]) ? 1 : 0;
  });
  image.frame.spacing_mm = spacing_mm;
  return image;
}

TEST(WorkEstimate, CountsSheetsWiresAndPoints) {
  EXPECT_EQ(boundary_kinds_of(boxed({3, 4, 1})).sheets, 12U);
  EXPECT_EQ(boundary_kinds_of(boxed({3, 4, 1})).faces, 38U);
  EXPECT_EQ(boundary_kinds_of(boxed({1, 4, 1})).wires, 4U);
  EXPECT_EQ(boundary_kinds_of(boxed({1, 1, 1})).points, 1U);
  EXPECT_EQ(boundary_kinds_of(boxed({2, 2, 2})).sheets, 0U);
}

TEST(WorkEstimate, CountsJunctionsAtTheImagesBorderToo) {
  const LabelImage two = image_of(4, 2, [](int i, int, int) { return i < 2 ? 1 : 2; });
  // The plane between the labels has 5 x 5 cells; the 16 at its rim touch the outside.
  EXPECT_EQ(boundary_kinds_of(two).junctions, 16U);
  EXPECT_EQ(boundary_kinds_of(two).faces, 96U + 16U);
}

TEST(WorkEstimate, CountsContacts) {
  const LabelImage diagonal =
      image_of(4, 1, [](int i, int j, int k) { return i == j && i < 2 && k == 0 ? 1 : 0; });
  EXPECT_EQ(boundary_kinds_of(diagonal).edge_contacts, 1U);
}

TEST(WorkEstimate, ThinPartsAndLongVoxelsCostMore) {
  const auto seconds = [](const LabelImage& image) {
    return estimated_cpu_seconds(boundary_kinds_of(image), image.frame);
  };
  EXPECT_GT(seconds(boxed({5, 5, 1})), 4 * seconds(boxed({5, 5, 2})));
  EXPECT_GT(seconds(boxed({5, 5, 5}, {1, 1, 50})), 5 * seconds(boxed({5, 5, 5})));
  EXPECT_DOUBLE_EQ(seconds(boxed({5, 5, 5}, {3, 3, 3})), seconds(boxed({5, 5, 5})));
}

TEST(WorkEstimate, OnlySmallFilesAreAskedAbout) {
  const LabelImage walls = image_of(48, 1, [](int i, int, int) { return i % 3 == 0 ? 1 : 0; });
  EXPECT_NE(why_long_work(walls, 1000), "");
  EXPECT_EQ(why_long_work(walls, kSmallFileBytes), "");
  EXPECT_EQ(why_long_work(boxed({5, 5, 5}), 100), "");
}

TEST(WorkEstimate, SmallFilesHaveALimitUnlessOptionsAskForSizes) {
  EXPECT_EQ(work_limit_s(kSmallFileBytes - 1, {}), kSmallFileWorkLimit);
  EXPECT_EQ(work_limit_s(kSmallFileBytes, {}), 0);
  EXPECT_EQ(work_limit_s(100, {{"mixed", true}}), kSmallFileWorkLimit);
  for (const char* name : {"elements", "edge-length", "max-distance", "size"}) {
    EXPECT_EQ(work_limit_s(100, {{name, std::string("1")}}), 0) << name;
  }
}

TEST(WorkEstimate, TheLimitHoldsWhateverTheEstimateSaid) {
  const LabelImage box = boxed({6, 6, 6});
  const auto cells_within = [&box](double limit_s) {
    MeshImageOptions options = preset_options(preset_names().front(), box.frame);
    options.work_limit_s = limit_s;
    MeshImageReport report;
    return mesh_image(box, options, {}, report).cell_count();
  };
  EXPECT_THROW(cells_within(1e-3), InputError);
  EXPECT_EQ(cells_within(1000), cells_within(0));
  EXPECT_DOUBLE_EQ(work_of_lattice_s(5'000'000, 2'000'000), 60);
}

}  // namespace
}  // namespace cbc3d
