// Where the topology of a label of a mesh differs from the image's.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "metrics/image_topology.hpp"
#include "metrics/surface.hpp"

namespace cbc3d::metrics {

/// Parts and cavities of mesh and image are matched by where they lie. A part of the image is lost when no
/// cell of the label lies in it, split when cells of several parts of the mesh do; a part of the mesh is
/// added when it lies in no voxel of the label, and parts are joined when it lies in several of the image's.
/// Cavities of the mesh are closed sheets of the label's surface that face inwards; they belong to the
/// image's cavity that most of their vertices lie next to. Tunnels are found at the scale of voxels: voxel
/// centres that the mesh labels otherwise than the image are relabelled one after the other, and where the
/// Euler characteristic of a group of neighbours changes by as much as tunnels would change it, there is a
/// place for each. Tunnels finer than that have none.
enum class TopologyPlaceKind : std::uint8_t {
  kPartLost,
  kPartAdded,
  kPartSplit,
  kPartsJoined,
  kCavityLost,
  kCavityAdded,
  kTunnelLost,
  kTunnelAdded
};
inline constexpr std::array<const char*, 8> kTopologyPlaceNames{"part_lost",    "part_added",  "part_split",
                                                                "parts_joined", "cavity_lost", "cavity_added",
                                                                "tunnel_lost",  "tunnel_added"};

struct TopologyPlace {
  Label label = 0;
  TopologyPlaceKind kind = TopologyPlaceKind::kPartLost;
  Vec3 at_mm{};  ///< physical
};

/// How many places of each kind are written.
inline constexpr std::size_t kMostPlacesOfAKind = 20;

/// A label to look at.
struct DifferingLabel {
  Label label = 0;
  std::optional<std::uint32_t> mesh_label;  ///< index into MeshView::labels()
  std::optional<MaterialId> material;       ///< of the image
  bool open = false;                        ///< see topology_difference.hpp
  std::optional<Betti>
      difference;  ///< mesh minus image; nothing: not known, parts and cavities are looked at
};

/// The places of all these labels, in their order, of each the parts first.
std::vector<TopologyPlace> topology_places(const MeshView& view, const Surface& surface,
                                           const LabelImage& image,
                                           const std::vector<DifferingLabel>& labels);

}  // namespace cbc3d::metrics
