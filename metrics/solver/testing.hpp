// Meshes that the solver's tests make themselves.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "mesher/core/mesh.hpp"

namespace cbc3d::solver::test {

/// Vertices of a grid of n x n x n cubes in the unit cube; those inside are moved by up to `shake` cube
/// sides, always the same way. Label 1 left of x = .5, 2 right of it.
class Grid {
 public:
  Grid(int n, double shake) : n_(n) {
    std::uint32_t state = 1;
    const auto random = [&state] {
      state = state * 1664525U + 1013904223U;
      return static_cast<double>(state >> 8U) / (1U << 23U) - 1;
    };
    const double side = 1.0 / n;
    for (int k = 0; k <= n; ++k) {
      for (int j = 0; j <= n; ++j) {
        for (int i = 0; i <= n; ++i) {
          const bool inside = i > 0 && j > 0 && k > 0 && i < n && j < n && k < n;
          Vec3 move{random(), random(), random()};
          move *= inside ? shake * side : 0;
          mesh.points.push_back(Vec3{i * side, j * side, k * side} + move);
        }
      }
    }
  }

  [[nodiscard]] VertexId at(int i, int j, int k) const {
    return static_cast<VertexId>((k * (n_ + 1) + j) * (n_ + 1) + i);
  }
  [[nodiscard]] Label label(int i) const { return 2 * i < n_ ? 1 : 2; }
  /// The cube's vertices in the order of a hex.
  [[nodiscard]] std::array<VertexId, 8> cube(int i, int j, int k) const {
    return {at(i, j, k),     at(i + 1, j, k),     at(i + 1, j + 1, k),     at(i, j + 1, k),
            at(i, j, k + 1), at(i + 1, j, k + 1), at(i + 1, j + 1, k + 1), at(i, j + 1, k + 1)};
  }

  Mesh mesh;

 private:
  int n_;
};

/// Each cube as six tets around its diagonal (Kuhn).
inline Mesh cube_of_tets(int n, double shake = 0) {
  Grid grid(n, shake);
  constexpr std::array<std::array<int, 2>, 6> kBetween = {{{1, 2}, {2, 3}, {3, 7}, {7, 4}, {4, 5}, {5, 1}}};
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const auto c = grid.cube(i, j, k);
        for (const auto& b : kBetween) {
          const auto node = [&](int m) { return c[static_cast<std::size_t>(m)]; };
          grid.mesh.tets.add({c[0], node(b[0]), node(b[1]), c[6]}, grid.label(i));
        }
      }
    }
  }
  return grid.mesh;
}

/// Columns of hexes, of wedges and of cubes cut into six pyramids, by turns; of those at the bottom, the
/// lowest pyramid is cut into two tets.
inline Mesh cube_of_all_kinds(int n, double shake = 0) {
  Grid grid(n, shake);
  Mesh& mesh = grid.mesh;
  constexpr std::array<std::array<std::size_t, 4>, 5> kFaces = {
      {{0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}, {4, 5, 6, 7}}};
  const auto add_pyramids = [&](const std::array<VertexId, 8>& c, bool bottom, Label label) {
    Vec3 middle{};
    for (const VertexId v : c) {
      middle += mesh.points[v] / 8;
    }
    const auto apex = static_cast<VertexId>(mesh.points.size());
    mesh.points.push_back(middle);
    // Seen from within, a face's vertices turn the other way.
    for (const auto& f : kFaces) {
      mesh.pyramids.add({c[f[3]], c[f[2]], c[f[1]], c[f[0]], apex}, label);
    }
    if (bottom) {
      mesh.tets.add({c[0], c[1], c[2], apex}, label);
      mesh.tets.add({c[0], c[2], c[3], apex}, label);
    } else {
      mesh.pyramids.add({c[0], c[1], c[2], c[3], apex}, label);
    }
  };
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const auto c = grid.cube(i, j, k);
        const Label label = grid.label(i);
        if ((i + j) % 3 == 0) {
          mesh.hexes.add(c, label);
        } else if ((i + j) % 3 == 1) {
          mesh.wedges.add({c[0], c[1], c[2], c[4], c[5], c[6]}, label);
          mesh.wedges.add({c[0], c[2], c[3], c[4], c[6], c[7]}, label);
        } else {
          add_pyramids(c, k == 0, label);
        }
      }
    }
  }
  return mesh;
}

