// Which boundary voxels, or boundary samples, of an image the vertices of a mesh cover: the refinement asks
// in every round which are still uncovered.
#pragma once

#include <cstdint>
#include <vector>

#include "mesher/core/voxel_bits.hpp"
#include "mesher/domain/image_domain.hpp"
#include "mesher/topology/tet_adjacency.hpp"

namespace cbc3d {

/// A vertex together with a labelled material whose surface it lies on.
struct SurfaceVertex {
  VertexId vertex;
  MaterialId material;
  auto operator<=>(const SurfaceVertex&) const = default;
};

/// Every (vertex, material) with the vertex on a face between that labelled material and anything else. A
/// pair may occur more than once.
std::vector<SurfaceVertex> surface_vertices(const TetNodes& tets, const TetNeighbours& neighbours,
                                            const std::vector<MaterialId>& materials);

/// The boundary voxels of an image (labelled, with a face neighbour of another material), and for each of
/// them whether a surface vertex of its own material lies within a distance of its centre.
class BoundaryCoverage {
 public:
  explicit BoundaryCoverage(const LabelImage& image);

  /// Renews the answers for a set of surface vertices at `points` (local mm). Parallel; linear in the
  /// boundary voxels and surface vertices.
  void update(const std::vector<SurfaceVertex>& surface, const std::vector<Vec3>& points, double distance_mm);

  /// True when one of the voxels [i_begin, i_end) of row (j, k) is uncovered or a face neighbour, of another
  /// material, of one that is: an interface can only appear between the two where the lattice resolves both.
  [[nodiscard]] bool wants_refinement(int j, int k, int i_begin, int i_end) const;
  /// Calls f(centre in local mm) for each of those voxels.
  template <typename F>
  void for_each_wanted(const F& f) const {
    const auto visit = [&](std::size_t v) {
      const Index3 at = image_.frame.index_of(v);
      f(image_.frame.local_centre(at[0], at[1], at[2]));
    };
    uncovered_.for_each(0, image_.frame.voxel_count(), visit);
    across_.for_each(0, image_.frame.voxel_count(), visit);
  }
  /// Number of boundary voxels without a surface vertex nearby.
  [[nodiscard]] std::size_t uncovered_count() const { return uncovered_count_; }

 private:
  /// Boundary voxels of a slice: those of row j are i[first[j]] ... i[first[j + 1] - 1], ascending.
  struct Slice {
    std::vector<std::size_t> first;
    std::vector<int> i;
  };

  void mark_across();

  const LabelImage& image_;
  VoxelBits uncovered_;        // boundary voxels only
  VoxelBits across_;           // face neighbours of uncovered voxels, of another material
  std::vector<Slice> slices_;  // the boundary voxels
  std::size_t uncovered_count_ = 0;
};

/// The same question asked for every interface, that is for every boundary sample: a boundary voxel with face
/// neighbours of several materials needs for each of them a vertex where its own and that material meet. A
/// gap of background between two labels that the mesh has closed shows here, and nowhere in the coverage of
/// either label.
class InterfaceCoverage {
 public:
  /// `domain` must outlive this.
  explicit InterfaceCoverage(const ImageDomain& domain);

  /// Renews the answers; `sets` are the materials around the vertices at `points`. From one update to the
  /// next vertices may be added, but none moves, and the distance stays the same.
  void update(const std::vector<MaterialSet>& sets, const std::vector<Vec3>& points, double distance_mm);

  /// True when one of the voxels (i_begin ... i_end - 1, j, k) has an uncovered sample, or lies across its
  /// face.
  [[nodiscard]] bool wants_refinement(int j, int k, int i_begin, int i_end) const {
    const std::size_t row = image_.frame.offset(0, j, k);
    return wanted_.any(row + static_cast<std::size_t>(i_begin), row + static_cast<std::size_t>(i_end));
  }
  /// Calls f(centre in local mm) for each of those voxels.
  template <typename F>
  void for_each_wanted(const F& f) const {
    wanted_.for_each(0, image_.frame.voxel_count(), [&](std::size_t v) {
      const Index3 at = image_.frame.index_of(v);
      f(image_.frame.local_centre(at[0], at[1], at[2]));
    });
  }
  [[nodiscard]] std::size_t uncovered_count() const { return uncovered_; }
  [[nodiscard]] std::size_t sample_count() const { return samples_.size(); }

 private:
  void want(const BoundarySample& sample);

  const LabelImage& image_;
  const std::vector<BoundarySample>& samples_;
  std::vector<VertexId> covering_;  // vertex of each sample, as the last update found it
  VoxelBits wanted_;
  std::size_t uncovered_ = 0;
};

}  // namespace cbc3d
