#include "baselines/ld/leaf_templates.hpp"

#include <cmath>
#include <optional>
#include <sstream>

#include "baselines/ld/dihedral.hpp"
#include "mesher/core/error.hpp"

namespace cbc3d::baselines::ld {
namespace {

/// A square on the face of a leaf, with the axes u and v that follow its normal's in cyclic order.
struct Square {
  int level;   // of the leaf that it is the whole face of
  Index3 low;  // its lowest corner in cells
  int axis;    // of its normal
  bool is_high;
};

class FaceFiller {
 public:
  FaceFiller(const LabelOctree& octree, std::vector<LeafTriangle>& triangles)
      : octree_(octree), triangles_(triangles) {}

  void fill(const Square& s) {
    set_corners(s);
    std::array<bool, 4> is_split{};
    bool is_any_split = false;
    for (std::size_t e = 0; e < 4; ++e) {
      is_split[e] = edge_is_split(s, e);
      is_any_split = is_any_split || is_split[e];
    }
    if (is_any_split) {
      add_fan(s, is_split);
    } else {
      add_halves(s);
    }
  }

 private:
  // Corners in cyclic order: low, along u, along u and v, along v.
  void set_corners(const Square& s) {
    const auto u = static_cast<std::size_t>((s.axis + 1) % 3);
    const auto v = static_cast<std::size_t>((s.axis + 2) % 3);
    const int side = 2 << s.level;
    for (std::size_t a = 0; a < 3; ++a) corners_[0][a] = 2 * s.low[a];
    corners_[1] = corners_[2] = corners_[3] = corners_[0];
    corners_[1][u] += side;
    corners_[2][u] += side;
    corners_[2][v] += side;
    corners_[3][v] += side;
  }

  // An edge has a vertex in its middle when one of the four boxes of the square's level around it is split.
  [[nodiscard]] bool edge_is_split(const Square& s, std::size_t edge) const {
    if (s.level == 0) return false;
    const auto along = static_cast<std::size_t>((s.axis + 1 + (edge % 2 == 0 ? 0 : 1)) % 3);
    Index3 box{};
    for (std::size_t a = 0; a < 3; ++a) {
      box[a] = std::min(corners_[edge][a], corners_[(edge + 1) % 4][a]) / 2 >> s.level;
    }
    const std::size_t one = (along + 1) % 3;
    const std::size_t other = (along + 2) % 3;
    for (int around = 0; around < 4; ++around) {
      Index3 beside = box;
      beside[one] -= around % 2;
      beside[other] -= around / 2;
      if (octree_.is_split(s.level, beside)) return true;
    }
    return false;
  }

  void add_halves(const Square& s) {
    const int sum = (s.low[0] >> s.level) + (s.low[1] >> s.level) + (s.low[2] >> s.level);
    const std::size_t first = sum % 2 == 0 ? 0 : 1;  // an end of the diagonal
    add(s, corners_[first], corners_[first + 1], corners_[first + 2]);
    add(s, corners_[first], corners_[first + 2], corners_[(first + 3) % 4]);
  }

  void add_fan(const Square& s, const std::array<bool, 4>& is_split) {
    const LatticePoint centre = middle(corners_[0], corners_[2]);
    for (std::size_t e = 0; e < 4; ++e) {
      const LatticePoint& from = corners_[e];
      const LatticePoint& to = corners_[(e + 1) % 4];
      if (is_split[e]) {
        add(s, centre, from, middle(from, to));
        add(s, centre, middle(from, to), to);
      } else {
        add(s, centre, from, to);
      }
    }
  }

  static LatticePoint middle(const LatticePoint& a, const LatticePoint& b) {
    return {(a[0] + b[0]) / 2, (a[1] + b[1]) / 2, (a[2] + b[2]) / 2};
  }

  // Counter-clockwise seen along the axis from above, so positive with a centre above the square.
  void add(const Square& s, const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) {
    triangles_.push_back({s.is_high ? std::array{a, c, b} : std::array{a, b, c}, s.axis, s.is_high});
  }

