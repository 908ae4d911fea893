#include "baselines/tetgen/surface_nets.hpp"

#include <algorithm>
#include <limits>
#include <numeric>

#include "mesher/core/error.hpp"

namespace cbc3d::baselines {
namespace {

// Shrinking and growing factors of Taubin's smoothing; their pass band is 0.1.
constexpr double kShrink = 0.5;
constexpr double kGrow = -0.526;

// Cell (i,j,k) of the dual grid lies between voxels (i-1,j-1,k-1) and (i,j,k), so that the grid has one cell
// more than the image along each axis and covers its border.
struct DualGrid {
  const LabelImage& image;
  Index3 size;

  explicit DualGrid(const LabelImage& of) : image(of), size(of.frame.size) {
    for (int& n : size) ++n;
  }
  [[nodiscard]] std::size_t offset(int i, int j, int k) const {
    return (static_cast<std::size_t>(k) * static_cast<std::size_t>(size[1]) + static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(size[0]) +
           static_cast<std::size_t>(i);
  }
  [[nodiscard]] std::size_t count() const { return offset(size[0] - 1, size[1] - 1, size[2] - 1) + 1; }
  // The materials at the cell's corners, x fastest.
  [[nodiscard]] std::array<MaterialId, 8> corners(int i, int j, int k) const {
    std::array<MaterialId, 8> materials{};
    for (int c = 0; c < 8; ++c) {
      materials[static_cast<std::size_t>(c)] =
          image.at_or_background(i - 1 + (c & 1), j - 1 + ((c >> 1) & 1), k - 1 + (c >> 2));
    }
    return materials;
  }
  [[nodiscard]] Vec3 centre(int i, int j, int k) const {
    const Vec3& h = image.frame.spacing_mm;
    return {(i - 0.5) * h.x, (j - 0.5) * h.y, (k - 0.5) * h.z};
  }
};

template <std::size_t N>
int distinct(std::array<MaterialId, N> materials) {
  std::sort(materials.begin(), materials.end());
  return static_cast<int>(std::unique(materials.begin(), materials.end()) - materials.begin());
}

// The four corners of a cell on one of its faces; faces are -x, +x, -y, +y, -z, +z.
std::array<MaterialId, 4> face_corners(const std::array<MaterialId, 8>& corners, int face) {
  const unsigned axis_bit = 1U << static_cast<unsigned>(face / 2);
  std::array<MaterialId, 4> result{};
  std::size_t next = 0;
  for (unsigned c = 0; c < 8; ++c)
    if (((c & axis_bit) != 0) == (face % 2 == 1)) result[next++] = corners[c];
  return result;
}

// Calls visit(i, j, k) for every cell, slices in parallel.
template <typename Visit>
void for_each_cell(const DualGrid& grid, Visit visit) {
#pragma omp parallel for schedule(dynamic)
  for (int k = 0; k < grid.size[2]; ++k) {
    for (int j = 0; j < grid.size[1]; ++j)
      for (int i = 0; i < grid.size[0]; ++i) visit(i, j, k);
  }
}

// Numbers the cells that see more than one label in grid order; the others have -1.
std::vector<int> number_vertices(const DualGrid& grid) {
  std::vector<int> ids(grid.count(), -1);
  for_each_cell(grid, [&](int i, int j, int k) {
    if (distinct(grid.corners(i, j, k)) > 1) ids[grid.offset(i, j, k)] = 0;
  });
  std::size_t next = 0;
  for (int& id : ids)
    if (id == 0) id = static_cast<int>(next++);
  if (next > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw JobError("the surface net has more than 2^31 vertices; crop the image");
  return ids;
}

// A vertex where three or more labels meet moves along such junctions only, so that they stay put.
std::array<int, 6> links_of(const DualGrid& grid, const std::vector<int>& ids, int i, int j, int k) {
  const auto corners = grid.corners(i, j, k);
  std::array<int, 6> all{};
  std::array<int, 6> along_junction{};
  bool has_junction = false;
  for (int face = 0; face < 6; ++face) {
    const auto slot = static_cast<std::size_t>(face);
    all[slot] = along_junction[slot] = -1;
    const int labels = distinct(face_corners(corners, face));
    if (labels < 2) continue;
    Index3 cell{i, j, k};
    cell[static_cast<std::size_t>(face / 2)] += face % 2 == 1 ? 1 : -1;
    all[slot] = ids[grid.offset(cell[0], cell[1], cell[2])];
    if (labels < 3) continue;
    along_junction[slot] = all[slot];
    has_junction = true;
  }
  return has_junction ? along_junction : all;
}

void place_vertices(const DualGrid& grid, const std::vector<int>& ids, SurfaceNet& net) {
  const std::size_t count = 1 + static_cast<std::size_t>(*std::max_element(ids.begin(), ids.end()));
  net.centres.resize(count);
  net.links.resize(count);
  for_each_cell(grid, [&](int i, int j, int k) {
    const int id = ids[grid.offset(i, j, k)];
    if (id < 0) return;
    net.centres[static_cast<std::size_t>(id)] = grid.centre(i, j, k);
    net.links[static_cast<std::size_t>(id)] = links_of(grid, ids, i, j, k);
  });
  net.points = net.centres;
}

Vec3 within_reach(const Vec3& p, const Vec3& centre, const Vec3& reach_mm) {
  Vec3 result;
  for (int axis = 0; axis < 3; ++axis)
    result[axis] = std::clamp(p[axis], centre[axis] - reach_mm[axis], centre[axis] + reach_mm[axis]);
  return result;
}

// One Jacobi step: every vertex moves by the share `factor` of the way to the mean of its links.
void smooth_once(const SurfaceNet& net, double factor, const std::vector<Vec3>& from, std::vector<Vec3>& to) {
  const auto count = static_cast<std::int64_t>(from.size());
#pragma omp parallel for schedule(static)
  for (std::int64_t signed_v = 0; signed_v < count; ++signed_v) {
    const auto v = static_cast<std::size_t>(signed_v);
    Vec3 sum;
    int links = 0;
    for (const int link : net.links[v]) {
      if (link < 0) continue;
      sum += from[static_cast<std::size_t>(link)];
      ++links;
    }
    const Vec3 target = links == 0 ? from[v] : from[v] + factor * (sum / links - from[v]);
    to[v] = within_reach(target, net.centres[v], net.reach_mm);
  }
}

void smooth(SurfaceNet& net, int steps) {
  std::vector<Vec3> next(net.points.size());
  for (int step = 0; step < steps; ++step) {
    smooth_once(net, step % 2 == 0 ? kShrink : kGrow, net.points, next);
    std::swap(net.points, next);
  }
}

using Quad = std::array<int, 4>;

// The quads of the voxel faces across `axis` at the low side of voxel (i,j,k), if two labels meet there. The
// quad turns counter-clockwise about the axis, so that its normal points from the lower voxel to (i,j,k).
void add_quad(const DualGrid& grid, const std::vector<int>& ids, const Index3& voxel, int axis,
              std::vector<Quad>& quads, std::vector<NetSides>& sides) {
  Index3 lower = voxel;
  --lower[static_cast<std::size_t>(axis)];
  const MaterialId behind = grid.image.at_or_background(lower[0], lower[1], lower[2]);
  const MaterialId ahead = grid.image.at_or_background(voxel[0], voxel[1], voxel[2]);
  if (behind == ahead) return;
  const auto u = static_cast<std::size_t>((axis + 1) % 3);
  const auto v = static_cast<std::size_t>((axis + 2) % 3);
  constexpr std::array<std::array<int, 2>, 4> kTurn{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  Quad quad{};
  for (std::size_t corner = 0; corner < 4; ++corner) {
    Index3 cell = voxel;
    cell[u] += kTurn[corner][0];
    cell[v] += kTurn[corner][1];
    quad[corner] = ids[grid.offset(cell[0], cell[1], cell[2])];
  }
  quads.push_back(quad);
  sides.push_back({behind, ahead});
}

// Visits every quad once, in slice order. Voxel indices go one past the image, whose far side has faces too.
void collect_quads(const DualGrid& grid, const std::vector<int>& ids, std::vector<Quad>& quads,
                   std::vector<NetSides>& sides) {
  const Index3& n = grid.image.frame.size;
  for (int k = 0; k <= n[2]; ++k) {
    for (int j = 0; j <= n[1]; ++j) {
      for (int i = 0; i <= n[0]; ++i) {
        // A face of an axis needs its voxel inside the image along the two others.
        if (j < n[1] && k < n[2]) add_quad(grid, ids, {i, j, k}, 0, quads, sides);
        if (i < n[0] && k < n[2]) add_quad(grid, ids, {i, j, k}, 1, quads, sides);
        if (i < n[0] && j < n[1]) add_quad(grid, ids, {i, j, k}, 2, quads, sides);
      }
    }
  }
}

// Splits every quad along its shorter diagonal.
void triangulate(const std::vector<Quad>& quads, const std::vector<NetSides>& sides, SurfaceNet& net) {
  net.triangles.resize(2 * quads.size());
  net.sides.resize(2 * quads.size());
  const auto point = [&](int id) { return net.points[static_cast<std::size_t>(id)]; };
  for (std::size_t q = 0; q < quads.size(); ++q) {
    const auto& [a, b, c, d] = quads[q];
    const bool along_ac = (point(a) - point(c)).squared_norm() <= (point(b) - point(d)).squared_norm();
    net.triangles[2 * q] = along_ac ? std::array<int, 3>{a, b, c} : std::array<int, 3>{b, c, d};
    net.triangles[2 * q + 1] = along_ac ? std::array<int, 3>{a, c, d} : std::array<int, 3>{b, d, a};
    net.sides[2 * q] = net.sides[2 * q + 1] = sides[q];
  }
}

}  // namespace

SurfaceNet surface_net(const LabelImage& image, const SurfaceNetOptions& options) {
  const DualGrid grid(image);
  const std::vector<int> ids = number_vertices(grid);
  SurfaceNet net;
  net.reach_mm = options.reach * image.frame.spacing_mm;
  place_vertices(grid, ids, net);
  smooth(net, options.smoothing_steps);
  std::vector<Quad> quads;
  std::vector<NetSides> sides;
  collect_quads(grid, ids, quads, sides);
  triangulate(quads, sides, net);
  return net;
}

void retract(SurfaceNet& net, const std::vector<std::uint8_t>& flagged) {
  std::vector<std::uint8_t> moved = flagged;
  for (const auto& triangle : net.triangles) {
    const bool touched = std::any_of(triangle.begin(), triangle.end(),
                                     [&](int v) { return flagged[static_cast<std::size_t>(v)] != 0; });
    if (!touched) continue;
    for (const int v : triangle) moved[static_cast<std::size_t>(v)] = 1;
  }
  for (std::size_t v = 0; v < net.points.size(); ++v)
    if (moved[v] != 0) net.points[v] = 0.5 * (net.points[v] + net.centres[v]);
}

}  // namespace cbc3d::baselines
