#include "mesher/app/flag_names.hpp"

#include <array>
#include <cctype>
#include <string_view>
#include <utility>

namespace cbc3d {
namespace {

/// Phrases of several words are for names that are ordinary words too.
constexpr std::array<std::pair<std::string_view, std::string_view>, 9> kFlags = {
    {{"lattice_spacing_mm", "--lattice-spacing"},
     {"max_distance_mm", "--max-distance"},
     {"region_tolerance", "--region-tolerance"},
     {"relabel_noise", "--relabel-noise"},
     {"topology_checks", "--topology-checks"},
     {"manifold_voxels off", "--no-manifold-voxels"},
     {"on_failure", "--on-failure"},
     {"connectivity vertex", "--connectivity vertex"},
     {"edge_gradient and contrast", "--edge-gradient and --contrast"}}};

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
  for (const auto& [parameter, flag] : kFlags) {
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
