#include "mesher/input/label_table.hpp"

#include <algorithm>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "mesher/core/error.hpp"
#include "mesher/core/json_text.hpp"
#include "mesher/formats/header_text.hpp"
#include "mesher/input/table_rows.hpp"

namespace cbc3d {
namespace fs = std::filesystem;
namespace {

using formats::in_quotes;
using formats::lower_case;
using formats::to_integer;
using formats::to_number;
using formats::trimmed;
using formats::words_of;
using nlohmann::json;

using Cells = std::vector<std::string>;

struct Line {
  std::size_t number;
  std::string_view text;
};

/// The lines that are neither empty nor comments.
std::vector<Line> lines_of(std::string_view text) {
  std::vector<Line> lines;
  std::size_t number = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = trimmed(text.substr(at, end - at));
    ++number;
    if (!line.empty() && !line.starts_with('#') && !line.starts_with("//")) {
      lines.push_back({number, line});
    }
    at = end + 1;
  }
  return lines;
}

// Columns.

/// Cells between separators; one in quotes may hold them, and quotes doubled.
Cells cells_of(std::string_view line, char separator) {
  Cells cells(1);
  bool quoted = false;
  for (std::size_t at = 0; at < line.size(); ++at) {
    const char c = line[at];
    if (c == '"') {
      const bool doubled = quoted && at + 1 < line.size() && line[at + 1] == '"';
      if (doubled) {
        cells.back() += c;
        ++at;
      } else {
        quoted = !quoted;
      }
    } else if (c == separator && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  return cells;
}

/// Places of the columns; the colour is one column or three.
struct Columns {
  std::size_t label = 0, name = 0;
  std::optional<std::size_t> colour = std::nullopt;
  std::vector<std::size_t> red_green_blue{};
};

/// Without blanks, hyphens and underscores, in lower case.
std::string plain(std::string_view name) {
  std::string text = lower_case(trimmed(name));
  std::erase_if(text, [](char c) { return c == ' ' || c == '_' || c == '-' || c == '.'; });
  return text;
}

/// The first of these columns that the table has, but not `taken`.
std::optional<std::size_t> find_column(const Cells& names, std::initializer_list<const char*> known,
                                       std::optional<std::size_t> taken = {}) {
  for (const char* const name : known) {
    for (std::size_t n = 0; n < names.size(); ++n) {
      if (names[n] == name && n != taken) {
        return n;
      }
    }
  }
  return std::nullopt;
}

Columns named_columns(Cells names, const TableRows& rows) {
  std::transform(names.begin(), names.end(), names.begin(), plain);
  const auto label =
      find_column(names, {"index", "labelvalue", "value", "labelid", "id", "number", "no", "label"});
  const auto name =
      find_column(names, {"name", "labelname", "structure", "segment", "region", "label"}, label);
  if (!label || !name) {
    rows.fail(std::string("names no column ") + (label ? "'name'" : "'index'") +
              "; write a first line with index, name and color");
  }
  Columns columns;
  columns.label = *label;
  columns.name = *name;
  columns.colour = find_column(names, {"color", "colour", "hex"});
  const auto red = find_column(names, {"r", "red", "colorr"}),
             green = find_column(names, {"g", "green", "colorg"}),
             blue = find_column(names, {"b", "blue", "colorb"});
  if (red && green && blue) {
    columns.red_green_blue = {*red, *green, *blue};
  }
  return columns;
}

/// Label, name, colour in this order.
Columns columns_by_place(std::size_t count) {
  Columns columns{.label = 0, .name = 1};
  if (count == 3) {
    columns.colour = 2;
  } else if (count >= 5) {
    columns.red_green_blue = {2, 3, 4};
  }
  return columns;
}

std::optional<Colour> colour_of(const Cells& cells, const Columns& columns, const TableRows& rows) {
  Cells numbers;
  for (const std::size_t place : columns.red_green_blue) {
    if (place < cells.size() && !trimmed(cells[place]).empty()) {
      numbers.push_back(cells[place]);
    }
  }
  if (!numbers.empty()) {
    return rows.colour(numbers);
  }
  return columns.colour && *columns.colour < cells.size() ? rows.colour(cells[*columns.colour])
                                                          : std::nullopt;
}

void take_columns(const std::vector<Line>& lines, char separator, TableRows& rows) {
  Columns columns;
  bool known = false;
  for (const Line& line : lines) {
    rows.begin_line(line.number, line.text);
    const Cells cells = cells_of(line.text, separator);
    if (!known) {
      known = true;
      const bool has_names = !to_number(trimmed(cells[0]));
      columns = has_names ? named_columns(cells, rows) : columns_by_place(cells.size());
      if (has_names) {
        continue;
      }
    }
    if (std::max(columns.label, columns.name) >= cells.size()) {
      rows.fail("has " + std::to_string(cells.size()) + " columns, too few; write label, name and colour");
    }
    rows.add(cells[columns.label], cells[columns.name], colour_of(cells, columns, rows));
  }
}

// Words.

std::string joined(const Cells& words, std::size_t begin, std::size_t end) {
  std::string text;
  for (std::size_t n = begin; n < end; ++n) {
    text += (n > begin ? " " : "") + words[n];
  }
  return text;
}

/// IDX R G B A VIS MSH "NAME".
void take_quoted(std::string_view line, TableRows& rows) {
  const std::size_t begin = line.find('"'), end = line.rfind('"');
  const Cells words = words_of(line.substr(0, begin));
  if (words.empty() || end == begin) {
    rows.fail(
        "has no number before its name, or a name without its closing quote; write IDX R G B A VIS MSH "
        "\"NAME\"");
  }
  const auto colour =
      words.size() >= 4 ? rows.colour(Cells(words.begin() + 1, words.begin() + 4)) : std::nullopt;
  rows.add(words[0], std::string(line.substr(begin + 1, end - begin - 1)), colour);
}

/// NUMBER NAME R G B A, NUMBER NAME R G B or NUMBER NAME; a name may have blanks.
void take_words(std::string_view line, TableRows& rows) {
  const Cells words = words_of(line);
  std::size_t numbers = 0;
  while (numbers < 4 && numbers + 2 < words.size() && to_number(words[words.size() - 1 - numbers])) {
    ++numbers;
  }
  const std::size_t name_end = words.size() - (numbers >= 3 ? numbers : 0);
  const auto first = words.begin() + static_cast<std::ptrdiff_t>(name_end);
  rows.add(words[0], joined(words, 1, name_end),
           numbers >= 3 ? rows.colour(Cells(first, first + 3)) : std::nullopt);
}

void take_lines(const std::vector<Line>& lines, TableRows& rows) {
  for (const Line& line : lines) {
    rows.begin_line(line.number, line.text);
    line.text.find('"') != std::string_view::npos ? take_quoted(line.text, rows)
                                                  : take_words(line.text, rows);
  }
}

// JSON.

std::string text_of(const json& value) {
  return value.is_string() ? value.get<std::string>() : json_text(value, -1);
}

void take_objects(const json& list, TableRows& rows) {
  std::size_t number = 0;
  for (const json& entry : list) {
    rows.begin_line(++number, json_text(entry, -1));
    if (!entry.is_object()) {
      rows.fail("is no object; write {\"label\": 5, \"name\": \"right lung\"}");
    }
    Cells keys, values;
    for (const auto& [key, value] : entry.items()) {
      keys.push_back(key);
      values.push_back(text_of(value));
    }
    const Columns columns = named_columns(keys, rows);
    rows.add(values[columns.label], values[columns.name], colour_of(values, columns, rows));
  }
}

void take_json(const json& table, TableRows& rows) {
  for (const char* const key : {"label_names", "labels"}) {
    if (table.is_object() && table.contains(key)) {
      return take_json(table.at(key), rows);
    }
  }
  if (table.is_array()) {
    return take_objects(table, rows);
  }
  if (!table.is_object()) {
    return;
  }
  std::size_t number = 0;
  for (const auto& [key, value] : table.items()) {
    rows.begin_line(++number, key + ": " + json_text(value, -1));
    if (value.is_object()) {
      json entry = value;
      entry["index"] = key;
      take_objects(json::array({entry}), rows);
    } else {
      value.is_string() && to_number(key) ? rows.add(key, value.get<std::string>(), {})
                                          : rows.add(text_of(value), key, {});
    }
  }
}

}  // namespace

LabelNames parse_label_table(std::string_view text, const std::string& subject,
                             const std::string& extension) {
  if (text.starts_with("\xEF\xBB\xBF")) {
    text.remove_prefix(3);
  }
  TableRows rows(subject);
  const std::string_view content = trimmed(text);
  const std::vector<Line> lines = lines_of(text);
  if (content.starts_with('{') || content.starts_with('[')) {
    take_json(parse_json<json>(content, subject), rows);
  } else if (extension == ".tsv") {
    take_columns(lines, '\t', rows);
  } else if (extension == ".csv") {
    const bool semicolons = !lines.empty() && lines[0].text.find(',') == std::string_view::npos;
    take_columns(lines, semicolons ? ';' : ',', rows);
  } else {
    take_lines(lines, rows);
  }
  return rows.names();
}

LabelNames read_label_table(const fs::path& path) {
  constexpr std::uintmax_t kMostBytes = std::uintmax_t{1} << 24U;
  const std::string subject = "cannot read '" + path.string() + "'";
  std::error_code error;
  if (!fs::is_regular_file(path, error)) {
    throw InputError(subject + ": " +
                     (fs::exists(path, error) ? "it is no file; name a table of labels"
                                              : "the file does not exist; check its name"));
  }
  if (fs::file_size(path, error) > kMostBytes) {
    throw InputError(subject + ": it has more than 16 MB, so it is no table of labels; name another file");
  }
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (!file) {
    throw InputError(subject + ": the file cannot be read; check its permissions");
  }
  return parse_label_table(text, subject, lower_case(path.extension().string()));
}

}  // namespace cbc3d
