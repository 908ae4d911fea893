#include "mesher/domain/mesh_domain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "mesher/core/nearest_on_triangle.hpp"
#include "mesher/domain/tolerances.hpp"

namespace cbc3d {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

/// The facets of one pair of materials in a balanced tree of boxes; node i has the children 2 i + 1 and 2 i
/// + 2.
class MeshDomain::FacetTree {
 public:
  void add(const std::array<VertexId, 3>& facet) { facets_.push_back(facet); }

  void build(const std::vector<Vec3>& points) {
    number_vertices(points);
    normals_.assign(points_.size(), {});
    for (const auto& f : facets_) {
      const Vec3 normal = (points_[f[1]] - points_[f[0]]).cross(points_[f[2]] - points_[f[0]]);
      for (const VertexId v : f) {
        normals_[v] += normal;
      }
    }
    std::size_t leaves = 1;
    while (leaves * kLeafFacets < facets_.size()) {
      leaves *= 2;
    }
    boxes_.resize(2 * leaves - 1);
    ranges_.resize(2 * leaves - 1);
    split(0, 0, facets_.size());
  }

  /// The nearest place of the facets and its squared distance.
  [[nodiscard]] std::pair<Vec3, double> nearest(const Vec3& x) const {
    Search search{x, kInfinity, {}, 0};
    descend(0, search);
    return {search.place.at, search.squared_mm2};
  }

  /// How x lies to the facets. The normal changes smoothly along them and points towards the higher material.
  [[nodiscard]] BoundaryDistance distance(const Vec3& x) const {
    Search search{x, kInfinity, {}, 0};
    descend(0, search);
    const auto& facet = facets_[search.facet];
    Vec3 normal;
    for (std::size_t i = 0; i < 3; ++i) {
      normal += search.place.weights[i] * normals_[facet[i]].normalized();
    }
    normal = normal.normalized();
    return {normal.dot(x - search.place.at), normal, std::sqrt(search.squared_mm2), true};
  }

 private:
  static constexpr std::size_t kLeafFacets = 4;
  struct Box {
    Vec3 low{kInfinity, kInfinity, kInfinity}, high{-kInfinity, -kInfinity, -kInfinity};
    [[nodiscard]] double squared_distance(const Vec3& x) const {
      double sum = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const double d = std::max({low[axis] - x[axis], 0.0, x[axis] - high[axis]});
        sum += d * d;
      }
      return sum;
    }
  };
  struct Search {
    const Vec3& x;
    double squared_mm2;
    TrianglePlace place;
    std::size_t facet;
  };

  /// Keeps only the vertices that the pair's facets have.
  void number_vertices(const std::vector<Vec3>& points) {
    std::vector<VertexId> used;
    for (const auto& f : facets_) {
      used.insert(used.end(), f.begin(), f.end());
    }
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    for (const VertexId v : used) {
      points_.push_back(points[v]);
    }
    for (auto& f : facets_) {
      for (VertexId& v : f) {
        v = static_cast<VertexId>(std::lower_bound(used.begin(), used.end(), v) - used.begin());
      }
    }
  }

  void split(std::size_t node, std::size_t begin, std::size_t end) {
    Box& box = boxes_[node];
    for (std::size_t i = begin; i < end; ++i) {
      for (const VertexId v : facets_[i]) {
        for (int axis = 0; axis < 3; ++axis) {
          box.low[axis] = std::min(box.low[axis], points_[v][axis]);
          box.high[axis] = std::max(box.high[axis], points_[v][axis]);
        }
      }
    }
    ranges_[node] = {begin, end};
    if (2 * node + 1 >= boxes_.size()) {
      return;
    }
    const Vec3 size = box.high - box.low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto centre = [&](const auto& f) {
      return points_[f[0]][axis] + points_[f[1]][axis] + points_[f[2]][axis];
    };
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [&](std::size_t i) { return facets_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end), [&](const auto& f, const auto& g) {
      return centre(f) != centre(g) ? centre(f) < centre(g) : f < g;
    });
    split(2 * node + 1, begin, middle);
    split(2 * node + 2, middle, end);
  }

  void descend(std::size_t node, Search& search) const {
    if (2 * node + 1 >= boxes_.size()) {
      for (std::size_t i = ranges_[node].first; i < ranges_[node].second; ++i) {
        const auto& f = facets_[i];
        const TrianglePlace place =
            nearest_on_triangle(search.x, points_[f[0]], points_[f[1]], points_[f[2]]);
        const double squared = (place.at - search.x).squared_norm();
        if (squared < search.squared_mm2) {
          search.squared_mm2 = squared;
          search.place = place;
          search.facet = i;
        }
      }
      return;
    }
    std::array<std::pair<double, std::size_t>, 2> order;
    for (std::size_t side = 0; side < 2; ++side) {
      const std::size_t child = 2 * node + 1 + side;
      order[side] = {boxes_[child].squared_distance(search.x), child};
    }
    std::sort(order.begin(), order.end());
    for (const auto& [squared, child] : order) {
      if (squared < search.squared_mm2) {
        descend(child, search);
      }
    }
  }

  std::vector<std::array<VertexId, 3>> facets_;
  std::vector<Vec3> points_, normals_;
  std::vector<Box> boxes_;
  std::vector<std::pair<std::size_t, std::size_t>> ranges_;
};

