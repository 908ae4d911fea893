#include "mesher/topology/labelled_tets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "mesher/core/error.hpp"

namespace cbc3d {
namespace {

std::size_t count_vertices(const MaterialMesh& mesh) {
  std::vector<std::uint8_t> used(mesh.points.size(), 0);
  for (const auto& tet : mesh.tets) {
    for (const VertexId v : tet) {
      used[v] = 1;
    }
  }
  return static_cast<std::size_t>(std::count(used.begin(), used.end(), 1));
}

/// Largest and smallest cosine of a positive tet's dihedral angles.
std::array<double, 2> extreme_cosines(const std::array<Vec3, 4>& p) {
  std::array<Vec3, 4> normals;
  for (std::size_t n = 0; n < 4; ++n) {
    const auto& f = kTetFace[n];
    normals[n] = (p[f[1]] - p[f[0]]).cross(p[f[2]] - p[f[0]]).normalized();
  }
  std::array<double, 2> cosines = {-1, 1};
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      const double cosine = -normals[i].dot(normals[j]);
      cosines = {std::max(cosines[0], cosine), std::min(cosines[1], cosine)};
    }
  }
  return cosines;
}

}  // namespace

void require_improvable(const Mesh& mesh) {
  if (mesh.cell_count() > mesh.tets.size()) {
    throw InputError("the mesh has " + std::to_string(mesh.pyramids.size()) + " pyramids, " +
                     std::to_string(mesh.wedges.size()) + " wedges and " + std::to_string(mesh.hexes.size()) +
                     " hexes; give one of tets alone");
  }
  if (mesh.tets.size() == 0) {
    throw InputError("the mesh has no tets; give one with labelled tets");
  }
  for (const auto& tet : mesh.tets.nodes) {
    for (const VertexId v : tet) {
      if (v >= mesh.points.size()) {
        throw InputError("the mesh has a tet with node " + std::to_string(v) + ", but " +
                         std::to_string(mesh.points.size()) + " points; the file is damaged, write it again");
      }
      if (!mesh.points[v].all_finite()) {
        throw InputError("the mesh has a coordinate at point " + std::to_string(v) +
                         " that is no finite number; the file is damaged, write it again");
      }
    }
  }
}

MaterialMesh number_labels(Mesh mesh, std::vector<Label>& labels) {
  const std::vector<Label> values = labels_of(mesh);
  if (values.size() >= std::numeric_limits<MaterialId>::max()) {
    throw InputError("the mesh has " + std::to_string(values.size()) +
                     " labels; at most 65534 can be told apart");
  }
  labels.assign(1, 0);
  labels.insert(labels.end(), values.begin(), values.end());
  MaterialMesh out;
  out.points = std::move(mesh.points);
  out.tets = std::move(mesh.tets.nodes);
  for (const Label label : mesh.tets.labels) {
    const auto at = std::lower_bound(values.begin(), values.end(), label) - values.begin();
    out.materials.push_back(static_cast<MaterialId>(at + 1));
  }
  return out;
}

TetMeasures measure_tets(const MaterialMesh& mesh, std::size_t materials) {
  TetMeasures measures;
  measures.vertices = count_vertices(mesh);
  measures.tets = mesh.tets.size();
  measures.volume_mm3.assign(materials, 0);
  std::array<double, 2> cosines = {-1, 1};
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    std::array<Vec3, 4> p;
    for (std::size_t n = 0; n < 4; ++n) {
      p[n] = mesh.points[mesh.tets[t][n]];
    }
    const double volume = six_volumes(p[0], p[1], p[2], p[3]) / 6;
    measures.volume_mm3[mesh.materials[t]] += volume;
    measures.not_positive += volume > 0 ? 0 : 1;
    const auto extremes = volume > 0 ? extreme_cosines(p) : std::array<double, 2>{1, -1};
    cosines = {std::max(cosines[0], extremes[0]), std::min(cosines[1], extremes[1])};
  }
  const auto degrees = [](double cosine) {
    return std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::numbers::pi;
  };
  measures.min_dihedral_deg = degrees(cosines[0]);
  measures.max_dihedral_deg = degrees(cosines[1]);
  return measures;
}

}  // namespace cbc3d
