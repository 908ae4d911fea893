// Source and target points of the deformation (paper, section "Extraction of source and target points").
//
// Notation: s  source: a vertex on the mesh surface or on an interface;
//           t  target: a boundary voxel of the image;
//           material set: the materials that meet at a point, background included; points with equal sets
//           correspond.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "mesher/topology/interface_facets.hpp"
#include "mesher/topology/material_set.hpp"

namespace cbc3d {

/// Which neighbours of an accepted target voxel are barred from becoming targets.
enum class Connectivity { vertex, edge, face, no };

/// Numbers material sets, so that equality is one comparison.
class MaterialSets {
 public:
  std::uint32_t number_of(const MaterialSet& set);
  [[nodiscard]] const MaterialSet& operator[](std::uint32_t number) const { return sets_[number]; }

 private:
  struct Hash {
    std::size_t operator()(const MaterialSet& set) const;
  };
  std::unordered_map<MaterialSet, std::uint32_t, Hash> numbers_;
  std::vector<MaterialSet> sets_;
};

struct SourcePoint {
  VertexId vertex;
  std::uint32_t set;
  bool two_sided;  ///< exactly two materials meet, so that the surface has a normal
};

/// The sources of a mesh, ascending by vertex, with the interface facets at each: facets[first[s]] ...
struct SourcePoints {
  std::vector<SourcePoint> sources;
  std::vector<InterfaceFacet> interface;
  std::vector<std::uint32_t> first;
  std::vector<std::uint32_t> facets;
};

SourcePoints extract_source_points(const MaterialMesh& mesh, const VertexCells& around, MaterialSets& sets);

/// Eight bytes: the search for displacements reads hundreds for every source.
struct TargetPoint {
  static constexpr std::uint32_t kMostSets = 1U << 25U;

  std::int32_t i;          ///< voxel index along x; (j, k) is told by the row
  std::uint32_t set : 25;  ///< below kMostSets
  /// Bit 2 * axis (+ 1): the face towards smaller (larger) indices has another material behind.
  std::uint32_t faces : 6;
  std::uint32_t lower_side : 1;  ///< the voxel's material is the lower of a set of two
};

/// Target points in rows of voxels: targets[first[r]] ... of row r = k * size_y + j, ascending in i.
struct TargetPoints {
  std::vector<std::uint64_t> first;
  std::vector<TargetPoint> targets;
};

/// The boundary voxels of the labelled materials thinned by `connectivity`: in raster order, x fastest, an
/// accepted voxel bars its 26 (vertex), 18 (edge) or 6 (face) neighbours; "no" accepts all. A boundary voxel
/// has a face neighbour of another material; its set are the materials in its 26-neighbourhood. Same result
/// at any thread count.
TargetPoints extract_target_points(const LabelImage& image, Connectivity connectivity, MaterialSets& sets);

}  // namespace cbc3d
