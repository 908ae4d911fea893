// A table of results and its four written forms.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reports/results/format_number.hpp"
#include "reports/results/result.hpp"

namespace cbc3d::reports {

/// One figure of one mesher on one case.
struct Cell {
  std::optional<double> value;  ///< median of the runs; none: "-"
  double lowest = 0;            ///< of the runs
  double highest = 0;           ///< of the runs
  int runs = 0;                 ///< that gave the figure
  std::optional<double> paper;  ///< the paper's figure for the same thing
  std::string reason;           ///< why the figure, or some run of it, is not there; or how it was taken
  std::string text;             ///< shown instead of the figure; empty: the figure is
  int decimals = -1;            ///< of this cell; -1: those of its row
  std::string where = {};       ///< shown in brackets: where a figure is the worst ("label 4"), what it is of
  bool missed = false;          ///< the figure is beyond what it should be, and is marked
  std::string missed_word = "missed";  ///< behind a marked figure where there are no colours; empty: none
};

/// A cell of one number without runs, or of a text.
Cell number_cell(double value, int decimals, std::optional<double> paper = std::nullopt);
Cell text_cell(const std::string& text);

struct Row {
  std::string case_name;
  std::string figure;  ///< with its unit
  int decimals = 0;
  std::vector<Cell> cells;  ///< in the order of Table::columns
};

struct Table {
  std::string name;   ///< file name without extension
  std::string title;  ///< one line
  std::vector<std::string> columns;
  std::vector<Row> rows = {};
  std::string row_header = "case";       ///< of the rows' first column
  std::string figure_header = "figure";  ///< of the second
  bool on_screen = true;                 ///< printed after a run too; false: too long for that
};

/// "1,234 [1,200-1,300] (paper: 1,100)", "1.5 missed (label 4)"; "-" without a value. The range is there when
/// the runs differ in what is shown.
std::string cell_text(const Cell& cell, int decimals);

/// The reasons of a table, each once, as "CASE, MESHER: REASON", numbered from 1 by their place.
class Footnotes {
 public:
  explicit Footnotes(const Table& table);
  /// Number of the note of a cell; 0: none.
  [[nodiscard]] std::size_t number(const Row& row, std::size_t column) const;
  [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }

 private:
  [[nodiscard]] std::string note_of(const Row& row, std::size_t column) const;
  const Table& table_;
  std::vector<std::string> notes_;
};

/// The table as texts, header first, with `mark(number)` after a cell that has a footnote.
template <class Mark>
std::vector<std::vector<std::string>> texts_of(const Table& table, const Footnotes& footnotes, Mark mark) {
  std::vector<std::string> header{table.row_header, table.figure_header};
  header.insert(header.end(), table.columns.begin(), table.columns.end());
  std::vector<std::vector<std::string>> rows{header};
  for (const Row& row : table.rows) {
    std::vector<std::string> texts{row.case_name, row.figure};
    for (std::size_t column = 0; column < row.cells.size(); ++column) {
      const std::size_t number = footnotes.number(row, column);
      texts.push_back(cell_text(row.cells[column], row.decimals) + (number > 0 ? mark(number) : ""));
    }
    rows.push_back(std::move(texts));
  }
  return rows;
}

/// A Markdown table, padded so that it also reads well as plain text, with the reasons beneath.
std::string to_markdown(const Table& table);
/// One line a row: raw numbers, and for each mesher a column with the paper's figures or reasons where there
/// are any.
std::string to_csv(const Table& table);
/// A tabular environment in a table, with the reasons beneath.
std::string to_latex(const Table& table);
Json to_json(const Table& table);

}  // namespace cbc3d::reports
