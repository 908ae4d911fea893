#include "baselines/ld/merge_guards.hpp"

#include <algorithm>

namespace cbc3d::baselines::ld {
namespace {

std::uint64_t key_of(VertexId a, VertexId b) {
  return a < b ? std::uint64_t{a} << 32U | b : std::uint64_t{b} << 32U | a;
}

}  // namespace

void Fan::gather(MergeMesh& mesh, VertexId v) {
  faces_.clear();
  facets_.clear();
  vertices_.clear();
  mesh.for_star(v, [&](TetId t, std::uint32_t node) {
    const auto& n = mesh.nodes(t);
    const std::array<VertexId, 3> link{n[(node + 1) % 4], n[(node + 2) % 4], n[(node + 3) % 4]};
    for (std::size_t i = 0; i < 3; ++i) {
      faces_.push_back({key_of(link[i], link[(i + 1) % 3]), mesh.material(t)});
    }
  });
  std::sort(faces_.begin(), faces_.end(), [](const Face& a, const Face& b) { return a.key < b.key; });
  for (std::size_t f = 0; f < faces_.size();) {
    const bool has_both = f + 1 < faces_.size() && faces_[f + 1].key == faces_[f].key;
    const MaterialId one = faces_[f].material;
    const MaterialId other = has_both ? faces_[f + 1].material : kOutside;
    if (one != other) {
      const auto x = static_cast<VertexId>(faces_[f].key >> 32U);
      const auto y = static_cast<VertexId>(faces_[f].key);
      facets_.push_back({x, y, std::min(one, other), std::max(one, other)});
      vertices_.push_back(x);
      vertices_.push_back(y);
    }
    f += has_both ? 2 : 1;
  }
  std::sort(vertices_.begin(), vertices_.end());
  vertices_.erase(std::unique(vertices_.begin(), vertices_.end()), vertices_.end());
}

int Fan::degree(VertexId x) const {
  int degree = 0;
  for (const FanFacet& f : facets_) degree += f.x == x || f.y == x ? 1 : 0;
  return degree;
}

bool Fan::has(VertexId x, VertexId y) const {
  const VertexId low = std::min(x, y);
  const VertexId high = std::max(x, y);
  return std::any_of(facets_.begin(), facets_.end(),
                     [&](const FanFacet& f) { return f.x == low && f.y == high; });
}

bool keeps_topology(Stratum stratum_of_v, const Fan& of_v, VertexId w, const Fan& of_w) {
  constexpr int kLineDegree = 3;
  if (of_v.degree(w) < (stratum_of_v == Stratum::line ? kLineDegree : 2)) return false;
  for (const VertexId x : of_v.vertices()) {
    if (x == w) continue;
    if (!of_v.has(w, x) && of_w.has(x)) return false;  // two sheets would meet along the edge w x
    if (of_v.degree(x) >= kLineDegree && of_w.degree(x) >= kLineDegree) return false;  // two lines would
  }
  return std::none_of(of_v.facets().begin(), of_v.facets().end(),
                      [&](const FanFacet& f) { return f.x != w && f.y != w && of_w.has(f.x, f.y); });
}

Star::StarTet Star::star_tet(const MergeMesh& mesh, TetId t, std::uint32_t node) const {
  // Even permutations that put the node first.
  static constexpr std::array<std::array<std::uint8_t, 3>, 4> kOthers{
      {{1, 2, 3}, {0, 3, 2}, {3, 0, 1}, {2, 1, 0}}};
  StarTet tet{};
  tet.material = mesh.material(t);
  const LatticePoint& origin = mesh.point(v_);
  std::array<std::array<std::int64_t, 3>, 3> p{};
  for (std::size_t i = 0; i < 3; ++i) {
    tet.link[i] = mesh.nodes(t)[kOthers[node][i]];
    const LatticePoint& at = mesh.point(tet.link[i]);
    for (std::size_t a = 0; a < 3; ++a) p[i][a] = at[a] - origin[a];
    tet.link_mm[i] = {static_cast<double>(p[i][0]) * half_cell_mm_.x,
                      static_cast<double>(p[i][1]) * half_cell_mm_.y,
                      static_cast<double>(p[i][2]) * half_cell_mm_.z};
  }
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t b = (a + 1) % 3;
    const std::size_t c = (a + 2) % 3;
    tet.normal[a] = (p[1][b] - p[0][b]) * (p[2][c] - p[0][c]) - (p[1][c] - p[0][c]) * (p[2][b] - p[0][b]);
  }
  tet.first = p[0];
  return tet;
}

void Star::gather(MergeMesh& mesh, VertexId v) {
  v_ = v;
  tets_.clear();
  neighbours_.clear();
  mesh.for_star(v, [&](TetId t, std::uint32_t node) {
    tets_.push_back(star_tet(mesh, t, node));
    const auto& link = tets_.back().link;
    neighbours_.insert(neighbours_.end(), link.begin(), link.end());
  });
  std::sort(neighbours_.begin(), neighbours_.end());
  neighbours_.erase(std::unique(neighbours_.begin(), neighbours_.end()), neighbours_.end());
  sort_neighbours(mesh);
}

void Star::sort_neighbours(const MergeMesh& mesh) {
  by_distance_.clear();
  const LatticePoint& origin = mesh.point(v_);
  for (const VertexId w : neighbours_) {
    const LatticePoint& at = mesh.point(w);
    const Vec3 edge{(at[0] - origin[0]) * half_cell_mm_.x, (at[1] - origin[1]) * half_cell_mm_.y,
                    (at[2] - origin[2]) * half_cell_mm_.z};
    by_distance_.emplace_back(edge.squared_norm(), w);
  }
  std::sort(by_distance_.begin(), by_distance_.end());
  for (std::size_t n = 0; n < neighbours_.size(); ++n) neighbours_[n] = by_distance_[n].second;
}

bool Star::accepts(const MergeMesh& mesh, VertexId w, const DihedralBounds& bounds) const {
  const auto has_w = [w](const StarTet& t) { return t.link[0] == w || t.link[1] == w || t.link[2] == w; };
  const LatticePoint& at = mesh.point(w);
  const LatticePoint& origin = mesh.point(v_);
  std::array<std::int64_t, 3> q{};
  for (std::size_t a = 0; a < 3; ++a) q[a] = at[a] - origin[a];
  for (const StarTet& t : tets_) {
    if (has_w(t)) continue;
    const std::int64_t volume = t.normal[0] * (t.first[0] - q[0]) + t.normal[1] * (t.first[1] - q[1]) +
                                t.normal[2] * (t.first[2] - q[2]);
    if (volume <= 0) return false;
  }
  const Vec3 q_mm{static_cast<double>(q[0]) * half_cell_mm_.x, static_cast<double>(q[1]) * half_cell_mm_.y,
                  static_cast<double>(q[2]) * half_cell_mm_.z};
  return std::all_of(tets_.begin(), tets_.end(), [&](const StarTet& t) {
    return has_w(t) || t.material == kBackground ||
           bounds.accept(t.link_mm[0] - q_mm, t.link_mm[1] - q_mm, t.link_mm[2] - q_mm);
  });
}

}  // namespace cbc3d::baselines::ld
