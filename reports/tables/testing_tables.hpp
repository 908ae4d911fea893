// Result lines and tables of known figures, for tests.
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "reports/tables/table_input.hpp"

namespace cbc3d::reports {

/// A good job's line.
inline Json job_line(const std::string& case_name, const std::string& mesher, int tets, int repeat = 0,
                     int threads = 1) {
  Json line = empty_result();
  line["case"] = case_name;
  line["mesher"] = mesher;
  line["threads"] = threads;
  line["repeat"] = repeat;
  line["status"] = "ok";
  line["counts"]["tets"] = tets;
  line["fidelity"]["hausdorff_mm"] = 1.5;
  line["fidelity"]["missing_labels"] = {4, 5};
  line["fidelity"]["per_label"] = {{{"volume_error_percent", 1.0}}, {{"volume_error_percent", -3.25}}};
  line["peak_rss_bytes"] = 250'000'000;
  return line;
}

/// A good job's line with times.
inline Json timed_line(const std::string& case_name, const std::string& mesher, int tets, double seconds,
                       int threads = 1) {
  Json line = job_line(case_name, mesher, tets, 0, threads);
  line["time_s"] = {{"mesh", seconds},
                    {"cpu", seconds * threads},
                    {"process_wall", seconds + 1},
                    {"stages", {{"lattice", seconds * 0.75}, {"rest", seconds * 0.01}}}};
  return line;
}

inline Json crashed_line(const std::string& case_name, const std::string& mesher, const std::string& reason,
                         int repeat = 0) {
  Json line = job_line(case_name, mesher, 0, repeat);
  line["status"] = "crashed";
  line["reason"] = reason;
  return line;
}

/// The table of these lines.
inline Table table_of(const TableBuilder& build, std::vector<Json> lines,
                      const std::vector<cases::Case>& cases = {}) {
  const std::vector<JobResult> results = decode_lines(std::move(lines));
  return build({results, cases});
}

inline const Row& row_of(const Table& table, const std::string& figure) {
  for (const Row& candidate : table.rows) {
    if (candidate.figure == figure) {
      return candidate;
    }
  }
  throw std::out_of_range("no row " + figure);
}

/// What a cell shows; "no row FIGURE" where there is no such row.
inline std::string text_in(const Table& table, const std::string& case_name, const std::string& figure,
                           std::size_t column) {
  for (const Row& row : table.rows) {
    if (row.case_name == case_name && row.figure == figure) {
      return cell_text(row.cells.at(column), row.decimals);
    }
  }
  return "no row " + figure;
}

}  // namespace cbc3d::reports
