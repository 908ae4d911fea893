// The judgement of a mesh in memory for programs that link the library: the main figures as a struct, and all
// of them as text.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "mesher/core/label_image.hpp"
#include "mesher/core/mesh.hpp"
#include "mesher/core/progress.hpp"

namespace cbc3d::metrics {

/// What is measured beyond what is always measured.
struct EvaluateMeshOptions {
  bool smooth = true;       ///< distances to, and smoothness against, the smooth surfaces of the labels
  bool certified = true;    ///< certified bounds of the surface Hausdorff distances
  double tolerance_mm = 0;  ///< upper less lower bound; 0: 2 % of the smallest voxel spacing
};

/// Figures of a mesh against the image that it was made from. One that the mesh cannot have is empty. The
/// conventions stand in metrics/README.md.
struct MeshEvaluation {
  std::size_t vertices = 0, tets = 0, pyramids = 0, wedges = 0, hexes = 0;
  std::size_t inverted = 0;  ///< cells of no positive volume
  std::optional<double> min_dihedral_deg, max_dihedral_deg;
  std::optional<double> min_scaled_jacobian;

  /// The Hausdorff distance of the paper, the largest of any label: the mesh's surface vertices against the
  /// centres of the boundary voxels.
  std::optional<double> hausdorff_mm;
  std::optional<double> surface_hausdorff_mm;      ///< of the surfaces themselves, from samples
  std::optional<double> mean_distance_mm;          ///< of the surfaces
  std::optional<double> dice_min;                  ///< of the worst label
  std::optional<double> volume_error_percent_max;  ///< of the worst label, without sign
  std::vector<Label> missing_labels;               ///< labels of the image that the mesh lacks

  bool conforming = false;  ///< cells meet in whole facets, edges and vertices
  std::size_t components = 0;
  std::size_t non_manifold_edges = 0, non_manifold_vertices = 0;
  std::size_t self_intersections = 0;  ///< pairs of facets
  std::vector<std::string> faults;     ///< what is wrong with the mesh, one line for each finding

  std::string json;  ///< all figures: the object that `cbc3d-bench evaluate --json` writes
};

/// Judges `mesh` (physical LPS mm) against `image`. The figures do not depend on the thread count. Throws
/// InputError when a cell names a vertex that does not exist or a coordinate is not finite, Cancelled when
/// `observer` returns false.
MeshEvaluation evaluate_mesh(const Mesh& mesh, const LabelImage& image,
                             const EvaluateMeshOptions& options = {}, const ProgressObserver& observer = {});

}  // namespace cbc3d::metrics
