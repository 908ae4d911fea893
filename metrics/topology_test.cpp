#include "metrics/topology.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <map>
#include <set>

#include "metrics/image_topology.hpp"
#include "metrics/testing.hpp"

namespace cbc3d::metrics {
namespace {

nlohmann::json topology_of(const Mesh& mesh) {
  return test::judge(mesh, test::two_boxes(), {false, false})["topology"];
}

// Positive tet whatever the order of its vertices.
void add_tet(Mesh& mesh, std::array<VertexId, 4> tet, Label label = 1) {
  const auto& p = mesh.points;
  if (six_volumes(p[tet[0]], p[tet[1]], p[tet[2]], p[tet[3]]) < 0) std::swap(tet[2], tet[3]);
  mesh.tets.add(tet, label);
}

TEST(Topology, TwoTetsAtAFace) {
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}};
  add_tet(mesh, {0, 1, 2, 3});
  add_tet(mesh, {0, 1, 2, 4});
  const auto found = topology_of(mesh);
  EXPECT_EQ(found["conforming"], true);
  EXPECT_EQ(found["non_manifold_edges"], 0);
  EXPECT_EQ(found["non_manifold_vertices"], 0);
  EXPECT_EQ(found["components"], 1);
}

TEST(Topology, TwoTetsAtAnEdge) {
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  add_tet(mesh, {0, 1, 2, 3});
  add_tet(mesh, {0, 1, 4, 5});
  const auto found = topology_of(mesh);
  EXPECT_EQ(found["conforming"], true);
  EXPECT_EQ(found["non_manifold_edges"], 1);
  EXPECT_EQ(found["non_manifold_vertices"], 0);
  EXPECT_EQ(found["components"], 2);
}

TEST(Topology, TwoTetsAtAVertex) {
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  add_tet(mesh, {0, 1, 2, 3});
  add_tet(mesh, {0, 4, 5, 6});
  const auto found = topology_of(mesh);
  EXPECT_EQ(found["non_manifold_edges"], 0);
  EXPECT_EQ(found["non_manifold_vertices"], 1);
}

TEST(Topology, ManifoldIsAskedPerLabel) {
  // Four labels around an edge: the union of the interfaces branches there, no single surface does.
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  add_tet(mesh, {0, 1, 2, 3}, 1);
  add_tet(mesh, {0, 1, 3, 4}, 2);
  add_tet(mesh, {0, 1, 4, 5}, 3);
  add_tet(mesh, {0, 1, 5, 2}, 4);
  EXPECT_EQ(topology_of(mesh)["non_manifold_edges"], 0);
  mesh.tets.labels[2] = 1;
  const auto found = topology_of(mesh);
  EXPECT_EQ(found["non_manifold_edges"], 1);
  EXPECT_EQ(found["per_label"][0]["non_manifold_edges"], 1);
  EXPECT_EQ(found["per_label"][0]["components"], 2);
  EXPECT_EQ(found["per_label"][1]["non_manifold_edges"], 0);
}

TEST(Topology, InvertedCellDoesNotConform) {
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}};
  add_tet(mesh, {0, 1, 2, 3});
  add_tet(mesh, {0, 1, 2, 4});
  std::swap(mesh.tets.nodes[1][0], mesh.tets.nodes[1][1]);
  EXPECT_EQ(topology_of(mesh)["conforming"], false);
}

TEST(Topology, ThreeCellsAtAFacetDoNotConform) {
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}, {.1, .1, 2}};
  add_tet(mesh, {0, 1, 2, 3});
  add_tet(mesh, {0, 1, 2, 4});
  add_tet(mesh, {0, 1, 2, 5});
  EXPECT_EQ(topology_of(mesh)["conforming"], false);
}

