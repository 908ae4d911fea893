// Figures of result lines as rows and cells of tables.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "reports/tables/table.hpp"

namespace cbc3d::reports {

/// A figure of a result line; nothing when the line has it not.
using FigureOf = std::function<std::optional<double>(const Json& result)>;

/// A row of a table for every case.
struct Measure {
  std::string name;  ///< with its unit
  int decimals;
  std::string paper_key;  ///< of the case's paper figures; empty: the paper has none
  FigureOf figure;
};

/// The number at a path such as {"fidelity", "hausdorff_mm"}, times a factor.
FigureOf at(std::vector<std::string> path, double factor = 1);

/// Elements of all kinds; none where the line has no counts.
std::optional<double> element_count(const Json& result);

/// The text under a key; empty when there is none.
std::string text_of(const Json& result, const char* key);

/// The median of a figure over `runs`, the lines of one case and column, with their range, or why there is
/// none.
Cell cell_of(const std::vector<const Json*>& runs, const Measure& measure);

}  // namespace cbc3d::reports
