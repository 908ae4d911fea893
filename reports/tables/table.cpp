#include "reports/tables/table.hpp"

#include <algorithm>
#include <cstdio>

namespace cbc3d::reports {

Cell number_cell(double value, int decimals, std::optional<double> paper) {
  return {value, value, value, 1, paper, "", "", decimals};
}

Cell text_cell(const std::string& text) {
  return {std::nullopt, 0, 0, 0, std::nullopt, "", text, -1};
}

std::string cell_text(const Cell& cell, int row_decimals) {
  if (!cell.text.empty()) {
    return cell.text;
  }
  const int decimals = cell.decimals >= 0 ? cell.decimals : row_decimals;
  std::string text = cell.value ? format_number(*cell.value, decimals) : "-";
  const std::string lowest = format_number(cell.lowest, decimals);
  const std::string highest = format_number(cell.highest, decimals);
  if (cell.value && cell.runs > 1 && lowest != highest) {
    text += " [" + lowest + "-" + highest + "]";
  }
  text += cell.missed && !cell.missed_word.empty() ? " " + cell.missed_word : "";
  text += cell.where.empty() ? "" : " (" + cell.where + ")";
  if (cell.paper) {
    text += " (paper: " + format_number(*cell.paper, decimals) + ")";
  }
  return text;
}

Footnotes::Footnotes(const Table& table) : table_(table) {
  for (const Row& row : table.rows) {
    for (std::size_t column = 0; column < row.cells.size(); ++column) {
      if (!row.cells[column].reason.empty() && number(row, column) == 0) {
        notes_.push_back(note_of(row, column));
      }
    }
  }
}

std::string Footnotes::note_of(const Row& row, std::size_t column) const {
  return row.case_name + ", " + table_.columns[column] + ": " + row.cells[column].reason;
}

std::size_t Footnotes::number(const Row& row, std::size_t column) const {
  if (row.cells[column].reason.empty()) {
    return 0;
  }
  const auto found = std::find(notes_.begin(), notes_.end(), note_of(row, column));
  return found == notes_.end() ? 0 : static_cast<std::size_t>(found - notes_.begin()) + 1;
}

Json to_json(const Table& table) {
  Json rows = Json::array();
  for (const Row& row : table.rows) {
    Json cells = Json::object();
    for (std::size_t column = 0; column < row.cells.size(); ++column) {
      const Cell& cell = row.cells[column];
      Json entry;
      entry["value"] = cell.value ? Json(*cell.value) : Json();
      entry["min"] = cell.value ? Json(cell.lowest) : Json();
      entry["max"] = cell.value ? Json(cell.highest) : Json();
      entry["runs"] = cell.runs;
      entry["paper"] = cell.paper ? Json(*cell.paper) : Json();
      entry["reason"] = cell.reason;
      if (!cell.text.empty()) {
        entry["text"] = cell.text;
      }
      if (cell.missed || !cell.where.empty()) {
        entry["missed"] = cell.missed;
        entry["where"] = cell.where;
      }
      cells[table.columns[column]] = std::move(entry);
    }
    rows.push_back(
        {{table.row_header, row.case_name}, {table.figure_header, row.figure}, {"cells", std::move(cells)}});
  }
  return {
      {"name", table.name}, {"title", table.title}, {"columns", table.columns}, {"rows", std::move(rows)}};
}

}  // namespace cbc3d::reports
