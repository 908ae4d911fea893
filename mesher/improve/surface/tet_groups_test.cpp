// Groups of neighbouring tets, each found, connected and in order.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "mesher/improve/surface/testing_layered_mesh.hpp"
#include "mesher/improve/surface/tet_groups.hpp"

namespace cbc3d {
namespace {

using testing::kPlane;
using testing::kSize;
using testing::two_layers;

TEST(TetGroups, AreConnectedOfOneMaterialAndTheSmallestFirst) {
  MaterialMesh mesh = two_layers(kSize, kPlane);
  const std::vector<MaterialId> label_of = {0, 1, 2};
  const LabelledComplex complex(mesh, label_of);
  const auto middle = static_cast<VertexId>((3 * 7 + 3) * 7 + 3);
  const auto groups = tet_groups_at(complex, {middle}, 3);
  std::set<TetGroup> distinct(groups.begin(), groups.end());
  EXPECT_EQ(distinct.size(), groups.size());
  double last = 0;
  for (const TetGroup& group : groups) {
    ASSERT_TRUE(std::is_sorted(group.begin(), group.end()));
    EXPECT_GE(volume_mm3(mesh, group), last);
    last = volume_mm3(mesh, group);
    TetGroup reached = {group[0]};
    for (std::size_t i = 0; i < reached.size(); ++i) {
      EXPECT_EQ(mesh.materials[reached[i]], mesh.materials[group[0]]);
      for (std::size_t n = 0; n < 4; ++n) {
        const TetId next = complex.neighbour(reached[i], n);
        if (std::count(group.begin(), group.end(), next) > 0 &&
            std::count(reached.begin(), reached.end(), next) == 0) {
          reached.push_back(next);
        }
      }
    }
    EXPECT_EQ(reached.size(), group.size());
  }
  const auto star = complex.star(middle);
  std::size_t pairs = 0;
  for (const TetId t : star) {
    EXPECT_EQ(distinct.count({t}), 1U);
    for (const TetId u : star) {
      for (std::size_t n = 0; n < 4; ++n) {
        pairs += t < u && complex.neighbour(t, n) == u && mesh.materials[t] == mesh.materials[u] ? 1 : 0;
        if (t < u && complex.neighbour(t, n) == u && mesh.materials[t] == mesh.materials[u]) {
          EXPECT_EQ(distinct.count({t, u}), 1U);
        }
      }
    }
  }
  EXPECT_GT(pairs, 10U);
}

}  // namespace
}  // namespace cbc3d