Mesh hex_with_lid(bool pyramid) {
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},    {0, 0, 1},
                 {1, 0, 1}, {1, 1, 1}, {0, 1, 1}, {.5, .5, 1.5}};
  mesh.hexes.add({0, 1, 2, 3, 4, 5, 6, 7}, 1);
  if (pyramid) {
    mesh.pyramids.add({4, 5, 6, 7, 8}, 1);
  } else {
    add_tet(mesh, {4, 5, 6, 8});
    add_tet(mesh, {4, 6, 7, 8});
  }
  return mesh;
}

TEST(Topology, QuadMeetsQuadsOnly) {
  const auto good = topology_of(hex_with_lid(true));
  EXPECT_EQ(good["conforming"], true);
  EXPECT_EQ(good["components"], 1);
  EXPECT_EQ(good["non_manifold_edges"], 0);
  EXPECT_EQ(topology_of(hex_with_lid(false))["conforming"], false);
}

TEST(Topology, CrossedQuadsDoNotMatch) {
  // The second hex runs the shared quad's vertices in an order that crosses.
  Mesh mesh = hex_with_lid(true);
  mesh.pyramids.nodes[0] = {4, 6, 5, 7, 8};
  const auto found = topology_of(mesh);
  EXPECT_EQ(found["components"], 2);
}

TEST(Topology, HangingVerticesAreFound) {
  // One tet above, two below that halve its base at the middle of an edge.
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 1}, {0, 0, -1}, {1, 1, 0}};
  add_tet(mesh, {0, 1, 2, 3});
  add_tet(mesh, {0, 1, 5, 4});
  add_tet(mesh, {0, 5, 2, 4});
  const auto found = topology_of(mesh);
  EXPECT_EQ(found["hanging_vertices"], 1);
  EXPECT_EQ(found["conforming"], false);
}

TEST(Topology, CoincidentVerticesHang) {
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}};
  add_tet(mesh, {0, 1, 2, 3});
  add_tet(mesh, {4, 5, 6, 7});
  EXPECT_EQ(topology_of(mesh)["hanging_vertices"], 6);
}

// A label image of what `inside` says of each voxel.
LabelImage image_of(const Index3& size, const std::function<int(int, int, int)>& inside) {
  LabelImage image = test::empty_image(size, {1, 1.5, .7}, {0, 3, 8});
  for (std::size_t v = 0; v < image.voxels.size(); ++v) {
    const Index3 at = image.frame.index_of(v);
    image.voxels[v] = static_cast<MaterialId>(inside(at[0], at[1], at[2]));
  }
  return image;
}

nlohmann::json label_row(const LabelImage& image, std::size_t row) {
  return test::judge(test::kuhn_mesh(image), image, {false, false})["topology"]["per_label"][row];
}

void expect_betti(const nlohmann::json& row, const nlohmann::json& expected) {
  EXPECT_EQ(row["betti"], expected);
  EXPECT_EQ(row["image_betti"], expected);
  EXPECT_EQ(row["image_open_betti"], expected);
  EXPECT_EQ(row["betti_as_image"], true);
  const int euler = expected[0].get<int>() - expected[1].get<int>() + expected[2].get<int>();
  EXPECT_EQ(row["euler"], euler);
  EXPECT_EQ(row["image_euler"], euler);
}

double radius(int i, int j, int k, double centre) {
  return std::hypot(i - centre, j - centre, k - centre);
}

TEST(Betti, Ball) {
  expect_betti(
      label_row(image_of({12, 12, 12}, [](int i, int j, int k) { return radius(i, j, k, 5.5) < 4; }), 0),
      {1, 0, 0});
}

TEST(Betti, NestedShellsAndTheUnionOfThem) {
  // A core (3) in a shell (8) with a gap between: the shell has one cavity, both together one more part.
  const LabelImage image = image_of({16, 16, 16}, [](int i, int j, int k) {
    const double r = radius(i, j, k, 7.5);
    return r < 2.5 ? 1 : r > 4.2 && r < 6.5 ? 2 : 0;
  });
  const auto topology = test::judge(test::kuhn_mesh(image), image, {false, false})["topology"];
  expect_betti(topology["per_label"][0], {1, 0, 0});
  expect_betti(topology["per_label"][1], {1, 0, 1});
  expect_betti(topology["all_labels"], {2, 0, 1});
}

