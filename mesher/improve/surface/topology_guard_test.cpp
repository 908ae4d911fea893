#include "mesher/improve/surface/topology_guard.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "mesher/testing/kuhn_box.hpp"

namespace cbc3d {
namespace {

const std::vector<MaterialId> kLabelOf = {0, 1, 2, 2};

/// Vertices - edges + faces - tets of all tets that `is_in` holds for, cell by cell over the whole mesh.
template <typename IsIn>
int characteristic_of_whole(const MaterialMesh& mesh, const IsIn& is_in) {
  std::set<std::set<VertexId>> cells;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (unsigned subset = 1; is_in(mesh.materials[t]) && subset < 16; ++subset) {
      std::set<VertexId> cell;
      for (std::size_t n = 0; n < 4; ++n) {
        if ((subset >> n & 1U) != 0) cell.insert(mesh.tets[t][n]);
      }
      cells.insert(cell);
    }
  }
  int sum = 0;
  for (const auto& cell : cells) sum += cell.size() % 2 == 1 ? 1 : -1;
  return sum;
}

Vec3 centroid(const MaterialMesh& mesh, TetId t) {
  Vec3 at;
  for (const VertexId v : mesh.tets[t]) at += 0.25 * mesh.points[v];
  return at;
}

/// 3 x 3 x 3 unit cubes of six tets each; `material` of each tet by its centroid.
template <typename Material>
MaterialMesh box_of(const Material& material) {
  const testing::KuhnBox box(3);
  MaterialMesh mesh{box.points, box.tets, {}, {}, {}};
  for (TetId t = 0; t < box.tets.size(); ++t) {
    mesh.materials.push_back(static_cast<MaterialId>(material(centroid(mesh, t))));
  }
  return mesh;
}

/// Whether the tets of the unit cube from `low` on may become `to`.
bool may_become(MaterialMesh mesh, const Vec3& low, MaterialId to) {
  std::vector<TetId> tets;
  for (TetId t = 0; t < mesh.tets.size(); ++t) {
    const Vec3 at = centroid(mesh, t) - low;
    if (std::min({at.x, at.y, at.z}) > 0 && std::max({at.x, at.y, at.z}) < 1) tets.push_back(t);
  }
  EXPECT_EQ(tets.size(), 6U);
  LabelledComplex complex(mesh, kLabelOf);
  const TopologyGuard guard(complex, tets, {complex.material(tets.front()), to});
  for (const TetId t : tets) complex.relabel(t, to);
  return guard.holds();
}

TEST(TopologyGuard, NoticesATunnelACutAndACavityAndAllowsACorner) {
  const MaterialMesh slab = box_of([](const Vec3& x) { return x.z < 1 ? 1 : 2; });
  EXPECT_FALSE(may_become(slab, {1, 1, 0}, 2));
  EXPECT_TRUE(may_become(slab, {0, 0, 0}, 2));
  const MaterialMesh bar = box_of([](const Vec3& x) { return std::max(x.y, x.z) < 1 ? 1 : 2; });
  EXPECT_FALSE(may_become(bar, {1, 0, 0}, 2));
  EXPECT_TRUE(may_become(bar, {2, 0, 0}, 2));
  EXPECT_FALSE(may_become(box_of([](const Vec3&) { return 1; }), {1, 1, 1}, 2));
}

TEST(TopologyGuard, WithoutMaterialsNothingIsGuarded) {
  MaterialMesh mesh = box_of([](const Vec3&) { return 1; });
  LabelledComplex complex(mesh, kLabelOf);
  const TopologyGuard guard(complex, {80}, {});
  complex.relabel(80, 2);
  EXPECT_TRUE(guard.holds());
}

TEST(TopologyGuard, AgreesWithTheCharacteristicOfTheWholeMesh) {
  std::mt19937 random(11);
  std::size_t held = 0, broken = 0;
  for (int trial = 0; trial < 200; ++trial) {
    MaterialMesh mesh = box_of([&](const Vec3& x) {
      return x.x < 1 + trial % 2 || random() % 40 == 0 ? 1 : x.y < 2 ? 2 : 3;
    });
    LabelledComplex complex(mesh, kLabelOf);
    const auto seed = static_cast<TetId>(random() % mesh.tets.size());
    std::vector<TetId> tets = {seed};
    for (std::size_t n = 0; n < 4; ++n) {
      const TetId next = complex.neighbour(seed, n);
      if (next != kNoTet && complex.material(next) == complex.material(seed) && random() % 2 == 0) {
        tets.push_back(next);
      }
    }
    const MaterialId from = complex.material(seed);
    const auto to = static_cast<MaterialId>(from == 1 ? 2 + random() % 2 : 1);
    std::set<VertexId> vertices;
    for (const TetId t : tets) vertices.insert(mesh.tets[t].begin(), mesh.tets[t].end());
    std::vector<MaterialId> guarded;
    for (const MaterialId m : {from, to}) {
      if (std::all_of(vertices.begin(), vertices.end(),
                      [&](VertexId v) { return complex.is_manifold_at(v, m); })) {
        guarded.push_back(m);
      }
    }
    const auto characteristics = [&] {
      std::vector<int> all;
      for (const MaterialId m : guarded) {
        all.push_back(characteristic_of_whole(mesh, [&](MaterialId o) { return o == m; }));
        all.push_back(
            characteristic_of_whole(mesh, [&](MaterialId o) { return kLabelOf[o] == kLabelOf[m]; }));
      }
      return all;
    };
    const TopologyGuard guard(complex, tets, {from, to});
    const std::vector<int> before = characteristics();
    for (const TetId t : tets) complex.relabel(t, to);
    const bool expected = before == characteristics();
    EXPECT_EQ(guard.holds(), expected) << trial;
    (expected ? held : broken) += 1;
  }
  EXPECT_GT(held, 25U);
  EXPECT_GT(broken, 25U);
}

}  // namespace
}  // namespace cbc3d
