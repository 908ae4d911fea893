// Lattices and indicators that the tests share.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <set>

#include "baselines/cleaver/alphas.hpp"
#include "baselines/cleaver/stencil.hpp"
#include "baselines/cleaver/triples.hpp"
#include "baselines/cleaver/warp_vertices.hpp"
#include "mesher/testing/random_draws.hpp"

namespace cbc3d::baselines::cleaver::testing {

/// A cube of cells of edge 1 mm, each leaf of its octree.
inline LatticeGrid cube_grid(int cells, int levels = 0) {
  LatticeGrid grid;
  grid.cell_mm = {1, 1, 1};
  grid.cells = {cells, cells, cells};
  grid.top_level = levels;
  return grid;
}

inline std::vector<Leaf> all_leaves(const Octree& octree) {
  std::vector<Leaf> leaves;
  const Index3& cells = octree.grid().cells;
  for (int k = 0; k < cells[2]; ++k) {
    for (int j = 0; j < cells[1]; ++j) {
      for (int i = 0; i < cells[0]; ++i) {
        const int level = octree.level_at({i, j, k});
        const int edge = 1 << level;
        if (i % edge == 0 && j % edge == 0 && k % edge == 0) leaves.push_back({{i, j, k}, level});
      }
    }
  }
  return leaves;
}

inline Lattice uniform_lattice(int cells) {
  const Octree octree = Octree::uniform(cube_grid(cells));
  return background_lattice(octree, all_leaves(octree));
}

/// A lattice of cells of edges 1 to 8 mm, divided at random places.
inline Lattice graded_lattice(int cells, std::mt19937& random) {
  LatticeGrid grid = cube_grid(cells, 3);
  grid.usual_level = 3;  // uniform() then divides nothing
  Octree octree = Octree::uniform(grid);
  std::vector<Index3> places;
  for (int n = 0; n < 6; ++n) {
    const Vec3 p = cbc3d::testing::draw_point(random, 0, cells);
    places.push_back({static_cast<int>(p.x), static_cast<int>(p.y), static_cast<int>(p.z)});
  }
  octree.divide_at(places);
  octree.balance();
  return background_lattice(octree, all_leaves(octree));
}

/// Indicators without any sense: where materials change is a hash of the places.
class RandomIndicators final : public Indicators {
 public:
  RandomIndicators(std::uint64_t seed, int materials) : seed_(seed), materials_(materials) {}

  [[nodiscard]] MaterialId material_at(const Vec3& place) const override {
    return static_cast<MaterialId>(hash(place) % static_cast<std::uint64_t>(materials_));
  }
  [[nodiscard]] double crossing(const Vec3& from, const Vec3& to, MaterialId a, MaterialId b) const override {
    const std::uint64_t bits = mix(hash(from) ^ mix(hash(to) + a) ^ (std::uint64_t{b} << 20U));
    return static_cast<double>(bits >> 11U) / 9007199254740992.0;
  }
  [[nodiscard]] bool is_outside(const Vec3&) const override { return false; }

 private:
  static std::uint64_t mix(std::uint64_t x) {
    x ^= x >> 33U;
    x *= 0xff51afd7ed558ccdULL;
    x ^= x >> 33U;
    x *= 0xc4ceb9fe1a85ec53ULL;
    return x ^ (x >> 33U);
  }
  [[nodiscard]] std::uint64_t hash(const Vec3& p) const {
    std::uint64_t h = mix(seed_ + 1);
    for (int axis = 0; axis < 3; ++axis) h = mix(h ^ std::bit_cast<std::uint64_t>(p[axis] + 1e3));
    return h;
  }

  std::uint64_t seed_;
  int materials_;
};

/// Two materials on either side of a plane.
class PlaneIndicators final : public Indicators {
 public:
  PlaneIndicators(const Vec3& normal, double offset) : normal_(normal), offset_(offset) {}

  [[nodiscard]] double height(const Vec3& p) const { return normal_.dot(p) - offset_; }
  [[nodiscard]] MaterialId material_at(const Vec3& p) const override { return height(p) > 0 ? 1 : 0; }
  [[nodiscard]] double crossing(const Vec3& from, const Vec3& to, MaterialId, MaterialId) const override {
    const double a = height(from), b = height(to);
    return a == b ? 0 : std::fmin(1.0, std::fmax(0.0, a / (a - b)));
  }
  [[nodiscard]] bool is_outside(const Vec3&) const override { return false; }

 private:
  Vec3 normal_;
  double offset_;
};

inline std::vector<MaterialId> materials_at(const std::vector<Vec3>& points, const Indicators& indicators) {
  std::vector<MaterialId> materials(points.size());
  for (std::size_t v = 0; v < points.size(); ++v) materials[v] = indicators.material_at(points[v]);
  return materials;
}

/// Materials of the vertices by the indicators, with 0 within 1.6 mm of the sides of a cube, so that no
/// vertex of the lattice's surface moves.
inline std::vector<MaterialId> inner_materials(const Lattice& lattice, const Indicators& indicators,
                                               double edge, double rim) {
  std::vector<MaterialId> materials = materials_at(lattice.points, indicators);
  for (std::size_t v = 0; v < materials.size(); ++v) {
    const Vec3& p = lattice.points[v];
    const bool inner = p.min_coeff() > rim && p.max_coeff() < edge - rim;
    if (!inner) materials[v] = 0;
  }
  return materials;
}

/// All stages up to the stencil.
inline CutLattice cut_and_warped(Lattice lattice, std::vector<MaterialId> materials,
                                 const Indicators& indicators) {
  CutLattice cut = cut_edges(std::move(lattice), std::move(materials), indicators);
  set_alphas(cut);
  warp_vertices(cut, indicators);
  find_triples(cut, indicators);
  return cut;
}

inline std::size_t materials_of_tet(const CutLattice& cut, std::size_t tet) {
  std::set<MaterialId> found;
  for (const VertexId v : cut.lattice.tets[tet]) found.insert(cut.materials[v]);
  return found.size();
}

inline double total_volume(const TetNodes& tets, const std::vector<Vec3>& points) {
  double sum = 0;
  for (const auto& n : tets) sum += six_volumes(points[n[0]], points[n[1]], points[n[2]], points[n[3]]) / 6;
  return sum;
}

}  // namespace cbc3d::baselines::cleaver::testing
