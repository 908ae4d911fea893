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

#include "mesher/domain/image_boundary.hpp"
#include "mesher/domain/interface_points.hpp"
#include "mesher/improve/surface/relabel_tets.hpp"
#include "mesher/topology/material_mesh.hpp"

namespace cbc3d {

inline constexpr double kReachDiagonals = 1.06;  ///< where a surface vertex is to be, by default

struct ImproveOptions {
  bool enabled = false;
  double min_dihedral_deg = 20;  ///< goal: no dihedral angle below this, none above 180 degrees minus it
  double reach_mm = 0;           ///< every boundary voxel keeps a surface vertex so near; 0: kReachDiagonals
  double deviation_diagonals = 0.35;  ///< facets stay so near to the boundary, voxel diagonals
  double surface_weight =
      1000;  ///< pull to the boundary against the tets' shape, distances in voxel diagonals
  /// In [0,1]: how much of the pull to the boundary goes to smooth surfaces, see RelaxOptions; 0: none.
  double smoothness = 0;
  double smoothness_cap_mm = 0;  ///< smoothness moves no vertex farther from the boundary; 0: .2 diagonals,
                                 ///< deviation_diagonals at most
  std::map<Label, double> size_mm;  ///< the decimation makes no edge of these labels longer
  /// No inner vertex vanishes for edges longer than those of the nearest interface and this times the way to
  /// there, about (see graded_sizes); interfaces thin out as ever. Below 0: no limit.
  double gradation = -1;
  /// Collapses may leave angles so far below the goal, though not below half of it, to what follows them.
  double collapse_leeway_deg = 7.5;
  int decimation_rounds = 6;  ///< at most, see kFewerShare; 0: as many tets as before
  int repair_rounds = 12;     ///< at most; they end when the goal is reached
  int untangle_rounds = 3;    ///< at most, before all else, while a tet is flat or inside out
  bool only_bad = false;  ///< only tets below the goal and what is round them; no relaxation, no decimation
  /// The reach is no larger than the largest distance of a point within reach was, and points beyond it are
  /// kept from growing lonelier: the distances of a finished mesh are not given away for fewer elements.
  bool keep_distances = false;
  ImageBoundaryOptions boundary;
};

/// What a mesh is improved towards.
struct ImproveTarget {
  const Boundary& boundary;
  const std::vector<InterfacePoint>& points;  ///< to be kept within reach of a surface vertex; may be empty
  double scale_mm = 1;                        ///< unit of distances from the boundary: the voxel diagonal
  double deviation_mm = 0.15;                 ///< facets stay so near to the boundary
  double reach_mm = kReachDiagonals;          ///< of a surface vertex
  std::vector<double> longest_mm = {};        ///< edges of each material; empty: no limit
  bool keep_distances = false;                ///< as in ImproveOptions
  std::function<bool(const InterfacePoint&)> is_thin = {};  ///< in a part that wears away easily; may be null
  double thin_reach_mm = 0;                                 ///< for these
  std::function<void(const MaterialMesh&)> correct =
      {};                                ///< moves the boundary by what the volumes lack; may be null
  std::vector<VertexId> hosts = {};      ///< of the points, where known; else they are looked for
  std::vector<double> volumes_mm3 = {};  ///< of every material, balanced in the end; empty: as they come
  double largest_change_mm3 = 8;         ///< RelabelOptions::largest_mm3
  ImagePlaces places = {};               ///< without them no tet changes its material in the end
};

struct ImproveReport {
  int rounds = 0;
  std::size_t tets_before = 0, tets_after = 0;
  double min_dihedral_before_deg = 0, min_dihedral_after_deg = 0;
  std::size_t boundary_points = 0;
  std::size_t uncovered_points = 0;  ///< without a surface vertex in reach in the end
  std::size_t tets_relabelled = 0;   ///< in the end: strays, and what could not be drawn apart
  std::size_t crossings_left = 0;    ///< pairs of facets between labels, or outer ones, that cut each other
  std::size_t faults_left = 0;       ///< places where a surface is not as it should be, see MendReport
  /// Seconds by part: hosts, untangling, fitting, volumes, decimation, repair, crossings, mending.
  std::vector<std::pair<std::string, double>> part_seconds;
};

/// Improves a mesh of tets (local mm) towards `target`. Same result at any thread count. Tets that are not
/// positive are untangled where that is possible, and else stay.
ImproveReport improve_mesh(MaterialMesh& mesh, const ImproveTarget& target, const ImproveOptions& options,
                           const std::function<void(int round)>& on_round);

/// The same towards the boundary that `image` means, volumes corrected.
ImproveReport improve_mesh(MaterialMesh& mesh, const LabelImage& image, const ImproveOptions& options,
                           const std::function<void(int round)>& on_round);

}  // namespace cbc3d
