// Groups of neighbouring tets of one material that may be relabelled together.
#pragma once

#include "mesher/improve/surface/labelled_complex.hpp"

namespace cbc3d {

/// Ascending.
using TetGroup = std::vector<TetId>;

/// The groups at some vertices, the smallest by volume first: face-connected groups of at most `most_tets`
/// tets of the vertices' stars, and the face-connected parts of each star and of the tets around each of its
/// edges.
std::vector<TetGroup> tet_groups_at(const LabelledComplex& complex, const std::vector<VertexId>& vertices,
                                    std::size_t most_tets);

double volume_mm3(const MaterialMesh& mesh, const TetGroup& group);

}  // namespace cbc3d
