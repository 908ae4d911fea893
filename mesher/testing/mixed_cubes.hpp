// A conforming mesh of hexes, pyramids and tets.
#pragma once

#include <algorithm>
#include <array>

#include "mesher/testing/cube_corners.hpp"
#include "mesher/topology/material_mesh.hpp"

namespace cbc3d::testing {

/// n unit cubes along each axis, by turns a hex and six pyramids around the centre; a pyramid whose base is
/// on the outside is two tets. Materials by the cube's first index: 1 below n / 2, 2 from there on.
inline MaterialMesh mixed_cubes(int n) {
  MaterialMesh mesh;
  mesh.points = cube_corners(n);
  const auto at = [n](int i, int j, int k) { return cube_corner(n, i, j, k); };
  // The sides of a hex, counter-clockwise seen from within, with the axis that they are across and the end
  // there.
  struct Side {
    std::array<std::size_t, 4> corners;
    std::size_t axis;
    bool high;
  };
  constexpr std::array<Side, 6> kSides = {{{{0, 1, 2, 3}, 2, false},
                                           {{7, 6, 5, 4}, 2, true},
                                           {{4, 5, 1, 0}, 1, false},
                                           {{5, 6, 2, 1}, 0, true},
                                           {{6, 7, 3, 2}, 1, true},
                                           {{7, 4, 0, 3}, 0, false}}};
  for (int cube = 0; cube < n * n * n; ++cube) {
    const std::array<int, 3> p = {cube % n, cube / n % n, cube / (n * n)};
    const auto [i, j, k] = p;
    const auto material = static_cast<MaterialId>(2 * i < n ? 1 : 2);
    const std::array<VertexId, 8> hex = {
        at(i, j, k),     at(i + 1, j, k),     at(i + 1, j + 1, k),     at(i, j + 1, k),
        at(i, j, k + 1), at(i + 1, j, k + 1), at(i + 1, j + 1, k + 1), at(i, j + 1, k + 1)};
    if ((i + j + k) % 2 == 0) {
      mesh.hexes.add(hex, material);
      continue;
    }
    const auto apex = static_cast<VertexId>(mesh.points.size());
    mesh.points.push_back({i + 0.5, j + 0.5, k + 0.5});
    for (const Side& side : kSides) {
      std::array<VertexId, 4> base{};
      std::transform(side.corners.begin(), side.corners.end(), base.begin(),
                     [&](std::size_t c) { return hex[c]; });
      if (p[side.axis] == (side.high ? n - 1 : 0)) {
        mesh.tets.push_back({base[0], base[1], base[2], apex});
        mesh.tets.push_back({base[0], base[2], base[3], apex});
        mesh.materials.insert(mesh.materials.end(), 2, material);
      } else {
        mesh.pyramids.add({base[0], base[1], base[2], base[3], apex}, material);
      }
    }
  }
  return mesh;
}

}  // namespace cbc3d::testing
