// What tables are made of.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "cases/core/case.hpp"
#include "reports/results/job_result.hpp"
#include "reports/tables/table.hpp"

namespace cbc3d::reports {

/// A run. What the references name must outlive this.
struct TableInput {
  const std::vector<JobResult>& results;
  const std::vector<cases::Case>& cases;  ///< they give images and published figures
  std::filesystem::path folder = {};      ///< of the run; empty: only the results are known
};

/// Makes one table; a table without rows is one that the run has nothing for.
using TableBuilder = std::function<Table(const TableInput& input)>;

/// The case of that name; null when there is none.
const cases::Case* find_case(const std::vector<cases::Case>& cases, const std::string& name);

}  // namespace cbc3d::reports
