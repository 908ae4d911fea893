// A mesh is cut into patches that threads improve side by side, and put together again.
//
// The cuts depend on the mesh and the round alone, never on threads or time, and vertices shared by patches
// are locked, so the result is the same at any thread count. Each round cuts elsewhere, so that vertices
// locked in one round are free in the next.
#pragma once

#include <functional>

#include "mesher/improve/local/patch.hpp"
#include "mesher/topology/material_mesh.hpp"

namespace cbc3d {

struct PatchRules {
  ShiftedBoundaries boundaries;
  Guards guards;
  const std::vector<BoundarySample>& samples;  ///< to be kept covered
  double reach_mm = 0;                         ///< within which a vertex covers a sample
  std::size_t patch_tets = 30000;              ///< tets of a patch, about
  std::span<const float> own_reach_mm = {};    ///< a sample's own reach where above 0; empty: none has one
  std::span<const std::uint8_t> locked = {};   ///< vertices that must stay; empty: none
  /// Of the first vertices, nonzero: stays, with the tets between such vertices; not on interfaces; empty:
  /// none.
  std::span<const std::uint8_t> fixed = {};
  std::span<const double> longest_mm = {};  ///< Patch::longest_mm of every vertex; empty: no limit
  std::span<const double> longest_on_interface_mm = {};  ///< Patch's, of every vertex; empty: no limit
  std::span<const double> smoothness_cap_mm = {};        ///< of every material, see Patch; empty: no limit
};

/// Cuts the mesh, calls improve(patch) for every patch in parallel, and puts the results back. `covering` has
/// the covering vertex of every sample, kNoVertex for none, and is kept up to date. Vertices out of use stay
/// in `mesh.points`.
void improve_in_patches(MaterialMesh& mesh, std::vector<VertexId>& covering, const PatchRules& rules,
                        int round, const std::function<void(Patch&)>& improve);

/// The same for the tets below the goal and `rings` layers of tets around them alone: the rest is left as it
/// is, so that a mesh with few bad tets takes little time. Returns the number of tets below the goal.
std::size_t improve_near_bad_tets(MaterialMesh& mesh, std::vector<VertexId>& covering,
                                  const PatchRules& rules, int round, double goal_quality, int rings,
                                  const std::function<void(Patch&)>& improve);

}  // namespace cbc3d
