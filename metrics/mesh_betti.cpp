#include "metrics/mesh_betti.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <tuple>

#include "mesher/core/disjoint_sets.hpp"
#include "metrics/vertex_cells.hpp"

namespace cbc3d::metrics {
namespace {

// Which class (set of cells) a cell is in.
using ClassOf = std::vector<std::uint32_t>;

// Calls visit(next, previous) for the neighbours of v in each face of the cell that holds it.
template <class Visit>
void for_faces_at(const CellView& cell, VertexId v, const Visit& visit) {
  const CellShape& shape = shape_of(cell.kind);
  for (int f = 0; f < shape.face_count; ++f) {
    const auto& face = shape.faces[static_cast<std::size_t>(f)];
    const std::size_t corners = face[3] < 0 ? 3 : 4;
    for (std::size_t n = 0; n < corners; ++n) {
      const auto node = [&](std::size_t at) {
        return cell.nodes[static_cast<std::size_t>(face[at % corners])];
      };
      if (node(n) == v) {
        visit(node(n + 1), node(n + corners - 1));
      }
    }
  }
}

// Vertices, edges and cells that each class has at a vertex, an edge counted at its lower end.
void count_at_vertex(const MeshView& view, const VertexCells& at, VertexId v, const ClassOf& class_of,
                     std::vector<std::pair<std::uint32_t, VertexId>>& ends,
                     std::vector<std::int64_t>& euler) {
  ends.clear();
  for (const std::uint32_t c : at.at(v)) {
    ends.emplace_back(class_of[c], v);  // the vertex itself
    for_faces_at(view.cell(c), v, [&](VertexId next, VertexId) {
      if (next > v) {
        ends.emplace_back(class_of[c], next);
      }
    });
  }
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  for (const auto& [of_class, end] : ends) {
    euler[of_class] += end == v ? 1 : -1;
  }
}

std::vector<std::int64_t> euler_characteristics(const MeshView& view, const std::vector<Facet>& facets,
                                                const VertexCells& at, const ClassOf& class_of,
                                                std::size_t classes) {
  std::vector<std::int64_t> euler(classes, 0);
#pragma omp parallel
  {
    std::vector<std::int64_t> mine(classes, 0);
    std::vector<std::pair<std::uint32_t, VertexId>> ends;
#pragma omp for schedule(dynamic, 4096) nowait
    for (std::size_t v = 0; v < view.mesh().points.size(); ++v) {
      count_at_vertex(view, at, static_cast<VertexId>(v), class_of, ends, mine);
    }
#pragma omp critical(cbc3d_euler)
    for (std::size_t n = 0; n < classes; ++n) {
      euler[n] += mine[n];
    }
  }
  for (std::size_t c = 0; c < class_of.size(); ++c) {
    --euler[class_of[c]];
  }
  std::vector<std::uint32_t> met;
  for_each_facet_run(facets, [&](std::size_t first, std::size_t last) {
    met.clear();
    for (std::size_t f = first; f < last; ++f) {
      const std::uint32_t of_class = class_of[facets[f].cell];
      if (std::find(met.begin(), met.end(), of_class) == met.end()) {
        met.push_back(of_class);
        ++euler[of_class];
      }
    }
  });
  return euler;
}

// Parts of each class that do not share a vertex.
std::vector<std::int64_t> count_parts(const MeshView& view, const VertexCells& at, const ClassOf& class_of,
                                      std::size_t classes) {
  DisjointSets sets(view.cell_count());
  std::vector<std::uint32_t> last_cell(classes, 0);
  std::vector<VertexId> last_vertex(classes, kNoVertex);
  for (VertexId v = 0; v < view.mesh().points.size(); ++v) {
    for (const std::uint32_t c : at.at(v)) {
      const std::uint32_t of_class = class_of[c];
      if (last_vertex[of_class] == v) {
        sets.join(last_cell[of_class], c);
      }
      last_vertex[of_class] = v;
      last_cell[of_class] = c;
    }
  }
  std::vector<std::int64_t> parts(classes, 0);
  for (std::uint32_t c = 0; c < sets.size(); ++c) {
    parts[class_of[c]] += sets.root(c) == c ? 1 : 0;
  }
  return parts;
}

// A boundary facet, its vertices counter-clockwise seen from outside the class.
struct BoundaryFacet {
  std::array<VertexId, 4> nodes;
  [[nodiscard]] std::size_t corners() const { return nodes[3] == kNoVertex ? 3 : 4; }
};

struct BoundaryEdge {
  VertexId low, high;
  std::uint32_t facet;
  bool upwards;       // the facet runs it from low to high
  VertexId opposite;  // a vertex of the facet off the edge
};

std::vector<BoundaryEdge> sorted_edges(const std::vector<BoundaryFacet>& facets) {
  std::vector<BoundaryEdge> edges;
  edges.reserve(3 * facets.size());
  for (std::size_t f = 0; f < facets.size(); ++f) {
    const std::size_t corners = facets[f].corners();
    for (std::size_t n = 0; n < corners; ++n) {
      const VertexId from = facets[f].nodes[n], to = facets[f].nodes[(n + 1) % corners];
      edges.push_back({std::min(from, to), std::max(from, to), static_cast<std::uint32_t>(f), from < to,
                       facets[f].nodes[(n + 2) % corners]});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const BoundaryEdge& a, const BoundaryEdge& b) {
    return std::tie(a.low, a.high, a.facet) < std::tie(b.low, b.high, b.facet);
  });
  return edges;
}

// Calls join(m, n) for facets at an edge that face each other across the outside; false when they do not
// alternate. A facet run upwards has its outer side counter-clockwise about the edge.
template <class Join>
bool join_round_edge(std::span<const BoundaryEdge> edges, const std::vector<Vec3>& points, const Join& join) {
  if (edges.size() == 2) {
    join(0, 1);
    return edges[0].upwards != edges[1].upwards;
  }
  if (edges.size() % 2 != 0) {
    return false;
  }
  const Vec3 origin = points[edges[0].low], axis = (points[edges[0].high] - origin).normalized();
  const auto off_axis = [&](VertexId v) {
    const Vec3 d = points[v] - origin;
    return d - d.dot(axis) * axis;
  };
  const Vec3 u = off_axis(edges[0].opposite), v = axis.cross(u);
  std::vector<std::pair<double, std::size_t>> order;  // such edges are rare
  for (std::size_t n = 0; n < edges.size(); ++n) {
    const Vec3 d = off_axis(edges[n].opposite);
    const double angle = n == 0 ? 0 : std::atan2(v.dot(d), u.dot(d));
    order.emplace_back(angle < 0 ? angle + 2 * std::numbers::pi : angle, n);
  }
  std::sort(order.begin(), order.end());
  for (std::size_t n = 0; n < order.size(); ++n) {
    const std::size_t one = order[n].second, next = order[(n + 1) % order.size()].second;
    if (edges[one].upwards == edges[next].upwards) {
      return false;
    }
    if (edges[one].upwards) {
      join(one, next);
    }
  }
  return true;
}

// Parts of the complement of the link of a vertex in the sphere around it: 1 + b1 = 1 + b0 - chi.
std::int64_t outer_parts_at(const MeshView& view, const VertexCells& at, VertexId v, const ClassOf& class_of,
                            std::uint32_t of_class) {
  std::vector<VertexId> ends;
  std::vector<std::array<VertexId, 2>> arcs;
  std::int64_t cells = 0;
  for (const std::uint32_t c : at.at(v)) {
    if (class_of[c] != of_class) {
      continue;
    }
    ++cells;
    for_faces_at(view.cell(c), v, [&](VertexId next, VertexId previous) {
      ends.push_back(next);
      arcs.push_back({std::min(next, previous), std::max(next, previous)});
    });
  }
  const auto make_distinct = [](auto& list) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  };
  make_distinct(ends);
  make_distinct(arcs);
  const auto number = [&ends](VertexId end) {
    return static_cast<std::uint32_t>(std::lower_bound(ends.begin(), ends.end(), end) - ends.begin());
  };
  DisjointSets sets(ends.size());
  for (const auto& [a, b] : arcs) {
    sets.join(number(a), number(b));
  }
  std::int64_t parts = 0;
  for (std::uint32_t n = 0; n < sets.size(); ++n) {
    parts += sets.root(n) == n ? 1 : 0;
  }
  const auto euler = static_cast<std::int64_t>(ends.size()) - static_cast<std::int64_t>(arcs.size()) + cells;
  return 1 + parts - euler;
}

// Counts the parts of the complement that one class's boundary facets look at, summed over the parts of the
// class.
class SideCounter {
 public:
  SideCounter(const MeshView& view, const VertexCells& at, const ClassOf& class_of, std::uint32_t of_class,
              const std::vector<BoundaryFacet>& facets)
      : view_(view),
        at_(at),
        class_of_(class_of),
        of_class_(of_class),
        facets_(facets),
        sides_(facets.size()) {}

