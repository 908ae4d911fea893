#include "mesher/stages/deformation_points.hpp"

#include <algorithm>
#include <array>

namespace cbc3d {

std::uint32_t LabelSets::number_of(const std::vector<MaterialId>& set) {
  return numbers_.try_emplace(set, static_cast<std::uint32_t>(numbers_.size())).first->second;
}

namespace {

void sort_unique(std::vector<MaterialId>& set) {
  std::sort(set.begin(), set.end());
  set.erase(std::unique(set.begin(), set.end()), set.end());
}

/// Marks the vertices of faces between different materials (1) and of faces without a second tet (2).
std::vector<std::uint8_t> interface_vertices(const MaterialMesh& mesh) {
  const auto neighbours = tet_neighbours(mesh.tets, mesh.points.size());
  std::vector<std::uint8_t> mark(mesh.points.size(), 0);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (std::size_t n = 0; n < 4; ++n) {
      const TetId across = neighbours[t][n];
      const bool outside = across == kNoTet;
      if (outside || mesh.materials[across] != mesh.materials[t]) {
        for (const std::uint8_t corner : kTetFace[n]) {
          mark[mesh.tets[t][corner]] |= outside ? 3U : 1U;
        }
      }
    }
  }
  return mark;
}

bool is_target_voxel(const LabelImage& image, int i, int j, int k) {
  return image.at(i, j, k) != kBackground && is_boundary_voxel(image, i, j, k);
}

/// The neighbours that come earlier in raster order and, when accepted, bar a voxel.
std::vector<Index3> barring_neighbours(Connectivity connectivity) {
  std::vector<Index3> offsets;
  const int most_steps = connectivity == Connectivity::vertex ? 3
                         : connectivity == Connectivity::edge ? 2
                                                              : 1;
  for (int k = -1; k <= 0; ++k) {
    for (int j = -1; j <= 1; ++j) {
      for (int i = -1; i <= 1; ++i) {
        const bool earlier = k < 0 || (k == 0 && (j < 0 || (j == 0 && i < 0)));
        if (earlier && std::abs(i) + std::abs(j) + std::abs(k) <= most_steps) {
          offsets.push_back({i, j, k});
        }
      }
    }
  }
  return offsets;
}

/// The boundary voxels by rows, found in parallel.
std::vector<std::vector<int>> boundary_rows(const LabelImage& image) {
  const auto& size = image.frame.size;
  std::vector<std::vector<int>> rows(static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(size[2]));
#pragma omp parallel for schedule(dynamic, 64)
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const int j = static_cast<int>(r % static_cast<std::size_t>(size[1]));
    const int k = static_cast<int>(r / static_cast<std::size_t>(size[1]));
    for (int i = 0; i < size[0]; ++i) {
      if (is_target_voxel(image, i, j, k)) {
        rows[r].push_back(i);
      }
    }
  }
  return rows;
}

/// Thinning depends on what was accepted before, so it runs in raster order; it touches boundary voxels only.
void thin(std::vector<std::vector<int>>& rows, const ImageFrame& frame, Connectivity connectivity) {
  if (connectivity == Connectivity::no) {
    return;
  }
  const std::vector<Index3> barring = barring_neighbours(connectivity);
  const auto accepted = [&](int i, int j, int k) {
    if (!frame.contains(i, j, k)) {
      return false;
    }
    const auto& row = rows[static_cast<std::size_t>(k) * static_cast<std::size_t>(frame.size[1]) +
                           static_cast<std::size_t>(j)];
    return std::binary_search(row.begin(), row.end(), i);
  };
  for (int k = 0; k < frame.size[2]; ++k) {
    for (int j = 0; j < frame.size[1]; ++j) {
      auto& row = rows[static_cast<std::size_t>(k) * static_cast<std::size_t>(frame.size[1]) +
                       static_cast<std::size_t>(j)];
      std::vector<int> kept;
      for (const int i : row) {
        const bool barred = std::any_of(barring.begin(), barring.end(), [&](const Index3& o) {
          return o[1] == 0 && o[2] == 0 ? !kept.empty() && kept.back() == i + o[0]
                                        : accepted(i + o[0], j + o[1], k + o[2]);
        });
        if (!barred) {
          kept.push_back(i);
        }
      }
      row.swap(kept);
    }
  }
}