MeshDomain::MeshDomain(const MaterialMesh& mesh, std::vector<Label> labels) : labels_(std::move(labels)) {
  label_of_.resize(labels_.size());
  std::iota(label_of_.begin(), label_of_.end(), MaterialId{0});
  add_volumes(mesh);
  const std::vector<Facet> facets = facets_of(mesh);
  double edges_mm = 0;
  FacetTree* tree_of_last = nullptr;
  std::pair<MaterialId, MaterialId> last;
  for (const Facet& f : facets) {
    if (tree_of_last == nullptr || last != std::pair{f.lower, f.higher}) {
      last = {f.lower, f.higher};
      auto& tree = trees_[last];
      if (tree == nullptr) {
        tree = std::make_unique<FacetTree>();
      }
      tree_of_last = tree.get();
    }
    tree_of_last->add(f.nodes);
    for (std::size_t i = 0; i < 3; ++i) {
      edges_mm += (mesh.points[f.nodes[i]] - mesh.points[f.nodes[(i + 1) % 3]]).norm();
    }
  }
  for (auto& [pair, tree] : trees_) {
    tree->build(mesh.points);
  }
  mean_edge_mm_ = facets.empty() ? 0 : edges_mm / (3.0 * static_cast<double>(facets.size()));
  add_samples(mesh, facets);
}

MeshDomain::~MeshDomain() = default;

void MeshDomain::add_volumes(const MaterialMesh& mesh) {
  volumes_mm3_.assign(labels_.size(), 0.0);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto& n = mesh.tets[t];
    volumes_mm3_[mesh.materials[t]] +=
        six_volumes(mesh.points[n[0]], mesh.points[n[1]], mesh.points[n[2]], mesh.points[n[3]]) / 6;
  }
  volumes_mm3_[kBackground] = 0;
}

std::vector<MeshDomain::Facet> MeshDomain::facets_of(const MaterialMesh& mesh) {
  const auto neighbours = tet_neighbours(mesh.tets, mesh.points.size());
  std::vector<Facet> facets;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (std::size_t n = 0; n < 4; ++n) {
      const TetId next = neighbours[t][n];
      const MaterialId other = next == kNoTet ? kBackground : mesh.materials[next];
      if (other < mesh.materials[t]) {  // the face looks outwards, the normal must point inwards
        const auto& face = kTetFace[n];
        const auto& nodes = mesh.tets[t];
        facets.push_back({{nodes[face[0]], nodes[face[2]], nodes[face[1]]}, other, mesh.materials[t]});
      }
    }
  }
  return facets;
}

void MeshDomain::add_samples(const MaterialMesh& mesh, const std::vector<Facet>& facets) {
  const auto add = [&](const Vec3& x, MaterialId lower, MaterialId higher, VertexId vertex) {
    own_samples_.push_back(
        {{static_cast<float>(x.x), static_cast<float>(x.y), static_cast<float>(x.z)}, higher, lower});
    nearest_.push_back(vertex);
    to_nearest_mm_.push_back((mesh.points[vertex] - x).norm());
  };
  std::vector<std::tuple<VertexId, MaterialId, MaterialId>> corners;
  corners.reserve(3 * facets.size());
  for (const Facet& f : facets) {
    for (const VertexId v : f.nodes) {
      corners.emplace_back(v, f.lower, f.higher);
    }
  }
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  for (const auto& [v, lower, higher] : corners) {
    add(mesh.points[v], lower, higher, v);
  }
  for (const Facet& f : facets) {
    const Vec3 centre = (mesh.points[f.nodes[0]] + mesh.points[f.nodes[1]] + mesh.points[f.nodes[2]]) / 3;
    add(centre, f.lower, f.higher,
        *std::min_element(f.nodes.begin(), f.nodes.end(), [&](VertexId v, VertexId w) {
          return (mesh.points[v] - centre).squared_norm() < (mesh.points[w] - centre).squared_norm();
        }));
  }
}

std::vector<VertexId> MeshDomain::covering_vertices(double reach_mm) const {
  std::vector<VertexId> covering = nearest_;
  for (std::size_t s = 0; s < covering.size(); ++s) {
    if (to_nearest_mm_[s] > reach_mm) {
      covering[s] = kNoVertex;
    }
  }
  return covering;
}

BoundaryDistance MeshDomain::boundary_distance(const Vec3& x, MaterialId a, MaterialId b) const {
  const auto tree = trees_.find({std::min(a, b), std::max(a, b)});
  if (tree == trees_.end()) {
    return {.deviation_mm = kInfinity};
  }
  BoundaryDistance distance = tree->second->distance(x);
  if (a < b) {
    distance.distance_mm = -distance.distance_mm;
    distance.normal = -distance.normal;
  }
  return distance;
}

MaterialId MeshDomain::material_at(const Vec3& x) const {
  BoundaryDistance nearest{.deviation_mm = kInfinity};
  MaterialId material = kBackground;
  for (const auto& [pair, tree] : trees_) {
    const BoundaryDistance distance = tree->distance(x);
    if (distance.deviation_mm < nearest.deviation_mm) {
      nearest = distance;
      material = distance.distance_mm > 0 ? pair.second : pair.first;
    }
  }
  return material;
}

std::optional<Vec3> MeshDomain::nearest_boundary(const Vec3& x, MaterialId material) const {
  const double search_mm = tolerances::kNearestSearch * scale_mm();
  double least = search_mm * search_mm;
  std::optional<Vec3> nearest;
  for (const auto& [pair, tree] : trees_) {
    if (pair.first == material || pair.second == material) {
      const auto& [at, squared] = tree->nearest(x);
      if (squared <= least) {
        least = squared;
        nearest = at;
      }
    }
  }
  return nearest;
}

bool MeshDomain::is_near_boundary(const Vec3& x, MaterialId material) const {
  const std::optional<Vec3> nearest = nearest_boundary(x, material);
  return nearest && (*nearest - x).norm() <= tolerances::kFarLimit * scale_mm();
}

}  // namespace cbc3d
