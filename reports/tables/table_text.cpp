// The written forms of a table.
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <string_view>

#include "reports/tables/markup.hpp"
#include "reports/tables/table.hpp"

namespace cbc3d::reports {
namespace {

std::string latex_text(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    switch (c) {
      case '\\':
        escaped += "\\textbackslash{}";
        break;
      case '~':
        escaped += "\\textasciitilde{}";
        break;
      case '^':
        escaped += "\\textasciicircum{}";
        break;
      case '\n':
        escaped += ' ';
        break;
      case '&':
      case '%':
      case '$':
      case '#':
      case '_':
      case '{':
      case '}':
        escaped += '\\';
        [[fallthrough]];
      default:
        escaped += c;
    }
  }
  return escaped;
}

/// True for a text that a spreadsheet would take for a formula, as names and reasons from outside may be; "-"
/// alone is our own sign of a missing figure.
bool is_formula(const std::string& text) {
  if (text.empty() || text == "-" || std::string_view("=+-@").find(text[0]) == std::string_view::npos) {
    return false;
  }
  double number = 0;
  const char* const begin = text.data() + (text[0] == '+' ? 1 : 0);
  const auto [end, error] = std::from_chars(begin, text.data() + text.size(), number);
  return error != std::errc() || end != text.data() + text.size();
}

std::string csv_text(const std::string& text) {
  if (is_formula(text)) {
    return "\"'" + replace_all(text, "\"", "\"\"") + '"';  // an apostrophe makes a text of it
  }
  if (text.find_first_of(",\"\n\r") == std::string::npos) {
    return text;
  }
  return '"' + replace_all(text, "\"", "\"\"") + '"';
}

std::string csv_number(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.10g", value);
  return buffer;
}

/// A column of the CSV form: a header and the text it shows of a cell.
struct CsvColumn {
  std::string header;
  std::size_t column;
  std::string (*text)(const Cell&);
};

std::vector<CsvColumn> csv_columns(const Table& table) {
  std::vector<CsvColumn> columns;
  for (std::size_t column = 0; column < table.columns.size(); ++column) {
    const std::string& name = table.columns[column];
    const auto any = [&](auto has) {
      return std::any_of(table.rows.begin(), table.rows.end(),
                         [&](const Row& row) { return has(row.cells[column]); });
    };
    columns.push_back({name, column, [](const Cell& c) {
                         return !c.text.empty() ? c.text : c.value ? csv_number(*c.value) : "-";
                       }});
    if (any([](const Cell& c) { return c.runs > 1; })) {
      columns.push_back(
          {name + " min", column, [](const Cell& c) { return c.value ? csv_number(c.lowest) : "-"; }});
      columns.push_back(
          {name + " max", column, [](const Cell& c) { return c.value ? csv_number(c.highest) : "-"; }});
    }
    if (any([](const Cell& c) { return c.paper.has_value(); })) {
      columns.push_back({name + " (paper)", column,
                         [](const Cell& c) { return c.paper ? csv_number(*c.paper) : std::string(); }});
    }
    if (any([](const Cell& c) { return c.missed || !c.where.empty(); })) {
      columns.push_back(
          {name + " missed", column, [](const Cell& c) { return std::string(c.missed ? "missed" : ""); }});
      columns.push_back({name + " where", column, [](const Cell& c) { return c.where; }});
    }
    if (any([](const Cell& c) { return !c.reason.empty(); })) {
      columns.push_back({name + " reason", column, [](const Cell& c) { return c.reason; }});
    }
  }
  return columns;
}

}  // namespace

namespace {

/// Characters of UTF-8: bytes that do not continue one.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](unsigned char c) { return (c & 0xC0U) != 0x80U; }));
}

/// A line of a Markdown table; the first two columns are set left.
std::string markdown_line(const std::vector<std::string>& entries, const std::vector<std::size_t>& widths) {
  std::string text = "|";
  for (std::size_t column = 0; column < widths.size(); ++column) {
    const std::string entry = markdown_text(entries[column]);
    const std::string padding(widths[column] - width_of(entry), ' ');
    text += " " + (column < 2 ? entry + padding : padding + entry) + " |";
  }
  return text + "\n";
}

}  // namespace

std::string to_markdown(const Table& table) {
  const Footnotes footnotes(table);
  const auto rows =
      texts_of(table, footnotes, [](std::size_t number) { return " [" + std::to_string(number) + "]"; });
  std::vector<std::size_t> widths(rows.front().size(), 3);
  for (const std::vector<std::string>& row : rows) {
    for (std::size_t column = 0; column < row.size(); ++column) {
      widths[column] = std::max(widths[column], width_of(markdown_text(row[column])));
    }
  }
  std::string text = "### " + table.title + "\n\n";
  text += markdown_line(rows.front(), widths) + "|";
  for (std::size_t column = 0; column < widths.size(); ++column) {
    text +=
        column < 2 ? std::string(widths[column] + 2, '-') + "|" : std::string(widths[column] + 1, '-') + ":|";
  }
  text += "\n";
  for (std::size_t line = 1; line < rows.size(); ++line) {
    text += markdown_line(rows[line], widths);
  }
  for (std::size_t note = 0; note < footnotes.notes().size(); ++note) {
    text += (note == 0 ? "\n[" : "[") + std::to_string(note + 1) + "] " +
            markdown_text(footnotes.notes()[note]) + "  \n";
  }
  return text;
}

std::string to_latex(const Table& table) {
  const Footnotes footnotes(table);
  const auto rows =
      texts_of(table, footnotes, [](std::size_t number) { return "@" + std::to_string(number) + "@"; });
  std::string text = "\\begin{table}[htb]\n\\caption{" + latex_text(table.title) +
                     "}\n\\centering\n\\begin{tabular}{ll" + std::string(table.columns.size(), 'r') +
                     "}\n\\hline\n";
  for (std::size_t line = 0; line < rows.size(); ++line) {
    for (std::size_t column = 0; column < rows[line].size(); ++column) {
      text += (column == 0 ? "" : " & ") + latex_text(rows[line][column]);
    }
    text += line == 0 ? " \\\\\\hline\n" : " \\\\\n";
  }
  text += "\\hline\n\\end{tabular}\n";
  for (std::size_t note = 1; note <= footnotes.notes().size(); ++note) {
    const std::string mark = "$^{" + std::to_string(note) + "}$";
    text = replace_all(text, "@" + std::to_string(note) + "@", mark);
    text += "\\par\\footnotesize " + mark + " " + latex_text(footnotes.notes()[note - 1]) + "\n";
  }
  return text + "\\end{table}\n";
}

std::string to_csv(const Table& table) {
  const std::vector<CsvColumn> columns = csv_columns(table);
  std::string text = csv_text(table.row_header) + "," + csv_text(table.figure_header);
  for (const CsvColumn& column : columns) {
    text += "," + csv_text(column.header);
  }
  text += "\n";
  for (const Row& row : table.rows) {
    text += csv_text(row.case_name) + "," + csv_text(row.figure);
    for (const CsvColumn& column : columns) {
      text += "," + csv_text(column.text(row.cells[column.column]));
    }
    text += "\n";
  }
  return text;
}

}  // namespace cbc3d::reports
