#include "mesher/topology/material_mesh.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include "mesher/core/error.hpp"
#include "mesher/core/parallel.hpp"

namespace cbc3d {

VertexCells cells_of_vertices(const MaterialMesh& mesh) {
  const auto cell_count = static_cast<CellId>(mesh.cell_count());
  const auto for_each_in = [&](std::size_t begin, std::size_t end, const auto& f) {
    for (CellId c = 0; c < cell_count; ++c) {
      for (const VertexId v : mesh.nodes_of(c)) {
        if (v >= begin && v < end) f(v, c);
      }
    }
  };
  VertexCells around;
  around.first.assign(mesh.points.size() + 1, 0);
  for_ranges(mesh.points.size(), [&](std::size_t begin, std::size_t end) {
    for_each_in(begin, end, [&](VertexId v, CellId) { ++around.first[v + 1]; });
  });
  std::partial_sum(around.first.begin(), around.first.end(), around.first.begin());
  around.cells.resize(around.first.back());
  std::vector<std::uint32_t> next(around.first.begin(), around.first.end() - 1);
  for_ranges(mesh.points.size(), [&](std::size_t begin, std::size_t end) {
    for_each_in(begin, end, [&](VertexId v, CellId c) { around.cells[next[v]++] = c; });
  });
  return around;
}

MaterialMesh discard_background(const std::vector<Vec3>& points, const TetNodes& tets,
                                const std::vector<MaterialId>& materials) {
  MaterialMesh kept;
  kept.points = points;
  for (std::size_t t = 0; t < tets.size(); ++t) {
    if (materials[t] != kBackground) {
      kept.tets.push_back(tets[t]);
      kept.materials.push_back(materials[t]);
    }
  }
  drop_unused_vertices(kept);
  return kept;
}

namespace {

template <typename Cells>
void mark_used(const Cells& cells, std::vector<VertexId>& number) {
  for (const auto& cell : cells) {
    for (const VertexId v : cell) {
      number[v] = 0;
    }
  }
}

template <typename Cells>
void renumber(Cells& cells, const std::vector<VertexId>& number) {
  for (auto& cell : cells) {
    for (VertexId& v : cell) {
      v = number[v];
    }
  }
}

template <typename Cells>
std::vector<Label> labels_of_materials(const Cells& materials, const LabelImage& image) {
  std::vector<Label> labels(materials.size());
  std::transform(materials.begin(), materials.end(), labels.begin(),
                 [&](MaterialId m) { return image.labels[m]; });
  return labels;
}

/// The first material of every label of the image.
std::map<Label, MaterialId> materials_by_label(const LabelImage& image) {
  std::map<Label, MaterialId> number;
  for (std::size_t m = 1; m < image.labels.size(); ++m) {
    number.emplace(image.labels[m], static_cast<MaterialId>(m));
  }
  return number;
}

std::vector<MaterialId> materials_of(const std::vector<Label>& labels,
                                     const std::map<Label, MaterialId>& number) {
  std::vector<MaterialId> materials(labels.size());
  for (std::size_t c = 0; c < labels.size(); ++c) {
    const auto found = number.find(labels[c]);
    if (found == number.end()) {
      throw InputError("the mesh has label " + std::to_string(labels[c]) +
                       ", the image has not; give the image that the mesh was made from");
    }
    materials[c] = found->second;
  }
  return materials;
}

/// The lowest 21 bits of a number, two zero bits after each.
std::uint64_t spread_bits(std::uint64_t bits) {
  bits &= 0x1FFFFFU;
  bits = (bits | bits << 32U) & 0x1F00000000FFFFU;
  bits = (bits | bits << 16U) & 0x1F0000FF0000FFU;
  bits = (bits | bits << 8U) & 0x100F00F00F00F00FU;
  bits = (bits | bits << 4U) & 0x10C30C30C30C30C3U;
  return (bits | bits << 2U) & 0x1249249249249249U;
}

/// Vertices along the Morton curve through a grid of 2^21 cells a side.
std::vector<VertexId> morton_order(const std::vector<Vec3>& points) {
  Vec3 low = points.empty() ? Vec3{} : points[0];
  Vec3 high = low;
  for (const Vec3& p : points) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  }
  const double cells_per_mm = 2097151 / std::max((high - low).max_coeff(), 1e-300);
  std::vector<std::pair<std::uint64_t, VertexId>> keys(points.size());
#pragma omp parallel for schedule(static)
  for (std::size_t v = 0; v < points.size(); ++v) {
    const auto cell = [&](int axis) {
      return spread_bits(static_cast<std::uint64_t>((points[v][axis] - low[axis]) * cells_per_mm));
    };
    keys[v] = {cell(0) | cell(1) << 1U | cell(2) << 2U, static_cast<VertexId>(v)};
  }
  sort_distinct(keys);
  std::vector<VertexId> order(points.size());
  std::transform(keys.begin(), keys.end(), order.begin(), [](const auto& key) { return key.second; });
  return order;
}

/// Tets by their smallest vertex, else in their order.
std::vector<TetId> tets_by_vertex(const TetNodes& tets, std::size_t vertex_count) {
  std::vector<TetId> next(vertex_count + 1, 0);
  const auto smallest = [](const auto& tet) { return *std::min_element(tet.begin(), tet.end()); };
  for (const auto& tet : tets) {
    ++next[smallest(tet) + 1];
  }
  for (std::size_t v = 0; v < vertex_count; ++v) {
    next[v + 1] += next[v];
  }
  std::vector<TetId> order(tets.size());
  for (std::size_t t = 0; t < tets.size(); ++t) {
    order[next[smallest(tets[t])]++] = static_cast<TetId>(t);
  }
  return order;
}

}  // namespace

