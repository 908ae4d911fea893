#include "reports/tables/deformation_pattern_table.hpp"

#include <algorithm>

#include "reports/tables/cells.hpp"
#include "reports/tables/paper_protocol.hpp"

namespace cbc3d::reports {
namespace {

using metrics::metric_id;
using metrics::MetricId;

constexpr const char* kName = "deformation_patterns";

/// The paper's row of a pattern, for an image that is as it was.
const PaperPattern* paper_pattern(const std::string& pattern) {
  const auto& patterns = paper_patterns();
  const auto found = std::find_if(patterns.begin(), patterns.end(),
                                  [&](const PaperPattern& p) { return p.pattern == pattern; });
  return found == patterns.end() ? nullptr : &*found;
}

Cell figure_cell(std::optional<double> value, int decimals, std::optional<double> paper) {
  Cell cell = value ? number_cell(*value, decimals, paper) : Cell{};
  cell.paper = paper;
  cell.decimals = decimals;
  return cell;
}

Cell figure_cell(const JobResult& job, MetricId id, std::optional<double> paper) {
  return figure_cell(shown_figure(id)(job), metrics::metric(id).decimals, paper);
}

/// The job of the case before with the same mesher and threads, without iterations.
const JobResult* job_before(const std::vector<JobResult>& results, const JobResult& job,
                            const std::string& case_before) {
  const auto found = std::find_if(results.begin(), results.end(), [&](const JobResult& candidate) {
    const auto iterations = candidate.parameters.find("iterations");
    return candidate.mesher == job.mesher && candidate.threads == job.threads &&
           candidate.case_name == case_before && candidate.is_ok() &&
           iterations != candidate.parameters.end() && iterations->second == "0";
  });
  return found == results.end() ? nullptr : &*found;
}

Cell distance_before(const TableInput& input, const JobResult& job, const std::string& case_before) {
  const JobResult* before = job_before(input.results, job, case_before);
  constexpr MetricId kDistance = metric_id("fidelity.hausdorff_mm");
  if (before != nullptr) {
    return figure_cell(*before, kDistance, kPaperHausdorffBeforeMm);
  }
  Cell cell = figure_cell(std::nullopt, metrics::metric(kDistance).decimals, kPaperHausdorffBeforeMm);
  cell.reason = "the case " + case_before + " has no good job of this mesher with 0 iterations";
  return cell;
}

Row pattern_row(const TableInput& input, const JobResult& job, const cases::DeformationPattern& pattern) {
  const PaperPattern* paper = paper_pattern(pattern.pattern);
  const auto paper_of = [&](double PaperPattern::*member) {
    return paper == nullptr ? std::nullopt : std::optional(paper->*member);
  };
  Row row{job.case_name + ", " + job.mesher,
          pattern.pattern + ", " + pattern.image,
          2,
          {figure_cell(job.target_points, 0, paper_of(&PaperPattern::target_points)),
           distance_before(input, job, pattern.before),
           figure_cell(job, metric_id("fidelity.hausdorff_mm"), paper_of(&PaperPattern::hausdorff_mm))}};
  for (const MetricId id : metrics_of_table(kName)) {
    row.cells.push_back(figure_cell(job, id, std::nullopt));
  }
  row.cells.push_back(figure_cell(job.stage("deformation"), 2, paper_of(&PaperPattern::seconds)));
  return row;
}

}  // namespace

Table deformation_pattern_table(const TableInput& input) {
  Table table{kName,
              "Deformation patterns (HD: the paper's Hausdorff distance; the paper's nidus, 10 iterations)",
              {"target points", "HD before (mm)", "HD after (mm)"},
              {},
              "case, mesher",
              "pattern, image"};
  for (const MetricId id : metrics_of_table(kName)) {
    table.columns.push_back(title(metrics::metric(id)));
  }
  table.columns.emplace_back("deformation (s)");
  for (const JobResult& result : input.results) {
    const cases::Case* subject = find_case(input.cases, result.case_name);
    if (subject != nullptr && subject->deformation_pattern && result.is_ok() && result.repeat == 0 &&
        result.target_points) {
      table.rows.push_back(pattern_row(input, result, *subject->deformation_pattern));
    }
  }
  return table;
}

}  // namespace cbc3d::reports
