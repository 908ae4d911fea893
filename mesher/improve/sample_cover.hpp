// The boundary samples of a domain with the vertices of the whole mesh that cover them, as the improvement
// keeps them.
#pragma once

#include <vector>

#include "mesher/domain/domain.hpp"
#include "mesher/topology/material_mesh.hpp"

namespace cbc3d {

struct SampleCover {
  std::vector<BoundarySample> samples;
  std::vector<VertexId> covering;  ///< of every sample; kNoVertex: uncovered
  std::vector<float>
      own_reach_mm;  ///< of samples with a reach of their own, 0 for the others; empty: none has one
  double reach_mm = 0;
};

/// The samples of the domain with their nearest covering vertices. With `keep_distances` the reach is at most
/// what the mesh needs, and an uncovered sample is covered by the nearest surface vertex of its own material,
/// with a reach of its own: it would otherwise grow farther from the mesh unnoticed.
SampleCover cover_samples(const MaterialMesh& mesh, const Domain& domain, double reach_mm,
                          bool keep_distances);

/// Gives covered samples in thin parts the smaller reach that they need, or what they have now.
void cover_thin_samples(const MaterialMesh& mesh, const Domain& domain, double reach_mm, SampleCover& cover);

/// Searches again for vertices that cover the uncovered samples: some may have come near.
void cover_uncovered_samples(const MaterialMesh& mesh, SampleCover& cover);

/// True when a sample is uncovered, or its vertex is beyond the limit. Parallel.
bool has_far_samples(const MaterialMesh& mesh, const SampleCover& cover, double limit_mm);

}  // namespace cbc3d