  // Nothing when the facets bound no set in space.
  std::optional<std::int64_t> count() {
    const std::vector<BoundaryEdge> edges = sorted_edges(facets_);
    // Two corners of facets at a vertex belong to one fan when an edge at that vertex joined their facets.
    DisjointSets fans(4 * facets_.size());
    for (std::size_t first = 0; first < edges.size();) {
      std::size_t last = first + 1;
      while (last < edges.size() && edges[last].low == edges[first].low &&
             edges[last].high == edges[first].high) {
        ++last;
      }
      if (!join_edge(std::span(edges).subspan(first, last - first), fans)) {
        return std::nullopt;
      }
      first = last;
    }
    if (!join_fans(fans)) {
      return std::nullopt;
    }
    std::int64_t parts = 0;
    for (std::uint32_t f = 0; f < sides_.size(); ++f) {
      parts += sides_.root(f) == f ? 1 : 0;
    }
    return parts;
  }

 private:
  [[nodiscard]] std::uint32_t corner(std::uint32_t facet, VertexId v) const {
    const auto& nodes = facets_[facet].nodes;
    return 4 * facet + static_cast<std::uint32_t>(std::find(nodes.begin(), nodes.end(), v) - nodes.begin());
  }

  bool join_edge(std::span<const BoundaryEdge> edges, DisjointSets& fans) {
    return join_round_edge(edges, view_.mesh().points, [&](std::size_t m, std::size_t n) {
      const BoundaryEdge &one = edges[m], &other = edges[n];
      sides_.join(one.facet, other.facet);
      fans.join(corner(one.facet, one.low), corner(other.facet, one.low));
      fans.join(corner(one.facet, one.high), corner(other.facet, one.high));
    });
  }

