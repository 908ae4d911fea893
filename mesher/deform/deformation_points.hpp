// Source and target points of the deformation (paper, section "Extraction of source and target points").
//
// Notation: s  source: a vertex on the mesh surface or on an interface;
//           t  target: a boundary voxel of the image;
//           label set: the materials that meet at a point, background included; points with equal sets
//           correspond.
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "mesher/topology/interface_facets.hpp"

namespace cbc3d {

/// Which neighbours of an accepted target voxel are barred from becoming targets.
enum class Connectivity { vertex, edge, face, no };

/// The distinct materials that meet at a point, ascending. Of more than kMost the lowest are kept; a set is
/// full of those from then on, so that such points still correspond to each other.
class LabelSet {
 public:
  static constexpr std::size_t kMost = 8;

  void insert(MaterialId material);
  [[nodiscard]] std::size_t size() const { return count_; }
  [[nodiscard]] MaterialId operator[](std::size_t i) const { return materials_[i]; }
  /// True when every material of this set is in the other.
  [[nodiscard]] bool is_within(const LabelSet& other) const;
  bool operator==(const LabelSet&) const = default;

 private:
  std::array<MaterialId, kMost> materials_{};
  std::uint8_t count_ = 0;
};

/// Numbers label sets, so that equality is one comparison.
class LabelSets {
 public:
  std::uint32_t number_of(const LabelSet& set);
  [[nodiscard]] const LabelSet& operator[](std::uint32_t number) const { return sets_[number]; }

 private:
  struct Hash {
    std::size_t operator()(const LabelSet& set) const;
  };
  std::unordered_map<LabelSet, std::uint32_t, Hash> numbers_;
  std::vector<LabelSet> sets_;
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

SourcePoints extract_source_points(const MaterialMesh& mesh, const VertexCells& around, LabelSets& sets);

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
TargetPoints extract_target_points(const LabelImage& image, Connectivity connectivity, LabelSets& sets);

}  // namespace cbc3d
