#include "reports/interfaces/python/keyword_names.hpp"

#include <algorithm>
#include <regex>
#include <utility>
#include <vector>

#include "mesher/input/input_options.hpp"
#include "mesher/pipeline/option_table.hpp"

namespace cbc3d::python {
namespace {

using Replacement = std::pair<std::regex, std::string>;

/// Names of one word are left alone, for they are ordinary words too.
std::vector<Replacement> replacements() {
  std::vector<Replacement> all = {{std::regex("\\bmanifold_voxels off\\b"), "no_manifold_voxels=True"},
                                  {std::regex("\\bmax_deviation_mm\\b"), "max_deviation"}};
  for (const InputOption& option : input_options()) {
    const bool is_word = option.name.find('-') == std::string::npos;
    all.emplace_back(std::regex((is_word ? "--" : "(--)?\\b") + option.name + "\\b"),
                     keyword_of(option.name));
  }
  for (const OptionRow& row : option_table()) {
    const std::string keyword = keyword_of(row.name);
    if (keyword != row.name) {
      all.emplace_back(std::regex("\\b(" + row.name + "|" + keyword + "(_mm|_deg)?)\\b"), keyword);
    }
  }
  return all;
}

}  // namespace

std::string keyword_of(std::string name) {
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

std::string with_keywords(std::string text) {
  static const std::vector<Replacement> kAll = replacements();
  for (const auto& [name, keyword] : kAll) {
    text = std::regex_replace(text, name, keyword);
  }
  return text;
}

}  // namespace cbc3d::python
