#include "reports/run/dial_search.hpp"

#include <algorithm>
#include <cmath>

#include "reports/results/format_number.hpp"

namespace cbc3d::reports {
namespace {

/// A step changes the value by this factor at most.
constexpr double kLongestStep = 8;
/// Tries whose values differ by this factor and whose elements by less than the tolerance show that the image
/// bounds the number of elements.
constexpr double kFlatStep = 1.9;

double miss(const DialTry& one, double budget) {
  return std::abs(std::log(one.elements / budget));
}

}  // namespace

DialSearch::DialSearch(baselines::SizeDial dial, double budget, std::vector<DialTry> known)
    : dial_(std::move(dial)), budget_(budget), tries_(std::move(known)), known_count_(tries_.size()) {}

void DialSearch::add(DialTry one) {
  tries_.push_back(std::move(one));
}

const DialTry* DialSearch::best() const {
  const DialTry* nearest = nullptr;
  for (const DialTry& one : tries_) {
    const bool is_nearer =
        one.has_mesh() && (nearest == nullptr || miss(one, budget_) < miss(*nearest, budget_));
    if (is_nearer) {
      nearest = &one;
    }
  }
  return nearest;
}

bool DialSearch::is_met() const {
  const DialTry* nearest = best();
  return nearest != nullptr && std::abs(nearest->elements - budget_) <= kBudgetTolerance * budget_;
}

std::optional<double> DialSearch::next() const {
  const bool has_tries_left = tries_.size() < known_count_ + kMostTries;
  if (is_met() || !has_tries_left) {
    return std::nullopt;
  }
  // What was found for other budgets says little of a number that the mesher takes as it is.
  if (dial_.counts_elements && !was_tried(rounded(budget_))) {
    return rounded(budget_);
  }
  const DialTry* nearest = best();
  const auto around = bracket();
  if (!around && nearest != nullptr && is_flat()) {
    return std::nullopt;
  }
  const double value = rounded(around               ? within(*around)
                               : nearest != nullptr ? beyond(*nearest)
                                                    : without_mesh());
  return was_tried(value) ? std::nullopt : std::optional(value);
}

std::vector<const DialTry*> DialSearch::good_by_value() const {
  std::vector<const DialTry*> good;
  for (const DialTry& one : tries_) {
    if (one.has_mesh()) {
      good.push_back(&one);
    }
  }
  std::stable_sort(good.begin(), good.end(),
                   [](const DialTry* a, const DialTry* b) { return a->value < b->value; });
  return good;
}

/// Neighbours in value on both sides of the budget; of several the pair whose elements are nearest to it.
std::optional<DialSearch::Bracket> DialSearch::bracket() const {
  const std::vector<const DialTry*> good = good_by_value();
  std::optional<Bracket> best;
  double least_miss = 0;
  for (std::size_t n = 1; n < good.size(); ++n) {
    const auto [finer, coarser] = good[n - 1]->elements > good[n]->elements ? std::pair(good[n - 1], good[n])
                                                                            : std::pair(good[n], good[n - 1]);
    const double both = miss(*finer, budget_) + miss(*coarser, budget_);
    if (finer->elements > budget_ && coarser->elements < budget_ && (!best || both < least_miss)) {
      best = Bracket{finer, coarser};
      least_miss = both;
    }
  }
  return best;
}

/// Between the two in log-log, not too near to either end, so that the bracket shrinks.
double DialSearch::within(const Bracket& around) const {
  constexpr double kNearest = 0.15;
  const double from = std::log(around.finer->value), to = std::log(around.coarser->value);
  const double all = std::log(around.finer->elements / around.coarser->elements);
  const double share = std::log(around.finer->elements / budget_) / all;
  return std::exp(from + std::clamp(share, kNearest, 1 - kNearest) * (to - from));
}

double DialSearch::beyond(const DialTry& nearest) const {
  const double factor = std::pow(budget_ / nearest.elements, 1 / measured_exponent());
  double value = nearest.value * std::clamp(factor, 1 / kLongestStep, kLongestStep);
  // A try without a mesh on the way is a wall: the search goes half of the way to it. Values are rounded, so
  // that one at the wall may seem to lie before it.
  constexpr double kRounding = 1e-3;
  for (const DialTry& one : tries_) {
    const double behind = std::log(value / one.value), before = std::log(nearest.value / one.value);
    if (!one.has_mesh() && behind * (before > 0 ? 1 : -1) < kRounding) {
      value = std::sqrt(nearest.value * one.value);
    }
  }
  return value;
}

/// The first try; after failures, coarser ones, for large meshes fail by time and memory.
double DialSearch::without_mesh() const {
  if (tries_.empty()) {
    return dial_.first;
  }
  constexpr double kFewer = 4;
  return tries_.back().value * std::pow(kFewer, -1 / dial_.exponent);
}

/// The power law of the two tries nearest to the budget, as long as it is something like the dial's.
double DialSearch::measured_exponent() const {
  std::vector<const DialTry*> good = good_by_value();
  std::stable_sort(good.begin(), good.end(), [this](const DialTry* a, const DialTry* b) {
    return miss(*a, budget_) < miss(*b, budget_);
  });
  if (good.size() < 2 || good[0]->value == good[1]->value) {
    return dial_.exponent;
  }
  const double measured =
      std::log(good[0]->elements / good[1]->elements) / std::log(good[0]->value / good[1]->value);
  const double ratio = measured / dial_.exponent;
  constexpr double kFlattest = 0.25, kSteepest = 3;
  return dial_.exponent * (ratio > 0 ? std::clamp(ratio, kFlattest, kSteepest) : kFlattest);
}

/// True when the last step towards the budget changed nothing. The steps of earlier searches, whose budgets
/// were others, may have ended on a floor that this one leaves.
bool DialSearch::is_flat() const {
  const std::vector<const DialTry*> good = good_by_value();
  if (good.size() < 2 || tries_.size() == known_count_) {
    return false;
  }
  const bool too_many = best()->elements > budget_;
  const bool at_high_end = too_many == (dial_.exponent < 0);
  const DialTry& last = at_high_end ? *good.back() : *good.front();
  return std::any_of(good.begin(), good.end(), [&](const DialTry* one) {
    const double step = std::abs(std::log(one->value / last.value));
    const double change = std::abs(std::log(one->elements / last.elements));
    return step > std::log(kFlatStep) && change < kBudgetTolerance * step;
  });
}

double DialSearch::rounded(double value) const {
  return std::stod(dial_text(dial_, std::clamp(value, dial_.lowest, dial_.highest)));
}

bool DialSearch::was_tried(double value) const {
  return std::any_of(tries_.begin(), tries_.end(), [&](const DialTry& one) { return one.value == value; });
}

std::string DialSearch::reason() const {
  const DialTry* nearest = best();
  if (is_met()) {
    return "";
  }
  if (nearest == nullptr) {
    return tries_.empty() ? "nothing was tried" : tries_.back().failure;
  }
  const auto at = [&](const DialTry& one) {
    return format_number(one.elements, 0) + " elements at " + dial_.parameter + "=" +
           dial_text(dial_, one.value);
  };
  if (const auto around = bracket()) {
    return "the number jumps from " + at(*around->coarser) + " to " + at(*around->finer);
  }
  const bool too_many = nearest->elements > budget_;
  const auto failed =
      std::find_if(tries_.begin(), tries_.end(), [](const DialTry& one) { return !one.has_mesh(); });
  return std::string(too_many ? "no fewer than " : "no more than ") + at(*nearest) +
         (failed == tries_.end()
              ? ""
              : "; at " + dial_.parameter + "=" + dial_text(dial_, failed->value) + ": " + failed->failure);
}

}  // namespace cbc3d::reports
