#include "reports/results/columns.hpp"

#include <algorithm>

#include "reports/results/format_number.hpp"

namespace cbc3d::reports {
namespace {

template <class Value>
void add_new(std::vector<Value>& values, const Value& value) {
  if (std::find(values.begin(), values.end(), value) == values.end()) {
    values.push_back(value);
  }
}

}  // namespace

Columns::Columns(const std::vector<JobResult>& results) : results_(results) {
  for (const JobResult& result : results) {
    auto entry = std::find_if(threads_.begin(), threads_.end(),
                              [&](const auto& e) { return e.first == result.mesher; });
    if (entry == threads_.end()) {
      entry = threads_.insert(threads_.end(), {result.mesher, {}});
    }
    add_new(entry->second, result.threads);
  }
  for (const JobResult& result : results) {
    add_new(names_, name_of(result));
  }
}

std::string Columns::name_of(const JobResult& result) const {
  const auto entry =
      std::find_if(threads_.begin(), threads_.end(), [&](const auto& e) { return e.first == result.mesher; });
  return entry->second.size() == 1 ? result.mesher
                                   : result.mesher + " (" + std::to_string(result.threads) +
                                         (result.threads == 1 ? " thread)" : " threads)");
}

Runs Columns::runs(const std::string& case_name, const std::string& column) const {
  Runs runs;
  for (const JobResult& result : results_) {
    if (row_name(result) == case_name && name_of(result) == column) {
      runs.push_back(&result);
    }
  }
  return runs;
}

std::string row_name(const JobResult& result) {
  return result.budget
             ? result.case_name + ", " + format_number(static_cast<double>(*result.budget), 0) + " elements"
             : result.case_name;
}

std::vector<std::string> case_names(const std::vector<JobResult>& results) {
  std::vector<std::string> names;
  for (const JobResult& result : results) {
    add_new(names, row_name(result));
  }
  return names;
}

std::vector<std::string> image_names(const std::vector<JobResult>& results) {
  std::vector<std::string> names;
  for (const JobResult& result : results) {
    add_new(names, result.case_name);
  }
  return names;
}

}  // namespace cbc3d::reports
