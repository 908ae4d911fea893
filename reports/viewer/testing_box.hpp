// A mesh of two labels and any size.
#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "mesher/core/mesh.hpp"

namespace cbc3d::reports::testing {

/// A box of `edge`^3 cubes of six tets each (Kuhn), label 1 below half its height and 2 above.
inline Mesh box(int edge) {
  constexpr std::array<std::array<int, 3>, 6> kPaths{
      {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
  Mesh mesh;
  const auto vertex = [edge](const std::array<int, 3>& p) {
    return static_cast<VertexId>(p[0] + (edge + 1) * (p[1] + (edge + 1) * p[2]));
  };
  for (int z = 0; z <= edge; ++z) {
    for (int y = 0; y <= edge; ++y) {
      for (int x = 0; x <= edge; ++x) {
        mesh.points.push_back({1.0 * x, 1.0 * y, 1.0 * z});
      }
    }
  }
  for (int cube = 0; cube < edge * edge * edge; ++cube) {
    const std::array<int, 3> corner{cube % edge, cube / edge % edge, cube / edge / edge};
    for (const auto& path : kPaths) {
      std::array<int, 3> p = corner;
      std::array<VertexId, 4> tet{vertex(p)};
      for (std::size_t n = 0; n < 3; ++n) {
        ++p[static_cast<std::size_t>(path[n])];
        tet[n + 1] = vertex(p);
      }
      if (six_volumes(mesh.points[tet[0]], mesh.points[tet[1]], mesh.points[tet[2]], mesh.points[tet[3]]) <
          0) {
        std::swap(tet[2], tet[3]);
      }
      mesh.tets.add(tet, 2 * corner[2] < edge ? 1 : 2);
    }
  }
  return mesh;
}

}  // namespace cbc3d::reports::testing
