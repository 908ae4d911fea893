// Results put in columns: a mesher each, or a mesher with a thread count.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "reports/results/result.hpp"

namespace cbc3d::reports {

/// Meshers by name in the order of their first lines, with "(N threads)" for those that ran with several
/// counts.
class Columns {
 public:
  /// `results` must outlive this.
  explicit Columns(const std::vector<Json>& results);
  [[nodiscard]] std::string name_of(const Json& result) const;
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  /// The result lines of a case in a column.
  [[nodiscard]] std::vector<const Json*> runs(const std::string& case_name, const std::string& column) const;

 private:
  const std::vector<Json>& results_;
  std::vector<std::pair<std::string, std::vector<int>>> threads_;
  std::vector<std::string> names_;
};

/// Cases in the order of their first lines.
std::vector<std::string> case_names(const std::vector<Json>& results);

}  // namespace cbc3d::reports
