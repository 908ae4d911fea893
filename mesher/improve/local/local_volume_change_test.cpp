// What materials lose by a step of a vertex, against the volumes of its tets.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <vector>

#include "mesher/improve/local/local_volume_change.hpp"
#include "mesher/improve/local/testing_box.hpp"
#include "mesher/testing/random_draws.hpp"

namespace cbc3d {
namespace {

TEST(LocalVolumeChange, IsTheLossOfTheStarsTets) {
  const testing::Box box(3, [](const Vec3& c) { return c.z < 1 ? 1 : c.x < 2 ? 2 : 3; });
  const TetComplex mesh = box.complex();
  std::mt19937 random(1);
  std::vector<TetId> star;
  std::vector<FacetAt> facets;
  LocalVolumeChange change;
  int lost = 0;
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    mesh.star(v, star);
    mesh.facets(v, star, facets);
    const Vec3 to = mesh.point(v) + testing::draw_point(random, -0.3, 0.3);
    std::map<MaterialId, std::array<double, 2>> volumes;  // before, after
    for (const TetId t : star) {
      std::array<Vec3, 4> p;
      for (std::size_t n = 0; n < 4; ++n) p[n] = mesh.point(mesh.nodes(t)[n]);
      volumes[mesh.material(t)][0] += six_volumes(p[0], p[1], p[2], p[3]);
      p[mesh.node_index(t, v)] = to;
      volumes[mesh.material(t)][1] += six_volumes(p[0], p[1], p[2], p[3]);
    }
    double wanted = 0;
    for (const auto& [material, volume] : volumes) wanted = std::max(wanted, 1 - volume[1] / volume[0]);
    change.clear();
    change.add_gains(mesh, facets, {v, kNoVertex}, to);
    change.add_volumes(mesh, star, kNoVertex);
    EXPECT_NEAR(change.largest_loss(), facets.empty() ? 0 : wanted, 1e-12) << v;
    lost += wanted > 0.01 ? 1 : 0;
  }
  EXPECT_GT(lost, 20);
}

}  // namespace
}  // namespace cbc3d