TEST(Betti, TorusAndItsFilledHole) {
  const LabelImage image = image_of({19, 19, 9}, [](int i, int j, int k) {
    const double ring = std::hypot(i - 9, j - 9);
    return std::hypot(ring - 6, k - 4) < 2.4 ? 1 : ring < 7 && k == 4 ? 2 : 0;
  });
  const auto topology = test::judge(test::kuhn_mesh(image), image, {false, false})["topology"];
  expect_betti(topology["per_label"][0], {1, 1, 0});
  expect_betti(topology["all_labels"], {1, 0, 0});
}

TEST(Betti, AtTheBordersOfTheImage) {
  // A tube along z that fills the image's length, and one block that fills the image.
  expect_betti(label_row(image_of({7, 7, 5}, [](int i, int j, int) { return i == 3 && j == 3 ? 0 : 1; }), 0),
               {1, 1, 0});
  expect_betti(label_row(image_of({3, 4, 5}, [](int, int, int) { return 1; }), 0), {1, 0, 0});
}

TEST(Betti, ContactsAtAnEdgeAreAmbiguous) {
  const auto row = label_row(
      image_of({4, 4, 3}, [](int i, int j,
                             int k) { return k == 1 && ((i == 1 && j == 1) || (i == 2 && j == 2)) ? 1 : 0; }),
      0);
  EXPECT_EQ(row["betti"], nlohmann::json({1, 0, 0}));
  EXPECT_EQ(row["image_betti"], nlohmann::json({1, 0, 0}));
  EXPECT_EQ(row["image_open_betti"], nlohmann::json({2, 0, 0}));
  EXPECT_EQ(row["image_ambiguous_places"], 2);
  EXPECT_EQ(row["betti_as_image"], true);
}

// Ranks over the field of two elements, by elimination of the boundary matrices of a small tet mesh.
class HomologyOracle {
 public:
  explicit HomologyOracle(const std::vector<std::array<VertexId, 4>>& tets) {
    for (const auto& tet : tets) {
      for (unsigned subset = 1; subset < 16; ++subset) {
        std::vector<VertexId> simplex;
        for (unsigned n = 0; n < 4; ++n)
          if ((subset >> n & 1U) != 0) simplex.push_back(tet[n]);
        std::sort(simplex.begin(), simplex.end());
        simplices_[simplex.size() - 1].insert(simplex);
      }
    }
  }
  [[nodiscard]] std::array<std::int64_t, 3> betti() const {
    std::array<std::int64_t, 5> rank{};
    for (std::size_t d = 1; d < 4; ++d) rank[d] = rank_of(d);
    std::array<std::int64_t, 3> result;
    for (std::size_t d = 0; d < 3; ++d)
      result[d] = static_cast<std::int64_t>(simplices_[d].size()) - rank[d] - rank[d + 1];
    return result;
  }

 private:
  using Simplex = std::vector<VertexId>;
  [[nodiscard]] std::int64_t rank_of(std::size_t d) const {
    std::map<Simplex, std::set<Simplex>> by_pivot;
    for (const Simplex& simplex : simplices_[d]) {
      std::set<Simplex> column;
      for (std::size_t skipped = 0; skipped <= d; ++skipped) {
        Simplex face = simplex;
        face.erase(face.begin() + static_cast<std::ptrdiff_t>(skipped));
        column.insert(face);
      }
      while (!column.empty()) {
        const auto [at, fresh] = by_pivot.try_emplace(*column.rbegin(), column);
        if (fresh) break;
        for (const Simplex& face : std::set<Simplex>(at->second))
          if (!column.insert(face).second) column.erase(face);
      }
    }
    return static_cast<std::int64_t>(by_pivot.size());
  }
  std::array<std::set<Simplex>, 4> simplices_;
};

