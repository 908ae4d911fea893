#include "mesher/preprocess/voxel_contacts.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "mesher/core/voxel_rows.hpp"
#include "mesher/domain/size_rank.hpp"

namespace cbc3d {
namespace {

enum class Kind { vertex, edge };

/// A hash in which every bit of the result depends on every bit of the input.
std::uint64_t mix(std::uint64_t h) {
  h ^= h >> 30U;
  h *= 0xBF58476D1CE4E5B9ULL;
  h ^= h >> 27U;
  h *= 0x94D049BB133111EBULL;
  return h ^ (h >> 31U);
}

/// The 2x2x2 cells of a row of voxels, a register full of them at once. Corner c of a cell is one voxel on
/// along x where bit 0 of c is set, along y where bit 1, along z where bit 2.
template <typename Voxel>
class CellLanes {
 public:
  using Register = VoxelLanes<Voxel>;
  using Lanes = typename Register::Lanes;
  using Mask = typename Register::Mask;

  CellLanes(const Voxel* first, std::size_t row, std::size_t slice) {
    const std::array<const Voxel*, 4> rows = {first, first + row, first + slice, first + row + slice};
    for (std::size_t r = 0; r < 4; ++r) {
      corner_[2 * r] = Register::load(rows[r]);
      corner_[2 * r + 1] = Register::load(rows[r] + 1);
    }
  }

  /// True when no cell has two materials, as nearly everywhere.
  [[nodiscard]] bool uniform() const {
    Lanes differ = corner_[0] ^ corner_[1];
    for (std::size_t c = 2; c < 8; ++c) {
      differ |= corner_[0] ^ corner_[c];
    }
    return !Register::any(differ);
  }

  [[nodiscard]] Mask vertex_contacts() const {
    Mask found{};
    for (std::size_t c = 0; c < 4; ++c) {
      Mask contact = (corner_[c] != 0) & (corner_[c] == corner_[7 - c]);
      for (std::size_t other = 0; other < 8; ++other) {
        contact &= other == c || other == 7 - c ? contact : corner_[other] != corner_[c];
      }
      found |= contact;
    }
    return found;
  }

  /// In the three squares at corner 0.
  [[nodiscard]] Mask edge_contacts() const {
    return square_contacts(1, 2) | square_contacts(2, 4) | square_contacts(4, 1);
  }

 private:
  [[nodiscard]] Mask square_contacts(std::size_t u, std::size_t w) const {
    return diagonal_contacts(corner_[0], corner_[u | w], corner_[u], corner_[w]) |
           diagonal_contacts(corner_[u], corner_[w], corner_[0], corner_[u | w]);
  }
  static Mask diagonal_contacts(const Lanes& a, const Lanes& b, const Lanes& one, const Lanes& other) {
    return (a != 0) & (a == b) & (a != one) & (a != other);
  }

  std::array<Lanes, 8> corner_;
};

class ContactRemover {
 public:
  ContactRemover(LabelImage& image, std::uint64_t seed)
      : image_(image),
        seed_(seed),
        step_{1, static_cast<std::size_t>(image.frame.size[0]),
              static_cast<std::size_t>(image.frame.size[0]) * static_cast<std::size_t>(image.frame.size[1])} {
  }

  ContactReport count() {
    const auto [vertex_places, edge_places] = places_in_image();
    report_.vertex_contacts = vertex_places.size();
    report_.edge_contacts = edge_places.size();
    return report_;
  }

  ContactReport run() {
    report_.gained.assign(image_.material_count(), 0);
    auto [vertex_places, edge_places] = places_in_image();
    report_.vertex_contacts = vertex_places.size();
    report_.edge_contacts = edge_places.size();
    if (!vertex_places.empty() || !edge_places.empty()) {
      priority_ = rank_by_size(count_materials(image_), BackgroundRank::lowest);
    }
    while (!vertex_places.empty() || !edge_places.empty()) {
      ++report_.rounds;
      // First all vertex contacts, then the edge contacts; changes make new places to look at.
      changed_.clear();
      resolve(vertex_places, Kind::vertex);
      add_places_near_changes(edge_places);
      resolve(edge_places, Kind::edge);
      vertex_places.clear();
      add_places_near_changes(vertex_places);
      edge_places = vertex_places;
      keep_contacts(vertex_places, Kind::vertex);
      keep_contacts(edge_places, Kind::edge);
    }
    return report_;
  }

 private:
  /// The two voxels in contact and the paths by which they can be joined.
  struct Contact {
    std::array<std::size_t, 2> ends;  // voxel offsets
    std::array<std::array<std::size_t, 2>, 6>
        paths;  // voxels to set; for an edge contact both entries are the same
    std::size_t path_count;
  };

  [[nodiscard]] MaterialId at(std::size_t v) const { return image_.voxels[v]; }

