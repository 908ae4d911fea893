#include "mesher/improve/part_thickness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesher/topology/tet_adjacency.hpp"

namespace cbc3d {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A material at a vertex, and the sum of its facets' normals there, outwards.
struct Side {
  MaterialId material;
  Vec3 normal;
};

/// The labelled materials that have facets at v. `sides` is scratch.
void find_sides(const MaterialMesh& mesh, const TetNeighbours& neighbours, std::span<const TetId> star,
                VertexId v, std::vector<Side>& sides) {
  sides.clear();
  for (const TetId t : star) {
    const MaterialId material = mesh.materials[t];
    for (std::size_t f = 0; f < 4; ++f) {
      const TetId other = neighbours[t][f];
      const bool is_interface = other == kNoTet || mesh.materials[other] != material;
      if (!is_interface || mesh.tets[t][f] == v || material == kBackground) {
        continue;
      }
      const auto corner = [&](std::size_t n) { return mesh.points[mesh.tets[t][kTetFace[f][n]]]; };
      const Vec3 normal = (corner(1) - corner(0)).cross(corner(2) - corner(0));
      auto side =
          std::find_if(sides.begin(), sides.end(), [&](const Side& s) { return s.material == material; });
      if (side == sides.end()) {
        side = sides.insert(side, {material, {}});
      }
      side->normal += normal;
    }
  }
}

/// The length of the way from x inwards through the side's material, a cell at least. It may begin a little
/// outside of it.
double way_through(const Domain& domain, const Vec3& x, const Side& side, double cell_mm, double largest_mm) {
  const double length = side.normal.norm();
  if (!(length > 0)) {
    return kInfinity;
  }
  const double step_mm = 0.25 * cell_mm;
  const Vec3 step = (-step_mm / length) * side.normal;
  constexpr int kStepsOutside = 4;
  const int most = static_cast<int>(std::ceil(largest_mm / step_mm));
  int entered = 0;
  for (int n = 1; n <= most + entered; ++n) {
    const bool is_inside = domain.material_at(x + static_cast<double>(n) * step) == side.material;
    if (is_inside && entered == 0) {
      entered = n;
    } else if (!is_inside && (entered > 0 || n > kStepsOutside)) {
      return entered > 0 ? std::max(cell_mm, (n - entered) * step_mm) : kInfinity;
    }
  }
  return kInfinity;
}

}  // namespace

std::vector<double> thickness_at_vertices(const MaterialMesh& mesh, const Domain& domain, double largest_mm) {
  std::vector<double> thickness(mesh.points.size(), kInfinity);
  const auto neighbours = tet_neighbours(mesh.tets, mesh.points.size());
  const VertexCells at = tets_of_vertices(mesh.tets, mesh.points.size());
  const double cell_mm = std::cbrt(domain.cell_mm3());
#pragma omp parallel
  {
    std::vector<Side> sides;
#pragma omp for schedule(static)
    for (std::size_t v = 0; v < mesh.points.size(); ++v) {
      find_sides(mesh, neighbours, at.of(static_cast<VertexId>(v)), static_cast<VertexId>(v), sides);
      for (const Side& side : sides) {
        thickness[v] = std::min(thickness[v], way_through(domain, mesh.points[v], side, cell_mm, largest_mm));
      }
    }
  }
  return thickness;
}

}  // namespace cbc3d
