#include "reports/output/html.hpp"

#include <algorithm>
#include <fstream>
#include <iomanip>
#include <iterator>
#include <map>
#include <set>
#include <sstream>

#include "reports/charts/picture_kinds.hpp"
#include "reports/results/columns.hpp"
#include "reports/tables/markup.hpp"
#include "reports/viewer/scripts.hpp"

namespace cbc3d::reports {
namespace {
namespace fs = std::filesystem;

/// True for a table of words rather than figures.
bool holds_texts(const Table& table) {
  return std::any_of(table.rows.begin(), table.rows.end(), [](const Row& row) {
    return std::all_of(row.cells.begin(), row.cells.end(),
                       [](const Cell& cell) { return !cell.text.empty(); });
  });
}

/// True where rows have figures of different units, which are not sorted among each other.
bool has_several_figures(const Table& table) {
  return std::any_of(table.rows.begin(), table.rows.end(),
                     [&](const Row& row) { return row.figure != table.rows.front().figure; });
}

/// The exact figure of a cell, for sorting; `line` counts from the header.
std::string stated_value(const Table& table, std::size_t line, std::size_t column) {
  constexpr int kDigits = 12;
  if (line == 0 || column < 2) {
    return "";
  }
  const auto& value = table.rows[line - 1].cells[column - 2].value;
  if (!value) {
    return "";
  }
  std::ostringstream text;
  text << std::setprecision(kDigits) << *value;
  return " data-value=\"" + text.str() + "\"";
}

std::string summary(const Report& report) {
  std::map<std::string, int> counts;
  for (const JobResult& result : report.results) {
    ++counts[result.status];
  }
  std::string html;
  for (const char* status : kStatuses) {
    if (counts.contains(status)) {
      const std::string name = status;
      html += element("span", std::to_string(counts[name]) + " " + name,
                      name == "ok" ? "class=\"badge ok\"" : "class=\"badge bad\"");
    }
  }
  return element("p", std::to_string(report.results.size()) + " jobs: " + html);
}

/// The picture's bytes as a data address; empty when there is none.
std::string data_address(const fs::path& stem) {
  for (const auto& [extension, type] : {std::pair{".jpg", "image/jpeg"}, std::pair{".png", "image/png"}}) {
    std::ifstream stream(stem.string() + extension, std::ios::binary);
    if (stream) {
      const std::string bytes((std::istreambuf_iterator<char>(stream)), {});
      return std::string("data:") + type + ";base64," + base64(bytes);
    }
  }
  return "";
}

/// All meshers' pictures of one kind side by side.
std::string picture_row(const Report& report, const std::string& case_name, const PictureKind& kind) {
  std::string html;
  std::set<std::string> seen;
  for (const JobResult& result : report.results) {
    const std::string& mesher = result.mesher;
    if (result.case_name != case_name || !seen.insert(mesher).second) {
      continue;
    }
    const std::string address =
        data_address(report.picture_dir / (picture_stem(case_name, mesher) + "-" + kind.name));
    if (!address.empty()) {
      const std::string label = case_name + ", " + mesher + ": " + kind.title;
      html += element("figure", "<img alt=\"" + markup_text(label) + "\" src=\"" + address + "\">" +
                                    element("figcaption", markup_text(mesher)));
    }
  }
  return html.empty() ? ""
                      : element("h4", markup_text(kind.title)) + element("div", html, "class=\"pictures\"");
}

std::string pictures(const Report& report) {
  std::string html;
  for (const std::string& case_name : image_names(report.results)) {
    std::string rows;
    for (const PictureKind& kind : picture_kinds()) {
      rows += picture_row(report, case_name, kind);
    }
    html += rows.empty() ? "" : element("h3", markup_text(case_name)) + rows;
  }
  return html;
}

std::string failures(const Report& report) {
  std::string rows;
  for (const JobResult& result : report.results) {
    if (!result.is_ok()) {
      rows += "<tr><td>" + markup_text(result.id) + "</td><td>" +
              markup_text(result.status.empty() ? "?" : result.status) + "</td><td>" +
              markup_text(result.reason.empty() ? "no reason was given" : result.reason) + "</td></tr>\n";
    }
  }
  if (rows.empty()) {
    return element("p", "None.");
  }
  return "<div class=\"scroll\"><table "
         "class=\"sortable left\"><thead><tr><th>job</th><th>status</th><th>reason</th></tr>"
         "</thead><tbody>\n" +
         rows + "</tbody></table></div>\n";
}

std::string plain(const Json& value) {
  return value.is_string()         ? value.get<std::string>()
         : value.is_number_float() ? format_number(value.get<double>(), 2)
                                   : value.dump();
}

/// The distinct values of a key of the provenance, or of many their range.
std::string joint_value(const Report& report, const char* key) {
  std::vector<Json> values;
  for (const JobResult& result : report.results) {
    const Json value = result.provenance(key);
    if (!value.is_null() && std::find(values.begin(), values.end(), value) == values.end()) {
      values.push_back(value);
    }
  }
  if (values.size() > 3) {
    const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());  // numbers as numbers
    return plain(*lowest) + " … " + plain(*highest) + " (" + std::to_string(values.size()) + " values)";
  }
  std::string text;
  for (const Json& value : values) {
    text += (text.empty() ? "" : "; ") + plain(value);
  }
  return text;
}

/// "key=value, key=value".
std::string parameters_text(const Parameters& parameters) {
  std::string text;
  for (const auto& [key, value] : parameters) {
    text += (text.empty() ? "" : ", ") + key + "=" + value;
  }
  return text;
}

std::string job_digests(const Report& report) {
  std::string rows;
  for (const JobResult& result : report.results) {
    const auto text = [&](const char* key) {
      const Json value = result.provenance(key);
      const std::string all = value.is_null() ? "-" : plain(value);
      return "<td><code>" + markup_text(all.size() == 64 ? all.substr(0, 12) : all) + "</code></td>";
    };
    rows += "<tr><td>" + markup_text(result.id) + "</td><td>" +
            markup_text(parameters_text(result.parameters)) + "</td>" + text("mesher_version") +
            text("mesher_licence") + text("seed") + text("image_sha256") + text("configuration_sha256") +
            text("program_sha256") + text("load_1min") + text("utc") + "</tr>\n";
  }
  return "<div class=\"scroll\"><table "
         "class=\"sortable left\"><thead><tr><th>job</th><th>parameters</th><th>version</th>"
         "<th>licence</th><th>seed</th><th>image sha256</th><th>configuration sha256</th><th>program "
         "sha256</th>"
         "<th>load</th><th>UTC</th></tr></thead><tbody>\n" +
         rows + "</tbody></table></div>\n";
}

std::string provenance_html(const Report& report) {
  std::string list;
  for (const auto& [key, title] :
       {std::pair{"cbc3d_version", "cbc3d"}, std::pair{"git_commit", "git commit"},
        std::pair{"git_dirty", "sources differ from it"}, std::pair{"compiler", "compiler"},
        std::pair{"compiler_flags", "flags"}, std::pair{"libraries", "libraries"}, std::pair{"cpu", "CPU"},
        std::pair{"cores", "cores"}, std::pair{"memory_bytes", "memory (bytes)"},
        std::pair{"system", "system"}, std::pair{"load_1min", "load (1 min)"},
        std::pair{"utc", "time (UTC)"}}) {
    const std::string value = joint_value(report, key);
    list += element("dt", title) + element("dd", value.empty() ? "-" : markup_text(value));
  }
  return element("dl", list) + job_digests(report);
}

}  // namespace

