// The account of voxels in sub-meshes, against counting them all.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "mesher/domain/size_rank.hpp"
#include "mesher/lattice/bcc_lattice.hpp"
#include "mesher/lattice/fidelity_account.hpp"
#include "mesher/lattice/red_green.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

using testing::noisy_blocks_image;

/// A lattice, its tets and a material for each.
struct Labelled {
  LabelImage image;
  Lattice lattice;
  LatticeTets tets;
  std::vector<MaterialId> materials;
  VoxelRaster raster;

  Labelled(LabelImage of, std::uint32_t seed)
      : image(std::move(of)),
        lattice(build_bcc_lattice(image, {6, 1})),
        tets(refined(lattice, seed)),
        raster(image.frame, lattice.frame) {
    for (const auto& n : tets.nodes) {
      Vec3 centroid;
      for (const VertexId v : n) {
        centroid += 0.25 * lattice.frame.local(lattice.points[v]);
      }
      materials.push_back(image.at_local(centroid));
    }
  }

  static LatticeTets refined(Lattice& lattice, std::uint32_t seed) {
    std::mt19937 random(seed);
    std::vector<std::uint8_t> marked(lattice.reds.size());
    for (auto& m : marked) {
      m = random() % 4 == 0 ? 1 : 0;
    }
    refine_red_green(lattice, marked);
    return extract_tets(lattice);
  }

  [[nodiscard]] std::array<LatticePoint, 4> corners(std::size_t t) const {
    const auto& n = tets.nodes[t];
    return {lattice.points[n[0]], lattice.points[n[1]], lattice.points[n[2]], lattice.points[n[3]]};
  }
  /// Calls f(voxel's offset) for the voxels in a tet.
  template <typename F>
  void for_each_voxel(std::size_t t, const F& f) const {
    raster.for_each_row(corners(t), [&](int j, int k, int begin, int end) {
      for (int i = begin; i < end; ++i) {
        f(image.frame.offset(i, j, k));
      }
    });
  }
};

void expect_counted_right(const Labelled& mesh, const FidelityAccount& account) {
  std::vector<std::size_t> inside(mesh.image.material_count(), 0), common = inside;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    mesh.for_each_voxel(t, [&](std::size_t v) {
      ++inside[mesh.materials[t]];
      common[mesh.materials[t]] += mesh.image.voxels[v] == mesh.materials[t] ? 1U : 0U;
    });
  }
  for (std::size_t m = 1; m < inside.size(); ++m) {
    EXPECT_EQ(account.mesh_voxels(m), inside[m]) << "material " << m;
    EXPECT_EQ(account.common_voxels(m), common[m]) << "material " << m;
  }
}

TEST(FidelityAccount, CountsAsOneThatLooksAtEveryVoxel) {
  for (const int materials : {1, 3, 20}) {
    Labelled mesh(noisy_blocks_image(materials, 5), 6);
    FidelityAccount account(mesh.image, mesh.raster, count_materials(mesh.image).count);
    FidelityAccount::Changes changes = account.no_changes();
    std::vector<ForeignMaterials> foreign(mesh.tets.size());
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      foreign[t] = account.enter(mesh.corners(t), mesh.materials[t], changes);
    }
    account.add(changes);
    expect_counted_right(mesh, account);
    EXPECT_GT(std::count(foreign.begin(), foreign.end(), ForeignMaterials{0}), 100);
    EXPECT_LT(std::count(foreign.begin(), foreign.end(), ForeignMaterials{0}),
              static_cast<std::ptrdiff_t>(foreign.size()) - 100);

    changes = account.no_changes();
    for (std::size_t t = 0; t < mesh.tets.size(); t += 3) {  // some change their material
      if (foreign[t] != 0) {
        account.leave(mesh.corners(t), mesh.materials[t], changes);
      }
      mesh.materials[t] = mesh.materials[t] == 1 ? kBackground : MaterialId{1};
      static_cast<void>(account.enter(mesh.corners(t), mesh.materials[t], changes));
    }
    account.add(changes);
    expect_counted_right(mesh, account);
  }
}

TEST(FidelityAccount, TellsWhichTetsHoldVoxelsOfAnUnmetMaterial) {
  for (const int materials : {3, 20}) {  // more than there are bits, too
    const Labelled mesh(noisy_blocks_image(materials, 9), 2);
    const FidelityAccount account(mesh.image, mesh.raster, count_materials(mesh.image).count);
    std::vector<std::uint8_t> unmet(mesh.image.material_count(), 0);
    unmet[2] = unmet[3] = 1;
    FidelityAccount::Changes changes = account.no_changes();
    std::size_t misjudged = 0;
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      const MaterialId own = mesh.materials[t];
      bool expected = false;
      mesh.for_each_voxel(t, [&](std::size_t v) {
        const MaterialId m = mesh.image.voxels[v];
        expected = expected || (m != own && (unmet[m] != 0 || unmet[own] != 0));
      });
      const ForeignMaterials foreign = account.enter(mesh.corners(t), own, changes);
      ASSERT_EQ(account.is_misjudged(mesh.corners(t), own, foreign, unmet), expected);
      misjudged += expected ? 1 : 0;
    }
    EXPECT_GT(misjudged, 20U);
  }
}

}  // namespace
}  // namespace cbc3d
