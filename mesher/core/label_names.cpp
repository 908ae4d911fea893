#include "mesher/core/label_names.hpp"

#include <algorithm>
#include <cctype>
#include <utility>

namespace cbc3d {
namespace {

bool is_control(char c) {
  return static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
}

bool is_word(char c) {
  const auto byte = static_cast<unsigned char>(c);
  return byte < 0x80 && std::isalnum(byte) != 0;
}

std::string number_of(Label label) {
  return label < 0 ? "m" + std::to_string(-static_cast<std::int64_t>(label)) : std::to_string(label);
}

/// Runs of anything but letters and digits become one underscore; none stands at the ends.
std::string words_of(std::string_view name) {
  std::string words;
  for (const char c : name) {
    if (is_word(c)) {
      words += c;
    } else if (!words.empty() && words.back() != '_') {
      words += '_';
    }
  }
  while (words.ends_with('_')) words.pop_back();
  return words;
}

/// Letters of other scripts do not survive as an identifier, so such a name counts as none.
bool begins_with_letter(const std::string& words) {
  return !words.empty() && std::isalpha(static_cast<unsigned char>(words.front())) != 0;
}

std::string lower(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

/// How many bytes follow the first one of a character in UTF-8; none where it is no first byte.
std::optional<std::size_t> following_bytes(unsigned char first) {
  if (first < 0x80) return 0;
  if (first >= 0xC2 && first < 0xE0) return 1;
  if (first >= 0xE0 && first < 0xF0) return 2;
  if (first >= 0xF0 && first < 0xF5) return 3;
  return std::nullopt;
}

/// Whether the bytes are characters of Unicode, which JSON and VTK ask for.
bool is_utf8(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const auto first = static_cast<unsigned char>(text[at]);
    const auto more = following_bytes(first);
    if (!more || at + *more >= text.size()) return false;
    for (std::size_t n = 1; n <= *more; ++n) {
      const auto byte = static_cast<unsigned char>(text[at + n]);
      const bool too_low = n == 1 && ((first == 0xE0 && byte < 0xA0) || (first == 0xF0 && byte < 0x90));
      const bool too_high = n == 1 && ((first == 0xED && byte > 0x9F) || (first == 0xF4 && byte > 0x8F));
      if ((byte & 0xC0U) != 0x80 || too_low || too_high) return false;
    }
    at += *more + 1;
  }
  return true;
}

std::string utf8_of_latin1(std::string_view text) {
  std::string utf8;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) {
      utf8 += c;
    } else {
      utf8 += static_cast<char>(0xC0U | (byte >> 6U));
      utf8 += static_cast<char>(0x80U | (byte & 0x3FU));
    }
  }
  return utf8;
}

}  // namespace

void LabelNames::set(NamedLabel named) {
  if (!is_utf8(named.name)) named.name = utf8_of_latin1(named.name);
  std::ranges::replace_if(named.name, is_control, ' ');
  const auto place = std::ranges::lower_bound(entries_, named.label, {}, &NamedLabel::label);
  if (place != entries_.end() && place->label == named.label) {
    *place = std::move(named);
  } else {
    entries_.insert(place, std::move(named));
  }
}

const NamedLabel* LabelNames::find(Label label) const {
  const auto place = std::ranges::lower_bound(entries_, label, {}, &NamedLabel::label);
  return place != entries_.end() && place->label == label ? &*place : nullptr;
}

void LabelNames::add_unknown(const LabelNames& other) {
  for (const NamedLabel& named : other.entries_) {
    if (find(named.label) == nullptr) set(named);
  }
}

LabelNames LabelNames::of(const std::vector<Label>& labels) const {
  LabelNames some;
  for (const Label label : labels) {
    const NamedLabel* const named = find(label);
    if (named != nullptr && (!named->name.empty() || named->colour)) some.set(*named);
  }
  return some;
}

std::string LabelNames::text(Label label) const {
  const NamedLabel* named = find(label);
  const bool has_name = named != nullptr && !named->name.empty();
  return has_name ? named->name + " (" + std::to_string(label) + ")" : "label " + std::to_string(label);
}

std::string LabelNames::identifier(Label label) const {
  const NamedLabel* named = find(label);
  const std::string words = named == nullptr ? std::string() : words_of(named->name);
  if (!begins_with_letter(words)) return "label_" + number_of(label);
  // Abaqus and others do not tell capitals from small letters.
  const bool twice = std::ranges::count_if(entries_, [&](const NamedLabel& other) {
                       return lower(words_of(other.name)) == lower(words);
                     }) > 1;
  return twice ? words + "_" + number_of(label) : words;
}

}  // namespace cbc3d