  // Where several fans meet at a vertex they may look at the same part of the complement.
  bool join_fans(DisjointSets& fans) {
    std::vector<std::pair<VertexId, std::uint32_t>> roots;  // of fans, by vertex
    for (std::uint32_t f = 0; f < facets_.size(); ++f) {
      for (std::uint32_t n = 0; n < facets_[f].corners(); ++n) {
        if (fans.root(4 * f + n) == 4 * f + n) {
          roots.emplace_back(facets_[f].nodes[n], f);
        }
      }
    }
    std::sort(roots.begin(), roots.end());
    for (std::size_t first = 0; first < roots.size();) {
      std::size_t last = first + 1;
      while (last < roots.size() && roots[last].first == roots[first].first) {
        ++last;
      }
      if (last - first > 1 && !join_at_vertex(std::span(roots).subspan(first, last - first))) {
        return false;
      }
      first = last;
    }
    return true;
  }

  bool join_at_vertex(std::span<const std::pair<VertexId, std::uint32_t>> fans) {
    const std::int64_t parts = outer_parts_at(view_, at_, fans[0].first, class_of_, of_class_);
    if (parts == static_cast<std::int64_t>(fans.size())) {
      return true;
    }
    for (const auto& [vertex, facet] : fans) {
      sides_.join(fans[0].second, facet);
    }
    return parts == 1;  // between, which fans look at the same part is not settled by counting
  }

