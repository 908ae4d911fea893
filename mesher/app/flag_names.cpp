#include "mesher/app/flag_names.hpp"

#include <algorithm>
#include <cctype>
#include <utility>
#include <vector>

#include "mesher/input/input_options.hpp"
#include "mesher/pipeline/option_table.hpp"

namespace cbc3d {
namespace {

using Replacement = std::pair<std::string, std::string>;

/// What is no option's name: two ordinary words, switches that are named by their effect, and options of
/// `segment` and of `improve`.
const std::vector<Replacement> kPhrases = {{"manifold_voxels off", "--no-manifold-voxels"},
                                           {"connectivity vertex", "--connectivity vertex"},
                                           {"edge_gradient and contrast", "--edge-gradient and --contrast"},
                                           {"max_deviation_mm", "--max-deviation"},
                                           {"a larger work_limit_s, or 0,", "--long-work"},
                                           {"label_array", "--label-array"}};

/// The fields of the options: their names with underscores, with a unit or without. Names of one word are
/// left alone, for they are ordinary words too.
std::vector<Replacement> replacements() {
  std::vector<Replacement> all = kPhrases;
  for (const InputOption& option : input_options()) {
    if (!option.parameter.empty()) {
      all.emplace_back(option.parameter,
                       "--" + option.name + (option.symbol.empty() ? "" : " " + option.symbol));
    }
  }
  for (const OptionRow& row : option_table()) {
    std::string field(row.name);
    std::replace(field.begin(), field.end(), '-', '_');
    if (field.find('_') != std::string::npos) {
      for (const char* unit : {"", "_mm", "_deg"}) {
        all.emplace_back(field + unit, "--" + std::string(row.name));
      }
    }
  }
  return all;
}

bool is_word_character(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-' || c == '/' || c == '.' ||
         c == '\'';
}

bool is_word(const std::string& text, std::size_t begin, std::size_t length) {
  const bool starts = begin == 0 || !is_word_character(text[begin - 1]);
  const std::size_t end = begin + length;
  return starts && (end == text.size() || !is_word_character(text[end]));
}

}  // namespace

std::string with_flags(std::string text) {
  static const std::vector<Replacement> kAll = replacements();
  for (const auto& [parameter, flag] : kAll) {
    for (std::size_t at = text.find(parameter); at != std::string::npos; at = text.find(parameter, at)) {
      if (is_word(text, at, parameter.size())) {
        text.replace(at, parameter.size(), flag);
        at += flag.size();
      } else {
        at += parameter.size();
      }
    }
  }
  return text;
}

}  // namespace cbc3d
