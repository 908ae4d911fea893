// How far each source should move, on images whose boundaries are known.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "mesher/deform/source_displacements.hpp"
#include "mesher/deform/testing_paper_mesh.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

using testing::paper_mesh;

struct Prepared {
  Prepared(const LabelImage& picture, MaterialMesh given)
      : image(picture),
        mesh(std::move(given)),
        sources(extract_source_points(mesh, cells_of_vertices(mesh), sets)),
        targets(extract_target_points(image, Connectivity::no, sets)) {}
  [[nodiscard]] std::vector<SourceDisplacement> displacements(const DisplacementOptions& options) const {
    return SourceDisplacements({sources, targets, sets, image.frame}, options).at(mesh.points);
  }
  const LabelImage& image;
  MaterialMesh mesh;
  MaterialSets sets;
  SourcePoints sources;
  TargetPoints targets;
};

/// Mean distance of the moved sources from a sphere.
double mean_miss(const Prepared& p, const DisplacementOptions& options, double radius) {
  const auto found = p.displacements(options);
  double sum = 0;
  for (std::size_t s = 0; s < found.size(); ++s) {
    const Vec3 at = p.mesh.points[p.sources.sources[s].vertex] + found[s].vector;
    sum += (at - testing::centre_of(p.image)).norm() - radius;
  }
  return sum / static_cast<double>(found.size());
}

TEST(SourceDisplacements, VoxelFacesHaveNoBiasAndCentresHalfAVoxel) {
  const LabelImage image = testing::ball_image(44, 1, 17);
  const Prepared p(image, paper_mesh(image, {.spacing_mm = 6}));
  DisplacementOptions options;
  options.target_position = TargetPosition::voxel_faces;
  EXPECT_LT(std::abs(mean_miss(p, options, 17)), 0.15);
  options.target_position = TargetPosition::voxel_centre;
  const double bias = mean_miss(p, options, 17);
  EXPECT_LT(bias, -0.3);
  EXPECT_GT(bias, -0.7);
}

TEST(SourceDisplacements, ReachWhatTheRegionMisses) {
  // A mesh shifted by 3 mm: most sources have no target within an edge.
  const LabelImage image = testing::ball_image(44, 1, 15);
  MaterialMesh mesh = paper_mesh(image, {.spacing_mm = 3});
  for (Vec3& x : mesh.points) {
    x.x += 3;
  }
  const Prepared p(image, mesh);
  const auto matched = [&](double reach) {
    DisplacementOptions options;
    options.pair_distance = 0;
    options.reach = reach;
    const auto found = p.displacements(options);
    return std::count_if(found.begin(), found.end(), [](const SourceDisplacement& d) { return d.matched; });
  };
  EXPECT_LT(matched(1), matched(3));
  EXPECT_EQ(matched(5), static_cast<std::ptrdiff_t>(p.sources.sources.size()));
}

TEST(SourceDisplacements, LeaveNoPairTooFarApart) {
  const LabelImage image = testing::ball_image(30, 1, 10);
  const Prepared p(image, paper_mesh(image, {.spacing_mm = 3}));
  for (const double most : {0.5, 0.8}) {
    DisplacementOptions options;
    options.pair_distance = most;
    const auto found = p.displacements(options);
    for (std::size_t s = 0; s < found.size(); ++s) {
      const Vec3 at = p.mesh.points[p.sources.sources[s].vertex] + found[s].vector;
      double nearest = 1e9;
      for (std::size_t v = 0; v < image.voxels.size(); ++v) {
        const Index3 i = image.frame.index_of(v);
        if (image.voxels[v] != 0 && is_boundary_voxel(image, i[0], i[1], i[2])) {
          nearest = std::min(nearest, (image.frame.local_centre(i[0], i[1], i[2]) - at).norm());
        }
      }
      // A source that a target pulls is at that distance from this target, and no other's.
      EXPECT_LE(nearest, most * image.frame.voxel_diagonal_mm() + 1e-6);
    }
  }
}

