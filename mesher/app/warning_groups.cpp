#include "mesher/app/warning_groups.hpp"

#include <cctype>
#include <map>

namespace cbc3d {
namespace {

/// A warning without its numbers.
std::string kind_of(const std::string& warning) {
  std::string kind;
  for (const char c : warning) {
    const bool digit = std::isdigit(static_cast<unsigned char>(c)) != 0;
    if (!digit || kind.empty() || kind.back() != '#') {
      kind += digit ? '#' : c;
    }
  }
  return kind;
}

}  // namespace

std::vector<std::string> grouped_warnings(const std::vector<std::string>& warnings) {
  constexpr std::size_t kFew = 3;
  std::map<std::string, std::size_t> count;
  for (const std::string& warning : warnings) {
    ++count[kind_of(warning)];
  }
  std::vector<std::string> grouped;
  for (const std::string& warning : warnings) {
    std::size_t& left = count[kind_of(warning)];
    if (left == 0) {  // told
      continue;
    }
    if (left <= kFew) {
      grouped.push_back(warning);
      continue;
    }
    grouped.push_back(warning + "; " + std::to_string(left - 1) +
                      " others alike (all of them in the file of --report)");
    left = 0;
  }
  return grouped;
}

}  // namespace cbc3d
