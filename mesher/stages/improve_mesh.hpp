// Stage "improvement and decimation", beyond the paper: fewer and better tets for the same boundaries.
//
// Vertices move, edges are removed, interfaces flipped and edges collapsed, under guards for angle, distance
// to the image's boundary, boundary voxels within reach of a surface vertex, manifoldness and the shape of
// every label's surface.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "mesher/improve/image_boundary.hpp"
#include "mesher/stages/material_mesh.hpp"

namespace cbc3d {

struct ImproveOptions {
  bool enabled = false;
  double min_dihedral_deg = 20;  ///< goal: no dihedral angle below this, none above 180 degrees minus it
  double reach_mm = 0;  ///< every boundary voxel keeps a surface vertex so near; 0: .9 voxel diagonals
  double deviation_diagonals = 0.15;  ///< facets stay so near to the boundary, voxel diagonals
  double surface_weight =
      1000;  ///< pull to the boundary against the tets' shape, distances in voxel diagonals
  std::map<Label, double> size_mm;  ///< the decimation makes no edge of these labels longer
  int decimation_rounds = 3;        ///< 0: as many tets as before
  int repair_rounds = 8;            ///< at most; they end when the goal is reached
  ImageBoundaryOptions boundary;
};

struct ImproveReport {
  int rounds = 0;
  std::size_t tets_before = 0, tets_after = 0;
  double min_dihedral_before_deg = 0, min_dihedral_after_deg = 0;
  std::size_t boundary_points = 0;
  std::size_t uncovered_points = 0;  ///< without a surface vertex in reach in the end
  std::size_t crossings_left = 0;    ///< pairs of outer facets that cut each other
  /// Seconds by part: hosts, fitting, volumes, decimation, repair, crossings.
  std::vector<std::pair<std::string, double>> part_seconds;
};

/// Improves a mesh of tets (local mm) towards `image`. Same result at any thread count.
ImproveReport improve_mesh(MaterialMesh& mesh, const LabelImage& image, const ImproveOptions& options,
                           const std::function<void(int round)>& on_round);

}  // namespace cbc3d
