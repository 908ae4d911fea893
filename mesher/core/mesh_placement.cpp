#include "mesher/core/mesh_placement.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <functional>

namespace cbc3d {
namespace {

/// From a point of the mesh to the place it may have been meant for, local mm.
using Map = std::function<Vec3(const Vec3&)>;

template <int Nodes>
std::size_t hits_of(const CellBlock<Nodes>& block, const std::vector<Vec3>& points, const LabelImage& image,
                    const Map& map) {
  std::size_t hits = 0;
#pragma omp parallel for schedule(static) reduction(+ : hits)
  for (std::size_t c = 0; c < block.size(); ++c) {
    Vec3 centre;
    for (const VertexId v : block.nodes[c]) {
      centre += points[v];
    }
    const MaterialId found = image.at_local(map(centre / static_cast<double>(Nodes)));
    hits += image.labels[found] == block.labels[c] ? 1 : 0;
  }
  return hits;
}

double overlap_under(const Mesh& mesh, const LabelImage& image, const Map& map) {
  const std::size_t hits =
      hits_of(mesh.tets, mesh.points, image, map) + hits_of(mesh.pyramids, mesh.points, image, map) +
      hits_of(mesh.wedges, mesh.points, image, map) + hits_of(mesh.hexes, mesh.points, image, map);
  return mesh.cell_count() == 0 ? 1 : static_cast<double>(hits) / static_cast<double>(mesh.cell_count());
}

struct Candidate {
  const char* what;
  Map map;
};

/// Mirrored in physical space, and indices of voxels taken for millimetres.
std::array<Candidate, 4> candidates(const ImageFrame& frame) {
  const auto mirrored = [&frame](double x, double y) {
    return [&frame, x, y](const Vec3& p) { return frame.to_local({x * p.x, y * p.y, p.z}); };
  };
  return {{{"its x and y mirrored (a mesh in RAS coordinates, where LPS are meant)", mirrored(-1, -1)},
           {"its x mirrored", mirrored(-1, 1)},
           {"its y mirrored", mirrored(1, -1)},
           {"its coordinates taken as voxel indices", [&frame](const Vec3& p) {
              return Vec3{p.x * frame.spacing_mm.x, p.y * frame.spacing_mm.y, p.z * frame.spacing_mm.z};
            }}}};
}

}  // namespace

Placement placement_of(const Mesh& mesh, const LabelImage& image) {
  constexpr double kFits = 0.5, kHardlyAny = 0.1, kFarBetter = 0.2;
  const ImageFrame& frame = image.frame;
  Placement placement;
  placement.overlap = overlap_under(mesh, image, [&frame](const Vec3& p) { return frame.to_local(p); });
  char text[300];
  std::snprintf(text, sizeof text,
                "mesh and image do not lie together: %.0f %% of the cells lie on voxels of their label",
                100 * placement.overlap);
  for (const auto& [what, map] : candidates(frame)) {
    const double other = placement.overlap < 1 - kFarBetter ? overlap_under(mesh, image, map) : 0;
    if (other >= kFits && other > placement.overlap + kFarBetter) {
      placement.elsewhere = true;
      placement.finding = std::string(text) + "; with " + what + " it would be " +
                          std::to_string(std::lround(100 * other)) + " %: give the mesh in physical LPS mm";
      return placement;
    }
  }
  if (placement.overlap < kFits) {
    placement.elsewhere = placement.overlap < kHardlyAny;
    placement.finding =
        std::string(text) + "; give the image that the mesh was made from, and the mesh in physical LPS mm";
  }
  return placement;
}

}  // namespace cbc3d
