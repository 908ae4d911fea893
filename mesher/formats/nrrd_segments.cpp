#include "mesher/formats/nrrd_segments.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <string_view>

#include "mesher/formats/header_text.hpp"

namespace cbc3d::formats {
namespace {

/// Properties of each segment by their names.
using SegmentNotes = std::map<std::int64_t, NrrdFields>;

/// Takes "Segment12_Name" apart.
SegmentNotes notes_of_segments(const NrrdFields& notes) {
  constexpr std::string_view kPrefix = "Segment";
  SegmentNotes segments;
  for (const auto& [key, value] : notes) {
    const std::size_t bar = key.find('_');
    if (key.starts_with(kPrefix) && bar != std::string::npos && bar > kPrefix.size()) {
      const auto number = to_integer(std::string_view(key).substr(kPrefix.size(), bar - kPrefix.size()));
      if (number && *number >= 0) {
        segments[*number].insert_or_assign(key.substr(bar + 1), value);
      }
    }
  }
  return segments;
}

/// NRRD writes a new line as \n and a backslash as two.
std::string unescaped(std::string_view text) {
  std::string plain;
  for (std::size_t at = 0; at < text.size(); ++at) {
    if (text[at] == '\\' && at + 1 < text.size()) {
      ++at;
      plain += text[at] == 'n' ? ' ' : text[at];
    } else {
      plain += text[at];
    }
  }
  return std::string(trimmed(plain));
}

std::optional<std::array<std::uint8_t, 3>> colour_of(std::string_view text) {
  const auto words = words_of(text);
  std::array<std::uint8_t, 3> colour{};
  if (words.size() < colour.size()) {
    return std::nullopt;
  }
  for (std::size_t n = 0; n < colour.size(); ++n) {
    const auto share = to_number(words[n]);
    if (!share || !(*share >= 0 && *share <= 1)) {
      return std::nullopt;
    }
    colour[n] = static_cast<std::uint8_t>(std::lround(255 * *share));
  }
  return colour;
}

std::int64_t whole_number(const NrrdFields& notes, const std::string& property, std::int64_t segment,
                          std::int64_t otherwise) {
  const auto found = notes.find(property);
  if (found == notes.end()) {
    return otherwise;
  }
  const auto number = to_integer(trimmed(found->second));
  if (!number) {
    throw FormatError("its header has Segment" + std::to_string(segment) + "_" + property + " " +
                      in_quotes(found->second) + ", which is no whole number; repair its header");
  }
  return *number;
}

}  // namespace

std::vector<Segment> nrrd_segments(const NrrdFields& notes, std::size_t layers) {
  std::vector<Segment> segments;
  const SegmentNotes all = notes_of_segments(notes);
  const bool one_each = layers > 1 && std::none_of(all.begin(), all.end(), [](const auto& own) {
                          return own.second.contains("Layer");
                        });
  for (const auto& [number, own] : all) {
    Segment segment;
    if (const auto name = own.find("Name"); name != own.end()) {
      segment.name = unescaped(name->second);
    }
    if (const auto colour = own.find("Color"); colour != own.end()) {
      segment.colour = colour_of(colour->second);
    }
    segment.value = whole_number(own, "LabelValue", number, 1);
    const auto layer = whole_number(own, "Layer", number, one_each ? number : 0);
    if (layer < 0 || static_cast<std::size_t>(layer) >= layers) {
      throw FormatError("its header puts segment " + std::to_string(number) + " into layer " +
                        std::to_string(layer) + ", but the file has " + std::to_string(layers) +
                        "; repair its header");
    }
    segment.layer = static_cast<std::size_t>(layer);
    segments.push_back(std::move(segment));
  }
  return segments;
}

}  // namespace cbc3d::formats
