#include "mesher/stages/material_mesh.hpp"

#include "mesher/stages/lattice.hpp"

namespace cbc3d {

MaterialMesh discard_background(const std::vector<Vec3>& points, const TetNodes& tets,
                                const std::vector<MaterialId>& materials) {
  MaterialMesh kept;
  std::vector<VertexId> number(points.size(), kNoVertex);
  for (std::size_t t = 0; t < tets.size(); ++t) {
    if (materials[t] != kBackground) {
      for (const VertexId v : tets[t]) {
        number[v] = 0;
      }
    }
  }
  for (std::size_t v = 0; v < points.size(); ++v) {
    if (number[v] != kNoVertex) {
      number[v] = static_cast<VertexId>(kept.points.size());
      kept.points.push_back(points[v]);
    }
  }
  for (std::size_t t = 0; t < tets.size(); ++t) {
    if (materials[t] != kBackground) {
      const auto& n = tets[t];
      kept.tets.push_back({number[n[0]], number[n[1]], number[n[2]], number[n[3]]});
      kept.materials.push_back(materials[t]);
    }
  }
  return kept;
}

Mesh to_physical_mesh(const MaterialMesh& mesh, const LabelImage& image) {
  Mesh out;
  out.points = mesh.points;
  out.tets.nodes = mesh.tets;
  out.tets.labels.reserve(mesh.materials.size());
  for (const MaterialId m : mesh.materials) {
    out.tets.labels.push_back(image.labels[m]);
  }
  map_to_physical(out, image.frame);
  return out;
}

}  // namespace cbc3d
