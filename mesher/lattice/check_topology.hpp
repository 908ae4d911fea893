// Stage "Mesh topological checks" (paper, section "Adaptive Lattice Refinement"): every label's sub-mesh a
// manifold, and without small components.
//
// The paper refines around non-manifold places and admits that this need not converge. Here refinement comes
// first (refine_lattice, while its bounds allow it) and what is left is relabelled, in a way that always
// ends: labels are ranked, background highest, then the smaller the label the higher, and a tet only ever
// changes to a label of higher rank. At a vertex where the surface of label m is non-manifold:
//   - m falls into pieces and no higher label is in the star: all lower tets of the star become m;
//   - m falls into pieces otherwise: all pieces but the largest go to the highest label of the star;
//   - the rest falls into pieces: those without a higher label become m; if two or more are left, m leaves
//   the star for
//     the highest label.
// Each step raises the sum of ranks, which is bounded, and while a vertex is not manifold a step is possible;
// the rule of the candidate mesh (two faces towards background: background) is such a step too and is kept on
// the way.
#pragma once

#include <string>
#include <vector>

#include "mesher/domain/image_domain.hpp"
#include "mesher/lattice/candidate_mesh.hpp"

namespace cbc3d {

struct TopologyOptions {
  bool enabled = false;       ///< the checks are made at all
  bool one_face_rule = true;  ///< kept on the way (RefineOptions::one_face_rule)
  int image_passes = 0;       ///< the first passes, this many, in which the image at a non-manifold vertex
                              ///< decides: its whole star becomes what the voxel there is
  bool drop_crumbs = false;   ///< components, background's too, of less than an eighth of a voxel or in
                              ///< no voxel of their label are relabelled
  double small_component = 0.01;  ///< a component below this share of its label's volume is relabelled
};

/// A component that the image has no region for.
struct ExtraComponent {
  Vec3 centroid_mm;  ///< physical
  double volume_mm3 = 0;
};

struct LabelTopology {
  Label label = 0;
  std::size_t image_regions = 0;      ///< face-connected regions of the label in the cleaned image
  std::size_t components = 0;         ///< face-connected components of its sub-mesh
  std::vector<ExtraComponent> extra;  ///< all but the largest image_regions components
};

struct TopologyReport {
  std::size_t non_manifold_vertices = 0;  ///< (vertex, label) pairs before the repair
  std::size_t tets_relabelled = 0;
  std::size_t components_removed = 0;
  std::size_t non_manifold_vertices_left = 0;  ///< 0, or a bug
  std::vector<LabelTopology> labels;
};

/// Vertices at which the surface of some label is non-manifold, ascending. Parallel.
std::vector<VertexId> non_manifold_vertices(const CandidateMesh& mesh, std::size_t vertex_count,
                                            const std::vector<Label>& label_of_material);

/// Makes every label's sub-mesh a manifold and removes small components, by relabelling. Looks at the
/// vertices that `mesh.unsure` has, and leaves there what is known then.
TopologyReport check_topology(CandidateMesh& mesh, const std::vector<Vec3>& points, const ImageDomain& domain,
                              const TopologyOptions& options);

/// The same without the account of what was found.
void repair_topology(CandidateMesh& mesh, const std::vector<Vec3>& points, const ImageDomain& domain,
                     const TopologyOptions& options);

}  // namespace cbc3d
