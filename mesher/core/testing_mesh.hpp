// A mesh with a cell of every kind.
#pragma once

#include "mesher/core/mesh.hpp"

namespace cbc3d::testing {

inline Mesh one_of_each() {
  Mesh mesh;
  for (int z = 0; z <= 2; ++z) {
    for (int y = 0; y <= 1; ++y) {
      for (int x = 0; x <= 1; ++x) {
        mesh.points.push_back({1.5 * x, 1.0 * y, 0.1 + z});
      }
    }
  }
  mesh.points.push_back({0.7, 0.5, -1});
  mesh.tets.add({0, 1, 3, 5}, 3);
  mesh.pyramids.add({0, 2, 3, 1, 12}, 4);
  mesh.wedges.add({0, 1, 2, 4, 5, 6}, 5);
  mesh.hexes.add({4, 5, 7, 6, 8, 9, 11, 10}, 6);
  return mesh;
}

}  // namespace cbc3d::testing
