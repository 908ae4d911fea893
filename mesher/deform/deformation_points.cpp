#include "mesher/deform/deformation_points.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <string>

#include "mesher/core/error.hpp"
#include "mesher/core/voxel_rows.hpp"

namespace cbc3d {

std::size_t MaterialSets::Hash::operator()(const MaterialSet& set) const {
  std::uint64_t hash = set.size;
  for (std::size_t i = 0; i < set.size; ++i) {
    hash = (hash ^ set[i]) * 0x9E3779B97F4A7C15U;
  }
  return hash ^ (hash >> 32U);
}

std::uint32_t MaterialSets::number_of(const MaterialSet& set) {
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

/// Boundary voxels by rows: i[first[r]] ... i[first[r] + count[r]) of row r, ascending.
struct BoundaryVoxels {
  std::vector<std::uint64_t> first;
  std::vector<std::uint32_t> count;
  std::vector<int> i;
};

/// Found slice by slice in parallel.
BoundaryVoxels boundary_voxels(const LabelImage& image) {
  const auto ny = static_cast<std::size_t>(image.frame.size[1]);
  const auto nz = static_cast<std::size_t>(image.frame.size[2]);
  const BoundaryRows boundary(image);
  std::vector<std::vector<int>> slices(nz);
  BoundaryVoxels all;
  all.count.resize(ny * nz);
#pragma omp parallel for schedule(dynamic)
  for (std::size_t k = 0; k < nz; ++k) {
    for (std::size_t j = 0; j < ny; ++j) {
      const std::size_t before = slices[k].size();
      boundary.find(static_cast<int>(j), static_cast<int>(k), slices[k]);
      all.count[k * ny + j] = static_cast<std::uint32_t>(slices[k].size() - before);
    }
  }
  all.first.assign(ny * nz + 1, 0);
  std::partial_sum(all.count.begin(), all.count.end(), all.first.begin() + 1, std::plus<std::uint64_t>());
  all.i.resize(all.first.back());
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < nz; ++k) {
    std::copy(slices[k].begin(), slices[k].end(),
              all.i.begin() + static_cast<std::ptrdiff_t>(all.first[k * ny]));
  }
  return all;
}

/// Thinning depends on what was accepted before, so it runs in raster order; it touches boundary voxels only.
void thin(BoundaryVoxels& voxels, const ImageFrame& frame, Connectivity connectivity) {
  if (connectivity == Connectivity::no) {
    return;
  }
  const std::vector<Index3> barring = barring_neighbours(connectivity);
  const auto row_at = [&](int j, int k) {
    return static_cast<std::size_t>(k) * static_cast<std::size_t>(frame.size[1]) +
           static_cast<std::size_t>(j);
  };
  const auto accepted = [&](int i, int j, int k) {
    if (!frame.contains(i, j, k)) {
      return false;
    }
    const int* const row = voxels.i.data() + voxels.first[row_at(j, k)];
    return std::binary_search(row, row + voxels.count[row_at(j, k)], i);
  };
  for (int k = 0; k < frame.size[2]; ++k) {
    for (int j = 0; j < frame.size[1]; ++j) {
      int* const row = voxels.i.data() + voxels.first[row_at(j, k)];
      std::uint32_t kept = 0;
      for (std::uint32_t n = 0; n < voxels.count[row_at(j, k)]; ++n) {
        const int i = row[n];
        const bool barred = std::any_of(barring.begin(), barring.end(), [&](const Index3& o) {
          return o[1] == 0 && o[2] == 0 ? kept > 0 && row[kept - 1] == i + o[0]
                                        : accepted(i + o[0], j + o[1], k + o[2]);
        });
        if (!barred) {
          row[kept++] = i;
        }
      }
      voxels.count[row_at(j, k)] = kept;
    }
  }
}

/// The face neighbours of a boundary voxel.
struct FaceNeighbours {
  std::uint32_t open = 0;          // TargetPoint::faces
  MaterialId other = kBackground;  // of one that is open
};

FaceNeighbours face_neighbours(const LabelImage& image, int i, int j, int k) {
  const MaterialId own = image.at(i, j, k);
  FaceNeighbours found;
  for (unsigned f = 0; f < 6; ++f) {
    Index3 n = {i, j, k};
    n[f / 2] += f % 2 == 0 ? -1 : 1;
    const MaterialId there = image.at_or_background(n[0], n[1], n[2]);
    found.open |= static_cast<std::uint32_t>(there != own) << f;
    found.other = there != own ? there : found.other;
  }
  return found;
}

/// The same inside the image, by the places of the neighbours.
template <typename Voxel>
FaceNeighbours face_neighbours_inside(const Voxel* at, std::ptrdiff_t row, std::ptrdiff_t slice) {
  FaceNeighbours found;
  unsigned f = 0;
  for (const std::ptrdiff_t step : {std::ptrdiff_t{-1}, std::ptrdiff_t{1}, -row, row, -slice, slice}) {
    const Voxel there = at[step];
    found.open |= static_cast<std::uint32_t>(there != *at) << f++;
    found.other = there != *at ? there : found.other;
  }
  return found;
}

/// True when all of the 26-neighbourhood are one of two materials. Without branches: in one of two images the
/// next voxel cannot be foretold.
template <typename Voxel>
bool only_two_around(const Voxel* at, std::ptrdiff_t row, std::ptrdiff_t slice, Voxel other) {
  const Voxel own = *at;
  bool third = false;
  for (const std::ptrdiff_t to_slice : {-slice, std::ptrdiff_t{0}, slice}) {
    for (const std::ptrdiff_t to_row : {-row, std::ptrdiff_t{0}, row}) {
      const Voxel* const middle = at + to_slice + to_row;
      for (int i = -1; i <= 1; ++i) {
        third |= (middle[i] != own) & (middle[i] != other);
      }
    }
  }
  return !third;
}

MaterialSet materials_around(const LabelImage& image, int i, int j, int k) {
  MaterialSet set;
  MaterialId last = image.at(i, j, k);
  set.add(last);
  for (int dk = -1; dk <= 1; ++dk) {
    for (int dj = -1; dj <= 1; ++dj) {
      for (int di = -1; di <= 1; ++di) {
        const MaterialId material = image.at_or_background(i + di, j + dj, k + dk);
        if (material != last) {  // mostly there are runs of the same
          set.add(material);
          last = material;
        }
      }
    }
  }
  return set;
}

/// The material sets of targets before they are numbered: nearly all are of two materials.
struct SetsFound {
  static constexpr std::uint32_t kMore = ~0U;
  std::vector<std::uint32_t> pairs;            // by target: the lower material above the higher; or kMore
  std::vector<std::vector<MaterialSet>> more;  // by slice, the sets of those of more than two
};

std::uint32_t pair_of(MaterialId a, MaterialId b) {
  return static_cast<std::uint32_t>(std::min(a, b)) << 16U | std::max(a, b);
}

/// A target and its pair; kMore when there are more materials around.
std::uint32_t find_target(const LabelImage& image, int i, int j, int k, TargetPoint& target) {
  const auto& size = image.frame.size;
  const std::ptrdiff_t row = size[0];
  const std::ptrdiff_t slice = row * size[1];
  const bool inside = i > 0 && j > 0 && k > 0 && i + 1 < size[0] && j + 1 < size[1] && k + 1 < size[2];
  return image.voxels.visit([&]<typename Voxel>(const Voxel* all) {
    const Voxel* const at = all + image.frame.offset(i, j, k);
    const FaceNeighbours faces =
        inside ? face_neighbours_inside(at, row, slice) : face_neighbours(image, i, j, k);
    target = {i, 0, faces.open & 63U, *at < faces.other ? 1U : 0U};
    return inside && only_two_around(at, row, slice, static_cast<Voxel>(faces.other))
               ? pair_of(*at, faces.other)
               : SetsFound::kMore;
  });
}

/// Sets all of the targets but the numbers of their sets.
SetsFound find_targets(const LabelImage& image, const BoundaryVoxels& voxels, TargetPoints& points) {
  const auto& size = image.frame.size;
  SetsFound found;
  found.pairs.resize(points.targets.size());
  found.more.resize(static_cast<std::size_t>(size[2]));
#pragma omp parallel for schedule(dynamic)
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < size[1]; ++j) {
      const std::size_t r =
          static_cast<std::size_t>(k) * static_cast<std::size_t>(size[1]) + static_cast<std::size_t>(j);
      for (std::size_t n = 0; n < voxels.count[r]; ++n) {
        const int i = voxels.i[voxels.first[r] + n];
        const std::size_t t = points.first[r] + n;
        found.pairs[t] = find_target(image, i, j, k, points.targets[t]);
        if (found.pairs[t] == SetsFound::kMore) {
          const MaterialSet set = materials_around(image, i, j, k);
          points.targets[t].lower_side = image.at(i, j, k) == set[0] ? 1U : 0U;
          found.more[static_cast<std::size_t>(k)].push_back(set);
        }
      }
    }
  }
  return found;
}

