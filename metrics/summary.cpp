#include "metrics/summary.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "metrics/reduce.hpp"

namespace cbc3d::metrics {
namespace {

using nlohmann::json;

// The largest of some values, and whose it is: of equal ones the first's.
struct Worst {
  std::optional<double> value;  // by magnitude
  double signed_value = 0;
  Label label = 0;

  void add(Label whose, double candidate) {
    if (!value || std::fabs(candidate) > *value) {
      *this = {std::fabs(candidate), candidate, whose};
    }
  }
  [[nodiscard]] json label_json() const { return value ? json(label) : json(nullptr); }
};

// A distance under `name`_mm and, over the voxel diagonal, under `name`_diagonals.
void write_distance(json& object, const std::string& name, std::optional<double> distance_mm,
                    double diagonal_mm) {
  object[name + "_mm"] = number_or_null(distance_mm);
  object[name + "_diagonals"] =
      number_or_null(distance_mm ? std::optional(*distance_mm / diagonal_mm) : std::nullopt);
}

void write_distances(json& object, const Fidelity& fidelity, double diagonal_mm) {
  Worst to_mesh, to_image, both;
  for (const LabelFidelity& row : fidelity.per_label) {
    if (row.points) {
      to_mesh.add(row.label, row.points->image_to_mesh_mm);
      to_image.add(row.label, row.points->mesh_to_image_mm);
      both.add(row.label, row.points->hausdorff_mm());
    }
  }
  for (const auto& [name, worst] : {std::pair("hausdorff", &both), std::pair("image_to_mesh", &to_mesh),
                                    std::pair("mesh_to_image", &to_image)}) {
    write_distance(object, name, worst->value, diagonal_mm);
    object[std::string(name) + "_label"] = worst->label_json();
  }
  Worst union_to_mesh, union_to_image, union_both;
  if (const auto& all = fidelity.outer_points) {
    union_to_mesh.add(0, all->image_to_mesh_mm);
    union_to_image.add(0, all->mesh_to_image_mm);
    union_both.add(0, all->hausdorff_mm());
  }
  write_distance(object, "union_hausdorff", union_both.value, diagonal_mm);
  write_distance(object, "union_image_to_mesh", union_to_mesh.value, diagonal_mm);
  write_distance(object, "union_mesh_to_image", union_to_image.value, diagonal_mm);
}

double volume_error_percent(const LabelFidelity& row) {
  return 100 * (row.mesh_volume_mm3 / row.image_volume_mm3 - 1);
}

// The first kWorstLabels of `rows` by `worse`, of equal ones those with the smaller label.
template <class Worse>
std::vector<const LabelFidelity*> worst_of(std::vector<const LabelFidelity*> rows, Worse worse) {
  std::stable_sort(rows.begin(), rows.end(),
                   [&](const LabelFidelity* a, const LabelFidelity* b) { return worse(*a, *b); });
  rows.resize(std::min(rows.size(), kWorstLabels));
  return rows;
}

bool has_lower_dice(const LabelFidelity& a, const LabelFidelity& b) {
  return a.overlap.dice() < b.overlap.dice();
}

bool has_larger_volume_error(const LabelFidelity& a, const LabelFidelity& b) {
  return std::fabs(volume_error_percent(a)) > std::fabs(volume_error_percent(b));
}

std::vector<const LabelFidelity*> worst_labels(const Fidelity& fidelity) {
  std::vector<const LabelFidelity*> all, large;
  for (const LabelFidelity& row : fidelity.per_label) {
    all.push_back(&row);
    if (row.voxels > kVoxelsForVolumeError) {
      large.push_back(&row);
    }
  }
  std::vector<const LabelFidelity*> worst = worst_of(std::move(all), has_lower_dice);
  for (const LabelFidelity* row : worst_of(std::move(large), has_larger_volume_error)) {
    if (std::find(worst.begin(), worst.end(), row) == worst.end()) {
      worst.push_back(row);
    }
  }
  std::stable_sort(worst.begin(), worst.end(),
                   [](const LabelFidelity* a, const LabelFidelity* b) { return has_lower_dice(*a, *b); });
  return worst;
}

void write_worst_labels(json& object, const Fidelity& fidelity) {
  auto rows = json::array();
  for (const LabelFidelity* row : worst_labels(fidelity)) {
    rows.push_back({{"label", row->label},
                    {"voxels", row->voxels},
                    {"dice", row->overlap.dice()},
                    {"volume_error_percent", volume_error_percent(*row)}});
  }
  object["dice_min"] = rows.empty() ? json(nullptr) : rows.front()["dice"];
  object["dice_label"] = rows.empty() ? json(nullptr) : rows.front()["label"];
  object["worst_labels"] = std::move(rows);
}

void write_topology(json& object, const TopologyDifference& difference) {
  auto labels = json::array();
  for (const LabelTopologyDifference& row : difference.per_label) {
    if (row.count().value_or(0) > 0) {
      labels.push_back(row.label);
    }
  }
  object["topology_differences"] = difference.total ? json(*difference.total) : json(nullptr);
  object["topology_difference_labels"] = std::move(labels);
}

void write_labels(json& object, const Fidelity& fidelity) {
  Worst volume;
  auto missing = json::array();
  const auto& absent = fidelity.labels.missing;
  for (const LabelFidelity& row : fidelity.per_label) {
    if (row.voxels > kVoxelsForVolumeError) {
      volume.add(row.label, volume_error_percent(row));
    }
    if (row.voxels > kVoxelsToBeThere && std::find(absent.begin(), absent.end(), row.label) != absent.end()) {
      missing.push_back(row.label);
    }
  }
  object["volume_error_percent"] =
      number_or_null(volume.value ? std::optional(volume.signed_value) : std::nullopt);
  object["volume_error_label"] = volume.label_json();
  object["missing_labels"] = std::move(missing);
}

// Labels of the mesh of which `has` is true.
json labels_that(const MeshView& view, const std::function<bool(std::size_t)>& has) {
  auto labels = json::array();
  for (std::size_t l = 0; l < view.labels().size(); ++l) {
    if (has(l)) {
      labels.push_back(view.labels()[l]);
    }
  }
  return labels;
}

void write_mesh(json& object, const Judged& mesh) {
  const auto& per_label = mesh.quality.per_label;
  Label sharpest = 0;
  for (std::size_t l = 0; l < per_label.size(); ++l) {
    if (per_label[l].min_dihedral_deg == mesh.quality.all.min_dihedral_deg) {
      sharpest = mesh.view.labels()[l];
      break;
    }
  }
  const auto& least = mesh.quality.all.min_dihedral_deg;
  object["elements"] = mesh.view.cell_count();
  object["min_dihedral_deg"] = number_or_null(least);
  object["min_dihedral_label"] = least ? json(sharpest) : json(nullptr);
  object["inverted"] = mesh.quality.all.inverted;
  object["inverted_labels"] =
      labels_that(mesh.view, [&](std::size_t l) { return per_label[l].inverted > 0; });
  std::int64_t edges = 0, vertices = 0;
  for (const LabelTopology& one : mesh.topology.per_label) {
    edges += one.non_manifold_edges;
    vertices += one.non_manifold_vertices;
  }
  object["non_manifold_edges"] = edges;
  object["non_manifold_vertices"] = vertices;
  object["non_manifold_labels"] = labels_that(mesh.view, [&](std::size_t l) {
    return mesh.topology.per_label[l].non_manifold_edges + mesh.topology.per_label[l].non_manifold_vertices >
           0;
  });
  object["self_intersections"] = mesh.crossing.pairs;
  object["self_intersection_labels"] =
      labels_that(mesh.view, [&](std::size_t l) { return mesh.crossing.per_label[l] > 0; });
}

}  // namespace

json summary(const Judged& mesh) {
  json object;
  write_mesh(object, mesh);
  const double diagonal_mm = mesh.frame.spacing_mm.norm();
  object["voxel_diagonal_mm"] = diagonal_mm;
  write_distances(object, mesh.fidelity, diagonal_mm);
  write_labels(object, mesh.fidelity);
  write_worst_labels(object, mesh.fidelity);
  write_topology(object, mesh.difference);
  return object;
}

}  // namespace cbc3d::metrics
