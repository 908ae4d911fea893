// What is wrong with the surfaces of a mesh at one place: counted so that a change of a few tets or vertices
// can be judged by what it does to all of it.
//
// Notation: pinch   a vertex where the surface of a label is no manifold;
//           facet   a face on the outside: an outer one, or one between two labels with a vertex there;
//           cut     two facets that cross or touch where they share no vertex;
//           fold    two outer facets that share an edge, one within the tet behind the other, as at a gap of
//                   one tet that is inside out: no facets cut each other there, but tets overlap;
//           far     a surface vertex too far from the boundary voxels of one of its labels;
//           lonely  a boundary voxel too far from the surface vertices of its label.
#pragma once

#include <cmath>
#include <vector>

#include "mesher/domain/cubes.hpp"
#include "mesher/improve/surface/labelled_complex.hpp"
#include "mesher/improve/surface/relabel_tets.hpp"

namespace cbc3d {

struct SurfaceDefects {
  std::size_t pinches = 0, cuts = 0;
  double far = 0, lonely = 0;  ///< sums of distances, in units of the limit, of those beyond it
  std::size_t folds = 0;

  [[nodiscard]] std::size_t shape() const { return pinches + cuts; }
  [[nodiscard]] bool none_but_folds() const { return shape() == 0 && far == 0 && lonely == 0; }
  /// True when nothing is worse and something is better; with `may_trade` a cut may become a pinch, or a
  /// pinch a cut. Folds count where all else is equal.
  [[nodiscard]] bool is_better_than(const SurfaceDefects& other, bool may_trade) const;
};

/// What the surfaces are measured against.
struct SurfaceGuide {
  const std::vector<InterfacePoint>& points;
  const ImagePlaces& places;
  double limit_mm = 1;  ///< of distances, both ways
};

/// Numbers at places, in cubes; add all, then sort.
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

/// The vertices of all tets round some, ascending; they among them.
std::vector<VertexId> ring_of(const LabelledComplex& complex, const std::vector<VertexId>& vertices);

/// Faults of a whole mesh, each by the vertices that take part: first the cuts, then what is pinched or far,
/// then what is nearest to lonely points. One fault may be there more than once.
struct FaultList {
  std::vector<std::vector<VertexId>> seeds;
  std::vector<std::vector<VertexId>> folds;
  std::size_t cuts = 0;
};
/// Parallel.
FaultList find_surface_defects(const LabelledComplex& complex, const SurfaceGuide& guide);

/// Measures faults near vertices that change. Both complex and guide must outlive it.
class FaultMeter {
 public:
  FaultMeter(const LabelledComplex& complex, const SurfaceGuide& guide) : complex_(complex), guide_(guide) {}

  /// What a change of some vertices, or of the tets round them, bears on.
  struct Scope {
    std::vector<VertexId> vertices;     // ascending
    std::vector<std::uint32_t> points;  // that one of them may be near to, numbered as they were looked at
  };

  /// Gathers all that changes of these vertices may bear on.
  void look_at(std::span<const VertexId> vertices);
  /// Of vertices that were looked at, where they are now.
  [[nodiscard]] Scope scope_of(std::vector<VertexId> vertices) const;
  /// The faults in which one of the vertices takes part; given up where there are more pinches than `most`.
  [[nodiscard]] SurfaceDefects measure(const Scope& scope, std::size_t most = ~std::size_t{0}) const;
  [[nodiscard]] std::size_t pinches(const std::vector<VertexId>& vertices) const;
  [[nodiscard]] double far(const std::vector<VertexId>& vertices) const;
  /// The points of a scope that are lonely.
  [[nodiscard]] std::vector<std::uint32_t> lonely_points(const Scope& scope) const;
  [[nodiscard]] const InterfacePoint& point(std::uint32_t i) const { return guide_.points[points_[i]]; }
  /// True when the surface of the point's label (of all labels, when `outer`) has a vertex within the limit.
  [[nodiscard]] bool is_reached(std::uint32_t i, bool outer) const;
  /// How near that surface comes, infinite where nothing is near; `nearest` is the vertex.
  [[nodiscard]] double distance_mm(std::uint32_t i, bool outer, VertexId& nearest) const;

 private:
  struct Facet {
    std::array<VertexId, 3> nodes;
    VertexId behind;  // the tet's fourth vertex
    bool is_outer;
    Vec3 low, high;
  };
  void make_grids();
  void list_vertices_near_points(const std::vector<VertexId>& vertices);
  void list_facets_near(const std::vector<VertexId>& vertices);
  void add_facets(std::vector<TetId>& tets, std::vector<Facet>& facets) const;
  [[nodiscard]] Facet facet(TetId t, std::size_t n) const;
  [[nodiscard]] bool is_on(VertexId v, std::uint32_t point, bool outer) const;
  void count_cuts_and_folds(const std::vector<VertexId>& vertices, SurfaceDefects& faults) const;
  [[nodiscard]] double lonely(const Scope& scope) const;

  const LabelledComplex& complex_;
  const SurfaceGuide& guide_;
  PlaceGrid vertex_grid_, point_grid_;  // where all was when first looked at
  bool has_grids_ = false;
  // Of what was looked at:
  std::vector<std::uint32_t> points_;
  std::vector<std::uint32_t> first_near_;  // of each point, into near_
  std::vector<VertexId> near_;
  std::vector<Facet> facets_;
};

}  // namespace cbc3d
