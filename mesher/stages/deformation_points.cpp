#include "mesher/stages/deformation_points.hpp"

#include <algorithm>
#include <array>

#include "mesher/core/voxel_rows.hpp"

namespace cbc3d {

void LabelSet::insert(MaterialId material) {
  const auto end = materials_.begin() + count_;
  const auto place = std::lower_bound(materials_.begin(), end, material);
  if (place == materials_.end() || (place != end && *place == material)) {
    return;
  }
  const bool full = count_ == kMost;
  std::copy_backward(place, full ? end - 1 : end, full ? end : end + 1);
  *place = material;
  count_ += full ? 0 : 1;
}

bool LabelSet::is_within(const LabelSet& other) const {
  return std::includes(other.materials_.begin(), other.materials_.begin() + other.count_, materials_.begin(),
                       materials_.begin() + count_);
}

std::size_t LabelSets::Hash::operator()(const LabelSet& set) const {
  std::uint64_t hash = set.size();
  for (std::size_t i = 0; i < set.size(); ++i) {
    hash = (hash ^ set[i]) * 0x9E3779B97F4A7C15U;
  }
  return hash ^ (hash >> 32U);
}

std::uint32_t LabelSets::number_of(const LabelSet& set) {
  const auto [place, is_new] = numbers_.try_emplace(set, static_cast<std::uint32_t>(sets_.size()));
  if (is_new) {
    sets_.push_back(set);
  }
  return place->second;
}

namespace {

/// Sources numbered by vertex, kNoVertex for the other vertices.
std::vector<VertexId> number_sources(const std::vector<InterfaceFacet>& interface, std::size_t vertex_count,
                                     std::vector<SourcePoint>& sources) {
  std::vector<VertexId> number(vertex_count, kNoVertex);
  for (const InterfaceFacet& facet : interface) {
    for (const VertexId v : facet.nodes) {
      if (v != kNoVertex) {
        number[v] = 0;
      }
    }
  }
  for (std::size_t v = 0; v < vertex_count; ++v) {
    if (number[v] != kNoVertex) {
      number[v] = static_cast<VertexId>(sources.size());
      sources.push_back({static_cast<VertexId>(v), 0, false});
    }
  }
  return number;
}

void gather_facets(const std::vector<VertexId>& number, SourcePoints& points) {
  points.first.assign(points.sources.size() + 1, 0);
  const auto each = [&](const auto& visit) {
    for (std::size_t f = 0; f < points.interface.size(); ++f) {
      for (const VertexId v : points.interface[f].nodes) {
        if (v != kNoVertex) {
          visit(number[v], static_cast<std::uint32_t>(f));
        }
      }
    }
  };
  each([&](VertexId s, std::uint32_t) { ++points.first[s + 1]; });
  for (std::size_t s = 0; s < points.sources.size(); ++s) {
    points.first[s + 1] += points.first[s];
  }
  points.facets.resize(points.first.back());
  std::vector<std::uint32_t> next(points.first.begin(), points.first.end() - 1);
  each([&](VertexId s, std::uint32_t f) { points.facets[next[s]++] = f; });
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
  const BoundaryRows boundary(image);
  std::vector<std::vector<int>> rows(static_cast<std::size_t>(size[1]) * static_cast<std::size_t>(size[2]));
#pragma omp parallel for schedule(dynamic, 64)
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const int j = static_cast<int>(r % static_cast<std::size_t>(size[1]));
    const int k = static_cast<int>(r / static_cast<std::size_t>(size[1]));
    boundary.find(j, k, rows[r]);
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

/// The materials of the 26-neighbourhood. Mostly there are runs of the same, so that few are inserted.
LabelSet materials_around(const LabelImage& image, int i, int j, int k) {
  const auto& size = image.frame.size;
  LabelSet set;
  MaterialId last = image.at(i, j, k);
  set.insert(last);
  const auto add = [&](MaterialId material) {
    if (material != last) {
      set.insert(material);
      last = material;
    }
  };
  const bool inside = i > 0 && j > 0 && k > 0 && i + 1 < size[0] && j + 1 < size[1] && k + 1 < size[2];
  for (int dk = -1; dk <= 1; ++dk) {
    for (int dj = -1; dj <= 1; ++dj) {
      if (inside) {
        image.voxels.visit([&](const auto* voxels) {
          const auto* const row = voxels + image.frame.offset(i - 1, j + dj, k + dk);
          add(row[0]);
          add(row[1]);
          add(row[2]);
        });
      } else {
        for (int di = -1; di <= 1; ++di) {
          add(image.at_or_background(i + di, j + dj, k + dk));
        }
      }
    }
  }
  return set;
}

}  // namespace

SourcePoints extract_source_points(const MaterialMesh& mesh, const VertexCells& around, LabelSets& sets) {
  SourcePoints points;
  points.interface = interface_facets(mesh, around);
  gather_facets(number_sources(points.interface, mesh.points.size(), points.sources), points);
  for (std::size_t s = 0; s < points.sources.size(); ++s) {
    // Every material of a star has a facet at its vertex, unless it is the only one there.
    LabelSet set;
    for (std::uint32_t f = points.first[s]; f < points.first[s + 1]; ++f) {
      set.insert(points.interface[points.facets[f]].lower);
      set.insert(points.interface[points.facets[f]].higher);
    }
    points.sources[s].set = sets.number_of(set);
    points.sources[s].two_sided = set.size() == 2;
  }
  return points;
}

TargetPoints extract_target_points(const LabelImage& image, Connectivity connectivity, LabelSets& sets) {
  std::vector<std::vector<int>> rows = boundary_rows(image);
  thin(rows, image.frame, connectivity);
  TargetPoints points;
  points.first.assign(rows.size() + 1, 0);
  for (std::size_t r = 0; r < rows.size(); ++r) {
    points.first[r + 1] = points.first[r] + rows[r].size();
  }
  points.targets.resize(points.first.back());
  std::vector<LabelSet> found(points.targets.size());
#pragma omp parallel for schedule(dynamic, 64)
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const int j = static_cast<int>(r % static_cast<std::size_t>(image.frame.size[1]));
    const int k = static_cast<int>(r / static_cast<std::size_t>(image.frame.size[1]));
    for (std::size_t n = 0; n < rows[r].size(); ++n) {
      const int i = rows[r][n];
      LabelSet& set = found[points.first[r] + n];
      set = materials_around(image, i, j, k);
      points.targets[points.first[r] + n] = {i, 0, open_faces(image, i, j, k), image.at(i, j, k) == set[0]};
    }
  }
  for (std::size_t t = 0; t < found.size(); ++t) {
    const bool as_before = t > 0 && found[t] == found[t - 1];
    points.targets[t].set = as_before ? points.targets[t - 1].set : sets.number_of(found[t]);
  }
  return points;
}

}  // namespace cbc3d
