#include "mesher/formats/file_list.hpp"

#include <algorithm>
#include <charconv>

#include "mesher/formats/header_text.hpp"

namespace cbc3d::formats {
namespace {

constexpr std::int64_t kMostFiles = 65536;

/// What stands before and after the number, and how it is padded.
struct Pattern {
  std::string before, after;
  bool zeros = false;
  int width = 0;
};

[[noreturn]] void refuse(const std::string& pattern) {
  throw FormatError("its voxels lie in files named by " + in_quotes(pattern) +
                    ", which has to have one number such as %03d; repair its header");
}

Pattern parse(const std::string& text) {
  Pattern pattern;
  const std::size_t percent = text.find('%');
  if (percent == std::string::npos || text.find('%', percent + 1) != std::string::npos) {
    refuse(text);
  }
  std::size_t at = percent + 1;
  pattern.zeros = at < text.size() && text[at] == '0';
  const char* const begin = text.data() + at;
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), pattern.width);
  at += static_cast<std::size_t>(end - begin);
  if (error == std::errc::result_out_of_range || pattern.width < 0 || pattern.width > 20 ||
      at >= text.size() || (text[at] != 'd' && text[at] != 'i' && text[at] != 'u')) {
    refuse(text);
  }
  pattern.before = text.substr(0, percent);
  pattern.after = text.substr(at + 1);
  return pattern;
}

std::string name_of(const Pattern& pattern, std::int64_t number) {
  std::string digits = std::to_string(number);
  const auto width = static_cast<std::size_t>(pattern.width);
  if (digits.size() < width) {
    digits.insert(0, width - digits.size(), pattern.zeros ? '0' : ' ');
  }
  return pattern.before + digits + pattern.after;
}

}  // namespace

bool is_file_pattern(const std::vector<std::string>& words) {
  return words.size() >= 4 && words[0].find('%') != std::string::npos;
}

std::vector<std::string> names_of_pattern(const std::vector<std::string>& words) {
  const Pattern pattern = parse(words.at(0));
  const auto first = to_integer(words.at(1)), last = to_integer(words.at(2)), step = to_integer(words.at(3));
  const bool counts = first && last && step && *step != 0 && *first >= 0 && *last >= 0 &&
                      *first < (1LL << 40U) && *last < (1LL << 40U) && (*last - *first) / *step >= 0 &&
                      (*last - *first) / *step < kMostFiles;
  if (!counts) {
    throw FormatError("its voxels lie in files numbered " +
                      in_quotes(words[1] + " " + words[2] + " " + words[3]) +
                      ", which are none; repair its header");
  }
  std::vector<std::string> names;
  for (std::int64_t n = 0; n <= (*last - *first) / *step; ++n) {
    names.push_back(name_of(pattern, *first + n * *step));
  }
  return names;
}

std::vector<DataFile> files_beside(const std::filesystem::path& header,
                                   const std::vector<std::string>& names) {
  std::vector<DataFile> files;
  for (const std::string& name : names) {
    if (trimmed(name).empty() || name.find('\0') != std::string::npos) {
      throw FormatError("its header names no file with its voxels; repair its header");
    }
    files.push_back({.path = header.parent_path() / std::string(trimmed(name))});
  }
  return files;
}

}  // namespace cbc3d::formats