  /// The places with a contact, by kind: the lowest voxel of the 2x2x2 cell, or of one of three 2x2 squares.
  struct Places {
    std::vector<std::size_t> vertex, edge;  // ascending
  };
  Places places_in_image() {
    const auto& size = image_.frame.size;
    std::vector<Places> found(static_cast<std::size_t>(size[2]));
#pragma omp parallel for schedule(dynamic)
    for (int k = 0; k < size[2]; ++k) {
      Places& slice = found[static_cast<std::size_t>(k)];
      for (int j = 0; j < size[1]; ++j) {
        const bool within = j + 1 < size[1] && k + 1 < size[2];
        for (int i = within ? add_places_of_lanes(j, k, slice) : 0; i < size[0]; ++i) {
          add_place({i, j, k}, slice);
        }
      }
    }
    Places places;
    for (const Places& slice : found) {
      places.vertex.insert(places.vertex.end(), slice.vertex.begin(), slice.vertex.end());
      places.edge.insert(places.edge.end(), slice.edge.begin(), slice.edge.end());
    }
    return places;
  }

  void add_place(const Index3& index, Places& places) const {
    const std::size_t v = image_.frame.offset(index[0], index[1], index[2]);
    if (may_have_contact(v, index)) {
      if (find_contact(v, Kind::vertex)) {
        places.vertex.push_back(v);
      }
      if (find_contact(v, Kind::edge)) {
        places.edge.push_back(v);
      }
    }
  }

  /// The places of a row that has others above it on both axes, up to the index that is returned: those
  /// beyond have no register full of neighbours.
  int add_places_of_lanes(int j, int k, Places& places) const {
    return image_.voxels.visit([&]<typename Voxel>(const Voxel* voxels) {
      constexpr int kCount = VoxelLanes<Voxel>::kCount;
      const std::size_t row = image_.frame.offset(0, j, k);
      const int end = image_.frame.size[0] - 1;  // of the cells with all eight corners
      if (end < kCount) {
        return 0;
      }
      for (int done = 0; done < end;) {
        const int i = std::min(done, end - kCount);  // the last register looks at some cells again
        const std::size_t v = row + static_cast<std::size_t>(i);
        const CellLanes<Voxel> cells(voxels + v, step_[1], step_[2]);
        if (!cells.uniform()) {
          add_lanes(cells.vertex_contacts(), v, done - i, places.vertex);
          add_lanes(cells.edge_contacts(), v, done - i, places.edge);
        }
        done = i + kCount;
      }
      return end;
    });
  }

  template <typename Mask>
  static void add_lanes(const Mask& contacts, std::size_t v, int from, std::vector<std::size_t>& places) {
    if (VoxelLanes<std::uint8_t>::any(contacts)) {
      constexpr int kCount = static_cast<int>(sizeof contacts / sizeof contacts[0]);
      for (int lane = from; lane < kCount; ++lane) {
        if (contacts[lane] != 0) {
          places.push_back(v + static_cast<std::size_t>(lane));
        }
      }
    }
  }

  /// Cheap test that nearly every voxel fails: all eight voxels of the cell are the same.
  [[nodiscard]] bool may_have_contact(std::size_t v, const Index3& at_index) const {
    const MaterialId m = at(v);
    const bool x = at_index[0] + 1 < image_.frame.size[0];
    const bool y = at_index[1] + 1 < image_.frame.size[1];
    const bool z = at_index[2] + 1 < image_.frame.size[2];
    return (x && at(v + step_[0]) != m) || (y && at(v + step_[1]) != m) || (z && at(v + step_[2]) != m) ||
           (x && y && at(v + step_[0] + step_[1]) != m) || (x && z && at(v + step_[0] + step_[2]) != m) ||
           (y && z && at(v + step_[1] + step_[2]) != m) ||
           (x && y && z && at(v + step_[0] + step_[1] + step_[2]) != m);
  }

  [[nodiscard]] std::optional<Contact> find_contact(std::size_t v, Kind kind) const {
    const Index3 index = image_.frame.index_of(v);
    std::array<bool, 3> room{};
    for (std::size_t d = 0; d < 3; ++d) {
      room[d] = index[d] + 1 < image_.frame.size[d];
    }
    if (kind == Kind::vertex) {
      return room[0] && room[1] && room[2] ? find_vertex_contact(v) : std::nullopt;
    }
    for (std::size_t d = 0; d < 3; ++d) {
      const std::size_t e = (d + 1) % 3;
      if (room[d] && room[e]) {
        if (auto contact = find_edge_contact(v, step_[d], step_[e])) {
          return contact;
        }
      }
    }
    return std::nullopt;
  }

  [[nodiscard]] std::optional<Contact> find_edge_contact(std::size_t v, std::size_t u, std::size_t w) const {
    const std::array<std::size_t, 4> corner = {v, v + u, v + u + w, v + w};  // around the square
    for (std::size_t c = 0; c < 2; ++c) {
      const MaterialId m = at(corner[c]);
      if (m != kBackground && at(corner[c + 2]) == m && at(corner[c + 1]) != m &&
          at(corner[(c + 3) % 4]) != m) {
        Contact contact{{corner[c], corner[c + 2]}, {}, 2};
        contact.paths[0] = {corner[c + 1], corner[c + 1]};
        contact.paths[1] = {corner[(c + 3) % 4], corner[(c + 3) % 4]};
        return contact;
      }
    }
    return std::nullopt;
  }

