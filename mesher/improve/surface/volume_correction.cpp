#include "mesher/improve/surface/volume_correction.hpp"

#include <algorithm>
#include <cmath>

#include "mesher/improve/local/mesh_star.hpp"

namespace cbc3d {
namespace {

/// A tet's volume and the areas of its faces towards another material, 0 for the other faces.
struct TetExtent {
  double volume_mm3;
  std::array<double, 4> area_mm2;
};

TetExtent extent_of_tet(const MaterialMesh& mesh, const std::array<TetId, 4>& neighbours, std::size_t t) {
  const auto& n = mesh.tets[t];
  TetExtent extent{
      six_volumes(mesh.points[n[0]], mesh.points[n[1]], mesh.points[n[2]], mesh.points[n[3]]) / 6, {}};
  for (std::size_t f = 0; f < 4; ++f) {
    if (neighbours[f] == kNoTet || mesh.materials[neighbours[f]] != mesh.materials[t]) {
      const auto& face = kTetFace[f];
      const Vec3& p = mesh.points[n[face[0]]];
      extent.area_mm2[f] = 0.5 * (mesh.points[n[face[1]]] - p).cross(mesh.points[n[face[2]]] - p).norm();
    }
  }
  return extent;
}

/// Measured in parallel, added up in the order of the tets: sums depend on it.
Extent extent_of(const MaterialMesh& mesh, const TetNeighbours& neighbours, std::size_t materials) {
  std::vector<TetExtent> of_tets(mesh.tets.size());
#pragma omp parallel for schedule(static)
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    of_tets[t] = extent_of_tet(mesh, neighbours[t], t);
  }
  Extent extent{std::vector<double>(materials, 0.0), std::vector<double>(materials, 0.0)};
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const MaterialId m = mesh.materials[t];
    extent.volume_mm3[m] += of_tets[t].volume_mm3;
    for (const double area_mm2 : of_tets[t].area_mm2) {
      extent.area_mm2[m] += area_mm2;
    }
  }
  return extent;
}

class VolumeCorrection {
 public:
  VolumeCorrection(MaterialMesh& mesh, const SurfaceCover& cover, const VolumeCorrectionOptions& options)
      : mesh_(mesh),
        cover_(cover),
        options_(options),
        neighbours_(tet_neighbours(mesh.tets, mesh.points.size())),
        around_(tets_of_vertices(mesh.tets, mesh.points.size())),
        sets_(vertex_materials(mesh.tets, mesh.materials, neighbours_, mesh.points.size())) {}

  void run() {
    for (int round = 0; round < options_.rounds && find_steps(); ++round) {
      find_normals();
      for (VertexId v = 0; v < sets_.size(); ++v) {
        const MaterialSet& set = sets_[v];
        if (set.size == 2) {  // the normal points out of the higher one
          const double step = step_mm_[set.ids[1]] - step_mm_[set.ids[0]];
          if (step != 0) {
            move(v, step * normals_[v].normalized());
          }
        }
      }
    }
  }

 private:
  /// Finds how far every material's surface has to move; false when all volumes are right.
  bool find_steps() {
    const Extent extent = extent_of(mesh_, neighbours_, options_.wanted_mm3.size());
    std::vector<double> wanted(extent.volume_mm3.size(), 0.0), lack = wanted, area = wanted;
    for (std::size_t m = 1; m < wanted.size(); ++m) {
      const MaterialId label = options_.label_of[m];
      wanted[label] += options_.wanted_mm3[m];
      lack[label] += options_.wanted_mm3[m] - extent.volume_mm3[m];
      area[label] += extent.area_mm2[m];
    }
    step_mm_.assign(wanted.size(), 0.0);
    bool any = false;
    for (std::size_t m = 1; m < wanted.size(); ++m) {
      const MaterialId label = options_.label_of[m];
      if (area[label] > 0 && std::fabs(lack[label]) > options_.tolerance * wanted[label]) {
        step_mm_[m] = std::clamp(lack[label] / area[label], -options_.step_mm, options_.step_mm);
        any = true;
      }
    }
    return any;
  }

  /// Sums of the area vectors of the facets at each vertex, out of the higher material.
  void find_normals() {
    normals_.assign(mesh_.points.size(), {});
    for (std::size_t t = 0; t < mesh_.tets.size(); ++t) {
      for (std::size_t n = 0; n < 4; ++n) {
        const TetId across = neighbours_[t][n];
        if (mesh_.materials[t] > (across == kNoTet ? kBackground : mesh_.materials[across])) {
          const auto& nodes = mesh_.tets[t];
          const std::array<VertexId, 3> f = {nodes[kTetFace[n][0]], nodes[kTetFace[n][1]],
                                             nodes[kTetFace[n][2]]};
          const Vec3& p = mesh_.points[f[0]];
          const Vec3 normal = (mesh_.points[f[1]] - p).cross(mesh_.points[f[2]] - p);
          for (const VertexId v : f) {
            normals_[v] += normal;
          }
        }
      }
    }
  }

  void move(VertexId v, const Vec3& step) {
    const Vec3 from = mesh_.points[v];
    const double floor = std::min(options_.goal_quality, worst_at(v));
    for (const double share : {1.0, 0.5, 0.25}) {
      mesh_.points[v] = from + share * step;
      if (cover_.may_move(v, from, mesh_.points[v]) && worst_at(v) >= floor) {
        return;
      }
    }
    mesh_.points[v] = from;
  }

  [[nodiscard]] double worst_at(VertexId v) const { return worst_quality(mesh_, around_.of(v)); }

  MaterialMesh& mesh_;
  const SurfaceCover& cover_;
  const VolumeCorrectionOptions& options_;
  TetNeighbours neighbours_;
  VertexCells around_;
  std::vector<MaterialSet> sets_;
  std::vector<double> step_mm_;  // of every material, outwards
  std::vector<Vec3> normals_;
};

}  // namespace

Extent extent_of_materials(const MaterialMesh& mesh, std::size_t materials) {
  return extent_of(mesh, tet_neighbours(mesh.tets, mesh.points.size()), materials);
}

void correct_volumes(MaterialMesh& mesh, const SurfaceCover& cover, const VolumeCorrectionOptions& options) {
  VolumeCorrection(mesh, cover, options).run();
}

}  // namespace cbc3d
