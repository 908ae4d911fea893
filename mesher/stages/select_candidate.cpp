#include "mesher/stages/select_candidate.hpp"

#include <algorithm>
#include <iterator>

namespace cbc3d {
namespace {

class Selector {
 public:
  Selector(const std::vector<std::array<TetId, 4>>& neighbours, const std::vector<std::uint32_t>& rank,
           std::vector<MaterialId>& materials)
      : neighbours_(neighbours), rank_(rank), materials_(materials) {}

  std::size_t run() {
    fill_notches();
    inspect_all();
    std::vector<TetId> queue;
    while (!next_.empty()) {
      std::sort(next_.begin(), next_.end());
      next_.erase(std::unique(next_.begin(), next_.end()), next_.end());
      queue.swap(next_);
      next_.clear();
      for (const TetId t : queue) {
        inspect(t);
      }
    }
    return relabelled_;
  }

 private:
  /// Inspects all tets in order. In parallel those are found before that have reason to change as things are;
  /// of the others only those are looked at of which a neighbour has changed meanwhile.
  void inspect_all() {
    std::vector<std::uint8_t> open(materials_.size());
#pragma omp parallel for schedule(static)
    for (std::size_t t = 0; t < open.size(); ++t) {
      open[t] = wanted_material(static_cast<TetId>(t)) != materials_[t] ? 1 : 0;
    }
    for (std::size_t t = 0; t < open.size(); ++t) {
      if (open[t] != 0 && inspect(static_cast<TetId>(t))) {
        for (const TetId n : neighbours_[t]) {
          if (n != kNoTet) {
            open[n] = 1;
          }
        }
      }
    }
  }

  /// Gives a tet the material it is to have; true when that is another one, and then it and its neighbours
  /// are to be inspected again.
  bool inspect(TetId t) {
    const MaterialId wanted = wanted_material(t);
    if (wanted == materials_[t]) {
      return false;
    }
    materials_[t] = wanted;
    ++relabelled_;
    next_.push_back(t);
    std::copy_if(neighbours_[t].begin(), neighbours_[t].end(), std::back_inserter(next_),
                 [](TetId n) { return n != kNoTet; });
    return true;
  }

  /// Background is inspected first, as in the paper, where no label is final yet: a background tet with two
  /// or more labelled neighbours goes to one of them. Without this step the rule for labelled tets would only
  /// ever remove. All are judged by the labels as they were before, so the outcome does not depend on the
  /// order.
  void fill_notches() {
    const std::vector<MaterialId> before = materials_;
#pragma omp parallel for schedule(static, 4096)
    for (std::size_t t = 0; t < before.size(); ++t) {
      if (before[t] != kBackground) {
        continue;
      }
      std::array<MaterialId, 4> around{};
      for (std::size_t n = 0; n < 4; ++n) {
        around[n] = neighbours_[t][n] == kNoTet ? kBackground : before[neighbours_[t][n]];
      }
      if (std::count(around.begin(), around.end(), kBackground) > 2) {
        continue;
      }
      MaterialId best = kBackground;
      std::ptrdiff_t best_faces = 0;
      for (const MaterialId m : around) {
        const auto faces = std::count(around.begin(), around.end(), m);
        if (m != kBackground && (faces > best_faces || (faces == best_faces && rank_[m] > rank_[best]))) {
          best = m;
          best_faces = faces;
        }
      }
      materials_[t] = best;
    }
  }

  [[nodiscard]] MaterialId material_across(TetId neighbour) const {
    return neighbour == kNoTet ? kBackground : materials_[neighbour];
  }

  /// The material with the most faces towards `t`; in a tie the higher rank.
  [[nodiscard]] MaterialId wanted_material(TetId t) const {
    const MaterialId own = materials_[t];
    std::array<MaterialId, 4> around{};
    for (std::size_t n = 0; n < 4; ++n) {
      around[n] = material_across(neighbours_[t][n]);
    }
    if (std::all_of(around.begin(), around.end(), [own](MaterialId m) { return m == own; })) {
      return own;  // as most
    }
    const auto faces = [&around](MaterialId m) { return std::count(around.begin(), around.end(), m); };
    if (own != kBackground && faces(kBackground) >= 2) {
      return kBackground;
    }
    MaterialId best = own;
    auto best_faces = faces(own);
    for (const MaterialId candidate : around) {
      const auto of_candidate = faces(candidate);
      const bool tie_won = of_candidate == best_faces && of_candidate >= 2 && rank_[candidate] > rank_[best];
      if (of_candidate > best_faces || tie_won) {
        best = candidate;
        best_faces = of_candidate;
      }
    }
    return best;
  }

  const std::vector<std::array<TetId, 4>>& neighbours_;
  const std::vector<std::uint32_t>& rank_;
  std::vector<MaterialId>& materials_;
  std::vector<TetId> next_;
  std::size_t relabelled_ = 0;
};

}  // namespace

std::size_t select_candidate(const std::vector<std::array<TetId, 4>>& neighbours,
                             const std::vector<std::uint32_t>& rank, std::vector<MaterialId>& materials) {
  return Selector(neighbours, rank, materials).run();
}

}  // namespace cbc3d
