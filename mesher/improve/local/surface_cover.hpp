// Which vertex covers which boundary sample: the guard that keeps every part of the domain's boundaries
// within the reach of the mesh's surface vertices while vertices move and vanish.
//
// Sample, covers and reach are those of boundary_samples.hpp.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesher/domain/boundary_samples.hpp"
#include "mesher/improve/local/tet_complex.hpp"

namespace cbc3d {

using SampleId = std::uint32_t;
inline constexpr SampleId kNoSample = 0xFFFFFFFFU;

/// The samples that vertices of a mesh, or of a patch of it, cover, as lists at the vertices.
class SurfaceCover {
 public:
  /// `own_reach_mm`: the reach of samples that have one of their own, 0 for the others; may be empty. Both
  /// lists must outlive this.
  SurfaceCover(const std::vector<BoundarySample>& samples, double reach_mm,
               std::span<const float> own_reach_mm = {})
      : samples_(&samples), reach_mm_(reach_mm), own_reach_mm_(own_reach_mm) {}
  /// With the covering vertex of every sample, kNoVertex for none, and one reach for all.
  SurfaceCover(const std::vector<BoundarySample>& samples, const std::vector<VertexId>& covering,
               std::size_t vertices, double reach_mm);

  /// Makes room for vertices that cover nothing yet.
  void resize(std::size_t vertices) { first_.resize(vertices, kNoSample); }
  void add(VertexId vertex, SampleId sample);

  [[nodiscard]] const BoundarySample& sample(SampleId s) const { return (*samples_)[s]; }
  [[nodiscard]] Vec3 centre(SampleId s) const { return (*samples_)[s].centre(); }
  [[nodiscard]] double reach_mm(SampleId s) const {
    return own_reach_mm_.empty() || own_reach_mm_[s] == 0 ? reach_mm_ : own_reach_mm_[s];
  }
  [[nodiscard]] double reach_squared(SampleId s) const { return reach_mm(s) * reach_mm(s); }

  /// True when holds(sample) for all samples of a vertex.
  template <typename Condition>
  bool all_of(VertexId v, const Condition& holds) const {
    for (std::uint32_t link = first_[v]; link != kNoSample; link = links_[link].next) {
      if (!holds(links_[link].sample)) {
        return false;
      }
    }
    return true;
  }
  /// Calls f(sample) for the samples of a vertex.
  template <typename F>
  void for_each(VertexId v, const F& f) const {
    all_of(v, [&](SampleId s) {
      f(s);
      return true;
    });
  }

  // ---- One vertex moves or is relabelled by itself; samples beyond the reach may stay so

  /// The largest squared distance that the sample's vertex may have when it was at `from`: the reach, or what
  /// it was.
  [[nodiscard]] double limit_squared(SampleId s, const Vec3& from) const;
  /// True when v may go from one place to another: its samples stay within that limit.
  [[nodiscard]] bool may_move(VertexId v, const Vec3& from, const Vec3& to) const;
  /// Gives a sample of one vertex to another.
  void reassign(SampleId sample, VertexId from, VertexId to);

  // ---- Samples pass to vertices around, all within the reach

  /// True when every sample of v is covered once v is at `to` (or gone, when `to` is null): by v itself or by
  /// one of `others`, which are at their places in `mesh` and whose materials are `sets`. What has to change
  /// is remembered for commit.
  bool can_release(VertexId v, const Vec3* to, std::span<const VertexId> others, const TetComplex& mesh,
                   const std::vector<MaterialSet>& sets);
  /// Carries out what the last successful can_release found.
  void commit(VertexId v);

  /// For two vertices that are to become one: finds the samples that none of `others` (as in can_release)
  /// covers, to which the one vertex has to be close; false where no place is within the reach of them all.
  /// Remembered for commit_merge.
  bool find_uncovered(VertexId u, VertexId v, std::span<const VertexId> others, const TetComplex& mesh,
                      const std::vector<MaterialSet>& sets);
  [[nodiscard]] const std::vector<SampleId>& uncovered() const { return uncovered_; }
  /// Carries out what the last find_uncovered found: v takes the uncovered samples, `others` the rest.
  void commit_merge(VertexId u, VertexId v);

 private:
  struct Link {
    SampleId sample;
    std::uint32_t next;
  };
  [[nodiscard]] bool reaches(const Vec3& at, SampleId s) const {
    return (centre(s) - at).squared_norm() <= reach_squared(s);
  }

  const std::vector<BoundarySample>* samples_;
  double reach_mm_;
  std::span<const float> own_reach_mm_;
  std::vector<std::uint32_t> first_;  // into links_, of every vertex
  std::vector<Link> links_;
  std::vector<SampleId> uncovered_;
  std::vector<VertexId> new_vertices_;  // of the links of the released vertex, in order; kNoVertex: it stays
};

}  // namespace cbc3d
