// Offsets against the volumes of two layers whose common plane has moved.
#include <gtest/gtest.h>

#include "mesher/domain/mesh_domain.hpp"
#include "mesher/improve/surface/testing_layered_mesh.hpp"
#include "mesher/improve/volume_offsets.hpp"

namespace cbc3d {
namespace {

using testing::kPlane;
using testing::kSize;
using testing::two_layers;

TEST(VolumeOffsets, MoveTheBoundariesByWhatTheMaterialsLack) {
  MaterialMesh mesh = two_layers(kSize, kPlane);
  const MeshDomain domain(mesh, {0, 1, 2});
  EXPECT_NEAR(largest_volume_error(mesh, domain, 0), 0, 1e-12);
  for (Vec3& p : mesh.points) p.z += p.z == kPlane ? 0.1 : 0;
  EXPECT_NEAR(largest_volume_error(mesh, domain, 0), 0.1 / 3, 1e-9);
  EXPECT_EQ(largest_volume_error(mesh, domain, 1e6), 0);  // small volumes do not count
  VolumeOffsets offsets(domain);
  EXPECT_EQ(offsets.offset_mm(), (std::vector<double>{0, 0, 0}));
  offsets.update(mesh);
  // 3.6 mm^3 over the surface of half a cube with its sides now 3.1 and 2.9 high.
  EXPECT_NEAR(offsets.offset_mm()[1], -3.6 / (2 * 36 + 24 * 3.1), 1e-9);
  EXPECT_NEAR(offsets.offset_mm()[2], 3.6 / (2 * 36 + 24 * 2.9), 1e-9);
  const double once = offsets.offset_mm()[2];
  offsets.update(mesh);  // the mesh has not followed: the next step is not smaller
  EXPECT_GE(offsets.offset_mm()[2], 2 * once * (1 - 1e-9));
}

}  // namespace
}  // namespace cbc3d
