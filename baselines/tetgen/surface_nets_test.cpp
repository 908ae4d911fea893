#include "baselines/tetgen/surface_nets.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <utility>

#include "mesher/core/runtime.hpp"

namespace cbc3d::baselines {
namespace {

// A ball of two materials, halved, that touches the image's low x border, and a single voxel of a third.
LabelImage two_material_ball() {
  LabelImage image;
  image.frame.size = {20, 24, 16};
  image.frame.spacing_mm = {1.0, 0.8, 1.5};
  image.labels = {0, 1, 2, 9};
  image.voxels.assign(image.frame.voxel_count(), kBackground);
  const Vec3 centre{6.2, 9.0, 11.0};
  for (int k = 0; k < 16; ++k) {
    for (int j = 0; j < 24; ++j) {
      for (int i = 0; i < 20; ++i) {
        if ((image.frame.local_centre(i, j, k) - centre).norm() < 7.0)
          image.voxels[image.frame.offset(i, j, k)] = k < 7 ? 1 : 2;
      }
    }
  }
  image.voxels[image.frame.offset(17, 20, 13)] = 3;
  return image;
}

// Calls visit(a, b, c) for the triangles of one material, normals outwards.
template <typename Visit>
void for_each_triangle_of(const SurfaceNet& net, MaterialId material, Visit visit) {
  for (std::size_t t = 0; t < net.triangles.size(); ++t) {
    const auto& [a, b, c] = net.triangles[t];
    if (net.sides[t].behind == material) visit(a, b, c);
    if (net.sides[t].ahead == material) visit(a, c, b);
  }
}

double volume_of(const SurfaceNet& net, MaterialId material) {
  double six = 0;
  const auto point = [&](int v) { return net.points[static_cast<std::size_t>(v)]; };
  for_each_triangle_of(net, material,
                       [&](int a, int b, int c) { six += point(a).dot(point(b).cross(point(c))); });
  return six / 6;
}

double voxel_volume(const LabelImage& image, MaterialId material) {
  const Vec3& h = image.frame.spacing_mm;
  return static_cast<double>(image.voxels_per_material()[material]) * h.x * h.y * h.z;
}

TEST(SurfaceNets, EveryMaterialIsClosedAndConsistentlyOriented) {
  const LabelImage image = two_material_ball();
  const SurfaceNet net = surface_net(image, {});
  for (MaterialId material = 1; material <= 3; ++material) {
    std::map<std::pair<int, int>, int> balance;  // of an edge's two directions
    int triangles = 0;
    for_each_triangle_of(net, material, [&](int a, int b, int c) {
      ++triangles;
      for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}})
        balance[std::minmax(from, to)] += from < to ? 1 : -1;
    });
    EXPECT_GE(triangles, 12);
    for (const auto& [edge, sum] : balance) EXPECT_EQ(sum, 0) << "material " << material;
  }
}

TEST(SurfaceNets, EdgesHaveTwoFacetsAndMoreOnlyWhereThreeLabelsMeet) {
  const SurfaceNet net = surface_net(two_material_ball(), {});
  std::map<std::pair<int, int>, int> facets;
  for (const auto& [a, b, c] : net.triangles) {
    for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, c}, std::pair{c, a}})
      ++facets[std::minmax(from, to)];
  }
  int junctions = 0;
  for (const auto& [edge, count] : facets) {
    EXPECT_TRUE(count == 2 || count == 3) << count;
    junctions += count == 3 ? 1 : 0;
  }
  EXPECT_GT(junctions, 20);  // the rim of the cut through the ball
}

TEST(SurfaceNets, VerticesStayWithinTheirReach) {
  SurfaceNetOptions options;
  options.smoothing_steps = 101;
  const LabelImage image = two_material_ball();
  const SurfaceNet net = surface_net(image, options);
  double farthest = 0;
  for (std::size_t v = 0; v < net.points.size(); ++v) {
    for (int axis = 0; axis < 3; ++axis) {
      const double share =
          std::fabs(net.points[v][axis] - net.centres[v][axis]) / image.frame.spacing_mm[axis];
      EXPECT_LE(share, options.reach + 1e-12);
      farthest = std::fmax(farthest, share);
    }
  }
  EXPECT_GT(farthest, 0.2);
}