std::string table_html(const Table& table) {
  const Footnotes footnotes(table);
  const auto rows =
      texts_of(table, footnotes, [](std::size_t number) { return " [" + std::to_string(number) + "]"; });
  std::string html = element("h3", markup_text(table.title), "id=\"table-" + markup_text(table.name) + "\"");
  html += "<div class=\"scroll\"><table class=\"sortable" +
          std::string(holds_texts(table) ? " left\"" : "\"") +
          (has_several_figures(table) ? " data-figures=\"1\">\n" : ">\n");
  for (std::size_t line = 0; line < rows.size(); ++line) {
    html += line == 0 ? "<thead><tr>" : "<tr>";
    for (std::size_t column = 0; column < rows[line].size(); ++column) {
      const std::string text = markup_text(rows[line][column]);
      const bool failed = line > 0 && (rows[line][column].rfind("- [", 0) == 0 ||
                                       (column >= 2 && table.rows[line - 1].cells[column - 2].missed));
      html += line == 0 ? "<th>" + text + "</th>"
                        : "<td" + std::string(failed ? " class=\"failed\"" : "") +
                              stated_value(table, line, column) + ">" + text + "</td>";
    }
    html += line == 0 ? "</tr></thead><tbody>\n" : "</tr>\n";
  }
  html += "</tbody></table></div>\n";
  if (!footnotes.notes().empty()) {
    std::string notes;
    for (const std::string& note : footnotes.notes()) {
      notes += element("li", markup_text(note));
    }
    html += element("ol", notes, "class=\"notes\"");
  }
  return html;
}

std::string plots_html(const std::vector<Figure>& figures) {
  std::string html;
  for (const Figure& figure : figures) {
    html += element("figure", figure.svg, "id=\"figure-" + markup_text(figure.name) + "\"");
  }
  return html.empty() ? "" : element("div", html, "class=\"plots\"");
}

std::string to_html(const Report& report) {
  std::string tables;
  for (const Table& table : report.tables) {
    tables += table_html(table);
  }
  return html_page(report.title, summary(report),
                   {{"tables", "Tables", tables},
                    {"plots", "Plots", plots_html(report.figures)},
                    {"view3d", "3D view", report.view},
                    {"pictures", "Pictures", pictures(report)},
                    {"failed", "Jobs that are not ok", failures(report)},
                    {"provenance", "Provenance", provenance_html(report)}},
                   report.view.empty() || view_script().empty() ? std::vector<std::string_view>{}
                                                                : std::vector{view_script()});
}

}  // namespace cbc3d::reports
