// Small images and mesh checks that the mesher's tests share.
#pragma once

#include <cmath>
#include <cstdint>
#include <functional>
#include <random>

#include "mesher/core/label_image.hpp"
#include "mesher/core/mesh.hpp"
#include "mesher/topology/cell_quality.hpp"

namespace cbc3d::testing {

/// An image filled voxel by voxel from its local position; `materials` labelled ones get the labels 1, 2, ...
inline LabelImage make_image(const Index3& size, const Vec3& spacing_mm, int materials,
                             const std::function<int(const Vec3&)>& material_at) {
  LabelImage image;
  image.frame.size = size;
  image.frame.spacing_mm = spacing_mm;
  image.voxels.resize(image.frame.voxel_count());
  for (Label label = 1; label <= materials; ++label) {
    image.labels.push_back(label);
  }
  for (std::size_t v = 0; v < image.voxels.size(); ++v) {
    const Index3 at = image.frame.index_of(v);
    image.voxels[v] = static_cast<MaterialId>(material_at(image.frame.local_centre(at[0], at[1], at[2])));
  }
  return image;
}

inline Vec3 centre_of(const LabelImage& image) {
  return {0.5 * (image.frame.size[0] - 1) * image.frame.spacing_mm.x,
          0.5 * (image.frame.size[1] - 1) * image.frame.spacing_mm.y,
          0.5 * (image.frame.size[2] - 1) * image.frame.spacing_mm.z};
}

/// A ball of material 1 with, when core_mm > 0, a concentric core of material 2.
inline LabelImage ball_image(int size, double spacing_mm, double radius_mm, double core_mm = 0) {
  const double c = 0.5 * (size - 1) * spacing_mm;
  return make_image({size, size, size}, {spacing_mm, spacing_mm, spacing_mm}, core_mm > 0 ? 2 : 1,
                    [=](const Vec3& p) {
                      const double r = (p - Vec3{c, c, c}).norm();
                      return r <= core_mm ? 2 : r <= radius_mm ? 1 : 0;
                    });
}

inline LabelImage touching_balls() {
  return make_image({26, 18, 18}, {1, 1, 1}, 2, [](const Vec3& p) {
    return (p - Vec3{8.2, 8.6, 8.5}).norm() < 6.1 ? 1 : (p - Vec3{17, 8.4, 8.7}).norm() < 6.3 ? 2 : 0;
  });
}

/// Label 1: a ball with a cavity (two spheres); label 2: a torus that goes around nothing.
inline LabelImage cavity_and_torus() {
  return make_image({42, 26, 18}, {1, 1, 1}, 2, [](const Vec3& p) {
    const double r = (p - Vec3{9, 12, 8.5}).norm();
    const Vec3 q = p - Vec3{29, 12.5, 8.5};
    const double ring = std::hypot(q.x, q.y) - 7;
    return r < 7 && r > 3 ? 1 : std::hypot(ring, q.z) < 2.8 ? 2 : 0;
  });
}

/// Blocks of labels with noise, so that many tets are pure and many are not.
inline LabelImage noisy_blocks_image(int materials, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::vector<int> of_block(512);
  for (int& m : of_block) {
    m = static_cast<int>(random() % static_cast<unsigned>(materials + 1));
  }
  return make_image({32, 28, 24}, {1, 0.9, 1.3}, materials, [&](const Vec3& p) {
    const auto block = static_cast<std::size_t>(p.x / 9) * 64 + static_cast<std::size_t>(p.y / 9) * 8 +
                       static_cast<std::size_t>(p.z / 9);
    return random() % 200 == 0 ? 1 : of_block[block];
  });
}

/// A block of two materials, so that there are an interface and coarse insides.
inline LabelImage block_image() {
  return make_image({56, 44, 44}, {1, 1, 1}, 2, [](const Vec3& p) {
    const bool inside = p.x > 2 && p.x < 53 && p.y > 2 && p.y < 41 && p.z > 2 && p.z < 41;
    return !inside ? 0 : p.x + 0.2 * p.y < 30 ? 1 : 2;
  });
}

/// Seeded noise of the given density over two materials, with an empty rim.
inline LabelImage noise_image(int size, double density, std::uint32_t seed) {
  std::mt19937 random(seed);
  LabelImage image = make_image({size, size, size}, {1, 1, 1}, 2, [](const Vec3&) { return 0; });
  for (std::size_t v = 0; v < image.voxels.size(); ++v) {
    const Index3 at = image.frame.index_of(v);
    const bool rim = std::min({at[0], at[1], at[2]}) == 0 || std::max({at[0], at[1], at[2]}) == size - 1;
    const double draw = random() / 4294967296.0;
    image.voxels[v] = static_cast<MaterialId>(rim || draw >= density ? 0 : draw < density / 2 ? 1 : 2);
  }
  return image;
}

/// The frame turned about an oblique axis and shifted; left-handed when `flipped`.
inline ImageFrame oblique(ImageFrame frame, bool flipped) {
  const double a = 0.4;
  const double b = 0.7;
  const Mat3 rz{{Vec3{std::cos(a), -std::sin(a), 0}, Vec3{std::sin(a), std::cos(a), 0}, Vec3{0, 0, 1}}};
  const Mat3 rx{{Vec3{1, 0, 0}, Vec3{0, std::cos(b), -std::sin(b)}, Vec3{0, std::sin(b), std::cos(b)}}};
  frame.direction = rz * rx;
  if (flipped) {
    frame.direction =
        Mat3::from_columns(-frame.direction.column(0), frame.direction.column(1), frame.direction.column(2));
  }
  frame.origin_mm = {-31, 12, 155};
  return frame;
}

inline double smallest_dihedral_deg(const Mesh& mesh) {
  double smallest = 180;
  for (const auto& n : mesh.tets.nodes) {
    smallest = std::min(smallest, min_dihedral_deg(mesh.points[n[0]], mesh.points[n[1]], mesh.points[n[2]],
                                                   mesh.points[n[3]]));
  }
  return smallest;
}

inline double volume_of(const Mesh& mesh, Label label) {
  double sum = 0;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto& n = mesh.tets.nodes[t];
    if (mesh.tets.labels[t] == label) {
      sum += six_volumes(mesh.points[n[0]], mesh.points[n[1]], mesh.points[n[2]], mesh.points[n[3]]) / 6;
    }
  }
  return sum;
}

}  // namespace cbc3d::testing