  const MeshView& view_;
  const VertexCells& at_;
  const ClassOf& class_of_;
  std::uint32_t of_class_;
  const std::vector<BoundaryFacet>& facets_;
  DisjointSets sides_;
};

// Boundary facets of every class; overfull when a facet has more than two cells.
struct Boundaries {
  std::vector<std::vector<BoundaryFacet>> of_class;
  std::vector<bool> overfull;
};

Boundaries boundaries_of(const std::vector<Facet>& facets, const ClassOf& class_of, std::size_t classes) {
  Boundaries result{std::vector<std::vector<BoundaryFacet>>(classes), std::vector<bool>(classes, false)};
  const auto add = [&](const Facet& facet) {
    BoundaryFacet boundary{facet.cycle};
    if (facet.reversed) {
      std::reverse(boundary.nodes.begin() + 1,
                   boundary.nodes.begin() + static_cast<std::ptrdiff_t>(boundary.corners()));
    }
    result.of_class[class_of[facet.cell]].push_back(boundary);
  };
  for_each_facet_run(facets, [&](std::size_t first, std::size_t last) {
    if (last - first > 2) {
      for (std::size_t f = first; f < last; ++f) {
        result.overfull[class_of[facets[f].cell]] = true;
      }
    } else if (last - first == 1) {
      add(facets[first]);
    } else if (class_of[facets[first].cell] != class_of[facets[first + 1].cell]) {
      add(facets[first]);
      add(facets[first + 1]);
    }
  });
  return result;
}

std::vector<CellSetTopology> class_topologies(const MeshView& view, const std::vector<Facet>& facets,
                                              const VertexCells& at, const ClassOf& class_of,
                                              std::size_t classes) {
  const std::vector<std::int64_t> euler = euler_characteristics(view, facets, at, class_of, classes);
  const std::vector<std::int64_t> parts = count_parts(view, at, class_of, classes);
  const Boundaries boundaries = boundaries_of(facets, class_of, classes);
  std::vector<CellSetTopology> result(classes);
#pragma omp parallel for schedule(dynamic)
  for (std::size_t n = 0; n < classes; ++n) {
    result[n].euler = euler[n];
    if (boundaries.overfull[n]) {
      continue;
    }
    const auto sides =
        SideCounter(view, at, class_of, static_cast<std::uint32_t>(n), boundaries.of_class[n]).count();
    if (sides) {
      const std::int64_t cavities = *sides - parts[n], tunnels = parts[n] + cavities - euler[n];
      if (cavities >= 0 && tunnels >= 0) {
        result[n].betti = Betti{{parts[n], tunnels, cavities}};
      }
    }
  }
  return result;
}

}  // namespace

MeshBetti mesh_betti(const MeshView& view, const std::vector<Facet>& facets) {
  const VertexCells at(view);
  ClassOf class_of(view.cell_count());
  for (std::size_t c = 0; c < class_of.size(); ++c) {
    class_of[c] = view.label_index(c);
  }
  MeshBetti result{class_topologies(view, facets, at, class_of, view.labels().size()), {}};
  if (view.labels().size() == 1) {
    result.all = result.per_label[0];
  } else if (view.cell_count() > 0) {
    std::fill(class_of.begin(), class_of.end(), 0U);
    result.all = class_topologies(view, facets, at, class_of, 1)[0];
  } else {
    result.all.betti = Betti{};
  }
  return result;
}

}  // namespace cbc3d::metrics
