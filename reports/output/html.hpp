// The report of a run as one HTML file that needs nothing else: no network, no script, no other file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/charts/figures.hpp"
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
};

/// Summary, tables, plots, pictures case by case, jobs that failed with their reasons, and at the end where
/// the figures come from. Readable on a phone (tables scroll on their own, pictures stack) and in print.
std::string to_html(const Report& report);

/// A part of a page, with a heading and a link to it; without HTML it is left out.
struct PageSection {
  std::string id, name;
  std::string html;
};

/// A page of this kind with other content; `title`, `id` and `name` are escaped, HTML is put in as it is.
std::string html_page(const std::string& title, const std::string& lead,
                      const std::vector<PageSection>& sections);
/// A table with its heading and its reasons beneath.
std::string table_html(const Table& table);
/// Figures side by side.
std::string plots_html(const std::vector<Figure>& figures);

}  // namespace cbc3d::reports
