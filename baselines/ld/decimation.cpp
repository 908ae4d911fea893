#include "baselines/ld/decimation.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace cbc3d::baselines::ld {
namespace {

class Decimation {
 public:
  Decimation(LatticeMesh mesh, const CellGrid& grid, const DecimationOptions& options)
      : options_(options),
        mesh_(std::move(mesh)),
        star_(grid.cell_mm() * 0.5),
        is_queued_(mesh_.vertex_count(), 0) {
    if (!options.keeps_surfaces()) distances_.emplace(grid, mesh_, options.distances);
  }

  void run() {
    if (options_.first_min_dihedral_deg > options_.min_dihedral_deg) {
      run_pass(options_.first_min_dihedral_deg, false);
    }
    run_pass(options_.min_dihedral_deg, true);
  }

  LatticeMesh release() { return mesh_.release(); }

 private:
  void run_pass(double min_dihedral_deg, bool is_last) {
    bounds_ = DihedralBounds(min_dihedral_deg, options_.max_dihedral_deg);
    for (VertexId v = 0; v < mesh_.vertex_count(); ++v) {
      if (mesh_.is_alive(v) && mesh_.state(v).is_open) enqueue(v);
    }
    while (!next_.empty()) {
      std::swap(now_, next_);
      for (const VertexId v : now_) {
        is_queued_[v] = 0;
        if (!mesh_.is_alive(v) || merge_away(v)) continue;
        if (is_last) mesh_.state(v).is_open = false;
      }
      now_.clear();
    }
  }

  void enqueue(VertexId v) {
    VertexState& state = mesh_.state(v);
    state.is_open = true;
    if (state.is_frozen || is_queued_[v] != 0) return;
    is_queued_[v] = 1;
    next_.push_back(v);
  }

  [[nodiscard]] bool can_move(const VertexState& state) const {
    constexpr std::uint8_t kAllAxes = 7;
    if (state.stratum == Stratum::point) return false;
    return distances_ || state.normal_axes != kAllAxes;
  }

  // Merges v into the first of its neighbours that all guards accept.
  bool merge_away(VertexId v) {
    const VertexState state = mesh_.state(v);
    if (!can_move(state)) return false;
    star_.gather(mesh_, v);
    const bool is_on_interface = state.stratum != Stratum::volume;
    if (is_on_interface) {
      fan_of_v_.gather(mesh_, v);
      if (distances_) distances_->gather(v, fan_of_v_);
    }
    for (const VertexId w : star_.neighbours()) {
      if (is_on_interface && !may_slide(v, w, state)) continue;
      if (!star_.accepts(mesh_, w, bounds_)) continue;
      if (is_on_interface && !keeps_surfaces(state.stratum, w)) continue;
      merge(v, w, is_on_interface);
      return true;
    }
    return false;
  }

  // The quick questions about a merge of a vertex of an interface.
  [[nodiscard]] bool may_slide(VertexId v, VertexId w, const VertexState& state) const {
    if (!distances_) {
      for (std::size_t a = 0; a < 3; ++a) {
        if ((state.normal_axes >> a & 1) != 0 && mesh_.point(v)[a] != mesh_.point(w)[a]) return false;
      }
    }
    return std::binary_search(fan_of_v_.vertices().begin(), fan_of_v_.vertices().end(), w);
  }

  bool keeps_surfaces(Stratum stratum, VertexId w) {
    fan_of_w_.gather(mesh_, w);
    return keeps_topology(stratum, fan_of_v_, w, fan_of_w_) && (!distances_ || distances_->accepts(w));
  }

  void merge(VertexId v, VertexId w, bool is_on_interface) {
    if (distances_ && is_on_interface) distances_->merge();
    mesh_.merge(v, w);
    for (const VertexId around : star_.neighbours()) enqueue(around);
  }

  DecimationOptions options_;
  MergeMesh mesh_;
  std::optional<DistanceGuard> distances_;
  DihedralBounds bounds_{0, 180};
  Star star_;
  Fan fan_of_v_, fan_of_w_;
  std::vector<std::uint8_t> is_queued_;
  std::vector<VertexId> now_, next_;
};

}  // namespace

LatticeMesh decimated(LatticeMesh mesh, const CellGrid& grid, const DecimationOptions& options) {
  Decimation decimation(std::move(mesh), grid, options);
  decimation.run();
  return decimation.release();
}

}  // namespace cbc3d::baselines::ld
