// Boundary samples and the vertices of a mesh that cover them.
//
// Notation: sample  a place on the boundary of two materials: of an image the centre of a boundary voxel
// together with
//                   its material and that of a face neighbour which is another; outside the image is
//                   background;
//           covers  a vertex covers a sample when tets of both materials meet at it and it lies within the
//           reach of
//                   the sample. A sample that no vertex covers is uncovered.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesher/core/label_image.hpp"
#include "mesher/core/mesh.hpp"
#include "mesher/topology/material_set.hpp"

namespace cbc3d {

struct BoundarySample {
  std::array<float, 3> centre_mm;  ///< local
  MaterialId own;                  ///< never background
  MaterialId other;                ///< the material across one face of the voxel or more

  [[nodiscard]] Vec3 centre() const { return {centre_mm[0], centre_mm[1], centre_mm[2]}; }
  [[nodiscard]] bool is_on(const MaterialSet& set) const { return set.has(own) && set.has(other); }
};

/// The samples of an image in the order of its voxels. Parallel.
std::vector<BoundarySample> boundary_samples(const LabelImage& image);

/// The nearest vertex that covers each sample, kNoVertex for uncovered ones. `sets` has the materials around
/// every vertex. Parallel.
std::vector<VertexId> nearest_covering_vertices(const std::vector<BoundarySample>& samples,
                                                const std::vector<Vec3>& vertices,
                                                const std::vector<MaterialSet>& sets, double reach_mm);

/// Finds some covering vertex for every sample whose entry of `covering` is none or no longer covers it;
/// kNoVertex where there is none. Returns the indices of the uncovered samples, ascending. Parallel.
/// `covering` is empty or what an earlier call with the same samples and reach left, of vertices that have
/// not moved.
std::vector<std::size_t> renew_covering_vertices(const std::vector<BoundarySample>& samples,
                                                 const std::vector<Vec3>& vertices,
                                                 const std::vector<MaterialSet>& sets, double reach_mm,
                                                 std::vector<VertexId>& covering);

/// The indices of the uncovered samples, ascending. Parallel.
std::vector<std::size_t> uncovered_samples(const std::vector<BoundarySample>& samples,
                                           const std::vector<Vec3>& vertices,
                                           const std::vector<MaterialSet>& sets, double reach_mm);

}  // namespace cbc3d