/// MaterialSets::number_of, of a target.
std::uint32_t number_of_set(MaterialSets& sets, const MaterialSet& set) {
  const std::uint32_t number = sets.number_of(set);
  if (number >= TargetPoint::kMostSets) {
    throw JobError("more than " + std::to_string(TargetPoint::kMostSets) +
                   " different sets of labels meet in this image; remove its noise first");
  }
  return number % TargetPoint::kMostSets;
}

/// In the order of the targets, so that the numbers are the same at any thread count.
void number_sets(const SetsFound& found, MaterialSets& sets, std::vector<TargetPoint>& targets) {
  std::size_t slice = 0;
  std::size_t in_slice = 0;
  const auto next_of_more = [&]() -> const MaterialSet& {
    while (in_slice == found.more[slice].size()) {
      ++slice;
      in_slice = 0;
    }
    return found.more[slice][in_slice++];
  };
  std::uint32_t last_pair = SetsFound::kMore;
  std::uint32_t last_number = 0;
  for (std::size_t t = 0; t < targets.size(); ++t) {
    const std::uint32_t pair = found.pairs[t];
    if (pair == SetsFound::kMore) {
      targets[t].set = number_of_set(sets, next_of_more()) % TargetPoint::kMostSets;
      continue;
    }
    if (pair != last_pair) {
      MaterialSet set;
      set.add(static_cast<MaterialId>(pair >> 16U));
      set.add(static_cast<MaterialId>(pair & 0xFFFFU));
      last_number = number_of_set(sets, set);
      last_pair = pair;
    }
    targets[t].set = last_number % TargetPoint::kMostSets;
  }
}

}  // namespace

