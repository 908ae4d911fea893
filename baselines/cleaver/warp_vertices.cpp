#include "baselines/cleaver/warp_vertices.hpp"

#include <algorithm>

#include "baselines/cleaver/tet_angles.hpp"
#include "mesher/core/parallel.hpp"

namespace cbc3d::baselines::cleaver {
namespace {

// The cuts of each vertex.
struct VertexCuts {
  std::vector<std::uint32_t> begin;
  std::vector<std::uint32_t> cuts;
};

VertexCuts cuts_of_vertices(const CutLattice& cut) {
  VertexCuts of;
  of.begin.assign(cut.lattice.points.size() + 1, 0);
  for (const Cut& c : cut.cuts) {
    ++of.begin[c.first + 1];
    ++of.begin[c.second + 1];
  }
  for (std::size_t v = 1; v < of.begin.size(); ++v) of.begin[v] += of.begin[v - 1];
  of.cuts.resize(of.begin.back());
  std::vector<std::uint32_t> next(of.begin.begin(), of.begin.end() - 1);
  for (std::size_t c = 0; c < cut.cuts.size(); ++c) {
    of.cuts[next[cut.cuts[c].first]++] = static_cast<std::uint32_t>(c);
    of.cuts[next[cut.cuts[c].second]++] = static_cast<std::uint32_t>(c);
  }
  return of;
}

bool violates(const Cut& cut, VertexId v) {
  if (cut.place != CutPlace::kWithin) return false;
  return v == cut.first ? cut.fraction <= cut.alpha_first : 1 - cut.fraction <= cut.alpha_second;
}

class Warp {
 public:
  explicit Warp(CutLattice& cut) : cut_(cut), of_(cuts_of_vertices(cut)), start_(cut.lattice.points) {}

  // Decides for each vertex where it goes and which cuts it takes, by the places of all cuts before any
  // moved.
  void snap() {
    for (VertexId v = 0; v < start_.size(); ++v) {
      if (of_.begin[v] != of_.begin[v + 1]) snap_to(v);
    }
  }

  void keep_tets_good() {
    for (int round = 0; round < kRounds; ++round) {
      const std::vector<std::uint32_t> bad = indices_where(cut_.lattice.tets.size(), [&](std::size_t t) {
        const auto& n = cut_.lattice.tets[t];
        const bool touched = std::any_of(n.begin(), n.end(), [&](VertexId v) { return has_moved(v); });
        return touched && !has_angles_within(corners_of(n), kLeastAngleDeg, kMostAngleDeg);
      });
      if (bad.empty()) return;
      draw_back(bad, round + 1 == kRounds);
    }
  }

  // A vertex that had to stay beyond the image's box gives its cuts back, for they are on the box.
  void release_cuts_outside(const Indicators& indicators) {
    const auto is_outside = [&](VertexId v) { return indicators.is_outside(cut_.lattice.points[v]); };
    for (Cut& cut : cut_.cuts) {
      const bool outside = (cut.place == CutPlace::kAtFirst && is_outside(cut.first)) ||
                           (cut.place == CutPlace::kAtSecond && is_outside(cut.second));
      if (outside) cut.place = CutPlace::kWithin;
    }
  }

  void find_cuts_again(const Indicators& indicators) {
#pragma omp parallel for schedule(dynamic, 512)
    for (std::size_t c = 0; c < cut_.cuts.size(); ++c) {
      Cut& cut = cut_.cuts[c];
      if (cut.place == CutPlace::kWithin && (has_moved(cut.first) || has_moved(cut.second)))
        find_again(cut, indicators);
    }
  }

 private:
  static constexpr int kRounds = 8;
  static constexpr float kLeastFraction = 0.02F;

  [[nodiscard]] bool has_moved(VertexId v) const {
    return cut_.lattice.points[v] != start_[v];
  }
  [[nodiscard]] std::array<Vec3, 4> corners_of(const std::array<VertexId, 4>& nodes) const {
    const auto& p = cut_.lattice.points;
    return {p[nodes[0]], p[nodes[1]], p[nodes[2]], p[nodes[3]]};
  }
  [[nodiscard]] MaterialId material_across(const Cut& cut, VertexId v) const {
    return cut_.materials[v == cut.first ? cut.second : cut.first];
  }

  void snap_to(VertexId v) {
    Vec3 sum{};
    int count = 0;
    across_.clear();
    for (std::uint32_t n = of_.begin[v]; n < of_.begin[v + 1]; ++n) {
      const Cut& cut = cut_.cuts[of_.cuts[n]];
      if (!violates(cut, v)) continue;
      sum += start_[cut.first] + (start_[cut.second] - start_[cut.first]) * static_cast<double>(cut.fraction);
      ++count;
      across_.push_back(material_across(cut, v));
    }
    if (count == 0) return;
    cut_.lattice.points[v] = sum / count;
    for (std::uint32_t n = of_.begin[v]; n < of_.begin[v + 1]; ++n) {
      Cut& cut = cut_.cuts[of_.cuts[n]];
      const bool same_pair =
          std::find(across_.begin(), across_.end(), material_across(cut, v)) != across_.end();
      if (cut.place == CutPlace::kWithin && same_pair)
        cut.place = v == cut.first ? CutPlace::kAtFirst : CutPlace::kAtSecond;
    }
  }

  void draw_back(const std::vector<std::uint32_t>& bad, bool all_the_way) {
    std::vector<VertexId> vertices;
    for (const std::uint32_t t : bad) {
      for (const VertexId v : cut_.lattice.tets[t]) {
        if (has_moved(v)) vertices.push_back(v);
      }
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    for (const VertexId v : vertices) {
      Vec3& place = cut_.lattice.points[v];
      place = all_the_way ? start_[v] : (place + start_[v]) / 2;
    }
  }

  // A cut that has come too near to an end goes to it or stays at its alpha, whichever is nearer.
  void find_again(Cut& cut, const Indicators& indicators) const {
    const auto& p = cut_.lattice.points;
    const auto t = static_cast<float>(indicators.crossing(
        p[cut.first], p[cut.second], cut_.materials[cut.first], cut_.materials[cut.second]));
    cut.fraction = std::clamp(t, cut.alpha_first, 1 - cut.alpha_second);
    // What is beyond the image's box stays out of the mesh, and the sides of the mesh on the box.
    const bool leaves_box = indicators.is_outside(p[cut.second]),
               enters_box = indicators.is_outside(p[cut.first]);
    if (leaves_box || enters_box) cut.fraction = std::clamp(t, kLeastFraction, 1 - kLeastFraction);
    if (t < cut.alpha_first / 2 && !enters_box) cut.place = CutPlace::kAtFirst;
    if (1 - t < cut.alpha_second / 2 && !leaves_box) cut.place = CutPlace::kAtSecond;
  }

  CutLattice& cut_;
  VertexCuts of_;
  std::vector<Vec3> start_;
  std::vector<MaterialId> across_;
};

}  // namespace

void warp_vertices(CutLattice& cut, const Indicators& indicators) {
  Warp warp(cut);
  warp.snap();
  warp.keep_tets_good();
  warp.release_cuts_outside(indicators);
  warp.find_cuts_again(indicators);
}

}  // namespace cbc3d::baselines::cleaver
