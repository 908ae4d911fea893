#include "metrics/topology_difference.hpp"

#include <algorithm>
#include <cstdlib>

namespace cbc3d::metrics {
namespace {

using nlohmann::json;

Betti minus(const Betti& a, const Betti& b) {
  return {{a.b[0] - b.b[0], a.b[1] - b.b[1], a.b[2] - b.b[2]}};
}

std::int64_t magnitude(const Betti& betti) {
  return std::abs(betti.b[0]) + std::abs(betti.b[1]) + std::abs(betti.b[2]);
}

void set_image(LabelTopologyDifference& row, const VoxelSetTopology& image) {
  row.in_image = true;
  row.open = image.ambiguous > 0;
  row.image = row.open ? image.open : image.closed;
}

// The image's labels with voxels and the mesh's, ascending.
std::vector<LabelTopologyDifference> rows_of(const MeshView& view, const Topology& topology,
                                             const ImageTopology& image_topology, const LabelImage& image) {
  std::vector<Label> labels(view.labels());
  for (std::size_t m = 1; m < image.material_count(); ++m) {
    if (image_topology.per_material[m].closed.b[0] > 0) {
      labels.push_back(image.labels[m]);
    }
  }
  std::sort(labels.begin(), labels.end());
  labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
  std::erase(labels, 0);
  std::vector<LabelTopologyDifference> rows;
  for (const Label label : labels) {
    LabelTopologyDifference& row = rows.emplace_back();
    row.label = label;
    row.mesh_label = view.find_label(label);
    row.mesh = row.mesh_label ? topology.betti.per_label[*row.mesh_label].betti : std::optional(Betti{});
    const VoxelSetTopology* found = find_label(image_topology, image, label);
    if (found != nullptr && found->closed.b[0] > 0) {
      set_image(row, *found);
    }
  }
  return rows;
}

std::vector<DifferingLabel> differing_labels(const std::vector<LabelTopologyDifference>& rows,
                                             const LabelImage& image) {
  std::vector<DifferingLabel> labels;
  for (const LabelTopologyDifference& row : rows) {
    if (row.count() == std::optional<std::int64_t>(0)) {
      continue;
    }
    DifferingLabel& label = labels.emplace_back(
        DifferingLabel{row.label, row.mesh_label, std::nullopt, row.open, row.difference()});
    if (row.in_image) {
      const auto found = std::lower_bound(image.labels.begin() + 1, image.labels.end(), row.label);
      label.material = static_cast<MaterialId>(found - image.labels.begin());
    }
  }
  return labels;
}

void write_row(json& object, const LabelTopologyDifference& row) {
  const std::optional<Betti> difference = row.difference();
  object["image_topology"] = row.in_image ? json(row.open ? "open" : "closed") : json(nullptr);
  object["betti_difference"] = difference ? json(difference->b) : json(nullptr);
  object["differences"] = difference ? json(magnitude(*difference)) : json(nullptr);
}

json places_json(const std::vector<TopologyPlace>& places) {
  std::array<std::size_t, kTopologyPlaceNames.size()> of_kind{};
  auto list = json::array();
  for (const TopologyPlace& place : places) {
    const auto kind = static_cast<std::size_t>(place.kind);
    if (++of_kind[kind] <= kMostPlacesOfAKind) {
      list.push_back({{"label", place.label},
                      {"kind", kTopologyPlaceNames[kind]},
                      {"at_mm", {place.at_mm.x, place.at_mm.y, place.at_mm.z}}});
    }
  }
  json object{{"count", places.size()}, {"list", std::move(list)}};
  for (std::size_t kind = 0; kind < of_kind.size(); ++kind) {
    object["per_kind"][kTopologyPlaceNames[kind]] = of_kind[kind];
  }
  return object;
}

}  // namespace

std::optional<Betti> LabelTopologyDifference::difference() const {
  return mesh ? std::optional(minus(*mesh, image)) : std::nullopt;
}

std::optional<std::int64_t> LabelTopologyDifference::count() const {
  const std::optional<Betti> found = difference();
  return found ? std::optional(magnitude(*found)) : std::nullopt;
}

TopologyDifference topology_difference(const MeshView& view, const Surface& surface, const Topology& topology,
                                       const ImageTopology& image_topology, const LabelImage& image) {
  TopologyDifference result;
  if (image_topology.per_material.size() < image.material_count()) {
    return result;  // too many labels
  }
  result.per_label = rows_of(view, topology, image_topology, image);
  result.total = 0;
  for (const LabelTopologyDifference& row : result.per_label) {
    const std::optional<std::int64_t> count = row.count();
    result.total = result.total && count ? std::optional(*result.total + *count) : std::nullopt;
  }
  result.places = topology_places(view, surface, image, differing_labels(result.per_label, image));
  return result;
}

void write_json(json& topology, const TopologyDifference& difference, const ImageTopology& image_topology,
                const LabelImage& image) {
  topology["differences"] = difference.total ? json(*difference.total) : json(nullptr);
  for (json& row : topology["per_label"]) {
    row["image_topology"] = row["betti_difference"] = row["differences"] = nullptr;
  }
  auto missing = json::array();
  for (const LabelTopologyDifference& row : difference.per_label) {
    if (row.mesh_label) {
      write_row(topology["per_label"][*row.mesh_label], row);
      continue;
    }
    const VoxelSetTopology* found = find_label(image_topology, image, row.label);
    json object{{"label", row.label}, {"image_betti", found->closed.b}, {"image_open_betti", found->open.b}};
    write_row(object, row);
    missing.push_back(std::move(object));
  }
  topology["missing_labels_topology"] = std::move(missing);
  topology["difference_places"] = places_json(difference.places);
}

}  // namespace cbc3d::metrics
