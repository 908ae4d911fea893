// The volume that each material around vertices of a surface gains or loses when these vertices become one at
// another place.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "mesher/improve/local/tet_complex.hpp"

namespace cbc3d {

/// Volumes are times six. Background is left out.
class LocalVolumeChange {
 public:
  /// The vertex whose facets are counted, and one whose facets have been.
  struct Vertices {
    VertexId counted, known;
  };

  void clear() { shares_.clear(); }

  /// Adds what each side gains: the volumes under the facets, seen from the place where these will meet.
  void add_gains(const TetComplex& mesh, std::span<const FacetAt> facets, const Vertices& at,
                 const Vec3& to) {
    for (const FacetAt& f : facets) {
      if (f.first != at.known && f.second != at.known) {
        const Vec3 normal = (mesh.point(f.first) - to).cross(mesh.point(f.second) - to);
        const double volume = normal.dot(mesh.point(at.counted) - to);
        share_of(f.inner).gain -= volume;
        share_of(f.outer).gain += volume;
      }
    }
  }

  /// The volumes before; the tets of `known` have been counted.
  void add_volumes(const TetComplex& mesh, std::span<const TetId> star, VertexId known) {
    for (const TetId t : star) {
      if (!mesh.has_node(t, known)) {
        const auto& n = mesh.nodes(t);
        share_of(mesh.material(t)).volume +=
            six_volumes(mesh.point(n[0]), mesh.point(n[1]), mesh.point(n[2]), mesh.point(n[3]));
      }
    }
  }

  /// The largest loss of a material, as a share of its volume before.
  [[nodiscard]] double largest_loss() const {
    double largest = 0;
    for (const Share& share : shares_) {
      if (share.material != kBackground && share.gain < 0) {
        largest = std::max(largest, -share.gain / share.volume);
      }
    }
    return largest;
  }

 private:
  struct Share {
    MaterialId material;
    double volume, gain;
  };

  Share& share_of(MaterialId material) {
    const auto found = std::find_if(shares_.begin(), shares_.end(),
                                    [&](const Share& share) { return share.material == material; });
    return found != shares_.end() ? *found : shares_.emplace_back(Share{material, 0, 0});
  }

  std::vector<Share> shares_;
};

}  // namespace cbc3d
