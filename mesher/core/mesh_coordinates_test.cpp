// Coordinates there and back, and cells that stay positive.
#include "mesher/core/mesh_coordinates.hpp"

#include <gtest/gtest.h>

#include "mesher/core/error.hpp"
#include "mesher/core/testing_mesh.hpp"

namespace cbc3d {
namespace {

/// Left-handed: z runs downwards.
ImageFrame frame() {
  ImageFrame frame;
  frame.size = {4, 5, 6};
  frame.spacing_mm = {0.5, 1, 2};
  frame.origin_mm = {10, -20, 30};
  frame.direction = Mat3::from_columns({1, 0, 0}, {0, 1, 0}, {0, 0, -1});
  return frame;
}

double six_volumes_of(const Mesh& mesh) {
  const auto& n = mesh.tets.nodes[0];
  return six_volumes(mesh.points[n[0]], mesh.points[n[1]], mesh.points[n[2]], mesh.points[n[3]]);
}

TEST(MeshCoordinates, ThereAndBack) {
  const Mesh mesh = testing::one_of_each();
  for (const char* const coordinates : {"LPS", "RAS", "voxel"}) {
    Mesh other = mesh;
    const ImageFrame f = frame();
    from_lps(other, coordinates, &f);
    EXPECT_GT(six_volumes_of(other), 0) << coordinates;
    to_lps(other, coordinates, &f);
    EXPECT_EQ(other.tets.nodes, mesh.tets.nodes);
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
      EXPECT_LT((other.points[v] - mesh.points[v]).norm(), 1e-12) << coordinates;
    }
  }
}

TEST(MeshCoordinates, KnownPlaces) {
  Mesh mesh;
  mesh.points = {{10, -20, 30}, {11, -19, 26}};
  Mesh ras = mesh, voxel = mesh;
  const ImageFrame f = frame();
  from_lps(ras, "RAS", nullptr);
  EXPECT_EQ(ras.points[0], (Vec3{-10, 20, 30}));
  from_lps(voxel, "voxel", &f);
  EXPECT_LT(voxel.points[0].norm(), 1e-12);
  EXPECT_LT((voxel.points[1] - Vec3{2, 1, 2}).norm(), 1e-12);
}

TEST(MeshCoordinates, UnknownOnesAreRefused) {
  Mesh mesh;
  EXPECT_THROW(from_lps(mesh, "MNI", nullptr), InputError);
  EXPECT_THROW(to_lps(mesh, "voxel", nullptr), InputError);
}

}  // namespace
}  // namespace cbc3d
