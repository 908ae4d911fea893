// The search for the value of a mesher's size dial that gives a wanted number of elements.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "baselines/core/size_dial.hpp"

namespace cbc3d::reports {

/// A run of the mesher with the dial at a value.
struct DialTry {
  double value = 0;
  double elements = 0;  ///< of the mesh; 0: there was none
  std::string failure;  ///< why there was none

  [[nodiscard]] bool has_mesh() const { return elements > 0; }
};

/// By how much the number of elements may miss the budget, as a share of it.
inline constexpr double kBudgetTolerance = 0.1;
/// Runs of the mesher that one search makes at most.
inline constexpr int kMostTries = 6;

/// The state of a search. With e elements at the value v it looks for log e(v) = log budget: by a secant step
/// between the two nearest tries around the budget, else by a step from the nearest one with the power law of
/// the dial or, where two tries measure it, of the mesher. The number of elements need not be monotone in the
/// value. Same tries, same search.
class DialSearch {
 public:
  /// `known`: tries of earlier searches with the same image, mesher and other parameters. They do not count
  /// among the tries of this one.
  DialSearch(baselines::SizeDial dial, double budget, std::vector<DialTry> known = {});

  /// The value to try next; none: the search is over.
  [[nodiscard]] std::optional<double> next() const;
  void add(DialTry one);

  /// The try nearest to the budget; null: none gave a mesh.
  [[nodiscard]] const DialTry* best() const;
  [[nodiscard]] bool is_met() const;
  /// Why the budget is not met, in words; empty when it is.
  [[nodiscard]] std::string reason() const;
  /// All tries, the known ones first.
  [[nodiscard]] const std::vector<DialTry>& tries() const { return tries_; }

 private:
  struct Bracket {
    const DialTry *finer, *coarser;  ///< with more and with fewer elements than the budget
  };
  [[nodiscard]] std::vector<const DialTry*> good_by_value() const;
  [[nodiscard]] std::optional<Bracket> bracket() const;
  [[nodiscard]] double within(const Bracket& around) const;
  [[nodiscard]] double beyond(const DialTry& nearest) const;
  [[nodiscard]] double without_mesh() const;
  [[nodiscard]] double measured_exponent() const;
  [[nodiscard]] bool is_flat() const;
  [[nodiscard]] double rounded(double value) const;
  [[nodiscard]] bool was_tried(double value) const;

  baselines::SizeDial dial_;
  double budget_;
  std::vector<DialTry> tries_;
  std::size_t known_count_;
};

}  // namespace cbc3d::reports
