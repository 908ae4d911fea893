// The defects of a mesh's surfaces at one place, counted so that a change of a few tets or vertices can be
// judged by its effect on all of them.
//
// Notation: pinch              a vertex where the surface of a label is non-manifold;
//           facet              an outer face, or a face between two labels with a vertex on the outside;
//           self-intersection  two facets that intersect or touch where they share no vertex;
//           fold               two outer facets that share an edge, one within the tet behind the other, as
//           at a gap of
//                              one tet that is inside out: no facets intersect there, but tets overlap;
//           far                a surface vertex beyond the limit from the boundary of one of its labels;
//           uncovered          a boundary sample with no surface vertex of its label within the limit. A
//           sample on the
//                              boundary to the background needs a vertex of the outer surface too.
#pragma once

#include <cmath>
#include <vector>

#include "mesher/domain/cubes.hpp"
#include "mesher/domain/domain.hpp"
#include "mesher/improve/surface/labelled_complex.hpp"

namespace cbc3d {

struct SurfaceDefects {
  std::size_t pinches = 0, self_intersections = 0;
  double far = 0, uncovered = 0;  ///< sums of the distances beyond the limit, in units of the limit
  std::size_t folds = 0;

  [[nodiscard]] std::size_t topological() const { return pinches + self_intersections; }
  [[nodiscard]] bool none_but_folds() const { return topological() == 0 && far == 0 && uncovered == 0; }
  /// True when nothing is worse and something is better; with `may_trade` a self-intersection may become a
  /// pinch, or a pinch a self-intersection. Folds count where all else is equal.
  [[nodiscard]] bool is_better_than(const SurfaceDefects& other, bool may_trade) const;
};

/// Numbered places sorted by cubes. All are added first, then sorted.
class PlaceGrid {
 public:
  explicit PlaceGrid(double cell_mm = 1) : cubes_{cell_mm} {}
  void add(const Vec3& at, std::uint32_t id) { entries_.push_back({CubeKeys::key(cubes_.cube_of(at)), id}); }
  void sort() { std::sort(entries_.begin(), entries_.end()); }
  /// Calls f(id) for the entries of all cubes that meet a box.
  template <typename F>
  void for_each_near(const Vec3& low, const Vec3& high, const F& f) const {
    const Index3 from = cubes_.cube_of(low);
    const Index3 to = cubes_.cube_of(high);
    for (int k = from[2]; k <= to[2]; ++k) {
      for (int j = from[1]; j <= to[1]; ++j) {
        const std::uint64_t last = CubeKeys::key({to[0], j, k});
        for (auto e =
                 std::lower_bound(entries_.begin(), entries_.end(), Entry{CubeKeys::key({from[0], j, k}), 0});
             e != entries_.end() && e->key <= last; ++e) {
          f(e->id);
        }
      }
    }
  }

 private:
  struct Entry {
    std::uint64_t key;
    std::uint32_t id;
    auto operator<=>(const Entry&) const = default;
  };
  CubeKeys cubes_;
  std::vector<Entry> entries_;
};

/// The vertices of all tets around some vertices, ascending; these are among them.
std::vector<VertexId> ring_of(const LabelledComplex& complex, const std::vector<VertexId>& vertices);

/// The defects of a whole mesh, each by the vertices that take part: first self-intersections, then pinches
/// and far vertices, then the vertices nearest to uncovered samples. A defect may be listed more than once.
struct DefectList {
  std::vector<std::vector<VertexId>> seeds;
  std::vector<std::vector<VertexId>> folds;
  std::size_t self_intersections = 0;
};
/// `limit_mm`: of distances between surfaces and boundaries, both ways. Parallel.
DefectList find_surface_defects(const LabelledComplex& complex, const Domain& domain, double limit_mm);

/// Measures the defects near vertices that change. Complex and domain must outlive it.
class DefectMeter {
 public:
  DefectMeter(const LabelledComplex& complex, const Domain& domain, double limit_mm)
      : complex_(complex), domain_(domain), samples_(domain.samples()), limit_mm_(limit_mm) {}

  /// What a change of some vertices, or of the tets around them, may affect.
  struct Scope {
    std::vector<VertexId> vertices;      // ascending
    std::vector<std::uint32_t> samples;  // that one of them may cover, numbered in the order of look_at
  };

  /// Gathers everything that changes of these vertices may affect. False where that is too much to look at,
  /// as at elements many times as large as voxels; then nothing may be measured.
  [[nodiscard]] bool look_at(std::span<const VertexId> vertices);
  /// The scope of vertices that were looked at, at the places where they are now.
  [[nodiscard]] Scope scope_of(std::vector<VertexId> vertices) const;
  /// The defects in which one of the vertices takes part. Where there are more pinches than `most`, only
  /// these.
  [[nodiscard]] SurfaceDefects measure(const Scope& scope, std::size_t most = ~std::size_t{0}) const;
  [[nodiscard]] std::size_t pinches(const std::vector<VertexId>& vertices) const;
  [[nodiscard]] double far(const std::vector<VertexId>& vertices) const;
  /// The samples of a scope that are uncovered.
  [[nodiscard]] std::vector<std::uint32_t> uncovered_samples(const Scope& scope) const;
  [[nodiscard]] const BoundarySample& sample(std::uint32_t i) const { return samples_[near_samples_[i]]; }
  /// True when the surface of the sample's label (the outer surface, when `outer`) has a vertex within the
  /// limit.
  [[nodiscard]] bool is_covered(std::uint32_t i, bool outer) const;
  /// The distance of that surface's nearest vertex, infinite where none is near; `nearest` is the vertex.
  [[nodiscard]] double distance_mm(std::uint32_t i, bool outer, VertexId& nearest) const;

 private:
  struct Facet {
    std::array<VertexId, 3> nodes;
    VertexId behind;  // the tet's fourth vertex
    bool is_outer;
    Vec3 low, high;
  };
  void make_grids();
  void list_vertices_near_samples(const std::vector<VertexId>& vertices);
  void list_facets_near(const std::vector<VertexId>& vertices);
  void add_facets(std::vector<TetId>& tets, std::vector<Facet>& facets) const;
  [[nodiscard]] Facet facet(TetId t, std::size_t n) const;
  [[nodiscard]] bool is_on(VertexId v, std::uint32_t sample, bool outer) const;
  void count_intersections_and_folds(const std::vector<VertexId>& vertices, SurfaceDefects& defects) const;
  [[nodiscard]] double uncovered(const Scope& scope) const;

  const LabelledComplex& complex_;
  const Domain& domain_;
  const std::vector<BoundarySample>& samples_;
  double limit_mm_;
  PlaceGrid vertex_grid_, sample_grid_;  // at the places of the first look_at
  bool has_grids_ = false;
  // Of the last look_at:
  std::vector<std::uint32_t> near_samples_;
  std::vector<std::uint32_t> first_near_;  // of each of these samples, into near_
  std::vector<VertexId> near_;
  std::vector<Facet> facets_;
};

}  // namespace cbc3d
