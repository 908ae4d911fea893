#include "mesher/mixed/mix_elements.hpp"

#include <algorithm>
#include <cmath>

#include "mesher/topology/cell_quality.hpp"

namespace cbc3d {
namespace {

constexpr std::size_t kStarTets = 24;
constexpr std::size_t kAxes = 6;
constexpr std::size_t kCorners = 8;
constexpr std::size_t kTetsOfAxis = 4;
constexpr std::size_t kTetsOfCorner = 6;

/// The hex of a centre and its six quads, each counter-clockwise seen from its axis neighbour.
struct Cluster {
  std::array<VertexId, 8> hex;
  std::array<VertexId, kAxes> axis;
  std::array<std::array<VertexId, 4>, kAxes> quad;
};

/// True for a tet of the BCC lattice: four edges of one length, two opposite ones sqrt(4/3) times as long.
bool is_red(const MaterialMesh& mesh, const std::array<VertexId, 4>& tet) {
  constexpr double kTolerance = 1e-6;
  const auto square = [&](std::size_t a, std::size_t b) {
    return (mesh.points[tet[a]] - mesh.points[tet[b]]).squared_norm();
  };
  std::array<std::pair<double, double>, 3> opposite = {
      {{square(0, 1), square(2, 3)}, {square(0, 2), square(1, 3)}, {square(0, 3), square(1, 2)}}};
  std::sort(opposite.begin(), opposite.end());
  const double shortest = opposite[0].first;
  const auto near = [&](double length, double factor) {
    return std::abs(length - factor * shortest) <= kTolerance * shortest;
  };
  return near(opposite[0].second, 1) && near(opposite[1].first, 1) && near(opposite[1].second, 1) &&
         near(opposite[2].first, 4.0 / 3) && near(opposite[2].second, 4.0 / 3);
}

/// The other two nodes of a positive tet, so that (a, b, first, second) is positive too.
std::array<VertexId, 2> rest_of(const std::array<VertexId, 4>& tet, VertexId a, VertexId b) {
  const auto place = [&](VertexId v) {
    return static_cast<unsigned>(std::find(tet.begin(), tet.end(), v) - tet.begin());
  };
  const unsigned pa = place(a);
  const unsigned pb = place(b);
  std::array<unsigned, 2> rest{};
  for (unsigned n = 0, r = 0; n < 4; ++n) {
    if (n != pa && n != pb) {
      rest[r++] = n;
    }
  }
  // Parity of the permutation (pa, pb, rest[0], rest[1]).
  const std::array<unsigned, 4> order = {pa, pb, rest[0], rest[1]};
  unsigned inversions = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      inversions += order[i] > order[j] ? 1 : 0;
    }
  }
  return inversions % 2 == 0 ? std::array{tet[rest[0]], tet[rest[1]]}
                             : std::array{tet[rest[1]], tet[rest[0]]};
}

class Mixer {
 public:
  Mixer(const MaterialMesh& mesh, const MixOptions& options)
      : mesh_(mesh),
        options_(options),
        around_(cells_of_vertices(mesh)),
        state_(mesh.points.size(), kOther) {}

  /// Chooses centres among the allowed vertices; empty: all are allowed.
  MixReport choose(std::span<const std::uint8_t> allowed) {
    MixReport report;
    report.centres = find_centres(allowed);
    choose_sublattices();
    report.hexes = accept();
    return report;
  }

  /// Takes the given centres.
  MixReport take(std::span<const VertexId> centres) {
    MixReport report;
    for (const VertexId v : centres) {
      if (is_centre(v)) {
        state_[v] = kChosen;
        ++report.centres;
      }
    }
    report.hexes = accept();
    return report;
  }

  /// The centres of the hexes, ascending.
  [[nodiscard]] std::vector<VertexId> hexes() const {
    std::vector<VertexId> centres;
    for (std::size_t v = 0; v < state_.size(); ++v) {
      if (state_[v] == kHex) {
        centres.push_back(static_cast<VertexId>(v));
      }
    }
    return centres;
  }

  [[nodiscard]] bool is_hex(VertexId v) const { return state_[v] == kHex; }
  [[nodiscard]] MaterialId material_of(VertexId centre) const {
    return mesh_.materials[around_.of(centre)[0]];
  }

  /// The hex and the quads of a star; false when it is not a centre's.
  bool cluster_of(VertexId v, Cluster& cluster) const {
    std::array<VertexId, kCorners> corners{};
    if (!link_of(v, cluster.axis, corners)) {
      return false;
    }
    for (std::size_t a = 0; a < kAxes; ++a) {
      if (!quad_around(v, cluster.axis[a], cluster.quad[a])) {
        return false;
      }
      for (const VertexId q : cluster.quad[a]) {
        if (!std::binary_search(corners.begin(), corners.end(), q)) {
          return false;
        }
      }
    }
    return close_hex(cluster);
  }

