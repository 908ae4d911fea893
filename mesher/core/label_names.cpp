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

}  // namespace

void LabelNames::set(NamedLabel named) {
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
