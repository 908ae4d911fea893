// The image that the tests of derived images share.
#pragma once

#include "cases/phantoms/shapes.hpp"
#include "mesher/core/label_image.hpp"

namespace cbc3d::cases::test {

/// A block of label 1 with an inner block of label 2, whose low side is at i = 7.
inline LabelImage two_blocks() {
  LabelImage image = box_image({16, 14, 12}, {1, 1, 1}, {2, 2, 2}, {12, 11, 9});
  image.labels.push_back(2);
  for (int k = 2; k <= 9; ++k) {
    for (int j = 2; j <= 11; ++j) {
      for (int i = 7; i <= 12; ++i) {
        image.voxels[image.frame.offset(i, j, k)] = 2;
      }
    }
  }
  return image;
}

inline void clear(LabelImage& image, const Index3& voxel) {
  image.voxels[image.frame.offset(voxel[0], voxel[1], voxel[2])] = kBackground;
}

}  // namespace cbc3d::cases::test
