#include "reports/results/columns.hpp"

#include <algorithm>

namespace cbc3d::reports {

Columns::Columns(const std::vector<Json>& results) : results_(results) {
  for (const Json& result : results) {
    const std::string mesher = result.value("mesher", "");
    const int threads = result.value("threads", 1);
    auto entry =
        std::find_if(threads_.begin(), threads_.end(), [&](const auto& e) { return e.first == mesher; });
    if (entry == threads_.end()) {
      entry = threads_.insert(threads_.end(), {mesher, {}});
    }
    if (std::find(entry->second.begin(), entry->second.end(), threads) == entry->second.end()) {
      entry->second.push_back(threads);
    }
  }
  for (const Json& result : results) {
    const std::string name = name_of(result);
    if (std::find(names_.begin(), names_.end(), name) == names_.end()) {
      names_.push_back(name);
    }
  }
}

std::string Columns::name_of(const Json& result) const {
  const std::string mesher = result.value("mesher", "");
  const int threads = result.value("threads", 1);
  const auto entry =
      std::find_if(threads_.begin(), threads_.end(), [&](const auto& e) { return e.first == mesher; });
  return entry->second.size() == 1
             ? mesher
             : mesher + " (" + std::to_string(threads) + (threads == 1 ? " thread)" : " threads)");
}

std::vector<const Json*> Columns::runs(const std::string& case_name, const std::string& column) const {
  std::vector<const Json*> runs;
  for (const Json& result : results_) {
    if (result.value("case", "") == case_name && name_of(result) == column) {
      runs.push_back(&result);
    }
  }
  return runs;
}

std::vector<std::string> case_names(const std::vector<Json>& results) {
  std::vector<std::string> names;
  for (const Json& result : results) {
    if (std::find(names.begin(), names.end(), result.value("case", "")) == names.end()) {
      names.push_back(result.value("case", ""));
    }
  }
  return names;
}

}  // namespace cbc3d::reports
