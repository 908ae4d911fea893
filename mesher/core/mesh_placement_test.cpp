#include "mesher/core/mesh_placement.hpp"

#include <gtest/gtest.h>

namespace cbc3d {
namespace {

/// A block of one label off the origin, and a small tet in each of its voxels.
struct Sample {
  LabelImage image;
  Mesh mesh;
  Sample() {
    image.frame.size = {8, 8, 8};
    image.frame.spacing_mm = {1, 2, 3};
    image.frame.origin_mm = {10, 20, 30};
    image.labels = {0, 7};
    image.voxels.resize(image.frame.voxel_count());
    for (std::size_t v = 0; v < image.voxels.size(); ++v) {
      const Index3 at = image.frame.index_of(v);
      if (at[0] >= 5 || at[1] >= 6) {
        image.voxels.set(v, 1);
        add_tet(image.frame.to_physical(image.frame.local_centre(at[0], at[1], at[2])));
      }
    }
  }
  void add_tet(const Vec3& centre) {
    const auto first = static_cast<VertexId>(mesh.points.size());
    for (const Vec3& offset : {Vec3{0.1, 0, 0}, Vec3{-0.1, 0, 0}, Vec3{0, 0.1, 0}, Vec3{0, 0, 0.1}}) {
      mesh.points.push_back(centre + offset);
    }
    mesh.tets.add({first, first + 1, first + 2, first + 3}, 7);
  }
};

TEST(MeshPlacement, AMeshOnItsImageIsNoFinding) {
  const Sample sample;
  const Placement placement = placement_of(sample.mesh, sample.image);
  EXPECT_EQ(placement.overlap, 1);
  EXPECT_EQ(placement.finding, "");
  EXPECT_FALSE(placement.elsewhere);
}

TEST(MeshPlacement, SaysWhichFrameWouldFit) {
  const std::pair<Vec3, const char*> mirrors[] = {
      {{-1, -1, 1}, "RAS coordinates"}, {{-1, 1, 1}, "its x mirrored"}, {{1, -1, 1}, "its y mirrored"}};
  for (const auto& [signs, words] : mirrors) {
    Sample sample;
    for (Vec3& p : sample.mesh.points) {
      p = {signs.x * p.x, signs.y * p.y, p.z};
    }
    const Placement placement = placement_of(sample.mesh, sample.image);
    EXPECT_TRUE(placement.elsewhere);
    EXPECT_NE(placement.finding.find(words), std::string::npos) << placement.finding;
  }
  Sample indices;
  const ImageFrame& frame = indices.image.frame;
  for (Vec3& p : indices.mesh.points) {
    const Vec3 local = frame.to_local(p);
    p = {local.x / frame.spacing_mm.x, local.y / frame.spacing_mm.y, local.z / frame.spacing_mm.z};
  }
  EXPECT_NE(placement_of(indices.mesh, indices.image).finding.find("voxel indices"), std::string::npos);
}

TEST(MeshPlacement, AnotherImageIsAFinding) {
  Sample sample;
  for (Vec3& p : sample.mesh.points) {
    p.z += 1000;
  }
  EXPECT_TRUE(placement_of(sample.mesh, sample.image).elsewhere);
  Sample other;
  other.image.labels[1] = 8;
  EXPECT_TRUE(placement_of(other.mesh, other.image).elsewhere);
}

}  // namespace
}  // namespace cbc3d
