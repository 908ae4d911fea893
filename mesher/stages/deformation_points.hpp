// Source and target points of the deformation (paper, section "Extraction of source and target points").
//
// Notation: s  source: a vertex on the mesh surface or on an interface;
//           t  target: a boundary voxel of the image;
//           label set: the materials that meet at a point, background included; only points with equal sets
//           are matched.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <vector>

#include "mesher/stages/material_mesh.hpp"

namespace cbc3d {

/// Which neighbours of an accepted target voxel are barred from becoming targets.
enum class Connectivity { vertex, edge, face, no };

/// Where a target lies.
enum class TargetPosition {
  voxel_centre,  ///< the paper's: the centre of the boundary voxel, half a voxel inside the boundary
  voxel_faces,   ///< the centres of the voxel's faces towards other materials, as far as they look the way of
                ///< the source's surface: on the boundary, and the far side of a thin wall or wire pulls
                ///< nothing
};

/// Numbers label sets, so that equality is one comparison.
class LabelSets {
 public:
  /// The number of a set given as ascending distinct materials.
  std::uint32_t number_of(const std::vector<MaterialId>& set);

 private:
  std::map<std::vector<MaterialId>, std::uint32_t> numbers_;
};

struct SourcePoint {
  VertexId vertex;
  std::uint32_t set;
  bool two_sided;  ///< exactly two materials meet, so that the surface has a normal
};

/// A mesh face between two materials, nodes ordered so that its right-hand normal points from the lower
/// material number to the higher.
using InterfaceFace = std::array<VertexId, 3>;

/// All interface and surface faces of a mesh; those between two labelled materials occur twice.
std::vector<InterfaceFace> interface_faces(const MaterialMesh& mesh);

/// The source points of a mesh, ascending by vertex.
std::vector<SourcePoint> extract_source_points(const MaterialMesh& mesh, LabelSets& sets);

struct TargetPoint {
  std::int32_t i;  ///< voxel index along x; (j, k) is told by the row
  std::uint32_t set;
  std::uint8_t
      faces;  ///< bit 2 * axis (+ 1): the face towards smaller (larger) indices has another material behind
  bool lower_side;  ///< the voxel's material is the lower of a set of two
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
