// Contacts of voxels, counted by their definition.
#pragma once

#include <cmath>

#include "mesher/core/label_image.hpp"

namespace cbc3d::testing {

/// Contacts by the definition: every pair of voxels of one label that share exactly an edge or a vertex, and
/// no voxel of the label in the smallest block that holds both.
inline std::size_t contacts_by_definition(const LabelImage& image) {
  std::size_t contacts = 0;
  const auto& size = image.frame.size;
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0]; ++i) {
        const MaterialId m = image.at(i, j, k);
        for (int step = 0; step < 27 && m != 0; ++step) {
          const Index3 d = {step % 3 - 1, step / 3 % 3 - 1, step / 9 - 1};
          const int steps = std::abs(d[0]) + std::abs(d[1]) + std::abs(d[2]);
          if (steps < 2 || step < 14 || image.at_or_background(i + d[0], j + d[1], k + d[2]) != m) {
            continue;
          }
          int same = 0;
          for (int part = 0; part < 8; ++part) {
            const Index3 o = {(part & 1) != 0 ? d[0] : 0, (part & 2) != 0 ? d[1] : 0,
                              (part & 4) != 0 ? d[2] : 0};
            same += image.at_or_background(i + o[0], j + o[1], k + o[2]) == m ? 1 : 0;
          }
          contacts += same == 2 * (8 >> steps) ? 1 : 0;  // a square is met twice among the eight parts
        }
      }
    }
  }
  return contacts;
}

}  // namespace cbc3d::testing
