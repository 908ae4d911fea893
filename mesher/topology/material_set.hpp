// The materials that meet at a point: at a vertex of a mesh, or around a voxel of an image.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesher/core/label_image.hpp"
#include "mesher/topology/tet_adjacency.hpp"

namespace cbc3d {

/// Distinct materials in ascending order; the outside of a mesh or image counts as background. Of more than
/// kCapacity the lowest are kept, in whatever order they are added.
struct MaterialSet {
  static constexpr std::size_t kCapacity = 8;
  std::array<MaterialId, kCapacity> ids{};
  std::uint8_t size = 0;
  bool overflow = false;  ///< some material has been left out

  void add(MaterialId material);
  [[nodiscard]] bool has(MaterialId material) const {
    for (std::uint8_t i = 0; i < size; ++i) {
      if (ids[i] == material) {
        return true;
      }
    }
    return false;
  }
  [[nodiscard]] MaterialId operator[](std::size_t i) const { return ids[i]; }
  /// True when every material of this set is in the other.
  [[nodiscard]] bool is_within(const MaterialSet& other) const;
  /// Compares the materials that are kept: two sets that both overflow may be equal and differ in the rest.
  bool operator==(const MaterialSet& other) const { return size == other.size && ids == other.ids; }
};

/// The materials of the tets around every vertex, background included where a face has no neighbour.
std::vector<MaterialSet> vertex_materials(const TetNodes& tets, const std::vector<MaterialId>& materials,
                                          const TetNeighbours& neighbours, std::size_t vertex_count);

/// Renews the sets of the vertices whose flag in `touched` is set; `touched` is as long as `sets`. Parallel.
void renew_vertex_materials(const TetNodes& tets, const std::vector<MaterialId>& materials,
                            const TetNeighbours& neighbours, const std::vector<std::uint8_t>& touched,
                            std::vector<MaterialSet>& sets);

}  // namespace cbc3d
