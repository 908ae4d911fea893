#include "mesher/pipeline/mesh_findings.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <span>

namespace cbc3d {
namespace {

constexpr double kMostOff = 0.02;

using Tets = std::span<const std::array<int, 4>>;

// Cells as tets of the same volume, by the node orders of Mesh.
constexpr std::array<std::array<int, 4>, 1> kOfTet = {{{0, 1, 2, 3}}};
constexpr std::array<std::array<int, 4>, 2> kOfPyramid = {{{0, 1, 2, 4}, {0, 2, 3, 4}}};
constexpr std::array<std::array<int, 4>, 6> kOfHex = {
    {{0, 1, 2, 6}, {0, 2, 3, 6}, {0, 3, 7, 6}, {0, 7, 4, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}}};

template <int Nodes>
void add_volumes(const CellBlock<Nodes>& block, const std::vector<Vec3>& points, Tets tets,
                 std::map<Label, double>& volume_mm3) {
  for (std::size_t c = 0; c < block.size(); ++c) {
    double six = 0;
    for (const auto& tet : tets) {
      const auto at = [&](std::size_t n) { return points[block.nodes[c][static_cast<std::size_t>(tet[n])]]; };
      six += six_volumes(at(0), at(1), at(2), at(3));
    }
    volume_mm3[block.labels[c]] += six / 6;
  }
}

std::map<Label, double> volumes_of_labels(const Mesh& mesh) {
  std::map<Label, double> volume_mm3;
  add_volumes(mesh.tets, mesh.points, kOfTet, volume_mm3);
  add_volumes(mesh.pyramids, mesh.points, kOfPyramid, volume_mm3);
  add_volumes(mesh.hexes, mesh.points, kOfHex, volume_mm3);
  return volume_mm3;
}

}  // namespace

std::vector<std::string> mesh_findings(const Mesh& mesh, const MeshImageReport& report,
                                       const ImageFrame& frame) {
  std::vector<std::string> findings;
  if (report.improve.self_intersections_left > 0) {
    findings.push_back(
        std::to_string(report.improve.self_intersections_left) +
        " pairs of facets intersect; a smaller lattice_spacing_mm or max_distance_mm leaves fewer");
  }
  const bool is_curved = !report.curve.volume_mm3.empty();
  std::map<Label, double> volume_mm3 = is_curved ? report.curve.volume_mm3 : volumes_of_labels(mesh);
  const double voxel_mm3 = frame.spacing_mm.x * frame.spacing_mm.y * frame.spacing_mm.z;
  for (const LabelChange& label : report.clean.labels) {
    const double wanted = static_cast<double>(label.voxels_after) * voxel_mm3;
    const double off = wanted > 0 ? volume_mm3[label.label] / wanted - 1 : 0;
    if (volume_mm3[label.label] > 0 && std::fabs(off) > kMostOff) {  // a missing label has its own warning
      char text[200];
      std::snprintf(text, sizeof text,
                    "the volume of label %d is %.1f %% %s than that of its voxels; a smaller max_distance_mm "
                    "keeps it closer",
                    label.label, 100 * std::fabs(off), off > 0 ? "larger" : "smaller");
      findings.emplace_back(text);
    }
  }
  return findings;
}

}  // namespace cbc3d
