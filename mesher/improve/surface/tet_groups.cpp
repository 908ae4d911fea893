#include "mesher/improve/surface/tet_groups.hpp"

#include "mesher/improve/surface/surface_defects.hpp"

namespace cbc3d {
namespace {

constexpr std::size_t kMostGroups = 6000;

template <typename T>
void sort_once(std::vector<T>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

bool has_node(const std::array<VertexId, 4>& nodes, VertexId v) {
  return std::find(nodes.begin(), nodes.end(), v) != nodes.end();
}

/// The face-connected parts of each material.
void add_parts(const LabelledComplex& complex, TetGroup tets, std::vector<TetGroup>& groups) {
  while (!tets.empty()) {
    TetGroup part = {tets.back()};
    tets.pop_back();
    for (std::size_t i = 0; i < part.size(); ++i) {
      for (std::size_t n = 0; n < 4; ++n) {
        const auto at = std::find(tets.begin(), tets.end(), complex.neighbour(part[i], n));
        if (at != tets.end() && complex.material(*at) == complex.material(part[i])) {
          part.push_back(*at);
          tets.erase(at);
        }
      }
    }
    std::sort(part.begin(), part.end());
    groups.push_back(std::move(part));
  }
}

/// Adds the parts of the tets around v, and of those around each edge of v.
void add_parts_of_star(const LabelledComplex& complex, VertexId v, std::vector<TetGroup>& groups) {
  const auto star = complex.star(v);
  add_parts(complex, {star.begin(), star.end()}, groups);
  for (const VertexId w : ring_of(complex, {v})) {
    TetGroup at_edge;
    std::copy_if(star.begin(), star.end(), std::back_inserter(at_edge),
                 [&](TetId t) { return w != v && has_node(complex.mesh().tets[t], w); });
    add_parts(complex, std::move(at_edge), groups);
  }
}

/// The groups that have one of the tets more.
std::vector<TetGroup> grown(const LabelledComplex& complex, const TetGroup& tets,
                            const std::vector<TetGroup>& groups) {
  std::vector<TetGroup> larger;
  for (const TetGroup& group : groups) {
    for (const TetId t : group) {
      for (std::size_t n = 0; n < 4; ++n) {
        const TetId next = complex.neighbour(t, n);
        if (next != kNoTet && complex.material(next) == complex.material(t) &&
            std::binary_search(tets.begin(), tets.end(), next) &&
            !std::binary_search(group.begin(), group.end(), next)) {
          larger.push_back(group);
          larger.back().insert(std::lower_bound(larger.back().begin(), larger.back().end(), next), next);
        }
      }
    }
  }
  sort_once(larger);
  return larger;
}

}  // namespace

double volume_mm3(const MaterialMesh& mesh, const TetGroup& group) {
  double sum = 0;
  for (const TetId t : group) {
    const auto& n = mesh.tets[t];
    sum += six_volumes(mesh.points[n[0]], mesh.points[n[1]], mesh.points[n[2]], mesh.points[n[3]]) / 6;
  }
  return sum;
}

std::vector<TetGroup> tet_groups_at(const LabelledComplex& complex, const std::vector<VertexId>& vertices,
                                    std::size_t most_tets) {
  std::vector<TetGroup> groups;
  TetGroup tets;
  for (const VertexId v : vertices) {
    add_parts_of_star(complex, v, groups);
    tets.insert(tets.end(), complex.star(v).begin(), complex.star(v).end());
  }
  sort_once(tets);
  std::vector<TetGroup> connected(tets.size());
  std::transform(tets.begin(), tets.end(), connected.begin(), [](TetId t) { return TetGroup{t}; });
  for (std::size_t size = 1; size <= most_tets && groups.size() < kMostGroups; ++size) {
    groups.insert(groups.end(), connected.begin(), connected.end());
    connected = size < most_tets ? grown(complex, tets, connected) : connected;
  }
  sort_once(groups);
  std::vector<std::pair<double, std::size_t>> order(groups.size());
  for (std::size_t g = 0; g < groups.size(); ++g) {
    order[g] = {volume_mm3(complex.mesh(), groups[g]), g};
  }
  std::sort(order.begin(), order.end());
  std::vector<TetGroup> sorted;
  sorted.reserve(order.size());
  for (const auto& [volume, g] : order) {
    sorted.push_back(std::move(groups[g]));
  }
  return sorted;
}

}  // namespace cbc3d