SourcePoints extract_source_points(const MaterialMesh& mesh, const VertexCells& around, MaterialSets& sets) {
  SourcePoints points;
  points.interface = interface_facets(mesh, around);
  gather_facets(number_sources(points.interface, mesh.points.size(), points.sources), points);
  for (std::size_t s = 0; s < points.sources.size(); ++s) {
    // Every material of a star has a facet at its vertex, unless it is the only one there.
    MaterialSet set;
    for (std::uint32_t f = points.first[s]; f < points.first[s + 1]; ++f) {
      set.add(points.interface[points.facets[f]].lower);
      set.add(points.interface[points.facets[f]].higher);
    }
    points.sources[s].set = sets.number_of(set);
    points.sources[s].two_sided = set.size == 2;
  }
  return points;
}

TargetPoints extract_target_points(const LabelImage& image, Connectivity connectivity, MaterialSets& sets) {
  BoundaryVoxels voxels = boundary_voxels(image);
  thin(voxels, image.frame, connectivity);
  TargetPoints points;
  points.first.assign(voxels.count.size() + 1, 0);
  std::partial_sum(voxels.count.begin(), voxels.count.end(), points.first.begin() + 1,
                   std::plus<std::uint64_t>());
  points.targets.resize(points.first.back());
  const SetsFound found = find_targets(image, voxels, points);
  number_sets(found, sets, points.targets);
  return points;
}

}  // namespace cbc3d