TEST(SurfaceNets, UnsmoothedItIsTheVoxelsBoundary) {
  SurfaceNetOptions options;
  options.smoothing_steps = 0;
  const LabelImage image = two_material_ball();
  const SurfaceNet net = surface_net(image, options);
  for (MaterialId material = 1; material <= 3; ++material)
    EXPECT_NEAR(volume_of(net, material), voxel_volume(image, material), 1e-9);
}

TEST(SurfaceNets, SmoothingKeepsVolumes) {
  const LabelImage image = two_material_ball();
  const SurfaceNet net = surface_net(image, {});
  for (MaterialId material = 1; material <= 2; ++material)
    EXPECT_NEAR(volume_of(net, material) / voxel_volume(image, material), 1.0, 0.02);
  EXPECT_GT(volume_of(net, 3), 0.05 * voxel_volume(image, 3));  // the single voxel
}

TEST(SurfaceNets, SmoothingSmooths) {
  // The net of a plane across the voxel grid must tend to that plane.
  LabelImage image;
  image.frame.size = {24, 24, 24};
  image.labels = {0, 1};
  image.voxels.assign(image.frame.voxel_count(), kBackground);
  const Vec3 normal = Vec3{1, 2, 4}.normalized();
  const auto height = [&](const Vec3& p) { return normal.dot(p - Vec3{11.5, 11.5, 11.5}); };
  for (std::size_t v = 0; v < image.voxels.size(); ++v) {
    const auto [i, j, k] = image.frame.index_of(v);
    image.voxels[v] = height(image.frame.local_centre(i, j, k)) < 0 ? 1 : 0;
  }
  const auto roughness = [&](int steps) {
    SurfaceNetOptions options;
    options.smoothing_steps = steps;
    const SurfaceNet net = surface_net(image, options);
    double sum = 0;
    for (std::size_t v = 0; v < net.points.size(); ++v) {
      const Vec3 from_middle = net.centres[v] - Vec3{11.5, 11.5, 11.5};
      const bool inner = std::fmax(std::fabs(from_middle.x), std::fabs(from_middle.y)) < 5;
      if (inner && std::fabs(height(net.centres[v])) < 2)
        sum += height(net.points[v]) * height(net.points[v]);
    }
    return sum;
  };
  EXPECT_LT(roughness(20), 0.25 * roughness(0));
}

TEST(SurfaceNets, SameAtEveryThreadCount) {
  set_thread_count(1);
  const SurfaceNet one = surface_net(two_material_ball(), {});
  set_thread_count(3);
  const SurfaceNet three = surface_net(two_material_ball(), {});
  EXPECT_EQ(one.points, three.points);
  EXPECT_EQ(one.triangles, three.triangles);
}

TEST(SurfaceNets, RetractHalvesTheFlaggedAndTheirNeighboursOnly) {
  SurfaceNet net = surface_net(two_material_ball(), {});
  const std::vector<Vec3> before = net.points;
  std::vector<std::uint8_t> flagged(net.points.size(), 0);
  const auto& first = net.triangles.front();
  flagged[static_cast<std::size_t>(first[0])] = 1;
  retract(net, flagged);
  int moved = 0;
  for (std::size_t v = 0; v < before.size(); ++v) moved += net.points[v] == before[v] ? 0 : 1;
  EXPECT_GE(moved, 3);
  EXPECT_LE(moved, 20);
  for (const int v : first) {
    const auto at = static_cast<std::size_t>(v);
    EXPECT_NEAR((net.points[at] - net.centres[at]).norm(), 0.5 * (before[at] - net.centres[at]).norm(),
                1e-12);
  }
}

}  // namespace
}  // namespace cbc3d::baselines
