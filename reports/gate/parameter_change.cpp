#include "reports/gate/parameter_change.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace cbc3d::reports {
namespace {

std::string value_text(const Json& object, const std::string& key) {
  if (!object.contains(key)) {
    return "not given";
  }
  return object[key].is_string() ? object[key].get<std::string>() : object[key].dump();
}

void append(std::string& text, const std::string& more) {
  text += (text.empty() ? "" : "; ") + more;
}

}  // namespace

std::string changes_of(const Json& were, const Json& are) {
  std::set<std::string> keys;
  for (const Json* object : {&were, &are}) {
    for (const auto& [key, value] : object->items()) {
      keys.insert(key);
    }
  }
  std::string text;
  for (const std::string& key : keys) {
    if (value_text(were, key) != value_text(are, key)) {
      append(text, "parameter " + key + " was " + value_text(were, key) + ", is " + value_text(are, key));
    }
  }
  return text;
}

std::string cost_of_change(std::vector<Check> checks) {
  std::stable_sort(checks.begin(), checks.end(), [](const Check& a, const Check& b) {
    const bool a_is_time = a.figure == "time_ratio", b_is_time = b.figure == "time_ratio";
    return a_is_time != b_is_time ? a_is_time : std::abs(a.severity) > std::abs(b.severity);
  });
  std::string cost, gain;
  for (const Check& check : checks) {
    if (check.figure == "time_ratio" || check.fell) {
      append(check.better ? gain : cost, check.text);
    } else if (check.better) {
      append(gain, check.text);
    }
  }
  return "It cost: " + (cost.empty() ? "nothing beyond the tolerances" : cost) +
         (gain.empty() ? "" : "; it gained: " + gain);
}

}  // namespace cbc3d::reports