/// A plate of one layer of blocks, six tets each (Kuhn's), all of material 1.
MaterialMesh plate(int blocks, double edge_mm, double z_low, double z_high) {
  MaterialMesh mesh;
  const auto node = [&](int i, int j, int k) {
    return static_cast<VertexId>((k * (blocks + 1) + j) * (blocks + 1) + i);
  };
  for (int k = 0; k < 2; ++k) {
    for (int j = 0; j <= blocks; ++j) {
      for (int i = 0; i <= blocks; ++i) {
        mesh.points.push_back({4 + edge_mm * i, 4 + edge_mm * j, k == 0 ? z_low : z_high});
      }
    }
  }
  const std::array<std::array<int, 3>, 6> orders = {
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {1, 0, 2}, {2, 1, 0}}};
  for (int j = 0; j < blocks; ++j) {
    for (int i = 0; i < blocks; ++i) {
      for (std::size_t o = 0; o < orders.size(); ++o) {
        Index3 at = {i, j, 0};
        std::array<VertexId, 4> tet = {node(at[0], at[1], at[2])};
        for (std::size_t n = 0; n < 3; ++n) {
          ++at[static_cast<std::size_t>(orders[o][n])];
          tet[n + 1] = node(at[0], at[1], at[2]);
        }
        if (o >= 3) {
          std::swap(tet[2], tet[3]);
        }
        mesh.tets.push_back(tet);
        mesh.materials.push_back(1);
      }
    }
  }
  return mesh;
}

TEST(SourceDisplacements, TheFarSideOfAThinWallPullsOnlyWhenLetTo) {
  // Edges of 4 mm on a plate of 3 mm: the far side's voxels lie within every source's region.
  const LabelImage image = testing::make_image({40, 40, 16}, {1, 1, 1}, 1, [](const Vec3& p) {
    return p.x > 3 && p.x < 37 && p.y > 3 && p.y < 37 && p.z > 6.5 && p.z < 9.5 ? 1 : 0;
  });
  const Prepared p(image, plate(8, 4, 6.2, 9.8));
  const auto thickness = [&](bool reject) {
    DisplacementOptions options;
    options.reject_outliers = reject;
    options.pair_distance = 0;
    const auto found = p.displacements(options);
    double thick = 0;
    double count = 0;
    for (std::size_t s = 0; s < found.size(); ++s) {
      const Vec3 from = p.mesh.points[p.sources.sources[s].vertex];
      if (std::abs(from.x - 20) < 9 && std::abs(from.y - 20) < 9) {
        thick += (from.z > 8 ? 2 : -2) * (from + found[s].vector).z;
        count += 1;
      }
    }
    return thick / count;
  };
  EXPECT_NEAR(thickness(true), 2, 1e-9) << "between the centres of the outer layers of voxels";
  EXPECT_LT(thickness(false), 1.2);
}

TEST(SourceDisplacements, JunctionsHaveTargetsOfTheirOwn) {
  const LabelImage image = testing::make_image({36, 36, 24}, {1, 1, 1}, 2, [](const Vec3& p) {
    const bool inside = (p - Vec3{17.5, 17.5, 11.5}).norm() < 10;
    return inside ? (p.x < 17 ? 1 : 2) : 0;
  });
  const Prepared p(image, paper_mesh(image, {.spacing_mm = 4}));
  const auto found = p.displacements({});
  std::size_t junctions = 0;
  for (std::size_t s = 0; s < found.size(); ++s) {
    if (!p.sources.sources[s].two_sided) {
      ++junctions;
      EXPECT_TRUE(found[s].matched);
      const Vec3 at = p.mesh.points[p.sources.sources[s].vertex] + found[s].vector;
      EXPECT_LT(std::abs(at.x - 16.5), 1.5) << "near the plane between the labels";
    }
  }
  EXPECT_GT(junctions, 10U);
}

}  // namespace
}  // namespace cbc3d
