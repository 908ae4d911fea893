// The parts of the improver that know no image: a tet's shape and the changing mesh.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "mesher/improve/local/tet_complex.hpp"
#include "mesher/improve/local/tet_shape.hpp"
#include "mesher/testing/mesh_checks.hpp"

namespace cbc3d {
namespace {

using Tet = std::array<Vec3, 4>;

double draw(std::mt19937& random, double low, double high) {
  return low + (high - low) * (random() / 4294967296.0);
}
Vec3 draw_point(std::mt19937& random, double low, double high) {
  const double x = draw(random, low, high);
  const double y = draw(random, low, high);
  return {x, y, draw(random, low, high)};
}

// ---- shape

const Tet kRegular = {{{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}}};

double six(const Tet& t) {
  return six_volumes(t[0], t[1], t[2], t[3]);
}

/// The dihedral angle at edge a, b between the half planes through c and d, by projection onto the plane
/// across the edge.
double dihedral(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const Vec3 along = (b - a).normalized();
  const Vec3 p = (c - a) - (c - a).dot(along) * along;
  const Vec3 q = (d - a) - (d - a).dot(along) * along;
  return std::atan2(p.cross(q).norm(), p.dot(q));
}

double smallest_sine_squared(const Tet& t) {
  constexpr std::array<std::array<std::size_t, 4>, 6> kEdges = {
      {{0, 1, 2, 3}, {0, 2, 1, 3}, {0, 3, 1, 2}, {1, 2, 0, 3}, {1, 3, 0, 2}, {2, 3, 0, 1}}};
  double smallest = 1;
  for (const auto& e : kEdges) {
    const double sine = std::sin(dihedral(t[e[0]], t[e[1]], t[e[2]], t[e[3]]));
    smallest = std::min(smallest, sine * sine);
  }
  return smallest;
}

TEST(TetShape, WorstSineIsThatOfTheDihedralAngles) {
  std::mt19937 random(1);
  int positive = 0;
  for (int i = 0; i < 2000; ++i) {
    Tet t;
    for (Vec3& p : t) {
      p = draw_point(random, -3, 3);
      p.z *= i % 2 == 0 ? 1 : 0.05;  // flat ones too
    }
    const double got = min_sine_squared(t[0], t[1], t[2], t[3]);
    const double mirrored = min_sine_squared(t[0], t[2], t[1], t[3]);
    EXPECT_NEAR(six(t) > 0 ? got : mirrored, smallest_sine_squared(t), 1e-9);
    EXPECT_EQ(six(t) > 0 ? mirrored : got, -1);
    EXPECT_NEAR(std::max(got, mirrored),
                std::max(min_sine_squared(t[1], t[3], t[2], t[0]), min_sine_squared(t[1], t[2], t[3], t[0])),
                1e-9);
    positive += six(t) > 0 ? 1 : 0;
  }
  EXPECT_GT(positive, 500);
  EXPECT_LT(positive, 1500);
}

TEST(TetShape, RegularAndFlatTets) {
  const double orientation = six(kRegular);
  const Tet t = orientation > 0 ? kRegular : Tet{kRegular[0], kRegular[2], kRegular[1], kRegular[3]};
  EXPECT_NEAR(min_sine_squared(t[0], t[1], t[2], t[3]), 8.0 / 9, 1e-12);  // the angle's cosine is 1/3
  EXPECT_NEAR(sine_squared_of_deg(std::acos(1.0 / 3) * 180 / std::numbers::pi), 8.0 / 9, 1e-12);
  EXPECT_NEAR(sine_squared_of_deg(20), sine_squared_of_deg(160), 1e-12);
  EXPECT_NEAR(shape_energy(t[0], t[1], t[2], t[3]), 1, 1e-12);
  EXPECT_NEAR(shape_energy(7 * t[0], 7 * t[1], 7 * t[2], 7 * t[3]), 1, 1e-12);  // of any size
  EXPECT_LT(shape_energy(t[0], t[2], t[1], t[3]), 0);
  const Vec3 flat = (t[0] + t[1] + t[2]) / 3;
  EXPECT_EQ(min_sine_squared(t[0], t[0], t[2], t[3]), -1);
  EXPECT_LT(shape_energy(t[0], t[1], t[2], t[0]), 0);
  EXPECT_LT(min_sine_squared(t[0], t[1], t[2], flat), 1e-20);
}

TEST(TetShape, EnergyIsLeastForTheRegularTet) {
  std::mt19937 random(2);
  for (int i = 0; i < 1000; ++i) {
    Tet t;
    for (Vec3& p : t) p = draw_point(random, -1, 1);
    if (six(t) > 0) {
      EXPECT_GE(shape_energy(t[0], t[1], t[2], t[3]), 1 - 1e-12);
    }
  }
}

double product(const std::array<double, 6>& h, const Vec3& v) {  // v' H v
  return h[0] * v.x * v.x + h[1] * v.y * v.y + h[2] * v.z * v.z +
         2 * (h[3] * v.x * v.y + h[4] * v.x * v.z + h[5] * v.y * v.z);
}

TEST(TetShape, GradientIsThatOfFiniteDifferencesAndTheHessianIsPositive) {
  std::mt19937 random(3);
  int checked = 0;
  for (int i = 0; i < 500; ++i) {
    Tet t;
    for (Vec3& p : t) p = draw_point(random, -1, 1);
    ShapeTerm term;
    const double energy = shape_energy(t[0], t[1], t[2], t[3]);
    ASSERT_EQ(add_shape_term(t[0], t[1], t[2], t[3], term), six(t) > 0);
    if (!(six(t) > 0.1)) {
      continue;
    }
    ++checked;
    EXPECT_NEAR(term.energy, energy, 1e-10 * energy);
    const Vec3 n = draw_point(random, -1, 1).normalized();
    add_plane_term(n, 0.3, 20, term);
    const auto total = [&](const Vec3& x) {
      const double offset = 0.3 + n.dot(x - t[0]);
      return shape_energy(x, t[1], t[2], t[3]) + 10 * offset * offset;
    };
    constexpr double kStep = 1e-6;
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 low = t[0];
      Vec3 high = t[0];
      low[axis] -= kStep;
      high[axis] += kStep;
      const double slope = (total(high) - total(low)) / (2 * kStep);
      EXPECT_NEAR(term.gradient[axis], slope, 1e-4 * (1 + term.gradient.norm()));
    }
    EXPECT_GT(product(term.hessian, draw_point(random, -1, 1)), 0);
    const Vec3 step = newton_step(term);
    EXPECT_LT(step.dot(term.gradient), 0);  // downhill
    EXPECT_LT(total(t[0] + 1e-4 * step), total(t[0]));
    // H step = -g, seen through an arbitrary direction.
    const Vec3 w = draw_point(random, -1, 1);
    const double across = 0.25 * (product(term.hessian, step + w) - product(term.hessian, step - w));
    EXPECT_NEAR(across, -term.gradient.dot(w), 1e-6 * (1 + term.gradient.norm()));
  }
  EXPECT_GT(checked, 100);
  EXPECT_EQ(newton_step(ShapeTerm{1, {1, 2, 3}, {}}), (Vec3{}));  // singular
}

// ---- the changing mesh

/// A box of unit cubes, six tets each round the diagonal; conforming, materials by `material_at` of the
/// centroid.
struct Box {
  std::vector<Vec3> points;
  TetNodes tets;
  std::vector<MaterialId> materials;

