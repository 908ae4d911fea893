// Stage "Adaptive refinement" (paper, section "Adaptive Lattice Refinement"): rounds of red-green subdivision
// until every material meets its fidelity, with the candidate mesh selected in every round, so that what is
// judged is what is kept.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "mesher/domain/image_domain.hpp"
#include "mesher/lattice/candidate_mesh.hpp"
#include "mesher/lattice/lattice.hpp"
#include "mesher/lattice/material_fidelity.hpp"

namespace cbc3d {

struct RefineOptions {
  double fidelity = 0.95;                     ///< F: a material is refined while F > F1 or F > F2; in (0, 1]
  std::map<Label, double> material_fidelity;  ///< F of single labels, in place of the global one
  std::map<Label, double> size_mm;            ///< no lattice edge of these labels is longer
  double max_distance_mm =
      0;  ///< > 0: refine also where a boundary voxel has no interface vertex within this
  double max_vertex_distance_mm = 0;  ///< > 0: refine also where an interface's vertex is farther than this
                                      ///< from where the image has that interface
  double contact_distance_mm =
      0;  ///< with max_vertex_distance_mm: materials that meet at a vertex must meet within this in the image
  bool keep_thin_parts = false;  ///< refine also where a voxel of a thin part (ImageDomain::is_thin_voxel) is
                                 ///< in a tet of another material
  bool smooth_labels = false;    ///< a tet takes the material whose smoothed share is largest at its centroid
  bool each_interface = false;   ///< the distance is judged for every interface, not for every material
  double coarsest_spacing_mm = 0;  ///< > 0: no tet of a label is of a coarser level than this lattice spacing
  double interface_spacing_mm = 0;  ///< > 0: the same of the tets at interfaces
  double finest_spacing_mm = 0;     ///< the fidelity criterion splits no tet below this lattice spacing, mm;
                                 ///< 0: the smallest voxel spacing (the distance criterion: a quarter of it)
  bool one_face_rule = true;     ///< the paper's: a candidate tet has at most one face towards background
  bool topology_checks = false;  ///< refine around non-manifold places once the fidelity is settled
  int topology_rounds = 3;       ///< how often, at most
  int repair_rounds =
      0;  ///< how often, at most, the distance is judged again after the repair of the topology
  int repair_image_passes = 0;  ///< TopologyOptions::image_passes of that repair
  bool keep_topology = false;   ///< with repair_rounds, of well-composed images: refine also where a label of
                                ///< the repaired mesh has another topology than in the image, and take the
                                ///< voxels' own labels there
  int max_rounds = 100;         ///< a bound that is never reached unless something is wrong
};

struct RefineResult {
  CandidateMesh mesh;
  std::vector<MaterialFidelity> fidelity;  ///< one per labelled material
  std::size_t uncovered_voxels = 0;  ///< boundary voxels beyond max_distance_mm that could not be reached
  int rounds = 0;
  std::vector<std::string> warnings;  ///< which materials fall short, and why the rounds ended
};

/// Refines `lattice` in place for the image of the domain. Calls `on_round(round, tets)` in each round. Same
/// result at any thread count.
RefineResult refine_lattice(Lattice& lattice, const ImageDomain& domain, const RefineOptions& options,
                            const std::function<void(int round, std::size_t tets)>& on_round);

}  // namespace cbc3d