/// Unit directions and triangles of an icosahedron whose triangles are cut in four `levels` times, turning
/// counter-clockwise seen from outside.
struct Icosphere {
  std::vector<Vec3> directions;
  std::vector<std::array<VertexId, 3>> triangles;

  explicit Icosphere(int levels) {
    const double g = (1 + std::sqrt(5)) / 2;
    for (const Vec3& p : {Vec3{-1, g, 0},
                          {1, g, 0},
                          {-1, -g, 0},
                          {1, -g, 0},
                          {0, -1, g},
                          {0, 1, g},
                          {0, -1, -g},
                          {0, 1, -g},
                          {g, 0, -1},
                          {g, 0, 1},
                          {-g, 0, -1},
                          {-g, 0, 1}}) {
      directions.push_back(p.normalized());
    }
    triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                 {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                 {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    for (int level = 0; level < levels; ++level) {
      refine();
    }
  }

 private:
  void refine() {
    std::map<std::pair<VertexId, VertexId>, VertexId> middles;
    const auto middle = [&](VertexId a, VertexId b) {
      const auto [found, is_new] =
          middles.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<VertexId>(directions.size()));
      if (is_new) {
        directions.push_back((directions[a] + directions[b]).normalized());
      }
      return found->second;
    };
    std::vector<std::array<VertexId, 3>> finer;
    for (const auto& [a, b, c] : triangles) {
      const VertexId ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    triangles.swap(finer);
  }
};

/// A ball, or a shell, of spherical layers of cells: icospheres at ascending radii, wedges between them cut
/// into three tets each; where the first radius is 0, tets up to the centre. `labels` has one per gap between
/// radii.
inline Mesh layered_ball(int levels, const std::vector<double>& radii, const std::vector<Label>& labels,
                         const Vec3& centre = {}) {
  const Icosphere sphere(levels);
  const auto per_sphere = static_cast<VertexId>(sphere.directions.size());
  Mesh mesh;
  for (const double radius : radii) {
    for (const Vec3& direction : sphere.directions) {
      mesh.points.push_back(centre + radius * direction);
    }
  }
  for (std::size_t gap = 0; gap + 1 < radii.size(); ++gap) {
    const auto inner = static_cast<VertexId>(gap) * per_sphere, outer = inner + per_sphere;
    for (const auto& triangle : sphere.triangles) {
      // From the lowest vertex on, so that both sides of a quad cut it alike; the turn stays.
      auto t = triangle;
      std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
      if (radii[gap] == 0) {
        mesh.tets.add({inner, outer + t[0], outer + t[1], outer + t[2]}, labels[gap]);
        continue;
      }
      // The vertex of a quad with the lower number has the diagonal from the inner sphere.
      const bool swapped = t[1] > t[2];
      mesh.tets.add({inner + t[0], outer + t[0], outer + t[1], outer + t[2]}, labels[gap]);
      if (swapped) {
        mesh.tets.add({inner + t[0], inner + t[1], inner + t[2], outer + t[1]}, labels[gap]);
        mesh.tets.add({inner + t[0], outer + t[1], inner + t[2], outer + t[2]}, labels[gap]);
      } else {
        mesh.tets.add({inner + t[0], inner + t[1], inner + t[2], outer + t[2]}, labels[gap]);
        mesh.tets.add({inner + t[0], inner + t[1], outer + t[2], outer + t[1]}, labels[gap]);
      }
    }
  }
  for (auto& c : mesh.tets.nodes) {
    if (six_volumes(mesh.points[c[0]], mesh.points[c[1]], mesh.points[c[2]], mesh.points[c[3]]) < 0) {
      std::swap(c[2], c[3]);
    }
  }
  return mesh;
}

/// `count` + 1 radii from one to another, evenly.
inline void append_radii(std::vector<double>& radii, std::vector<Label>& labels, double to, int count,
                         Label label) {
  const double from = radii.back();
  for (int i = 1; i <= count; ++i) {
    radii.push_back(from + (to - from) * i / count);
    labels.push_back(label);
  }
}

}  // namespace cbc3d::solver::test