/// The faces of a voxel towards other materials, as TargetPoint::faces.
std::uint8_t open_faces(const LabelImage& image, int i, int j, int k) {
  const MaterialId own = image.at(i, j, k);
  unsigned faces = 0;
  for (unsigned f = 0; f < 6; ++f) {
    Index3 n = {i, j, k};
    n[f / 2] += f % 2 == 0 ? -1 : 1;
    faces |= image.at_or_background(n[0], n[1], n[2]) != own ? 1U << f : 0U;
  }
  return static_cast<std::uint8_t>(faces);
}

std::vector<MaterialId> materials_around(const LabelImage& image, int i, int j, int k) {
  std::vector<MaterialId> set;
  for (int dk = -1; dk <= 1; ++dk) {
    for (int dj = -1; dj <= 1; ++dj) {
      for (int di = -1; di <= 1; ++di) {
        const MaterialId m = image.at_or_background(i + di, j + dj, k + dk);
        if (std::find(set.begin(), set.end(), m) == set.end()) {
          set.push_back(m);
        }
      }
    }
  }
  std::sort(set.begin(), set.end());
  return set;
}

}  // namespace

std::vector<InterfaceFace> interface_faces(const MaterialMesh& mesh) {
  const auto neighbours = tet_neighbours(mesh.tets, mesh.points.size());
  std::vector<InterfaceFace> faces;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (std::size_t n = 0; n < 4; ++n) {
      const TetId neighbour = neighbours[t][n];
      const MaterialId across = neighbour == kNoTet ? kBackground : mesh.materials[neighbour];
      if (across == mesh.materials[t]) {
        continue;
      }
      const auto& corner = kTetFace[n];
      InterfaceFace face = {mesh.tets[t][corner[0]], mesh.tets[t][corner[1]], mesh.tets[t][corner[2]]};
      if (mesh.materials[t] > across) {
        std::swap(face[1], face[2]);
      }
      faces.push_back(face);
    }
  }
  return faces;
}

std::vector<SourcePoint> extract_source_points(const MaterialMesh& mesh, LabelSets& sets) {
  const std::vector<std::uint8_t> mark = interface_vertices(mesh);
  const VertexTets around = tets_of_vertices(mesh.tets, mesh.points.size());
  std::vector<SourcePoint> sources;
  std::vector<MaterialId> set;
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    if (mark[v] != 0) {
      set.clear();
      for (std::uint32_t a = around.first[v]; a < around.first[v + 1]; ++a) {
        set.push_back(mesh.materials[around.tets[a]]);
      }
      if ((mark[v] & 2U) != 0) {
        set.push_back(kBackground);
      }
      sort_unique(set);
      sources.push_back({static_cast<VertexId>(v), sets.number_of(set), set.size() == 2});
    }
  }
  return sources;
}

TargetPoints extract_target_points(const LabelImage& image, Connectivity connectivity, LabelSets& sets) {
  std::vector<std::vector<int>> rows = boundary_rows(image);
  thin(rows, image.frame, connectivity);
  TargetPoints points;
  points.first.assign(rows.size() + 1, 0);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const int j = static_cast<int>(r % static_cast<std::size_t>(image.frame.size[1]));
    const int k = static_cast<int>(r / static_cast<std::size_t>(image.frame.size[1]));
    for (const int i : rows[r]) {
      const std::vector<MaterialId> set = materials_around(image, i, j, k);
      points.targets.push_back(
          {i, sets.number_of(set), open_faces(image, i, j, k), image.at(i, j, k) == set.front()});
    }
    points.first[r + 1] = points.targets.size();
  }
  return points;
}

}  // namespace cbc3d
