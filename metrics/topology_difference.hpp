// How the topology of a mesh differs from that of its image, label by label, and where.
//
// An image does not say by itself what its topology is: voxels of a label that touch at an edge or a corner
// alone are connected as a closed set and are not as an open one. Which of the two a mesh must have is
// decided by the image alone:
//   closed  where no voxels of the label touch like that, so that closed and open set agree;
//   open    elsewhere: voxels are connected through faces, their complement through corners too.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "metrics/topology.hpp"
#include "metrics/topology_places.hpp"

namespace cbc3d::metrics {

struct LabelTopologyDifference {
  Label label = 0;
  std::optional<std::uint32_t>
      mesh_label;  ///< index into MeshView::labels(); nothing where no cell has the label
  bool in_image = false;
  bool open = false;  ///< the image's label is taken as an open set; without meaning where it is not there
  Betti image;        ///< zeros where the image has not the label
  std::optional<Betti>
      mesh;  ///< zeros where no cell has it; nothing where the cells form no set (mesh_betti.hpp)

  /// Mesh minus image.
  [[nodiscard]] std::optional<Betti> difference() const;
  /// The sum of the three magnitudes.
  [[nodiscard]] std::optional<std::int64_t> count() const;
};

struct TopologyDifference {
  std::vector<LabelTopologyDifference> per_label;  ///< labels of image or mesh without 0, ascending
  std::optional<std::int64_t> total;  ///< nothing where a label has none or the image has too many labels
  std::vector<TopologyPlace> places;  ///< labels ascending
};

/// Time linear in the labels; for labels that differ also in their cells and the box around their voxels.
TopologyDifference topology_difference(const MeshView& view, const Surface& surface, const Topology& topology,
                                       const ImageTopology& image_topology, const LabelImage& image);

/// Writes into the section `topology`: differences; into each row of its per_label image_topology (open or
/// closed; null where the image has not the label), betti_difference ([parts, tunnels, cavities], mesh minus
/// image) and differences; missing_labels_topology, rows of label, image_topology, image_betti,
/// image_open_betti, betti_difference and differences for the image's labels in no cell; difference_places:
/// count, per_kind, and in list at most kMostPlacesOfAKind of each kind ({label, kind, at_mm}).
void write_json(nlohmann::json& topology, const TopologyDifference& difference,
                const ImageTopology& image_topology, const LabelImage& image);

}  // namespace cbc3d::metrics
