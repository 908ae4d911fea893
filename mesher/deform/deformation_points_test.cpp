// Sources and targets of the deformation, against their rules vertex by vertex and voxel by voxel.
#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <set>

#include "mesher/deform/deformation_points.hpp"
#include "mesher/deform/testing_paper_mesh.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

using testing::paper_mesh;

/// What extract_target_points promises, voxel by voxel.
std::size_t count_by_rule(const LabelImage& image, Connectivity connectivity) {
  const int most = connectivity == Connectivity::vertex ? 3 : connectivity == Connectivity::edge ? 2 : 1;
  std::set<Index3> accepted;
  for (std::size_t v = 0; v < image.voxels.size(); ++v) {
    const Index3 at = image.frame.index_of(v);
    if (image.voxels[v] == 0 || !is_boundary_voxel(image, at[0], at[1], at[2])) {
      continue;
    }
    const bool barred = connectivity != Connectivity::no &&
                        std::any_of(accepted.begin(), accepted.end(), [&](const Index3& o) {
                          const std::array<int, 3> d = {std::abs(o[0] - at[0]), std::abs(o[1] - at[1]),
                                                        std::abs(o[2] - at[2])};
                          return std::max({d[0], d[1], d[2]}) == 1 && d[0] + d[1] + d[2] <= most;
                        });
    if (!barred) {
      accepted.insert(at);
    }
  }
  return accepted.size();
}

TEST(TargetPoints, FollowTheRuleAtAnyThreadCount) {
  for (const std::uint32_t seed : {1U, 2U}) {
    const LabelImage image = testing::noise_image(11, 0.6, seed);
    for (const Connectivity c :
         {Connectivity::vertex, Connectivity::edge, Connectivity::face, Connectivity::no}) {
      for (const int threads : {1, 2}) {
        omp_set_num_threads(threads);
        MaterialSets sets;
        EXPECT_EQ(extract_target_points(image, c, sets).targets.size(), count_by_rule(image, c));
      }
    }
  }
}

TEST(TargetPoints, OfASolidBlock) {
  // A face of 4x4 voxels of an 8x4x4 block at the image's border: the shell has 8*4*4 - 6*2*2 voxels.
  const LabelImage image = testing::make_image({8, 4, 4}, {1, 1, 1}, 1, [](const Vec3&) { return 1; });
  MaterialSets sets;
  const TargetPoints points = extract_target_points(image, Connectivity::no, sets);
  EXPECT_EQ(points.targets.size(), 8U * 16 - 6 * 4);
  for (const TargetPoint& t : points.targets) {
    EXPECT_EQ(sets[t.set].size, 2U);
    EXPECT_FALSE(t.lower_side) << "the outside is the lower material";
  }
}

TEST(SourcePoints, KnowTheMaterialsThatMeet) {
  const LabelImage image = testing::make_image({30, 30, 20}, {1, 1, 1}, 2, [](const Vec3& p) {
    const bool inside = p.x > 4 && p.x < 25 && p.y > 4 && p.y < 25 && p.z > 4 && p.z < 15;
    return inside ? (p.x < 15 ? 1 : 2) : 0;
  });
  const MaterialMesh mesh = paper_mesh(image, {.spacing_mm = 5});
  const VertexCells around = cells_of_vertices(mesh);
  MaterialSets sets;
  const SourcePoints points = extract_source_points(mesh, around, sets);
  std::set<std::size_t> sizes;
  for (const SourcePoint& s : points.sources) {
    std::set<MaterialId> materials;
    for (const CellId c : around.of(s.vertex)) {
      materials.insert(mesh.material_of(c));
    }
    const MaterialSet& set = sets[s.set];
    sizes.insert(set.size);
    EXPECT_EQ(s.two_sided, set.size == 2);
    for (std::size_t i = 0; i < set.size; ++i) {
      EXPECT_TRUE(set[i] == kBackground || materials.count(set[i]) == 1);
    }
    EXPECT_EQ(set.size - (set[0] == kBackground ? 1 : 0), materials.size());
  }
  EXPECT_EQ(sizes, (std::set<std::size_t>{2, 3})) << "faces, and the rim where both labels meet the outside";
}

}  // namespace
}  // namespace cbc3d
