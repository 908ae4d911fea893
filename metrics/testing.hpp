// Images and meshes whose figures are known.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "mesher/core/label_image.hpp"
#include "mesher/core/mesh.hpp"
#include "mesher/core/progress.hpp"
#include "metrics/box_tree.hpp"
#include "metrics/evaluate.hpp"

namespace cbc3d::metrics::test {

inline LabelImage empty_image(const Index3& size, const Vec3& spacing_mm, std::vector<Label> labels) {
  LabelImage image;
  image.frame.size = size;
  image.frame.spacing_mm = spacing_mm;
  image.labels = std::move(labels);
  image.voxels.assign(image.frame.voxel_count(), kBackground);
  return image;
}

inline void fill_box(LabelImage& image, const Index3& low, const Index3& high, MaterialId material) {
  for (int k = low[2]; k <= high[2]; ++k) {
    for (int j = low[1]; j <= high[1]; ++j)
      for (int i = low[0]; i <= high[0]; ++i) image.voxels[image.frame.offset(i, j, k)] = material;
  }
}

/// Two boxes of labels 1 and 7, face to face, in an anisotropic image.
inline LabelImage two_boxes() {
  LabelImage image = empty_image({9, 8, 7}, {1.0, 0.5, 2.0}, {0, 1, 7});
  fill_box(image, {2, 2, 2}, {4, 5, 4}, 1);
  fill_box(image, {5, 2, 2}, {6, 5, 4}, 2);
  return image;
}

/// The voxels of the labels themselves as six tets each (Kuhn's split, which conforms), in physical space.
inline Mesh kuhn_mesh(const LabelImage& image) {
  const ImageFrame& frame = image.frame;
  const Index3 n{frame.size[0] + 1, frame.size[1] + 1, frame.size[2] + 1};
  Mesh mesh;
  for (int k = 0; k < n[2]; ++k) {
    for (int j = 0; j < n[1]; ++j) {
      for (int i = 0; i < n[0]; ++i) {
        mesh.points.push_back(
            {(i - 0.5) * frame.spacing_mm.x, (j - 0.5) * frame.spacing_mm.y, (k - 0.5) * frame.spacing_mm.z});
      }
    }
  }
  for (std::size_t v = 0; v < image.voxels.size(); ++v) {
    if (image.voxels[v] == kBackground) continue;
    std::array<int, 3> axes{0, 1, 2};
    do {
      Index3 at = frame.index_of(v);
      std::array<VertexId, 4> tet{};
      for (std::size_t step = 0; step < 4; ++step) {
        tet[step] = static_cast<VertexId>((at[2] * n[1] + at[1]) * n[0] + at[0]);
        if (step < 3) ++at[static_cast<std::size_t>(axes[step])];
      }
      const auto& p = mesh.points;
      if (six_volumes(p[tet[0]], p[tet[1]], p[tet[2]], p[tet[3]]) < 0) std::swap(tet[2], tet[3]);
      mesh.tets.add(tet, image.labels[image.voxels[v]]);
    } while (std::next_permutation(axes.begin(), axes.end()));
  }
  map_to_physical(mesh, frame);
  return mesh;
}

/// The body-centred cubic lattice of n cubes a side: four tets around the line between the centres of every
/// two cubes that share a face.
inline Mesh bcc_block(int n, double side_mm, Label label) {
  Mesh mesh;
  const auto corner = [n](int i, int j, int k) {
    return static_cast<VertexId>((k * (n + 1) + j) * (n + 1) + i);
  };
  for (int k = 0; k <= n; ++k) {
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) mesh.points.push_back(side_mm * Vec3{double(i), double(j), double(k)});
  }
  const auto first_centre = static_cast<VertexId>(mesh.points.size());
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) mesh.points.push_back(side_mm * Vec3{i + .5, j + .5, k + .5});
  }
  const auto centre = [&](const Index3& c) {
    return first_centre + static_cast<VertexId>((c[2] * n + c[1]) * n + c[0]);
  };
  for (int cell = 0; cell < n * n * n; ++cell) {
    const Index3 low{cell % n, cell / n % n, cell / n / n};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Index3 high = low;
      if (++high[axis] == n) continue;
      std::array<Index3, 4> ring{high, high, high, high};  // around the face between the two
      const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
      ++ring[1][u], ++ring[2][u], ++ring[2][v], ++ring[3][v];
      for (std::size_t r = 0; r < 4; ++r) {
        const Index3 &a = ring[r], &b = ring[(r + 1) % 4];
        mesh.tets.add({centre(low), corner(a[0], a[1], a[2]), corner(b[0], b[1], b[2]), centre(high)}, label);
      }
    }
  }
  return mesh;
}

/// A sphere about the origin: the faces of a cube in n x n squares, blown up; convex, outward normals.
inline std::vector<Triangle> sphere_triangles(double radius, int n) {
  std::vector<Triangle> triangles;
  for (int axis = 0; axis < 3; ++axis) {
    for (const int side : {-1, 1}) {
      const auto at = [&](int u, int v) {
        Vec3 p{};
        p[axis] = side;
        // Equal angles make the squares nearly equal.
        p[(axis + 1) % 3] = std::tan(M_PI / 4 * (2.0 * u / n - 1));
        p[(axis + 2) % 3] = std::tan(M_PI / 4 * (2.0 * v / n - 1));
        return radius * p.normalized();
      };
      for (int u = 0; u < n; ++u) {
        for (int v = 0; v < n; ++v) {
          const Vec3 a = at(u, v), b = at(u + 1, v), c = at(u + 1, v + 1), d = at(u, v + 1);
          // By the diagonal that leaves the surface convex.
          const bool ac = side * six_volumes(a, b, c, d) <= 0;
          const Triangle first = ac ? Triangle{a, b, c} : Triangle{a, b, d};
          const Triangle second = ac ? Triangle{a, c, d} : Triangle{b, c, d};
          for (const Triangle& t : {first, second})
            triangles.push_back(side > 0 ? t : Triangle{t.a, t.c, t.b});
        }
      }
    }
  }
  return triangles;
}

inline nlohmann::json judge(const Mesh& mesh, const LabelImage& image, const EvaluateOptions& options = {}) {
  Progress quiet;
  return evaluate(mesh, image, options, quiet);
}

}  // namespace cbc3d::metrics::test