  [[nodiscard]] std::optional<Contact> find_vertex_contact(std::size_t v) const {
    std::array<std::size_t, 8> corner{};
    for (std::size_t c = 0; c < 8; ++c) {
      corner[c] = v + ((c & 1U) != 0 ? step_[0] : 0) + ((c & 2U) != 0 ? step_[1] : 0) +
                  ((c & 4U) != 0 ? step_[2] : 0);
    }
    for (std::size_t c = 0; c < 4; ++c) {
      const MaterialId m = at(corner[c]);
      if (m == kBackground || at(corner[7 - c]) != m) {
        continue;
      }
      const auto same =
          std::count_if(corner.begin(), corner.end(), [&](std::size_t o) { return at(o) == m; });
      if (same == 2) {
        Contact contact{{corner[c], corner[7 - c]}, {}, 6};
        std::size_t path = 0;
        for (std::size_t first = 0; first < 3; ++first) {
          for (std::size_t second = 0; second < 3; ++second) {
            if (second != first) {
              const std::size_t one = c ^ (1U << first);
              contact.paths[path++] = {corner[one], corner[one ^ (1U << second)]};
            }
          }
        }
        return contact;
      }
    }
    return std::nullopt;
  }

  /// In order, each place looked at as it is when its turn comes.
  void resolve(const std::vector<std::size_t>& places, Kind kind) {
    for (const std::size_t v : places) {
      for (auto contact = find_contact(v, kind); contact; contact = find_contact(v, kind)) {
        resolve(*contact, mix(v ^ mix(seed_ ^ (static_cast<std::uint64_t>(report_.rounds) << 32U))));
      }
    }
  }

  void resolve(const Contact& contact, std::uint64_t random) {
    const MaterialId m = at(contact.ends[0]);
    const auto highest = [&](const std::array<std::size_t, 2>& path) {
      return std::max(priority_[at(path[0])], priority_[at(path[1])]);
    };
    std::array<std::size_t, 6> open{};
    std::size_t count = 0;
    const auto collect_below = [&](std::uint32_t priority) {
      for (std::size_t p = 0; p < contact.path_count; ++p) {
        if (highest(contact.paths[p]) < priority) {
          open[count++] = p;
        }
      }
    };
    collect_below(1);  // background only
    if (count == 0) {
      collect_below(priority_[m]);
    }
    if (count > 0) {
      for (const std::size_t v : contact.paths[open[random % count]]) {
        set(v, m);
      }
      return;
    }
    give_way(contact, m, random);
  }

  /// Every path holds a material of higher priority: one of the two ends takes over such a neighbour's
  /// material.
  void give_way(const Contact& contact, MaterialId m, std::uint64_t random) {
    const auto& path = contact.paths[random % contact.path_count];
    const std::size_t end = contact.ends[(random >> 8U) % 2];
    set(end, priority_[at(path[0])] > priority_[m] ? at(path[0]) : at(path[1]));
  }

  void set(std::size_t v, MaterialId m) {
    if (at(v) != m) {
      --report_.gained[at(v)];
      ++report_.gained[m];
      image_.voxels.set(v, m);
      changed_.push_back(v);
      ++report_.voxels_changed;
    }
  }

  /// Adds the places whose cell holds a changed voxel; ascending and distinct.
  void add_places_near_changes(std::vector<std::size_t>& places) const {
    for (const std::size_t v : changed_) {
      const Index3 index = image_.frame.index_of(v);
      for (int k = std::max(0, index[2] - 1); k <= index[2]; ++k) {
        for (int j = std::max(0, index[1] - 1); j <= index[1]; ++j) {
          for (int i = std::max(0, index[0] - 1); i <= index[0]; ++i) {
            places.push_back(image_.frame.offset(i, j, k));
          }
        }
      }
    }
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
  }

  void keep_contacts(std::vector<std::size_t>& places, Kind kind) const {
    std::erase_if(places, [&](std::size_t v) { return !find_contact(v, kind); });
  }

  LabelImage& image_;
  std::uint64_t seed_;
  std::vector<std::uint32_t> priority_;  // by material; only where there are contacts
  std::array<std::size_t, 3> step_;
  std::vector<std::size_t> changed_;
  ContactReport report_;
};

}  // namespace

ContactReport remove_voxel_contacts(LabelImage& image, std::uint64_t seed) {
  return ContactRemover(image, seed).run();
}

ContactReport count_voxel_contacts(const LabelImage& image) {
  LabelImage copy = image;
  return ContactRemover(copy, 0).count();
}

}  // namespace cbc3d
