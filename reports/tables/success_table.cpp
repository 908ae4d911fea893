#include "reports/tables/success_table.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include "metrics/catalog.hpp"
#include "reports/results/columns.hpp"

namespace cbc3d::reports {
namespace {

using metrics::metric_id;
using metrics::MetricId;

using Test = std::function<bool(const JobResult&)>;

bool is_zero(const JobResult& result, MetricId id) {
  return result.figures[id] == 0.0;
}

/// The self-intersections are not looked for in every evaluation; that they are not known is no fault.
bool is_valid(const JobResult& result) {
  return result.is_ok() && is_zero(result, metric_id("quality.inverted")) &&
         result.figures[metric_id("topology.conforming")] == 1.0 &&
         is_zero(result, metric_id("topology.non_manifold_edges")) &&
         is_zero(result, metric_id("topology.non_manifold_vertices")) &&
         result.figures[metric_id("topology.self_intersections")].value_or(0) == 0;
}

bool has_topology(const JobResult& result) {
  return result.is_ok() && is_zero(result, metric_id("topology.differences"));
}

bool has_labels(const JobResult& result) {
  return result.is_ok() && result.missing_labels.empty();
}

/// The jobs of a column that could run.
Runs runs_of(const std::vector<JobResult>& results, const Columns& columns, const std::string& column) {
  Runs runs;
  for (const JobResult& result : results) {
    const bool ran = result.status != "skipped" && result.status != "unavailable";
    if (ran && columns.name_of(result) == column) runs.push_back(&result);
  }
  return runs;
}

class Builder {
 public:
  Builder(const std::vector<JobResult>& results, const Columns& columns)
      : table_{.name = "success", .title = "", .columns = columns.names()},
        images_(image_names(results).size()) {
    for (const std::string& column : columns.names()) runs_.push_back(runs_of(results, columns, column));
    table_.title = "How many of " + std::to_string(images_) + " images every mesher masters";
  }

  void add(const std::string& figure, const std::function<Cell(const Runs&)>& cell_of) {
    Row row{.case_name = std::to_string(images_) + " images", .figure = figure, .cells = {}};
    for (const Runs& runs : runs_) row.cells.push_back(runs.empty() ? text_cell("-") : cell_of(runs));
    table_.rows.push_back(std::move(row));
  }

  void add_share(const std::string& figure, const Test& test) {
    add(figure, [&](const Runs& runs) {
      const auto good = std::ranges::count_if(runs, [&](const JobResult* job) { return test(*job); });
      return number_cell(100.0 * static_cast<double>(good) / static_cast<double>(runs.size()), 1);
    });
  }

  /// The extreme of a metric, and the case where it was.
  void add_worst(const std::string& figure, MetricId id, int decimals, double scale, bool smallest) {
    add(figure, [=](const Runs& runs) {
      const JobResult* worst = nullptr;
      for (const JobResult* job : runs) {
        const auto value = job->figures[id];
        const bool worse =
            value &&
            (worst == nullptr || (smallest ? *value < *worst->figures[id] : *value > *worst->figures[id]));
        worst = worse ? job : worst;
      }
      if (worst == nullptr) return text_cell("-");
      Cell cell = number_cell(*worst->figures[id] * scale, decimals);
      cell.where = worst->case_name;
      return cell;
    });
  }

  void add_sum(const std::string& figure, MetricId id) {
    add(figure, [=](const Runs& runs) {
      double sum = 0;
      for (const JobResult* job : runs) sum += job->figures[id].value_or(0);
      return number_cell(sum, 0);
    });
  }

  void add_failures() {
    for (const std::string& reason : reasons()) {
      add("failed: " + reason, [&](const Runs& runs) {
        const auto failed =
            std::ranges::count_if(runs, [&](const JobResult* job) { return group_of(*job) == reason; });
        return number_cell(static_cast<double>(failed), 0);
      });
    }
  }

  [[nodiscard]] Table table() const { return table_; }

 private:
  /// The status and the reason without what differs from case to case: names in quotation marks, numbers.
  static std::string group_of(const JobResult& result) {
    if (result.is_ok()) return "";
    const std::string failure = failure_of(result);
    std::string group;
    bool quoted = false;
    for (const char c : failure) {
      if (c == '\'') {
        quoted = !quoted;
        if (quoted) group += "...";
      } else if (!quoted && c >= '0' && c <= '9') {
        if (!group.ends_with('N')) group += 'N';
      } else if (!quoted) {
        group += c;
      }
    }
    constexpr std::size_t kLongest = 90;
    return group.size() > kLongest ? group.substr(0, kLongest) + "..." : group;
  }

  [[nodiscard]] std::set<std::string> reasons() const {
    std::set<std::string> all;
    for (const Runs& runs : runs_) {
      for (const JobResult* job : runs) all.insert(group_of(*job));
    }
    all.erase("");
    return all;
  }

  Table table_;
  std::size_t images_;
  std::vector<Runs> runs_;
};

}  // namespace

Table success_table(const TableInput& input) {
  const Columns columns(input.results);
  Builder builder(input.results, columns);
  if (image_names(input.results).size() < kManyImages) return builder.table();
  builder.add_share("meshes made (%)", [](const JobResult& job) { return job.is_ok(); });
  builder.add_share("valid (%)", is_valid);
  builder.add_share("right topology (%)", has_topology);
  builder.add_share("every label (%)", has_labels);
  builder.add_share("all of these (%)", [](const JobResult& job) {
    return is_valid(job) && has_topology(job) && has_labels(job);
  });
  builder.add_worst("smallest dihedral angle (deg)", metric_id("quality.min_dihedral_deg"), 2, 1, true);
  builder.add_worst("slowest (s)", metric_id("time_s.mesh"), 2, 1, false);
  builder.add_worst("most elements", metric_id("elements"), 0, 1, false);
  builder.add_worst("most memory (MB)", metric_id("peak_rss_bytes"), 0, 1e-6, false);
  builder.add_sum("CPU time of all (s)", metric_id("time_s.cpu"));
  builder.add_failures();
  return builder.table();
}

}  // namespace cbc3d::reports
