#include "metrics/evaluate.hpp"

#include <vector>

#include "mesher/core/mesh_placement.hpp"
#include "metrics/cells.hpp"
#include "metrics/element_quality.hpp"
#include "metrics/element_shape.hpp"
#include "metrics/faults.hpp"
#include "metrics/fidelity.hpp"
#include "metrics/gradation.hpp"
#include "metrics/self_intersection.hpp"
#include "metrics/summary.hpp"
#include "metrics/surface.hpp"
#include "metrics/surface_shape.hpp"
#include "metrics/topology.hpp"
#include "metrics/topology_difference.hpp"

namespace cbc3d::metrics {
namespace {

using nlohmann::json;

json counts_of(const Mesh& mesh) {
  return {{"vertices", mesh.points.size()},
          {"tets", mesh.tets.size()},
          {"pyramids", mesh.pyramids.size()},
          {"wedges", mesh.wedges.size()},
          {"hexes", mesh.hexes.size()}};
}

FidelityOptions fidelity_options(const EvaluateOptions& options, const ImageFrame& frame) {
  FidelityOptions result;
  result.smooth = options.smooth;
  if (options.certified) {
    result.certify = CertifyOptions{};
    result.certify->tolerance_mm =
        options.tolerance_mm > 0 ? options.tolerance_mm : kRelativeTolerance * frame.spacing_mm.min_coeff();
  }
  return result;
}

}  // namespace

json evaluate(const Mesh& mesh, const LabelImage& image, const EvaluateOptions& options,
              const Progress& progress) {
  const MeshView view(mesh, image);
  progress.step("element quality", 0);
  const MeshQuality quality = element_quality(view);
  json result{{"counts", counts_of(mesh)}};
  result["quality"] = to_json(quality, view);
  write_json(result["quality"], element_shape(view));
  progress.step("topology", 0.1);
  std::vector<Facet> facets = sorted_facets(view);
  const Surface surface = extract_surface(view, facets);
  const Topology connected = topology(view, facets, surface);
  write_json(result["quality"], gradation(view, facets, surface), view);
  facets = {};
  result["surface"] = to_json(surface_shapes(view, image, surface), view);
  progress.step("self-intersections", 0.2);
  const SelfIntersections crossing = self_intersections(view, surface);
  progress.step("topology of the image", 0.25);
  const ImageTopology in_image = image_topology(image);
  result["topology"] = to_json(connected, view, in_image, image);
  write_json(result["topology"], crossing, view, surface);
  const TopologyDifference difference = topology_difference(view, surface, connected, in_image, image);
  write_json(result["topology"], difference, in_image, image);
  const FidelityOptions how = fidelity_options(options, image.frame);
  const Fidelity near = fidelity(view, image, surface, how, progress);
  result["fidelity"] = to_json(near, how);
  result["faults"] = describe_faults(view, quality, connected, crossing, in_image, image, near.labels);
  if (const Placement placement = placement_of(mesh, image); !placement.finding.empty()) {
    result["faults"].insert(result["faults"].begin(), placement.finding);
  }
  result["summary"] = summary({view, image.frame, quality, connected, difference, crossing, near});
  if (options.shapes) {
    progress.step("true shape", 0.97);
    result["shape"] = to_json(compare_with_shapes(view, image, surface, options.shapes));
  }
  progress.step("evaluated", 1);
  return result;
}

}  // namespace cbc3d::metrics
