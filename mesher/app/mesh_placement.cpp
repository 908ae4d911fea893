#include "mesher/app/mesh_placement.hpp"

#include <array>
#include <cstdio>
#include <functional>

namespace cbc3d {
namespace {

/// A place that a mesh's point may have been meant for, local mm.
using Map = std::function<Vec3(const Vec3&)>;

double overlap_under(const MaterialMesh& mesh, const LabelImage& image, const Map& map) {
  std::size_t hits = 0;
  const std::size_t cells = mesh.cell_count();
#pragma omp parallel for schedule(static) reduction(+ : hits)
  for (std::size_t c = 0; c < cells; ++c) {
    const auto nodes = mesh.nodes_of(static_cast<CellId>(c));
    Vec3 centre;
    for (const VertexId v : nodes) {
      centre += mesh.points[v];
    }
    const MaterialId found = image.at_local(map(centre / static_cast<double>(nodes.size())));
    hits += image.labels[found] == image.labels[mesh.material_of(static_cast<CellId>(c))] ? 1 : 0;
  }
  return cells == 0 ? 1 : static_cast<double>(hits) / static_cast<double>(cells);
}

struct Candidate {
  const char* what;
  Map map;
};

/// Mirrored in physical space, and indices of voxels taken for millimetres.
std::array<Candidate, 4> candidates(const ImageFrame& frame) {
  const auto mirrored = [frame](double x, double y) {
    return [=](const Vec3& local) {
      const Vec3 p = frame.to_physical(local);
      return frame.to_local({x * p.x, y * p.y, p.z});
    };
  };
  return {{{"its x and y mirrored (a mesh in RAS coordinates, where LPS are meant)", mirrored(-1, -1)},
           {"its x mirrored", mirrored(-1, 1)},
           {"its y mirrored", mirrored(1, -1)},
           {"its coordinates taken as voxel indices", [frame](const Vec3& local) {
              const Vec3 p = frame.to_physical(local);
              return Vec3{p.x * frame.spacing_mm.x, p.y * frame.spacing_mm.y, p.z * frame.spacing_mm.z};
            }}}};
}

}  // namespace

double label_overlap(const MaterialMesh& mesh, const LabelImage& image) {
  return overlap_under(mesh, image, [](const Vec3& local) { return local; });
}

Placement placement_of(const MaterialMesh& mesh, const LabelImage& image) {
  constexpr double kFits = 0.5, kHardlyAny = 0.1, kFarBetter = 0.2;
  Placement placement{.overlap = label_overlap(mesh, image)};
  char text[300];
  std::snprintf(text, sizeof text,
                "mesh and image do not lie together: %.0f %% of the cells lie on voxels of their label",
                100 * placement.overlap);
  for (const auto& [what, map] : candidates(image.frame)) {
    const double other = overlap_under(mesh, image, map);
    if (other >= kFits && other > placement.overlap + kFarBetter) {
      placement.elsewhere = true;
      placement.finding = std::string(text) + "; with " + what + " it would be " +
                          std::to_string(static_cast<int>(100 * other + 0.5)) +
                          " %: give the mesh in physical LPS mm";
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
