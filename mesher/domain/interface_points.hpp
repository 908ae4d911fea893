// Boundary voxels, each with the interface it is to have nearby, and which vertices of a mesh lie there.
//
// Notation: point  the centre of a voxel together with its material and that of a face neighbour which is
//                  another; outside the image is background;
//           host   a vertex where tets of both materials meet, within reach of the point.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesher/core/label_image.hpp"
#include "mesher/core/mesh.hpp"
#include "mesher/topology/tet_adjacency.hpp"

namespace cbc3d {

/// The distinct materials around a vertex, ascending; the outside counts as background.
struct MaterialSet {
  static constexpr std::size_t kCapacity = 8;
  std::array<MaterialId, kCapacity> ids{};
  std::uint8_t size = 0;
  bool overflow = false;  ///< more than kCapacity; the lowest are kept

  void add(MaterialId material);
  [[nodiscard]] bool has(MaterialId material) const {
    for (std::uint8_t i = 0; i < size; ++i) {
      if (ids[i] == material) {
        return true;
      }
    }
    return false;
  }
};

/// The materials of the tets round every vertex, background included where a face has no neighbour.
std::vector<MaterialSet> vertex_materials(const TetNodes& tets, const std::vector<MaterialId>& materials,
                                          const TetNeighbours& neighbours, std::size_t vertex_count);

/// Renews the sets of the vertices that are `touched` (one flag a vertex, as long as `sets`). Parallel.
void renew_vertex_materials(const TetNodes& tets, const std::vector<MaterialId>& materials,
                            const TetNeighbours& neighbours, const std::vector<std::uint8_t>& touched,
                            std::vector<MaterialSet>& sets);

/// True when every two of the materials meet, at least by a corner of voxels, within `reach_mm` of a place.
bool all_meet_near(const LabelImage& image, const Vec3& local_mm, const MaterialSet& set, double reach_mm);

struct InterfacePoint {
  std::array<float, 3> centre_mm;  ///< local
  MaterialId own;                  ///< never background
  MaterialId other;                ///< across one face of the voxel or more

  [[nodiscard]] Vec3 centre() const { return {centre_mm[0], centre_mm[1], centre_mm[2]}; }
  [[nodiscard]] bool is_on(const MaterialSet& set) const { return set.has(own) && set.has(other); }
};

/// The points of an image in the order of its voxels. Parallel.
std::vector<InterfacePoint> interface_points(const LabelImage& image);

/// The nearest host of every point, kNoVertex where there is none within reach. Parallel.
std::vector<VertexId> nearest_hosts(const std::vector<InterfacePoint>& points,
                                    const std::vector<Vec3>& vertices, const std::vector<MaterialSet>& sets,
                                    double reach_mm);

/// Finds some host for every point whose entry of `hosts` is none or no longer one; kNoVertex where there is
/// none within reach. Returns the indices of the points without, ascending. Parallel. `hosts` is empty or
/// what an earlier call with the same points and reach left, of vertices that have not moved.
std::vector<std::size_t> renew_hosts(const std::vector<InterfacePoint>& points,
                                     const std::vector<Vec3>& vertices, const std::vector<MaterialSet>& sets,
                                     double reach_mm, std::vector<VertexId>& hosts);

/// The indices of the points that have no host within reach, ascending. Parallel.
std::vector<std::size_t> points_without_host(const std::vector<InterfacePoint>& points,
                                             const std::vector<Vec3>& vertices,
                                             const std::vector<MaterialSet>& sets, double reach_mm);

}  // namespace cbc3d
