#include "metrics/topology_places.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <span>
#include <tuple>
#include <unordered_set>

#include "mesher/core/disjoint_sets.hpp"
#include "metrics/mesh_raster.hpp"
#include "metrics/nearest_voxel.hpp"
#include "metrics/reduce.hpp"
#include "metrics/smoothness.hpp"
#include "metrics/voxel_components.hpp"

namespace cbc3d::metrics {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Vec3 physical_centre(const ImageFrame& frame, const Index3& voxel) {
  return frame.to_physical(frame.local_centre(voxel[0], voxel[1], voxel[2]));
}

// Calls visit(voxel) for a voxel and its 26 neighbours, inside the image or not.
template <class Visit>
void for_neighbourhood(const Index3& voxel, const Visit& visit) {
  for (int n = 0; n < 27; ++n) {
    visit(Index3{voxel[0] + n % 3 - 1, voxel[1] + n / 3 % 3 - 1, voxel[2] + n / 9 - 1});
  }
}

Vec3 local_centroid(const MeshView& view, std::uint32_t cell) {
  Vec3 centre{};
  const CellView found = view.cell(cell);
  for (const VertexId v : found.nodes) {
    centre += view.local_points()[v] / static_cast<double>(found.nodes.size());
  }
  return centre;
}

template <typename Value>
std::vector<Value> values_at(const std::vector<std::uint32_t>& places, const std::vector<Value>& values) {
  std::vector<Value> found;
  found.reserve(places.size());
  for (const std::uint32_t place : places) {
    found.push_back(values[place]);
  }
  return found;
}

// A part of the mesh: cells of one label that are connected through vertices.
struct MeshPart {
  std::vector<std::uint32_t> cells;
  Vec3 place_mm{};  // local: the centroid of the cell nearest to that of the part
};

std::vector<MeshPart> mesh_parts(const MeshView& view, const std::vector<std::uint32_t>& cells) {
  std::vector<std::pair<VertexId, std::uint32_t>> corners;  // vertex, number of the cell
  for (std::uint32_t n = 0; n < cells.size(); ++n) {
    for (const VertexId v : view.cell(cells[n]).nodes) {
      corners.emplace_back(v, n);
    }
  }
  std::sort(corners.begin(), corners.end());
  DisjointSets sets(cells.size());
  for (std::size_t c = 1; c < corners.size(); ++c) {
    if (corners[c].first == corners[c - 1].first) {
      sets.join(corners[c].second, corners[c - 1].second);
    }
  }
  std::vector<MeshPart> parts;
  for (const std::vector<std::uint32_t>& members : sets.members()) {
    parts.push_back({.cells = values_at(members, cells)});
  }
  return parts;
}

void find_place(const MeshView& view, MeshPart& part) {
  Vec3 centre{};
  for (const std::uint32_t c : part.cells) {
    centre += local_centroid(view, c) / static_cast<double>(part.cells.size());
  }
  double nearest = kInfinity;
  for (const std::uint32_t c : part.cells) {
    const Vec3 at = local_centroid(view, c);
    if ((at - centre).squared_norm() < nearest) {
      nearest = (at - centre).squared_norm();
      part.place_mm = at;
    }
  }
}

// The components of the image that a part lies in, ascending; those next to it where it lies in none.
std::vector<std::uint32_t> components_under(const MeshView& view, const ImageFrame& frame,
                                            const MeshPart& part, const VoxelComponents& components) {
  std::vector<std::uint32_t> found;
  for (const int reach : {0, 1}) {
    for (const std::uint32_t c : part.cells) {
      for_neighbourhood(nearest_voxel(frame, local_centroid(view, c)), [&](const Index3& voxel) {
        const bool is_near = reach == 1 || voxel == nearest_voxel(frame, local_centroid(view, c));
        if (const auto component = is_near ? components.find(voxel) : std::nullopt) {
          if (found.empty() || found.back() != *component) {
            found.push_back(*component);
          }
        }
      });
    }
    if (!found.empty()) {
      break;
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

// The sheets of a label's surface, joined at edges, that enclose a negative volume: walls of cavities.
std::vector<std::vector<Vec3>> cavity_walls(const MeshView& view, const Surface& surface,
                                            std::uint32_t label) {
  struct Side {
    std::uint64_t low, high;
    std::uint32_t facet;
  };
  const std::vector<NumberedFacet> facets = numbered_facets(surface, label, view.mesh().points);
  std::vector<Side> sides;
  for (std::uint32_t f = 0; f < facets.size(); ++f) {
    const std::size_t corners = corner_count(facets[f]);
    for (std::size_t n = 0; n < corners; ++n) {
      const auto [low, high] = std::minmax(facets[f].corner[n], facets[f].corner[(n + 1) % corners]);
      sides.push_back({low, high, f});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.facet) < std::tie(b.low, b.high, b.facet);
  });
  DisjointSets sets(facets.size());
  for (std::size_t s = 1; s < sides.size(); ++s) {
    if (sides[s].low == sides[s - 1].low && sides[s].high == sides[s - 1].high) {
      sets.join(sides[s].facet, sides[s - 1].facet);
    }
  }
  std::vector<double> volumes(facets.size(), 0);  // six times, about the sheet's first corner
  for (std::uint32_t f = 0; f < facets.size(); ++f) {
    const std::uint32_t root = sets.root(f);
    const auto& p = facets[f].at;
    for (std::size_t n = 2; n < corner_count(facets[f]); ++n) {
      volumes[root] += six_volumes(facets[root].at[0], p[0], p[n - 1], p[n]);
    }
  }
  std::vector<std::vector<Vec3>> walls;
  std::vector<std::size_t> number(facets.size());
  for (std::uint32_t f = 0; f < facets.size(); ++f) {
    const std::uint32_t root = sets.root(f);
    if (!(volumes[root] < 0)) {
      continue;
    }
    if (root == f) {
      number[f] = walls.size();
      walls.emplace_back();
    }
    std::vector<Vec3>& wall = walls[number[root]];
    wall.insert(wall.end(), facets[f].at.begin(),
                facets[f].at.begin() + static_cast<std::ptrdiff_t>(corner_count(facets[f])));
  }
  return walls;
}

Vec3 mean_of(const std::vector<Vec3>& points) {
  Vec3 sum{};
  for (const Vec3& p : points) {
    sum += p;
  }
  return sum / static_cast<double>(points.size());
}

// The cavity that most corners of a wall lie next to.
std::optional<std::uint32_t> cavity_of(const std::vector<Vec3>& wall, const ImageFrame& frame,
                                       const VoxelComponents& complement) {
  std::vector<std::int64_t> votes(complement.components().size(), 0);
  for (const Vec3& p : wall) {
    for_neighbourhood(nearest_voxel(frame, frame.to_local(p)), [&](const Index3& voxel) {
      const auto found = complement.find(voxel);
      if (found && !complement.components()[*found].reaches_border) {
        ++votes[*found];
      }
    });
  }
  const auto most = std::max_element(votes.begin(), votes.end());
  return most == votes.end() || *most == 0 ? std::nullopt
                                           : std::optional(static_cast<std::uint32_t>(most - votes.begin()));
}

// Where the Euler characteristic of a material changes while voxels are relabelled one after the other.
class EulerWalk {
 public:
  EulerWalk(const LabelImage& image, MaterialId material, bool open)
      : image_(image), material_(material), table_(open ? corner_tables().open : corner_tables().closed) {}

  /// Relabels the voxels of each group of neighbours; appends those at which the group changed the
  /// characteristic by what has the sign of `sign`, as many of each group as it changed it by in all.
  void relabel(const std::vector<std::size_t>& voxels, int sign, std::vector<Index3>& places) {
    for (const std::vector<std::size_t>& group : groups_of(voxels)) {
      int total = 0;
      std::vector<Index3> candidates;
      for (const std::size_t voxel : group) {
        const int change = flip(voxel);
        total += change;
        if (change * sign > 0) {
          candidates.push_back(image_.frame.index_of(voxel));
        }
      }
      const auto wanted = static_cast<std::size_t>(std::max(0, total * sign));
      candidates.resize(std::min(candidates.size(), wanted));
      places.insert(places.end(), candidates.begin(), candidates.end());
    }
  }

 private:
  [[nodiscard]] bool is_in(const Index3& at) const {
    if (!image_.frame.contains(at[0], at[1], at[2])) {
      return false;
    }
    const std::size_t voxel = image_.frame.offset(at[0], at[1], at[2]);
    return (image_.voxels[voxel] == material_) != flipped_.contains(voxel);
  }

  // Relabels a voxel; returns by how much the characteristic changes.
  int flip(std::size_t voxel) {
    const Index3 at = image_.frame.index_of(voxel);
    std::array<bool, 27> in;
    std::size_t n = 0;
    for_neighbourhood(at, [&](const Index3& neighbour) { in[n++] = is_in(neighbour); });
    int eight_times = 0;
    for (std::size_t corner = 0; corner < 8; ++corner) {
      const std::size_t low = corner % 2 + 3 * (corner / 2 % 2) + 9 * (corner / 4);
      unsigned before = 0, own = 0;
      for (unsigned bit = 0; bit < 8; ++bit) {
        const std::size_t cell = low + bit % 2 + 3 * (bit / 2 % 2) + 9 * (bit / 4);
        before |= in[cell] ? 1U << bit : 0U;
        own |= cell == 13 ? 1U << bit : 0U;
      }
      eight_times += table_[before ^ own] - table_[before];
    }
    if (!flipped_.insert(voxel).second) {
      flipped_.erase(voxel);
    }
    return eight_times / 8;
  }

  // Voxels that touch, at corners too; ascending within a group, groups by their first.
  [[nodiscard]] std::vector<std::vector<std::size_t>> groups_of(
      const std::vector<std::size_t>& voxels) const {
    DisjointSets sets(voxels.size());
    for (std::uint32_t v = 0; v < voxels.size(); ++v) {
      for_neighbourhood(image_.frame.index_of(voxels[v]), [&](const Index3& at) {
        if (!image_.frame.contains(at[0], at[1], at[2])) {
          return;
        }
        const std::size_t other = image_.frame.offset(at[0], at[1], at[2]);
        const auto found = std::lower_bound(voxels.begin(), voxels.begin() + v, other);
        if (found != voxels.begin() + v && *found == other) {
          sets.join(v, static_cast<std::uint32_t>(found - voxels.begin()));
        }
      });
    }
    std::vector<std::vector<std::size_t>> groups;
    for (const std::vector<std::uint32_t>& members : sets.members()) {
      groups.push_back(values_at(members, voxels));
    }
    return groups;
  }

  const LabelImage& image_;
  MaterialId material_;
  std::array<int, 256> table_;
  std::unordered_set<std::size_t> flipped_;
};

// The places of one label.
class PlaceFinder {
 public:
  PlaceFinder(const MeshView& view, const Surface& surface, const LabelImage& image,
              const DifferingLabel& label, const VoxelBox& box)
      : view_(view), surface_(surface), image_(image), label_(label), box_(box) {}

  void find_parts(const std::vector<std::uint32_t>& cells);
  void find_cavities();
  void find_tunnels(const RelabelledVoxels& voxels);
  [[nodiscard]] std::vector<TopologyPlace> take() { return std::move(places_); }

 private:
  void add(TopologyPlaceKind kind, const Vec3& physical_mm) {
    places_.push_back({label_.label, kind, physical_mm});
  }
  void add(TopologyPlaceKind kind, const Index3& voxel) { add(kind, physical_centre(image_.frame, voxel)); }
  // The material's voxels, or with `complement` the rest and a margin around the box.
  [[nodiscard]] VoxelComponents components(bool complement) const {
    VoxelBox box = box_;
    for (std::size_t axis = 0; axis < 3 && complement; ++axis) {
      --box.low[axis];
      ++box.high[axis];
    }
    return {image_, {label_.material.value(), complement, complement == label_.open}, box};
  }

  const MeshView& view_;
  const Surface& surface_;
  const LabelImage& image_;
  const DifferingLabel& label_;
  const VoxelBox box_;
  std::vector<TopologyPlace> places_;
};

void PlaceFinder::find_parts(const std::vector<std::uint32_t>& cells) {
  std::vector<MeshPart> parts = mesh_parts(view_, cells);
  // The largest part first, to which the others count as added.
  std::stable_sort(parts.begin(), parts.end(),
                   [](const MeshPart& a, const MeshPart& b) { return a.cells.size() > b.cells.size(); });
  std::optional<VoxelComponents> in_image;
  if (label_.material) {
    in_image.emplace(components(false));
  }
  std::vector<bool> is_met(in_image ? in_image->components().size() : 0, false);
  for (MeshPart& part : parts) {
    find_place(view_, part);
    std::vector<std::uint32_t> under;
    if (in_image) {
      under = components_under(view_, image_.frame, part, *in_image);
    }
    if (under.empty()) {
      add(TopologyPlaceKind::kPartAdded, image_.frame.to_physical(part.place_mm));
      continue;
    }
    std::stable_sort(under.begin(), under.end(), [&](std::uint32_t a, std::uint32_t b) {
      return in_image->components()[a].voxels > in_image->components()[b].voxels;
    });
    for (std::size_t n = 1; n < under.size(); ++n) {
      add(TopologyPlaceKind::kPartsJoined, in_image.value().components()[under[n]].place);
    }
    if (under.size() == 1 && is_met[under[0]]) {
      add(TopologyPlaceKind::kPartSplit, image_.frame.to_physical(part.place_mm));
    }
    for (const std::uint32_t component : under) {
      is_met[component] = true;
    }
  }
  for (std::size_t c = 0; c < is_met.size(); ++c) {
    if (!is_met[c]) {
      add(TopologyPlaceKind::kPartLost, in_image.value().components()[c].place);
    }
  }
}

void PlaceFinder::find_cavities() {
  std::vector<std::vector<Vec3>> walls;
  if (label_.mesh_label) {
    walls = cavity_walls(view_, surface_, *label_.mesh_label);
  }
  std::optional<VoxelComponents> complement;
  if (label_.material) {
    complement.emplace(components(true));
  }
  std::vector<bool> is_met(complement ? complement->components().size() : 0, false);
  for (const std::vector<Vec3>& wall : walls) {
    const auto cavity = complement ? cavity_of(wall, image_.frame, *complement) : std::nullopt;
    if (!cavity || is_met[*cavity]) {
      add(TopologyPlaceKind::kCavityAdded, mean_of(wall));
    } else {
      is_met[*cavity] = true;
    }
  }
  for (std::size_t c = 0; c < is_met.size(); ++c) {
    const VoxelComponent& component = complement.value().components()[c];
    if (!is_met[c] && !component.reaches_border) {
      add(TopologyPlaceKind::kCavityLost, component.place);
    }
  }
}

void PlaceFinder::find_tunnels(const RelabelledVoxels& voxels) {
  const bool added = label_.difference.value().b[1] > 0;
  EulerWalk walk(image_, label_.material.value(), label_.open);
  std::vector<Index3> found;
  walk.relabel(voxels.uncovered, added ? -1 : 1, found);
  walk.relabel(voxels.overfilled, added ? -1 : 1, found);
  // Where some tunnels are added and others lost, the label differs by fewer than there are places.
  found.resize(std::min(found.size(), static_cast<std::size_t>(std::abs(label_.difference.value().b[1]))));
  for (const Index3& voxel : found) {
    add(added ? TopologyPlaceKind::kTunnelAdded : TopologyPlaceKind::kTunnelLost, voxel);
  }
}

bool differs(const DifferingLabel& label, std::size_t dimension) {
  return !label.difference || label.difference->b[dimension] != 0;
}

// The cells of each of the labels.
std::vector<std::vector<std::uint32_t>> cells_of(const MeshView& view,
                                                 const std::vector<DifferingLabel>& labels) {
  std::vector<std::vector<std::uint32_t>*> wanted(view.labels().size(), nullptr);
  std::vector<std::vector<std::uint32_t>> cells(labels.size());
  for (std::size_t n = 0; n < labels.size(); ++n) {
    if (labels[n].mesh_label && differs(labels[n], 0)) {
      wanted[labels[n].mesh_label.value()] = &cells[n];
    }
  }
  for (std::size_t c = 0; c < view.cell_count(); ++c) {
    if (auto* list = wanted[view.label_index(c)]) {
      list->push_back(static_cast<std::uint32_t>(c));
    }
  }
  return cells;
}

// Of each label whose tunnels differ; nothing of the others.
std::vector<std::optional<RelabelledVoxels>> voxels_of(const MeshView& view, const LabelImage& image,
                                                       const std::vector<DifferingLabel>& labels) {
  std::vector<RasterLabel> wanted;
  std::vector<std::size_t> whose;
  for (std::size_t n = 0; n < labels.size(); ++n) {
    if (labels[n].mesh_label && labels[n].material && labels[n].difference && differs(labels[n], 1)) {
      wanted.push_back({labels[n].mesh_label.value(), labels[n].material.value()});
      whose.push_back(n);
    }
  }
  std::vector<std::optional<RelabelledVoxels>> result(labels.size());
  if (!wanted.empty()) {
    std::vector<RelabelledVoxels> found = relabelled_voxels(view, image, wanted);
    for (std::size_t n = 0; n < whose.size(); ++n) {
      result[whose[n]] = std::move(found[n]);
    }
  }
  return result;
}

}  // namespace

std::vector<TopologyPlace> topology_places(const MeshView& view, const Surface& surface,
                                           const LabelImage& image,
                                           const std::vector<DifferingLabel>& labels) {
  if (labels.empty()) {
    return {};
  }
  const std::vector<std::vector<std::uint32_t>> cells = cells_of(view, labels);
  const std::vector<std::optional<RelabelledVoxels>> voxels = voxels_of(view, image, labels);
  const std::vector<VoxelBox> boxes = boxes_of_materials(image);
  std::vector<std::vector<TopologyPlace>> places(labels.size());
#pragma omp parallel for schedule(dynamic) if (view.cell_count() > kWorthThreads)
  for (std::size_t n = 0; n < labels.size(); ++n) {
    const DifferingLabel& label = labels[n];
    PlaceFinder finder(view, surface, image, label, label.material ? boxes[*label.material] : VoxelBox{});
    if (differs(label, 0)) {
      finder.find_parts(cells[n]);
    }
    if (differs(label, 2)) {
      finder.find_cavities();
    }
    if (voxels[n]) {
      finder.find_tunnels(voxels[n].value());
    }
    places[n] = finder.take();
  }
  std::vector<TopologyPlace> all;
  for (const std::vector<TopologyPlace>& of_label : places) {
    all.insert(all.end(), of_label.begin(), of_label.end());
  }
  return all;
}

}  // namespace cbc3d::metrics
