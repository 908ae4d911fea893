#include "reports/viewer/shown_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <unordered_map>

#include "mesher/core/error.hpp"
#include "metrics/cells.hpp"
#include "metrics/element_shapes.hpp"

namespace cbc3d::reports {
namespace {

using Corners = std::array<VertexId, 4>;

std::uint16_t index_of(const std::vector<Label>& labels, Label label) {
  return static_cast<std::uint16_t>(std::lower_bound(labels.begin(), labels.end(), label) - labels.begin());
}

std::array<Vec3, 4> points_of(const ShownMesh& mesh, const Corners& tet) {
  return {mesh.points[tet[0]], mesh.points[tet[1]], mesh.points[tet[2]], mesh.points[tet[3]]};
}

/// A tet without extent may have no angle.
float number_or_zero(double value) {
  return std::isfinite(value) ? static_cast<float>(value) : 0;
}

void add_tet(ShownMesh& shown, const Corners& tet, std::uint16_t label) {
  const auto [a, b, c, d] = points_of(shown, tet);
  const auto angles = metrics::dihedral_angles_deg(a, b, c, d);
  shown.tets.push_back(tet);
  shown.label_index.push_back(label);
  shown.min_dihedral_deg.push_back(number_or_zero(*std::min_element(angles.begin(), angles.end())));
  shown.mean_ratio.push_back(number_or_zero(metrics::mean_ratio_tet({a, b, c, d})));
}

template <int Nodes>
void add_cells(const CellBlock<Nodes>& cells, metrics::CellKind kind, ShownMesh& shown) {
  for (std::size_t c = 0; c < cells.size(); ++c) {
    for (const VertexId node : cells.nodes[c]) {
      if (node >= shown.points.size()) {
        throw InputError("an element names vertex " + std::to_string(node) + ", and there are only " +
                         std::to_string(shown.points.size()));
      }
    }
    const metrics::TetSplit split = metrics::split_into_tets({kind, cells.nodes[c]});
    for (int t = 0; t < split.count; ++t) {
      add_tet(shown, split.tets[static_cast<std::size_t>(t)], index_of(shown.labels, cells.labels[c]));
    }
  }
}

/// A face by its sorted nodes, and the tet and corner that it is opposite of.
struct Face {
  std::array<VertexId, 3> nodes;
  std::uint32_t tet;
  std::uint8_t corner;
};

std::vector<Face> sorted_faces(const std::vector<Corners>& tets) {
  std::vector<Face> faces;
  faces.reserve(4 * tets.size());
  for (std::uint32_t t = 0; t < tets.size(); ++t) {
    for (std::uint8_t corner = 0; corner < 4; ++corner) {
      Face face{{tets[t][(corner + 1) % 4], tets[t][(corner + 2) % 4], tets[t][(corner + 3) % 4]}, t, corner};
      std::sort(face.nodes.begin(), face.nodes.end());
      faces.push_back(face);
    }
  }
  std::sort(faces.begin(), faces.end(), [](const Face& a, const Face& b) { return a.nodes < b.nodes; });
  return faces;
}

/// Marks the faces at which no tet of the same label goes on.
void find_boundary(ShownMesh& mesh) {
  mesh.boundary.assign(mesh.tets.size(), 0);
  const std::vector<Face> faces = sorted_faces(mesh.tets);
  for (std::size_t begin = 0, end = 0; begin < faces.size(); begin = end) {
    while (end < faces.size() && faces[end].nodes == faces[begin].nodes) {
      ++end;
    }
    const auto has_same_label = [&](std::size_t one) {
      return std::any_of(faces.begin() + static_cast<std::ptrdiff_t>(begin),
                         faces.begin() + static_cast<std::ptrdiff_t>(end), [&](const Face& other) {
                           return other.tet != faces[one].tet &&
                                  mesh.label_index[other.tet] == mesh.label_index[faces[one].tet];
                         });
    };
    for (std::size_t n = begin; n < end; ++n) {
      const unsigned bit = has_same_label(n) ? 0U : 1U << faces[n].corner;
      mesh.boundary[faces[n].tet] = static_cast<std::uint8_t>(mesh.boundary[faces[n].tet] | bit);
    }
  }
}

std::vector<bool> vertices_on_boundary(const ShownMesh& mesh) {
  std::vector<bool> on_boundary(mesh.points.size(), false);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (std::size_t corner = 0; corner < 4; ++corner) {
      if ((mesh.boundary[t] >> corner & 1U) != 0) {
        for (std::size_t other = 1; other < 4; ++other) {
          on_boundary[mesh.tets[t][(corner + other) % 4]] = true;
        }
      }
    }
  }
  return on_boundary;
}

/// For each vertex the cell of a grid that it lies in, numbered, on boundaries apart.
std::vector<VertexId> grid_cells(const ShownMesh& mesh, const std::vector<bool>& on_boundary,
                                 double edge_mm) {
  Vec3 low = mesh.points.front();
  for (const Vec3& p : mesh.points) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
  }
  std::unordered_map<std::uint64_t, VertexId> numbers;
  std::vector<VertexId> cells;
  cells.reserve(mesh.points.size());
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    std::uint64_t key = on_boundary[v] ? 1 : 0;
    for (int axis = 0; axis < 3; ++axis) {
      key = key << 21U | static_cast<std::uint64_t>((mesh.points[v][axis] - low[axis]) / edge_mm);
    }
    cells.push_back(numbers.try_emplace(key, static_cast<VertexId>(numbers.size())).first->second);
  }
  return cells;
}

