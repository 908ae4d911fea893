// The refinement's state and steps, for one worker or several on one triangulation (GPL, as CGAL's
// triangulations are). refinement.hpp has the rules and the notation.
//
// Workers insert and remove speculatively: before a worker reads or changes tets it locks the cells of CGAL's
// lock grid that their vertices are in. A lock that a worker of a lower number holds is not waited for: the
// worker gives back all its own, changes nothing, and comes back to the tet later. A lock of a worker of a
// higher number is waited for. So nobody waits in a circle, the busy worker of the lowest number is never
// turned away, and there is neither deadlock nor livelock.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "baselines/podm/podm_triangulation.hpp"
#include "baselines/podm/point_grid.hpp"
#include "baselines/podm/refinement.hpp"

namespace cbc3d::baselines::podm {

/// The queues, in their order; rule 6 comes before them all.
enum class Rule : std::uint8_t { kSample, kSplit, kFacet, kVolume, kNone };
inline constexpr std::size_t kQueues = 4;

/// How an attempt at a job ended.
enum class Attempt : std::uint8_t { kDone, kBlocked };

template <typename Concurrency>
class Refiner {
 public:
  using Dt = Triangulation<Concurrency>;
  using Cell = typename Dt::Cell_handle;
  using Vertex = typename Dt::Vertex_handle;
  static constexpr bool kParallel = std::is_same_v<Concurrency, CGAL::Parallel_tag>;

  /// A tet to be judged again, if it still is what it was; the place of one of its vertices, by which it is
  /// locked before it is looked at.
  struct Job {
    Cell cell;
    std::uint64_t stamp = 0;
    Vec3 key;
  };
  struct Removal {
    Vertex vertex;
    std::uint64_t stamp = 0;
    Vec3 key;
  };
  /// What one thread has to do, and its scratch memory.
  struct Worker {
    std::uint64_t number = 0, stamps = 0;
    std::array<std::deque<Job>, kQueues> jobs;
    std::deque<Removal> removals;
    RefinementCounts counts;
    std::vector<Cell> cells, fresh;
    std::vector<typename Dt::Facet> facets;
    std::vector<std::pair<Cell, int>> outer;  // tets around a hole, and their facet on it

    [[nodiscard]] bool idle() const {
      for (const auto& queue : jobs)
        if (!queue.empty()) return false;
      return removals.empty();
    }
    [[nodiscard]] std::size_t size() const {
      std::size_t sum = removals.size();
      for (const auto& queue : jobs) sum += queue.size();
      return sum;
    }
    std::uint64_t next_stamp() { return (number << 48) | ++stamps; }
  };

  Refiner(const LabelImage& image, const SurfaceOracle& oracle, const RefinementOptions& options);

  /// Puts the tets of the virtual box in the worker's queues.
  void start(Worker& worker);
  /// Does the most urgent of a worker's jobs, which must have one.
  Attempt step(Worker& worker);
  /// Inserts surface vertices anywhere; no other worker may be at work.
  void insert_samples(const std::vector<Vec3>& places, Worker& worker);

  /// The materials that tets have, each at least once.
  [[nodiscard]] std::vector<MaterialId> materials_present() const;
  /// The triangulation in arrays; the vertices' and tets' data get their numbers.
  [[nodiscard]] LabelledComplex exported();

 private:
  struct Decision {
    Rule rule = Rule::kNone;
    Vec3 place;
    VertexKind kind = VertexKind::kFree;
    Cell conflicting = {};  // a tet whose ball has the place in it
  };
  struct FreeVertex {
    Vertex vertex;
    std::uint64_t stamp = 0;
    bool operator==(const FreeVertex& other) const { return stamp == other.stamp; }
  };
  // Circumcentres and surface centres nearer than this to a vertex, in deltas, are not inserted, so that the
  // refinement ends at any surface; at a smooth one it never comes to that.
  static constexpr double kLeastGap = 0.01;
  static constexpr double kLeastSliver = 0.5;  // circumradius in deltas, so that the refinement ends
  using LockGrid = CGAL::Spatial_lock_grid_3<CGAL::Tag_priority_blocking>;

  Attempt attempt(const Job& job, Rule queue, Worker& worker);
  Attempt attempt(const Removal& removal, Worker& worker);
  void give_locks_back();

  [[nodiscard]] Decision decide(Cell cell) const;
  [[nodiscard]] Decision decide_by_ball(Cell cell) const;
  [[nodiscard]] std::optional<Vec3> met_surface(const CellData& cell) const;
  [[nodiscard]] bool is_sampled(Cell cell, const Vec3& place) const;
  [[nodiscard]] Decision split_at_centre(Cell cell) const;
  [[nodiscard]] bool is_in_ball(Cell cell, const Vec3& place) const;
  [[nodiscard]] bool is_bad_facet(Cell cell, int facet) const;
  [[nodiscard]] bool is_large(Cell cell) const;
  [[nodiscard]] bool is_sliver(Cell cell) const;
  [[nodiscard]] Decision decide_by_facet(Cell cell) const;

  bool reserve(const Decision& decision);
  Attempt insert(const Decision& decision, Worker& worker);
  void fill_hole(const Decision& decision, Worker& worker);
  void note_vertex(Vertex vertex, const Decision& decision, Worker& worker);
  void collect_fresh(Worker& worker);
  void register_fresh(Worker& worker);
  void set_data(Cell cell);
  void enqueue(Cell cell, Rule rule, Worker& worker);
  bool take_cavity_around(Vertex vertex, Worker& worker);

  [[nodiscard]] Vec3 point(Cell cell, int i) const { return to_vec3(cell->vertex(i)->point()); }

  const SurfaceOracle& oracle_;
  RefinementOptions options_;
  double facet_cosine_, least_gap_mm_, sample_gap_mm_, dihedral_cosine_;
  Vec3 low_, high_;  // of the virtual box
  std::unique_ptr<LockGrid> locks_;
  Dt dt_;
  mutable std::mutex grids_;
  PointGrid<char> surface_;
  PointGrid<FreeVertex> free_;
  std::uint64_t removals_ = 0;
};

extern template class Refiner<CGAL::Sequential_tag>;
extern template class Refiner<CGAL::Parallel_tag>;

}  // namespace cbc3d::baselines::podm
