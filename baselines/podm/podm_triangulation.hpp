// CGAL's Delaunay triangulation with what the refinement keeps of vertices and tets. This header, and what
// includes it, is under the GPL as CGAL's triangulations are.
#pragma once

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_3.h>

#include <atomic>
#include <cstdint>

#include "mesher/core/label_voxels.hpp"
#include "mesher/core/vec3.hpp"

namespace cbc3d::baselines::podm {

/// What a vertex is there for.
enum class VertexKind : std::uint8_t {
  kBox,      ///< on the virtual box; never removed, never in the mesh of a label
  kSurface,  ///< on the surface, never removed
  kFree,     ///< a circumcentre; removed where a surface vertex comes near (rule 6)
};

/// A number that no two states of an element have in common, 0 for none. Elements are recycled: whoever kept
/// one's address finds by its stamp whether it is still the same. Others may write it at the same time.
class Stamp {
 public:
  // A recycled element is constructed while others may look at its stamp, so that too is an atomic store.
  Stamp() { set(0); }
  Stamp(const Stamp& other) { set(other.get()); }
  Stamp& operator=(const Stamp& other) {
    set(other.get());
    return *this;
  }
  ~Stamp() = default;
  [[nodiscard]] std::uint64_t get() const { return std::atomic_ref(value_).load(std::memory_order_relaxed); }
  void set(std::uint64_t value) { std::atomic_ref(value_).store(value, std::memory_order_relaxed); }

 private:
  mutable std::uint64_t value_;
};

struct VertexData {
  Stamp stamp;
  VertexKind kind = VertexKind::kBox;
  std::uint32_t id = 0;  ///< in the exported mesh
};

struct CellData {
  Stamp stamp;
  Vec3 centre;                        ///< circumcentre
  double radius_mm = 0;               ///< circumradius
  MaterialId material = kBackground;  ///< at the circumcentre
  std::uint32_t id = 0;               ///< in the exported mesh
};

/// A vertex with data. CGAL orders and hashes vertices by their time stamps where they have one, and by
/// address where they do not, which would not repeat.
template <typename Traits, typename Base = CGAL::Triangulation_vertex_base_3<Traits>>
class PodmVertex : public Base {
 public:
  template <typename Tds2>
  struct Rebind_TDS {  // NOLINT(readability-identifier-naming): CGAL's name
    using Other = PodmVertex<Traits, typename Base::template Rebind_TDS<Tds2>::Other>;
  };
  using Base::Base;
  PodmVertex() = default;

  using Has_timestamp = CGAL::Tag_true;                           // NOLINT(readability-identifier-naming)
  [[nodiscard]] std::size_t time_stamp() const { return time_; }  // NOLINT: CGAL's name
  void set_time_stamp(std::size_t time) { time_ = time; }         // NOLINT: CGAL's name

  VertexData data;

 private:
  std::size_t time_ = std::size_t(-1);
};

template <typename Traits, typename Base = CGAL::Delaunay_triangulation_cell_base_3<Traits>>
class PodmCell : public Base {
 public:
  template <typename Tds2>
  struct Rebind_TDS {  // NOLINT(readability-identifier-naming): CGAL's name
    using Other = PodmCell<Traits, typename Base::template Rebind_TDS<Tds2>::Other>;
  };
  using Base::Base;
  PodmCell() = default;

  CellData data;
};

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

/// `Concurrency` is CGAL::Sequential_tag or CGAL::Parallel_tag.
template <typename Concurrency>
using Triangulation = CGAL::Delaunay_triangulation_3<
    Kernel, CGAL::Triangulation_data_structure_3<PodmVertex<Kernel>, PodmCell<Kernel>, Concurrency>>;

inline Vec3 to_vec3(const Kernel::Point_3& p) {
  return {p.x(), p.y(), p.z()};
}
inline Kernel::Point_3 to_point(const Vec3& p) {
  return {p.x, p.y, p.z};
}

}  // namespace cbc3d::baselines::podm
