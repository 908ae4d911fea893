#include "mesher/topology/material_set.hpp"

#include <omp.h>

#include <algorithm>

#include "mesher/core/parallel.hpp"

namespace cbc3d {

void MaterialSet::add(MaterialId material) {
  if (size == 1 && ids[0] == material) {  // the most frequent case
    return;
  }
  const auto end = ids.begin() + size;
  const auto place = std::lower_bound(ids.begin(), end, material);
  if (place != end && *place == material) {
    return;
  }
  const bool is_full = size == kCapacity;
  overflow = overflow || is_full;
  if (place == ids.end()) {
    return;
  }
  std::move_backward(place, is_full ? end - 1 : end, is_full ? end : end + 1);
  *place = material;
  size = static_cast<std::uint8_t>(size + (is_full ? 0 : 1));
}

bool MaterialSet::is_within(const MaterialSet& other) const {
  return std::includes(other.ids.begin(), other.ids.begin() + other.size, ids.begin(), ids.begin() + size);
}

std::vector<MaterialSet> vertex_materials(const TetNodes& tets, const std::vector<MaterialId>& materials,
                                          const TetNeighbours& neighbours, std::size_t vertex_count) {
  std::vector<MaterialSet> sets(vertex_count);
  renew_vertex_materials(tets, materials, neighbours, std::vector<std::uint8_t>(vertex_count, 1), sets);
  return sets;
}

void renew_vertex_materials(const TetNodes& tets, const std::vector<MaterialId>& materials,
                            const TetNeighbours& neighbours, const std::vector<std::uint8_t>& touched,
                            std::vector<MaterialSet>& sets) {
  const std::vector<std::uint32_t> concerned = indices_where(tets.size(), [&](std::size_t t) {
    const auto& n = tets[t];
    return (touched[n[0]] | touched[n[1]] | touched[n[2]] | touched[n[3]]) != 0;
  });
  const auto parts = static_cast<std::size_t>(std::min(8, omp_get_max_threads()));
#pragma omp parallel for schedule(static, 1)
  for (std::size_t part = 0; part < parts; ++part) {
    // Every thread passes over all these tets for its range of vertices: no two threads write the same set.
    const auto begin = static_cast<VertexId>(part * sets.size() / parts);
    const auto end = static_cast<VertexId>((part + 1) * sets.size() / parts);
    const auto is_mine = [&](VertexId v) { return v >= begin && v < end && touched[v] != 0; };
    for (VertexId v = begin; v < end; ++v) {
      sets[v] = touched[v] != 0 ? MaterialSet{} : sets[v];
    }
    for (const std::uint32_t t : concerned) {
      for (std::size_t n = 0; n < 4; ++n) {
        if (is_mine(tets[t][n])) {
          sets[tets[t][n]].add(materials[t]);
        }
        if (neighbours[t][n] == kNoTet && materials[t] != kBackground) {
          for (const std::uint8_t face : kTetFace[n]) {
            if (is_mine(tets[t][face])) {
              sets[tets[t][face]].add(kBackground);
            }
          }
        }
      }
    }
  }
}

}  // namespace cbc3d