 private:
  enum State : std::uint8_t { kOther, kCentre, kEven, kOdd, kChosen, kHex };

  /// The axis neighbours of v, then its corners, ascending each; false when its star is not closed as a
  /// centre's.
  bool link_of(VertexId v, std::array<VertexId, kAxes>& axes, std::array<VertexId, kCorners>& corners) const {
    const auto star = around_.of(v);
    if (star.size() != kStarTets) {
      return false;
    }
    std::array<VertexId, 3 * kStarTets> ends{};
    std::size_t count = 0;
    for (const CellId t : star) {
      for (const VertexId n : mesh_.tets[t]) {
        if (n != v) {
          ends[count++] = n;
        }
      }
    }
    std::sort(ends.begin(), ends.end());
    std::size_t axis_count = 0;
    std::size_t corner_count = 0;
    for (std::size_t e = 0; e < ends.size();) {
      std::size_t next = e + 1;
      while (next < ends.size() && ends[next] == ends[e]) {
        ++next;
      }
      if (next - e == kTetsOfAxis && axis_count < kAxes) {
        axes[axis_count++] = ends[e];
      } else if (next - e == kTetsOfCorner && corner_count < kCorners) {
        corners[corner_count++] = ends[e];
      } else {
        return false;
      }
      e = next;
    }
    return axis_count == kAxes && corner_count == kCorners;
  }

  /// The corners around an axis in order; false when they do not close.
  bool quad_around(VertexId v, VertexId axis, std::array<VertexId, 4>& quad) const {
    std::array<std::array<VertexId, 2>, kTetsOfAxis> edges{};
    std::size_t count = 0;
    for (const CellId t : around_.of(v)) {
      const auto& tet = mesh_.tets[t];
      if (std::find(tet.begin(), tet.end(), axis) != tet.end()) {
        edges[count++] = rest_of(tet, v, axis);
      }
    }
    quad[0] = edges[0][0];
    for (std::size_t n = 0; n < 4; ++n) {
      const auto edge =
          std::find_if(edges.begin(), edges.end(), [&](const auto& e) { return e[0] == quad[n]; });
      if (edge == edges.end()) {
        return false;
      }
      if (n == 3) {
        return (*edge)[1] == quad[0];
      }
      quad[n + 1] = (*edge)[1];
    }
    return false;
  }

  /// The quad opposite to quads[0] and the hex between them; false when the quads are no cube's.
  static bool close_hex(Cluster& cluster) {
    const auto& top = cluster.quad[0];
    for (std::size_t n = 0; n < 4; ++n) {
      // Below top[n]: in a side quad ... top[n], below ... the edge of top comes backwards, so after top[n].
      bool found = false;
      for (std::size_t q = 1; q < kAxes; ++q) {
        const auto& side = cluster.quad[q];
        for (std::size_t m = 0; m < 4; ++m) {
          if (side[m] == top[(n + 1) % 4] && side[(m + 1) % 4] == top[n]) {
            cluster.hex[n] = side[(m + 2) % 4];
            found = true;
          }
        }
      }
      if (!found) {
        return false;
      }
      cluster.hex[n + 4] = top[n];
    }
    auto nodes = cluster.hex;
    std::sort(nodes.begin(), nodes.end());
    return std::adjacent_find(nodes.begin(), nodes.end()) == nodes.end();
  }

  [[nodiscard]] bool is_good(const Cluster& cluster) const {
    std::array<Vec3, 8> hex;
    std::transform(cluster.hex.begin(), cluster.hex.end(), hex.begin(),
                   [&](VertexId v) { return mesh_.points[v]; });
    double smallest = scaled_jacobian_hex(hex);
    for (std::size_t a = 0; a < kAxes; ++a) {
      const auto& q = cluster.quad[a];
      const std::array<Vec3, 5> pyramid = {mesh_.points[q[0]], mesh_.points[q[1]], mesh_.points[q[2]],
                                           mesh_.points[q[3]], mesh_.points[cluster.axis[a]]};
      smallest = std::fmin(smallest, scaled_jacobian_pyramid(pyramid));
    }
    return smallest >= options_.min_scaled_jacobian;
  }

  [[nodiscard]] bool is_centre(VertexId v) const {
    const auto star = around_.of(v);
    if (star.size() != kStarTets || star.back() >= mesh_.tets.size()) {
      return false;
    }
    const bool uniform = std::all_of(star.begin(), star.end(), [&](CellId t) {
      return mesh_.materials[t] == mesh_.materials[star[0]] &&
             (!options_.red_only || is_red(mesh_, mesh_.tets[t]));
    });
    Cluster cluster;
    return uniform && cluster_of(v, cluster) && is_good(cluster);
  }

  std::size_t find_centres(std::span<const std::uint8_t> allowed) {
    std::size_t count = 0;
#pragma omp parallel for schedule(dynamic, 1024) reduction(+ : count)
    for (std::size_t v = 0; v < state_.size(); ++v) {
      if ((allowed.empty() || allowed[v] != 0) && is_centre(static_cast<VertexId>(v))) {
        state_[v] = kCentre;
        ++count;
      }
    }
    return count;
  }

