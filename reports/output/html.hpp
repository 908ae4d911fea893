// The report of a run as one HTML file that needs nothing else: no network, no other file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/charts/figures.hpp"
#include "reports/output/page.hpp"
#include "reports/results/job_result.hpp"
#include "reports/tables/table.hpp"

namespace cbc3d::reports {

/// What a report shows.
struct Report {
  std::string title;
  std::vector<JobResult> results;
  std::vector<Table> tables;
  std::vector<Figure> figures;        ///< put in as SVG
  std::filesystem::path picture_dir;  ///< CASE-MESHER-KIND.jpg or .png are put in from here
  std::string view = {};              ///< HTML of the 3D view (view_section.hpp); empty: none
};

/// Summary, tables, plots, the 3D view, pictures case by case, jobs that failed with their reasons, and at
/// the end where the figures come from. Readable on a phone (tables scroll on their own, pictures stack) and
/// in print.
std::string to_html(const Report& report);

/// A table with its heading and its reasons beneath.
std::string table_html(const Table& table);
/// Figures side by side.
std::string plots_html(const std::vector<Figure>& figures);

}  // namespace cbc3d::reports
