#include "mesher/lattice/select_candidate.hpp"

#include <algorithm>

#include "mesher/core/parallel.hpp"

namespace cbc3d {
namespace {

class Selector {
 public:
  Selector(const TetNeighbours& neighbours, const std::vector<std::uint32_t>& rank,
           std::vector<MaterialId>& materials)
      : neighbours_(neighbours), rank_(rank), materials_(materials) {}

  std::size_t run() {
    fill_notches();
    before_ = materials_;
    listed_.assign(materials_.size(), 0);
    in_pass_.assign(materials_.size(), 0);
    std::vector<TetId> changed = finish_pass(changes_of_all());
    while (!changed.empty()) {
      ++pass_;
      changed = finish_pass(changes_of(tets_to_inspect(changed)));
    }
    return relabelled_;
  }

 private:
  struct Change {
    TetId tet;
    MaterialId wanted;
  };

  std::vector<Change> changes_of_all() const {
    return collect<Change>(before_.size(), 1, [this](std::size_t i, const auto& add) {
      const auto t = static_cast<TetId>(i);
      const MaterialId wanted = wanted_material(t, [this](TetId n) { return before_[n]; });
      if (wanted != before_[t]) {
        add({t, wanted});
      }
    });
  }

  [[nodiscard]] std::vector<Change> changes_of(const std::vector<TetId>& tets) const {
    return collect<Change>(tets.size(), 1, [&](std::size_t i, const auto& add) {
      const MaterialId wanted = wanted_material(tets[i]);
      if (wanted != materials_[tets[i]]) {
        add({tets[i], wanted});
      }
    });
  }

  /// A pass inspects its tets in order, so each sees what those before it have become and what those behind
  /// it were. That outcome is found in parallel: all change by what was, and what comes behind a changed one
  /// is inspected again, until nothing changes. Returns the tets that are other than they were.
  std::vector<TetId> finish_pass(std::vector<Change> changes) {
    std::vector<TetId> ever_changed;
    while (!changes.empty()) {
      for (const Change& change : changes) {
        materials_[change.tet] = change.wanted;
        ever_changed.push_back(change.tet);
      }
      ++list_;
      changes = changes_of(tets_behind(changes));
    }
    std::vector<TetId> changed;
    for (const TetId t : ever_changed) {
      if (before_[t] != materials_[t]) {
        before_[t] = materials_[t];
        changed.push_back(t);
      }
    }
    relabelled_ += changed.size();
    return changed;
  }

  /// Tets of this pass behind those, each once; in any order.
  std::vector<TetId> tets_behind(const std::vector<Change>& changes) {
    return collect<TetId>(changes.size(), 4, [&](std::size_t i, const auto& add) {
      const TetId t = changes[i].tet;
      for (const TetId n : neighbours_[t]) {
        if (n != kNoTet && n > t && in_pass_[n] == pass_ && is_first(listed_[n], list_)) {
          add(n);
        }
      }
    });
  }

  /// A tet that has changed and its neighbours are inspected in the next pass, `pass_`.
  std::vector<TetId> tets_to_inspect(const std::vector<TetId>& changed) {
    return collect<TetId>(changed.size(), 5, [&](std::size_t i, const auto& add) {
      const auto add_once = [&](TetId t) {
        if (t != kNoTet && is_first(in_pass_[t], pass_)) {
          add(t);
        }
      };
      add_once(changed[i]);
      std::for_each(neighbours_[changed[i]].begin(), neighbours_[changed[i]].end(), add_once);
    });
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

  /// What a tet is to be as the pass comes to it.
  [[nodiscard]] MaterialId wanted_material(TetId t) const {
    const std::array<const MaterialId*, 2> now = {before_.data(), materials_.data()};
    return wanted_material(t, [&](TetId n) { return now[n < t ? 1 : 0][n]; });
  }

  /// The material with the most faces towards `t`; in a tie the higher rank.
  template <typename MaterialOf>
  [[nodiscard]] MaterialId wanted_material(TetId t, const MaterialOf& material_of) const {
    const MaterialId own = before_[t];
    std::array<MaterialId, 4> around{};
    for (std::size_t n = 0; n < 4; ++n) {
      const TetId across = neighbours_[t][n];
      around[n] = across == kNoTet ? kBackground : material_of(across);
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

  const TetNeighbours& neighbours_;
  const std::vector<std::uint32_t>& rank_;
  std::vector<MaterialId>& materials_;
  std::vector<MaterialId> before_;      // the pass
  std::vector<std::uint32_t> in_pass_;  // the last pass that inspects a tet
  std::vector<std::uint32_t> listed_;   // the last list of tets behind changed ones that has it
  std::uint32_t pass_ = 0, list_ = 0;
  std::size_t relabelled_ = 0;
};

}  // namespace

std::size_t select_candidate(const TetNeighbours& neighbours, const std::vector<std::uint32_t>& rank,
                             std::vector<MaterialId>& materials) {
  return Selector(neighbours, rank, materials).run();
}

}  // namespace cbc3d
