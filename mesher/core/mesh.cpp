#include "mesher/core/mesh.hpp"

#include <algorithm>
#include <set>

namespace cbc3d {

void flip_orientation(Mesh& mesh) {
  for (auto& c : mesh.tets.nodes) {
    std::swap(c[1], c[2]);
  }
  for (auto& c : mesh.pyramids.nodes) {
    std::swap(c[1], c[3]);
  }
  for (auto& c : mesh.wedges.nodes) {
    std::swap(c[1], c[2]);
    std::swap(c[4], c[5]);
  }
  for (auto& c : mesh.hexes.nodes) {
    std::swap(c[1], c[3]);
    std::swap(c[5], c[7]);
  }
}

void map_to_physical(Mesh& mesh, const ImageFrame& frame) {
#pragma omp parallel for
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    mesh.points[v] = frame.to_physical(mesh.points[v]);
  }
  if (frame.left_handed()) {
    flip_orientation(mesh);
  }
}

std::vector<Label> labels_of(const Mesh& mesh) {
  std::set<Label> found;
  const auto collect = [&found](const std::vector<Label>& labels) {
    Label last = 0;
    bool any = false;
    for (const Label label : labels) {
      if (!any || label != last) {
        found.insert(label);
      }
      last = label;
      any = true;
    }
  };
  collect(mesh.tets.labels);
  collect(mesh.pyramids.labels);
  collect(mesh.wedges.labels);
  collect(mesh.hexes.labels);
  return {found.begin(), found.end()};
}

}  // namespace cbc3d