  /// Colours each connected region of centres by turns and chooses the colour that has more of them.
  void choose_sublattices() {
    std::vector<VertexId> region;
    for (std::size_t seed = 0; seed < state_.size(); ++seed) {
      if (state_[seed] != kCentre) {
        continue;
      }
      region.assign(1, static_cast<VertexId>(seed));
      state_[seed] = kEven;
      std::size_t even = 1;
      for (std::size_t r = 0; r < region.size(); ++r) {
        even += colour_neighbours(region, r);
      }
      const State chosen = 2 * even >= region.size() ? kEven : kOdd;
      for (const VertexId v : region) {
        state_[v] = state_[v] == chosen ? kChosen : kOther;
      }
    }
  }

  /// Appends the neighbours of region[r] that are centres; returns how many of them are even.
  std::size_t colour_neighbours(std::vector<VertexId>& region, std::size_t r) {
    std::array<VertexId, kAxes> axes{};
    std::array<VertexId, kCorners> corners{};
    link_of(region[r], axes, corners);
    const State own = static_cast<State>(state_[region[r]]);
    std::size_t even = 0;
    const auto visit = [&](VertexId n, State colour) {
      if (state_[n] == kCentre) {
        state_[n] = colour;
        region.push_back(n);
        even += colour == kEven ? 1 : 0;
      }
    };
    for (const VertexId a : axes) {
      visit(a, own);
    }
    for (const VertexId c : corners) {
      visit(c, own == kEven ? kOdd : kEven);
    }
    return even;
  }

  /// Turns the chosen into hexes, except one whose corner is the centre of another: in a lattice there is
  /// none.
  std::size_t accept() {
    std::size_t count = 0;
    std::array<VertexId, kAxes> axes{};
    std::array<VertexId, kCorners> corners{};
    for (std::size_t v = 0; v < state_.size(); ++v) {
      if (state_[v] == kChosen) {
        link_of(static_cast<VertexId>(v), axes, corners);
        const bool free =
            std::none_of(corners.begin(), corners.end(), [&](VertexId c) { return state_[c] == kHex; });
        state_[v] = free ? kHex : kOther;
        count += free ? 1 : 0;
      }
    }
    return count;
  }

  const MaterialMesh& mesh_;
  const MixOptions& options_;
  VertexCells around_;
  std::vector<std::uint8_t> state_;
};

/// Drops the tets of the stars of hexes; returns how many there were.
std::size_t drop_merged_tets(MaterialMesh& mesh, const Mixer& mixer) {
  std::size_t kept = 0;
  const std::size_t count = mesh.tets.size();
  for (std::size_t t = 0; t < count; ++t) {
    const auto& tet = mesh.tets[t];
    if (std::none_of(tet.begin(), tet.end(), [&](VertexId v) { return mixer.is_hex(v); })) {
      mesh.tets[kept] = tet;
      mesh.materials[kept++] = mesh.materials[t];
    }
  }
  mesh.tets.resize(kept);
  mesh.materials.resize(kept);
  return count - kept;
}

/// Puts hexes and pyramids in place of the stars that the mixer, which looks at this mesh, has chosen.
MixReport merge(MaterialMesh& mesh, const Mixer& mixer, MixReport report) {
  report.vertices_before = mesh.points.size();
  for (const VertexId v : mixer.hexes()) {
    Cluster cluster;
    mixer.cluster_of(v, cluster);
    const MaterialId material = mixer.material_of(v);
    mesh.hexes.add(cluster.hex, material);
    for (std::size_t a = 0; a < kAxes; ++a) {
      if (!mixer.is_hex(cluster.axis[a])) {
        const auto& q = cluster.quad[a];
        mesh.pyramids.add({q[0], q[1], q[2], q[3], cluster.axis[a]}, material);
      }
    }
  }
  report.pyramids = mesh.pyramids.size();
  report.tets_merged = drop_merged_tets(mesh, mixer);
  drop_unused_vertices(mesh);
  report.vertices_after = mesh.points.size();
  return report;
}

}  // namespace

MixReport mix_elements(MaterialMesh& mesh, const MixOptions& options) {
  Mixer mixer(mesh, options);
  const MixReport report = mixer.choose({});
  return merge(mesh, mixer, report);
}

std::vector<VertexId> choose_centres(const MaterialMesh& mesh, const MixOptions& options,
                                     std::span<const std::uint8_t> allowed) {
  Mixer mixer(mesh, options);
  mixer.choose(allowed);
  return mixer.hexes();
}

MixReport merge_stars(MaterialMesh& mesh, const MixOptions& options, std::span<const VertexId> centres) {
  Mixer mixer(mesh, options);
  const MixReport report = mixer.take(centres);
  return merge(mesh, mixer, report);
}

}  // namespace cbc3d
