// What is wrong with a mesh, in words.
#pragma once

#include <string>
#include <vector>

#include "metrics/element_quality.hpp"
#include "metrics/fidelity.hpp"
#include "metrics/self_intersection.hpp"
#include "metrics/topology.hpp"

namespace cbc3d::metrics {

/// One line for each kind of fault that the mesh has, with its count and, where it is at a place, the first
/// cell or vertex and its position (physical mm): no cells, inverted, flat or folded cells, facets with more
/// than two cells or with both on one side, hanging (T-junction), duplicate and unused vertices, surfaces
/// that are non-manifold or cut themselves or each other, labels that are missing or unknown to the image,
/// Betti numbers that are not the image's (a hole, for one). Empty for a sound mesh.
std::vector<std::string> describe_faults(const MeshView& view, const MeshQuality& quality,
                                         const Topology& topology, const SelfIntersections& crossing,
                                         const ImageTopology& image_topology, const LabelImage& image,
                                         const LabelComparison& labels);

}  // namespace cbc3d::metrics
