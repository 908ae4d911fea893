// Results put in columns: one per mesher, or per mesher and thread count.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "reports/results/job_result.hpp"

namespace cbc3d::reports {

/// Meshers by name in the order of their first lines, with "(N threads)" for those that ran with several
/// counts.
class Columns {
 public:
  /// `results` must outlive this.
  explicit Columns(const std::vector<JobResult>& results);
  [[nodiscard]] std::string name_of(const JobResult& result) const;
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }
  /// The results of a case, by its row name, in a column.
  [[nodiscard]] Runs runs(const std::string& case_name, const std::string& column) const;

 private:
  const std::vector<JobResult>& results_;
  std::vector<std::pair<std::string, std::vector<int>>> threads_;
  std::vector<std::string> names_;
};

/// What a result's case is called in tables: its name, with a budget "liver, 25,000 elements", for results of
/// different budgets are not repeats of each other.
std::string row_name(const JobResult& result);

/// Row names in the order of their first lines.
std::vector<std::string> case_names(const std::vector<JobResult>& results);

/// Cases in the order of their first lines, whatever the budgets.
std::vector<std::string> image_names(const std::vector<JobResult>& results);

}  // namespace cbc3d::reports
