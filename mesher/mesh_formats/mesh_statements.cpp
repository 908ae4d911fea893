#include "mesher/mesh_formats/mesh_statements.hpp"

#include <array>
#include <charconv>
#include <cstdint>
#include <cstdio>
#include <optional>

namespace cbc3d {
namespace {

constexpr std::string_view kName = "name ", kColour = "colour ", kCoordinates = "coordinates ",
                           kEquals = " = ";

std::string_view without_blanks_at_ends(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

std::string colour_text(const std::array<std::uint8_t, 3>& colour) {
  std::array<char, 8> text;
  static_cast<void>(
      std::snprintf(text.data(), text.size(), "#%02x%02x%02x", colour[0], colour[1], colour[2]));
  return text.data();
}

std::optional<std::array<std::uint8_t, 3>> colour_of(std::string_view text) {
  constexpr std::size_t kLength = 7;
  if (text.size() != kLength || text.front() != '#') return std::nullopt;
  std::array<std::uint8_t, 3> colour;
  for (std::size_t n = 0; n < colour.size(); ++n) {
    const char* const begin = text.data() + 1 + 2 * n;
    const auto [end, error] = std::from_chars(begin, begin + 2, colour[n], 16);
    if (error != std::errc() || end != begin + 2) return std::nullopt;
  }
  return colour;
}

/// "5 = right lung" in two; nothing where it is not so.
struct LabelText {
  Label label = 0;
  std::string_view text;
};

std::optional<LabelText> label_text_of(std::string_view line) {
  const std::size_t equals = line.find(kEquals);
  if (equals == std::string_view::npos) return std::nullopt;
  LabelText found;
  const std::string number(line.substr(0, equals));
  const char* const number_end = number.data() + number.size();
  const auto [end, error] = std::from_chars(number.data(), number_end, found.label);
  if (error != std::errc() || end != number_end) return std::nullopt;
  found.text = line.substr(equals + kEquals.size());
  return found;
}

NamedLabel entry_of(const LabelNames& names, Label label) {
  const NamedLabel* const known = names.find(label);
  return known == nullptr ? NamedLabel{.label = label, .name = {}, .colour = {}} : *known;
}

void take_name(const LabelText& line, LabelNames& names) {
  NamedLabel named = entry_of(names, line.label);
  named.name = line.text;
  names.set(std::move(named));
}

void take_colour(const LabelText& line, LabelNames& names) {
  NamedLabel named = entry_of(names, line.label);
  named.colour = colour_of(line.text);
  if (named.colour) names.set(std::move(named));
}

/// Words of other programs are left aside.
void take_coordinates(std::string_view text, MeshFileOptions& stated) {
  for (const std::string_view known : {"LPS", "RAS", "voxel"}) {
    if (text == known) stated.coordinates = known;
  }
}

}  // namespace

std::string coordinates_statement(const MeshFileOptions& options) {
  return std::string(kCoordinates) + options.coordinates + (options.coordinates == "voxel" ? "" : ", mm");
}

std::vector<std::string> name_statements(const LabelNames& names, const std::vector<Label>& labels) {
  std::vector<std::string> lines;
  const LabelNames known = names.of(labels);
  for (const NamedLabel& named : known.entries()) {
    const std::string label = std::to_string(named.label).append(kEquals);
    if (!named.name.empty()) lines.push_back(std::string(kName) + label + named.name);
    if (named.colour) lines.push_back(std::string(kColour) + label + colour_text(*named.colour));
  }
  return lines;
}

void take_statement(std::string_view line, MeshFileOptions& stated) {
  line = without_blanks_at_ends(line);
  if (line.starts_with(kCoordinates)) {
    const std::string_view rest = line.substr(kCoordinates.size());
    take_coordinates(rest.substr(0, rest.find(',')), stated);
  } else if (line.starts_with(kName)) {
    if (const auto found = label_text_of(line.substr(kName.size()))) take_name(*found, stated.names);
  } else if (line.starts_with(kColour)) {
    if (const auto found = label_text_of(line.substr(kColour.size()))) take_colour(*found, stated.names);
  }
}

void take_group_name(Label label, std::string_view group, LabelNames& names) {
  const std::string_view name = without_blanks_at_ends(group);
  NamedLabel named = entry_of(names, label);
  if (name.empty() || !named.name.empty() || name == LabelNames().identifier(label)) return;
  named.name = name;
  names.set(std::move(named));
}

}  // namespace cbc3d