  const LabelOctree& octree_;
  std::vector<LeafTriangle>& triangles_;
  std::array<LatticePoint, 4> corners_{};
};

void fill_face(const LabelOctree& octree, const Leaf& leaf, int axis, bool is_high, FaceFiller& filler) {
  const auto a = static_cast<std::size_t>(axis);
  const int side = 1 << leaf.level;
  Square whole{leaf.level, leaf.low, axis, is_high};
  whole.low[a] += is_high ? side : 0;
  Index3 neighbour{leaf.low[0] >> leaf.level, leaf.low[1] >> leaf.level, leaf.low[2] >> leaf.level};
  neighbour[a] += is_high ? 1 : -1;
  if (!octree.is_split(leaf.level, neighbour)) {
    filler.fill(whole);
    return;
  }
  for (int quarter = 0; quarter < 4; ++quarter) {
    Square part = whole;
    part.level = leaf.level - 1;
    part.low[(a + 1) % 3] += (quarter & 1) * side / 2;
    part.low[(a + 2) % 3] += (quarter >> 1) * side / 2;
    filler.fill(part);
  }
}

/// The triangles that may stand on the lower face of a cube of side 4 along an axis, centred at the origin.
std::vector<std::array<Vec3, 3>> possible_triangles(int axis) {
  const auto at = [axis](double u, double v) {
    Vec3 p;
    p[axis] = -2;
    p[(axis + 1) % 3] = u;
    p[(axis + 2) % 3] = v;
    return p;
  };
  std::vector<std::array<Vec3, 3>> triangles;
  const auto add_halves = [&](double u, double v, double side, std::size_t diagonal) {
    const std::array<Vec3, 4> c{at(u, v), at(u + side, v), at(u + side, v + side), at(u, v + side)};
    for (const std::size_t n : {diagonal, diagonal + 2})
      triangles.push_back({c[n], c[(n + 1) % 4], c[(n + 2) % 4]});
  };
  for (const std::size_t diagonal : {0, 1}) add_halves(-2, -2, 4, diagonal);
  for (const double u : {-2, 0}) {
    // Counted in edges of a quarter the corners of the face and its centre have even sums.
    for (const double v : {-2, 0}) add_halves(u, v, 2, u == v ? 0 : 1);
  }
  for (const double sign : {-2, 2}) {  // of the fans; the others mirror these
    triangles.push_back({at(0, 0), at(sign, -2), at(sign, 2)});
    triangles.push_back({at(0, 0), at(-2, sign), at(2, sign)});
    triangles.push_back({at(0, 0), at(sign, 0), at(sign, 2)});
    triangles.push_back({at(0, 0), at(0, sign), at(2, sign)});
  }
  return triangles;
}

}  // namespace

void append_leaf_triangles(const LabelOctree& octree, const Leaf& leaf,
                           std::vector<LeafTriangle>& triangles) {
  FaceFiller filler(octree, triangles);
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool is_high : {false, true}) fill_face(octree, leaf, axis, is_high, filler);
  }
}

double least_template_dihedral_deg(const Vec3& cell_mm) {
  const auto scaled = [&](const Vec3& p) { return Vec3{p.x * cell_mm.x, p.y * cell_mm.y, p.z * cell_mm.z}; };
  double least = 180;
  for (int axis = 0; axis < 3; ++axis) {
    for (const auto& t : possible_triangles(axis)) {
      least = std::fmin(least, least_dihedral_deg(scaled(t[0]), scaled(t[1]), scaled(t[2])));
    }
  }
  return least;
}

Index3 pieces_for(const Vec3& spacing_mm, double min_dihedral_deg) {
  constexpr int kMostPieces = 64;
  constexpr double kRounding = 1e-6;  // degrees
  constexpr double kHeadroom = 4.0 / 3;
  std::optional<Index3> first_within_bound;
  Index3 pieces{1, 1, 1};
  while (true) {
    Vec3 cell = spacing_mm;
    for (int axis = 0; axis < 3; ++axis) cell[axis] /= pieces[static_cast<std::size_t>(axis)];
    const double least = least_template_dihedral_deg(cell);
    if (least >= kHeadroom * min_dihedral_deg + kRounding) return pieces;
    if (!first_within_bound && least >= min_dihedral_deg + kRounding) first_within_bound = pieces;
    const std::size_t longest = cell.x >= cell.y ? (cell.x >= cell.z ? 0 : 2) : (cell.y >= cell.z ? 1 : 2);
    if (++pieces[longest] > kMostPieces) break;
  }
  if (first_within_bound) return *first_within_bound;
  std::ostringstream text;
  text << "voxels of " << spacing_mm.x << " x " << spacing_mm.y << " x " << spacing_mm.z
       << " mm cannot be filled with dihedral angles of at least " << min_dihedral_deg
       << " degrees; give a smaller bound or resample the image";
  throw InputError(text.str());
}

}  // namespace cbc3d::baselines::ld
