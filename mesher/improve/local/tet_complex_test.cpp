// The changing mesh: what it knows of its stars, rings and facets, against what the list of tets says.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "mesher/improve/local/testing_box.hpp"
#include "mesher/improve/local/tet_complex.hpp"
#include "mesher/testing/mesh_checks.hpp"

namespace cbc3d {
namespace {

using testing::Box;

double volume_of_complex(const TetComplex& mesh) {
  double sum = 0;
  for (TetId t = 0; t < mesh.tet_slots(); ++t) {
    if (mesh.alive(t)) {
      const auto& n = mesh.nodes(t);
      sum += six_volumes(mesh.point(n[0]), mesh.point(n[1]), mesh.point(n[2]), mesh.point(n[3])) / 6;
    }
  }
  return sum;
}

/// Every neighbour is the one that tet_neighbours finds, every vertex in use has a tet and the others none.
void expect_consistent(const TetComplex& mesh) {
  TetNodes tets;
  std::vector<TetId> slot;
  std::vector<std::uint8_t> used(mesh.vertex_count(), 0);
  for (TetId t = 0; t < mesh.tet_slots(); ++t) {
    if (mesh.alive(t)) {
      tets.push_back(mesh.nodes(t));
      slot.push_back(t);
      for (const VertexId v : mesh.nodes(t)) used[v] = 1;
    }
  }
  const auto neighbours = tet_neighbours(tets, mesh.vertex_count());
  std::size_t wrong = 0;
  for (std::size_t t = 0; t < tets.size(); ++t) {
    for (unsigned n = 0; n < 4; ++n) {
      const TetId expected = neighbours[t][n] == kNoTet ? kNoTet : slot[neighbours[t][n]];
      wrong += mesh.across(slot[t], n) != expected ? 1 : 0;
    }
  }
  EXPECT_EQ(wrong, 0U);
  for (VertexId v = 0; v < mesh.vertex_count(); ++v) {
    EXPECT_EQ(mesh.in_use(v), used[v] != 0) << v;
  }
}

TEST(TetComplex, StarsFacetsAndMaterialsAreThoseOfTheTets) {
  const Box box(4, [](const Vec3& c) { return c.x < 2 ? 1 : c.y < 2 ? 2 : 3; });
  const TetComplex mesh = box.complex();
  const auto around = tets_of_vertices(box.tets, box.points.size());
  const auto neighbours = tet_neighbours(box.tets, box.points.size());
  const auto sets = vertex_materials(box.tets, box.materials, neighbours, box.points.size());
  std::vector<TetId> star;
  std::vector<VertexId> joined;
  std::vector<FacetAt> facets;
  std::size_t corners = 0;
  for (VertexId v = 0; v < box.points.size(); ++v) {
    mesh.star(v, star);
    mesh.neighbours(v, star, joined);
    mesh.facets(v, star, facets);
    const std::set<TetId> expected(around.cells.begin() + around.first[v],
                                   around.cells.begin() + around.first[v + 1]);
    EXPECT_EQ(std::set<TetId>(star.begin(), star.end()), expected);
    EXPECT_EQ(star.size(), expected.size());  // each once
    std::set<VertexId> nodes;
    for (const TetId t : expected) nodes.insert(box.tets[t].begin(), box.tets[t].end());
    nodes.erase(v);
    EXPECT_EQ(std::set<VertexId>(joined.begin(), joined.end()), nodes);
    EXPECT_EQ(joined.size(), nodes.size());
    const MaterialSet set = mesh.materials(v, star);
    EXPECT_EQ(set.ids, sets[v].ids);
    EXPECT_EQ(set.size, sets[v].size);
    for (const FacetAt& f : facets) {
      EXPECT_GT(f.inner, f.outer);
      // Counter-clockwise seen from outside: the facet's normal points away from an inner tet that has it.
      const auto inner = std::find_if(star.begin(), star.end(), [&](TetId t) {
        return mesh.material(t) == f.inner && mesh.has_node(t, f.first) && mesh.has_node(t, f.second);
      });
      ASSERT_NE(inner, star.end());
      const Vec3& x = mesh.point(v);
      const Vec3 normal = (mesh.point(f.first) - x).cross(mesh.point(f.second) - x);
      for (const VertexId w : mesh.nodes(*inner)) {
        EXPECT_LE(normal.dot(mesh.point(w) - x), 1e-12);
      }
    }
    corners += facets.size();
  }
  // 96 squares outside, 4 x 4 at x = 2 and 2 x 4 at y = 2, two triangles each, three corners each.
  EXPECT_EQ(corners, 3U * 2U * (96 + 16 + 8));
}

TEST(TetComplex, RingsAreOrderedAndPositive) {
  const Box box(3);
  const TetComplex mesh = box.complex();
  std::set<std::array<VertexId, 2>> outside;
  for (const testing::FaceKey& f : testing::surface_of_label(box.tets, box.materials, MaterialId{1})) {
    outside.insert({{f[0], f[1]}, {f[0], f[2]}, {f[1], f[2]}});
  }
  EdgeRing ring;
  std::size_t open = 0;
  std::size_t closed = 0;
  for (VertexId a = 0; a < box.points.size(); ++a) {
    for (VertexId b = 0; b < box.points.size(); ++b) {
      std::set<TetId> expected;
      for (TetId t = 0; a != b && t < box.tets.size(); ++t) {
        if (mesh.has_node(t, a) && mesh.has_node(t, b)) expected.insert(t);
      }
      if (a == b || !mesh.ring(a, b, ring)) {
        EXPECT_TRUE(expected.empty());
        continue;
      }
      EXPECT_EQ(std::set<TetId>(ring.tets.begin(), ring.tets.end()), expected);
      EXPECT_EQ(ring.tets.size(), expected.size());
      EXPECT_EQ(ring.closed, outside.count({std::min(a, b), std::max(a, b)}) == 0);
      ASSERT_EQ(ring.vertices.size(), ring.tets.size() + (ring.closed ? 0 : 1));
      for (std::size_t i = 0; i < ring.tets.size(); ++i) {
        const VertexId p = ring.vertices[i];
        const VertexId q = ring.vertices[(i + 1) % ring.vertices.size()];
        EXPECT_TRUE(mesh.has_node(ring.tets[i], p) && mesh.has_node(ring.tets[i], q));
        EXPECT_GT(six_volumes(mesh.point(a), mesh.point(b), mesh.point(p), mesh.point(q)), 0);
      }
      ++(ring.closed ? closed : open);
    }
  }
  EXPECT_GT(open, 100U);
  EXPECT_GT(closed, 100U);
}

TEST(TetComplex, ReplaceKeepsVolumeAndNeighboursThroughRandomOperations) {
  // Splits at a centroid, flips of two tets to three and back, and collapses onto a neighbour, wherever all
  // stays positive.
  for (const std::uint32_t seed : {1U, 2U, 3U}) {
    std::mt19937 random(seed);
    const Box box(3, [](const Vec3& c) { return c.z < 1.5 ? 1 : 2; });
    TetComplex mesh = box.complex();
    std::array<int, 4> done{};
    std::vector<TetId> star;
    std::vector<FreshTet> fresh;
    EdgeRing ring;
    const auto positive = [&](const FreshTet& f) {
      return six_volumes(mesh.point(f.nodes[0]), mesh.point(f.nodes[1]), mesh.point(f.nodes[2]),
                         mesh.point(f.nodes[3])) > 1e-4;
    };
    for (int step = 0; step < 3000; ++step) {
      TetId t = static_cast<TetId>(random() % mesh.tet_slots());
      while (!mesh.alive(t)) t = static_cast<TetId>(random() % mesh.tet_slots());
      const auto nodes = mesh.nodes(t);
      const VertexId a = nodes[random() % 4];
      VertexId b = nodes[random() % 4];
      while (b == a) b = nodes[random() % 4];
      fresh.clear();
      std::vector<TetId> old;
      const std::size_t kind = random() % 4;
      if (kind == 0) {
        const VertexId v = mesh.add_vertex(0.25 * (mesh.point(nodes[0]) + mesh.point(nodes[1]) +
                                                   mesh.point(nodes[2]) + mesh.point(nodes[3])));
        for (std::size_t n = 0; n < 4; ++n) {
          fresh.push_back({nodes, mesh.material(t)});
          fresh.back().nodes[n] = v;
        }
        old = {t};
      } else if (kind == 1) {
        ASSERT_TRUE(mesh.ring(a, b, ring));
        if (!ring.closed || ring.tets.size() != 3) continue;
        const VertexId p = ring.vertices[0];
        fresh = {{{p, ring.vertices[1], ring.vertices[2], b}, mesh.material(ring.tets[0])},
                 {{p, ring.vertices[2], ring.vertices[1], a}, mesh.material(ring.tets[0])}};
        old = ring.tets;
      } else if (kind == 2) {
        const unsigned n = mesh.node_index(t, a);
        const TetId other = mesh.across(t, n);
        if (other == kNoTet || mesh.material(other) != mesh.material(t)) continue;
        VertexId apex = a;
        for (const VertexId w : mesh.nodes(other)) {
          apex = mesh.has_node(t, w) ? apex : w;
        }
        for (std::size_t i = 0; i < 3; ++i) {
          const VertexId p = nodes[kTetFace[n][i]];
          const VertexId q = nodes[kTetFace[n][(i + 1) % 3]];
          fresh.push_back({{a, apex, p, q}, mesh.material(t)});
        }
        if (!positive(fresh[0])) {
          for (FreshTet& f : fresh) std::swap(f.nodes[2], f.nodes[3]);
        }
        old = {t, other};
      } else {
        mesh.star(a, star);
        std::vector<FacetAt> facets;
        mesh.facets(a, star, facets);
        if (!facets.empty()) continue;  // would change the box
        for (const TetId s : star) {
          if (!mesh.has_node(s, b)) {
            fresh.push_back({mesh.nodes(s), mesh.material(s)});
            fresh.back().nodes[mesh.node_index(s, a)] = b;
          }
        }
        old = star;
      }
      if (!std::all_of(fresh.begin(), fresh.end(), positive)) continue;
      double volume_old = 0;
      for (const TetId s : old) {
        const auto& n = mesh.nodes(s);
        volume_old += six_volumes(mesh.point(n[0]), mesh.point(n[1]), mesh.point(n[2]), mesh.point(n[3]));
      }
      double volume_new = 0;
      for (const FreshTet& f : fresh) {
        volume_new += six_volumes(mesh.point(f.nodes[0]), mesh.point(f.nodes[1]), mesh.point(f.nodes[2]),
                                  mesh.point(f.nodes[3]));
      }
      if (std::abs(volume_new - volume_old) > 1e-9) continue;  // does not fill the same space
      done[kind] += mesh.replace(old, fresh) ? 1 : 0;
      if (step % 100 == 0) expect_consistent(mesh);
    }
    expect_consistent(mesh);
    EXPECT_NEAR(volume_of_complex(mesh), 27, 1e-9);
    for (std::size_t kind = 0; kind < done.size(); ++kind) {
      EXPECT_GT(done[kind], 2) << "seed " << seed << " kind " << kind;
    }
  }
}

TEST(TetComplex, ReplaceRefusesAFaceOfThreeTets) {
  const Box box(2);
  TetComplex mesh = box.complex();
  std::vector<TetId> star;
  mesh.star(13, star);  // the middle
  // A corner tet is to be replaced by one that lies on a face which two others have.
  const TetId inner = star[0];
  const auto nodes = mesh.nodes(inner);
  TetId far = 0;
  while (mesh.has_node(far, 13) || mesh.across(far, 0) == inner) ++far;
  const double volume = volume_of_complex(mesh);
  const std::array<TetId, 1> old = {far};
  const VertexId apex = mesh.add_vertex({0.3, 0.4, 0.5});
  const unsigned n = mesh.node_index(inner, 13);
  const auto& face = kTetFace[(n + 1) % 4];  // has the middle, so both its sides are taken
  const std::array<FreshTet, 1> fresh = {{{{nodes[face[0]], nodes[face[1]], nodes[face[2]], apex}, 1}}};
  EXPECT_FALSE(mesh.replace(old, fresh));
  EXPECT_TRUE(mesh.alive(far));
  EXPECT_FALSE(mesh.in_use(apex));
  EXPECT_EQ(volume_of_complex(mesh), volume);
  expect_consistent(mesh);
}

TEST(TetComplex, ALockedFaceIsNotMadeAnew) {
  // Two patches might both make it. Two tets on a common edge's ring: 3 -> 2 makes the face of the ring.
  const std::vector<Vec3> points = {{0, 0, -1}, {0, 0, 1}, {1, 0, 0}, {-0.5, 0.9, 0}, {-0.5, -0.9, 0}};
  const TetNodes tets = {{0, 1, 2, 3}, {0, 1, 3, 4}, {0, 1, 4, 2}};
  for (const bool locked : {false, true}) {
    const std::uint8_t l = locked ? 1 : 0;
    TetComplex mesh(points, tets, {1, 1, 1}, {0, 0, l, l, l});
    const std::array<TetId, 3> old = {0, 1, 2};
    const std::array<FreshTet, 2> fresh = {{{{2, 3, 4, 1}, 1}, {{2, 4, 3, 0}, 1}}};
    EXPECT_EQ(mesh.replace(old, fresh), !locked);
    expect_consistent(mesh);
  }
}

}  // namespace
}  // namespace cbc3d
