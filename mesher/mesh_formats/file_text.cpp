#include "mesher/mesh_formats/file_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <fstream>

#include "mesher/core/error.hpp"

namespace cbc3d {
namespace {

constexpr const char* kDamaged = "; the file is truncated or damaged, export it again";

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v';
}

/// A word for a message: short, without control characters.
std::string shown(std::string_view word) {
  std::string text(word.substr(0, 40));
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < ' ' || c >= 0x7F; }, '?');
  return "'" + text + "'";
}

std::string_view without_plus(std::string_view word) {
  return word.starts_with('+') && word.size() > 1 && word[1] != '-' ? word.substr(1) : word;
}

}  // namespace

FileText::FileText(const std::filesystem::path& path) : path_(path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) {
    throw InputError("cannot read '" + path.string() + "': the file cannot be opened; check its permissions");
  }
  text_.resize(std::filesystem::file_size(path));
  in.read(text_.data(), static_cast<std::streamsize>(text_.size()));
  text_.resize(static_cast<std::size_t>(in.gcount()));
}

std::string_view FileText::line() {
  const std::size_t end = std::min(text_.find('\n', at_), text_.size());
  std::string_view found(text_.data() + at_, end - at_);
  at_ = std::min(end + 1, text_.size());
  if (found.ends_with('\r')) found.remove_suffix(1);
  return found;
}

void FileText::skip_blanks() {
  while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
}

std::string_view FileText::word() {
  skip_blanks();
  const std::size_t begin = at_;
  while (at_ < text_.size() && !is_blank(text_[at_])) ++at_;
  return {text_.data() + begin, at_ - begin};
}

std::string_view FileText::peek_word() {
  skip_blanks();
  const std::size_t begin = at_;
  const std::string_view found = word();
  at_ = begin;
  return found;
}

std::int64_t FileText::integer_of(std::string_view word, const char* what) const {
  if (word.empty()) fail_at_end(what);
  const std::string_view digits = without_plus(word);
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size()) {
    fail(shown(word) + " stands for an integer of its " + what + kDamaged);
  }
  return value;
}

double FileText::real_of(std::string_view word, const char* what) const {
  if (word.empty()) fail_at_end(what);
  std::string digits(without_plus(word));
  for (char& c : digits) c = c == 'D' || c == 'd' ? 'e' : c;
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  // from_chars does not say whether a number is too large or too small; what is too small is 0.
  const bool is_small =
      error == std::errc::result_out_of_range && std::fabs(std::strtod(digits.c_str(), nullptr)) < 1;
  if ((error != std::errc() && !is_small) || end != digits.data() + digits.size() || !std::isfinite(value)) {
    fail(shown(word) + ", which is no finite number, stands among its " + what + kDamaged);
  }
  return value;
}

std::size_t FileText::checked_count(std::int64_t count, const char* what, std::size_t least_bytes) const {
  if (count < 0 || static_cast<std::uint64_t>(count) > bytes_left() / least_bytes + 1) {
    fail("it promises " + std::to_string(count) + " " + what + ", for which it is too short" + kDamaged);
  }
  return static_cast<std::size_t>(count);
}

bool FileText::skip_past_line(std::string_view mark) {
  for (std::size_t found = text_.find(mark, at_); found != std::string::npos;
       found = text_.find(mark, found + 1)) {
    if (found > 0 && text_[found - 1] != '\n') continue;
    at_ = found + mark.size();
    line();
    return true;
  }
  return false;
}

void FileText::fail_at_end(const char* what) const {
  fail(std::string("it ends within its ") + what + kDamaged);
}

void FileText::fail(const std::string& what) const {
  const auto lines = std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at_), '\n');
  const bool behind_end = at_ > 0 && text_[at_ - 1] == '\n';
  throw InputError("cannot read '" + path_.string() + "', " +
                   (binary_ ? "byte " + std::to_string(at_)
                            : "line " + std::to_string(lines + (behind_end && lines > 0 ? 0 : 1))) +
                   ": " + what);
}

}  // namespace cbc3d