  explicit Box(
      int n, const std::function<int(const Vec3&)>& material_at = [](const Vec3&) { return 1; }) {
    const auto at = [&](int i, int j, int k) {
      return static_cast<VertexId>((k * (n + 1) + j) * (n + 1) + i);
    };
    for (int v = 0; v < (n + 1) * (n + 1) * (n + 1); ++v) {
      points.push_back({static_cast<double>(v % (n + 1)), static_cast<double>(v / (n + 1) % (n + 1)),
                        static_cast<double>(v / ((n + 1) * (n + 1)))});
    }
    constexpr std::array<std::array<int, 3>, 6> kOrders = {
        {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
    for (int cube = 0; cube < n * n * n; ++cube) {
      for (const auto& order : kOrders) {
        Index3 p = {cube % n, cube / n % n, cube / (n * n)};
        std::array<VertexId, 4> nodes{};
        Vec3 centroid;
        for (std::size_t s = 0; s < 4; ++s) {
          nodes[s] = at(p[0], p[1], p[2]);
          centroid += 0.25 * points[nodes[s]];
          if (s < 3) ++p[static_cast<std::size_t>(order[s])];
        }
        if (six_volumes(points[nodes[0]], points[nodes[1]], points[nodes[2]], points[nodes[3]]) < 0) {
          std::swap(nodes[2], nodes[3]);
        }
        tets.push_back(nodes);
        materials.push_back(static_cast<MaterialId>(material_at(centroid)));
      }
    }
  }
  [[nodiscard]] TetComplex complex() const {
    return {points, tets, materials, std::vector<std::uint8_t>(points.size(), 0)};
  }
};

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
    const std::set<TetId> expected(around.tets.begin() + around.first[v],
                                   around.tets.begin() + around.first[v + 1]);
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