TEST(Betti, NoiseAgreesWithTheVoxelsAndWithLinearAlgebra) {
  std::mt19937 random(5);
  int known = 0, cavities = 0, tunnels = 0;
  for (int round = 0; round < 40; ++round) {
    const unsigned sparse = 2 + random() % 4;
    const LabelImage image = image_of({4, 4, 3}, [&](int, int, int) {
      return random() % 5 < sparse ? 1 + static_cast<int>(random() % 7 == 0) : 0;
    });
    const Mesh mesh = test::kuhn_mesh(image);
    const nlohmann::json topology = test::judge(mesh, image, {false, false})["topology"];
    for (const auto& row : topology["per_label"]) {
      if (row["betti"].is_null()) continue;
      ++known;
      std::vector<std::array<VertexId, 4>> tets;
      for (std::size_t t = 0; t < mesh.tets.size(); ++t)
        if (mesh.tets.labels[t] == row["label"]) tets.push_back(mesh.tets.nodes[t]);
      const auto expected = HomologyOracle(tets).betti();
      EXPECT_EQ(row["betti"], expected);
      EXPECT_EQ(row["image_betti"], expected);
      EXPECT_EQ(row["euler"], expected[0] - expected[1] + expected[2]);
      cavities += expected[2] > 0 ? 1 : 0;
      tunnels += expected[1] > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(known, 25);
  EXPECT_GT(cavities, 1);
  EXPECT_GT(tunnels, 8);
}

TEST(Betti, OpenSetIsTheDualOfTheComplement) {
  // In a box of background the closed voxels' complement is the open rest: Alexander's duality in the box.
  std::mt19937 random(6);
  for (int round = 0; round < 20; ++round) {
    const auto inside = [&random](int i, int j, int k) {
      return i > 0 && j > 0 && k > 0 && i < 6 && j < 5 && k < 5 && random() % 2 == 0 ? 1 : 0;
    };
    const LabelImage image = image_of({7, 6, 6}, inside);
    LabelImage rest = image;
    for (std::size_t v = 0; v < rest.voxels.size(); ++v)
      rest.voxels.set(v, static_cast<MaterialId>(1 - image.voxels[v]));
    const auto closed = image_topology(image).per_material[1].closed.b;
    const auto open = image_topology(rest).per_material[1].open.b;
    // The rest is a ball less the set: a part more for each cavity, a tunnel for each tunnel, a cavity for
    // each part.
    EXPECT_EQ(open[0], closed[2] + 1);
    EXPECT_EQ(open[1], closed[1]);
    EXPECT_EQ(open[2], closed[0]);
  }
}

TEST(Betti, MixedCells) {
  const auto good = topology_of(hex_with_lid(true))["all_labels"];
  EXPECT_EQ(good["betti"], nlohmann::json({1, 0, 0}));
  EXPECT_EQ(good["euler"], 1);
}

TEST(Topology, DuplicateAndUnusedVertices) {
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}, {0, 0, -1}, {9, 9, 9}};
  add_tet(mesh, {0, 1, 2, 3});
  add_tet(mesh, {4, 1, 2, 5});
  const auto found = topology_of(mesh);
  EXPECT_EQ(found["duplicate_vertices"], 1);
  EXPECT_EQ(found["unused_vertices"], 1);
  EXPECT_EQ(found["conforming"], false);
}

TEST(Topology, FaultsOfFacetsAreCounted) {
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, -1}, {.1, .1, 2}};
  add_tet(mesh, {0, 1, 2, 3});
  add_tet(mesh, {0, 1, 2, 4});
  EXPECT_EQ(topology_of(mesh)["misoriented_facets"], 0);
  std::swap(mesh.tets.nodes[1][0], mesh.tets.nodes[1][1]);
  EXPECT_EQ(topology_of(mesh)["misoriented_facets"], 1);
  add_tet(mesh, {0, 1, 2, 5});
  const auto found = topology_of(mesh);
  EXPECT_EQ(found["overfull_facets"], 1);
  EXPECT_TRUE(found["all_labels"]["betti"].is_null());
}

}  // namespace
}  // namespace cbc3d::metrics
