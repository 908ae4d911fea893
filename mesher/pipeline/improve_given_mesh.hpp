// The improvement alone, on a given mesh of labelled tets of whatever origin.
#pragma once

#include <string>
#include <vector>

#include "mesher/core/label_image.hpp"
#include "mesher/core/mesh.hpp"
#include "mesher/core/progress.hpp"
#include "mesher/improve/improve_mesh.hpp"
#include "mesher/topology/labelled_tets.hpp"
#include "mesher/topology/orient_tets.hpp"

namespace cbc3d {

/// The improvement of a mesh that may have flat and inverted tets: more rounds against those.
ImproveOptions given_mesh_defaults();

struct ImproveGivenMeshOptions {
  /// Of these the distances and what may change are set by the fields below, not by the caller.
  ImproveOptions improve = given_mesh_defaults();
  /// Every boundary voxel, or without an image every surface vertex of the input, keeps a surface vertex
  /// within this distance, and facets stay within a tenth of it. 0: as the mesh has it, at most 0.9 voxel
  /// diagonals, or half the mean surface edge.
  double max_deviation_mm = 0;
  /// The surfaces are fitted to the boundary and the mesh is thinned out; else what is below the goal is
  /// repaired and all else is left as it is.
  bool decimate = false;
};

struct ImproveGivenMeshReport {
  std::vector<Label> labels;  ///< by material; the first is background's
  OrientReport orient;
  TetMeasures before, after;
  ImproveReport improve;
  double max_deviation_mm = 0;  ///< in force
  double seconds = 0;           ///< of the improvement
  std::vector<std::string> warnings;
};

/// Improves `mesh` (physical LPS mm) towards the boundaries of `image`, or towards its own where `image` is
/// null. Throws InputError for a mesh that is not of labelled tets, and for one that does not lie where the
/// image lies.
Mesh improve_given_mesh(Mesh mesh, const LabelImage* image, const ImproveGivenMeshOptions& options,
                        const Progress& progress, ImproveGivenMeshReport& report);

}  // namespace cbc3d