void order_for_locality(MaterialMesh& mesh) {
  const std::vector<VertexId> vertices = morton_order(mesh.points);
  std::vector<Vec3> points(mesh.points.size());
  std::vector<VertexId> number(mesh.points.size());
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    points[v] = mesh.points[vertices[v]];
    number[vertices[v]] = static_cast<VertexId>(v);
  }
  mesh.points.swap(points);
  renumber(mesh.tets, number);
  const std::vector<TetId> order = tets_by_vertex(mesh.tets, mesh.points.size());
  TetNodes tets(mesh.tets.size());
  std::vector<MaterialId> materials(mesh.tets.size());
  for (std::size_t t = 0; t < order.size(); ++t) {
    tets[t] = mesh.tets[order[t]];
    materials[t] = mesh.materials[order[t]];
  }
  mesh.tets.swap(tets);
  mesh.materials.swap(materials);
}

void drop_unused_vertices(MaterialMesh& mesh) {
  std::vector<VertexId> number(mesh.points.size(), kNoVertex);
  mark_used(mesh.tets, number);
  mark_used(mesh.pyramids.nodes, number);
  mark_used(mesh.hexes.nodes, number);
  VertexId next = 0;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] != kNoVertex) {
      mesh.points[next] = mesh.points[v];
      number[v] = next++;
    }
  }
  mesh.points.resize(next);
  renumber(mesh.tets, number);
  renumber(mesh.pyramids.nodes, number);
  renumber(mesh.hexes.nodes, number);
}

Mesh to_physical_mesh(const MaterialMesh& mesh, const LabelImage& image) {
  Mesh out;
  out.points = mesh.points;
  out.tets = {mesh.tets, labels_of_materials(mesh.materials, image)};
  out.pyramids = {mesh.pyramids.nodes, labels_of_materials(mesh.pyramids.materials, image)};
  out.hexes = {mesh.hexes.nodes, labels_of_materials(mesh.hexes.materials, image)};
  map_to_physical(out, image.frame);
  return out;
}

MaterialMesh to_material_mesh(Mesh mesh, const LabelImage& image) {
  if (mesh.wedges.size() > 0) {
    throw InputError("the mesh has " + std::to_string(mesh.wedges.size()) +
                     " wedges; give one of tets, pyramids and hexes");
  }
  if (image.frame.left_handed()) {
    flip_orientation(mesh);
  }
  const std::map<Label, MaterialId> number = materials_by_label(image);
  MaterialMesh out;
  out.points = std::move(mesh.points);
  for (Vec3& p : out.points) {
    p = image.frame.to_local(p);
  }
  out.tets = std::move(mesh.tets.nodes);
  out.materials = materials_of(mesh.tets.labels, number);
  out.pyramids = {std::move(mesh.pyramids.nodes), materials_of(mesh.pyramids.labels, number)};
  out.hexes = {std::move(mesh.hexes.nodes), materials_of(mesh.hexes.labels, number)};
  return out;
}

}  // namespace cbc3d