Corners merged(const Corners& tet, const std::vector<VertexId>& cells) {
  return {cells[tet[0]], cells[tet[1]], cells[tet[2]], cells[tet[3]]};
}

bool is_flat(Corners tet) {
  std::sort(tet.begin(), tet.end());
  return std::adjacent_find(tet.begin(), tet.end()) != tet.end();
}

std::size_t tets_left(const ShownMesh& mesh, const std::vector<VertexId>& cells) {
  return static_cast<std::size_t>(std::count_if(
      mesh.tets.begin(), mesh.tets.end(), [&](const Corners& t) { return !is_flat(merged(t, cells)); }));
}

/// The mesh with one vertex for each cell, in the mean of those that lie there.
void merge_vertices(ShownMesh& mesh, const std::vector<VertexId>& cells) {
  const std::size_t count = *std::max_element(cells.begin(), cells.end()) + 1UL;
  std::vector<Vec3> sums(count);
  std::vector<double> members(count, 0);
  for (std::size_t v = 0; v < cells.size(); ++v) {
    sums[cells[v]] += mesh.points[v];
    ++members[cells[v]];
  }
  for (std::size_t n = 0; n < count; ++n) {
    sums[n] /= members[n];
  }
  mesh.points = std::move(sums);
  std::size_t kept = 0;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const Corners tet = merged(mesh.tets[t], cells);
    if (!is_flat(tet)) {
      mesh.tets[kept] = tet;
      mesh.label_index[kept] = mesh.label_index[t];
      mesh.min_dihedral_deg[kept] = mesh.min_dihedral_deg[t];
      mesh.mean_ratio[kept++] = mesh.mean_ratio[t];
    }
  }
  mesh.tets.resize(kept);
  mesh.label_index.resize(kept);
  mesh.min_dihedral_deg.resize(kept);
  mesh.mean_ratio.resize(kept);
}

/// The longest side of the box around all points.
double extent_mm(const ShownMesh& mesh) {
  double extent = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [low, high] =
        std::minmax_element(mesh.points.begin(), mesh.points.end(),
                            [axis](const Vec3& a, const Vec3& b) { return a[axis] < b[axis]; });
    extent = std::max(extent, (*high)[axis] - (*low)[axis]);
  }
  return extent;
}

void simplify(ShownMesh& mesh, std::size_t most_tets) {
  constexpr int kSteps = 12;           // of the search for the grid, to within 0.2 % of its edge
  constexpr double kFinest = 1 / 4e3;  // of the extent; the cells' numbers have 21 bits an axis
  const std::vector<bool> on_boundary = vertices_on_boundary(mesh);
  double fine = kFinest * extent_mm(mesh), coarse = extent_mm(mesh) / 2;
  for (int step = 0; step < kSteps; ++step) {
    const double middle = std::sqrt(fine * coarse);
    (tets_left(mesh, grid_cells(mesh, on_boundary, middle)) > most_tets ? fine : coarse) = middle;
  }
  merge_vertices(mesh, grid_cells(mesh, on_boundary, coarse));
  mesh.merged_within_mm = coarse;
  find_boundary(mesh);
}

void find_worst(ShownMesh& mesh, std::size_t most) {
  std::vector<std::uint32_t> order(mesh.tets.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto count = static_cast<std::ptrdiff_t>(std::min(most, order.size()));
  // An inverted tet is worse than a flat one, and its angles do not tell.
  const auto badness = [&](std::uint32_t t) {
    return mesh.mean_ratio[t] < 0 ? mesh.mean_ratio[t] - 1 : mesh.min_dihedral_deg[t];
  };
  std::partial_sort(order.begin(), order.begin() + count, order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return badness(a) != badness(b) ? badness(a) < badness(b) : a < b;
  });
  for (auto t = order.begin(); t != order.begin() + count; ++t) {
    mesh.worst.push_back({points_of(mesh, mesh.tets[*t]), mesh.label_index[*t], mesh.min_dihedral_deg[*t],
                          mesh.mean_ratio[*t]});
  }
}

}  // namespace

ShownMesh shown_mesh(const Mesh& mesh, std::size_t most_tets, std::size_t most_worst) {
  ShownMesh shown;
  shown.points = mesh.points;
  shown.labels = labels_of(mesh);
  add_cells(mesh.tets, metrics::CellKind::kTet, shown);
  add_cells(mesh.pyramids, metrics::CellKind::kPyramid, shown);
  add_cells(mesh.wedges, metrics::CellKind::kWedge, shown);
  add_cells(mesh.hexes, metrics::CellKind::kHex, shown);
  shown.tets_of_mesh = shown.tets.size();
  find_worst(shown, most_worst);
  find_boundary(shown);
  if (shown.tets.size() > most_tets) {
    simplify(shown, most_tets);
  }
  return shown;
}

std::size_t tets_for_each(std::vector<std::size_t> counts, std::size_t total) {
  std::sort(counts.begin(), counts.end());
  for (std::size_t n = 0; n < counts.size(); ++n) {
    const std::size_t share = total / (counts.size() - n);
    if (counts[n] > share) {
      return share;
    }
    total -= counts[n];
  }
  return counts.empty() ? total : counts.back();
}

}  // namespace cbc3d::reports
