#include "reports/history/history_tables.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "reports/results/format_number.hpp"

namespace cbc3d::reports {
namespace {

using metrics::metric;
using metrics::metric_id;
using metrics::MetricId;

std::string formatted(const char* format, double value) {
  std::array<char, 48> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

std::string joined(const std::set<std::string>& texts) {
  std::string text;
  for (const std::string& one : texts) {
    text += (text.empty() ? "" : ", ") + one;
  }
  return text.empty() ? "-" : text;
}

std::string day_of(const Commit& commit) {
  constexpr std::size_t kDay = 10;
  return commit.date.substr(0, kDay);
}

const char* word_of(Direction direction) {
  switch (direction) {
    case Direction::worse:
      return "worse";
    case Direction::better:
      return "better";
    case Direction::neither:
      break;
  }
  return "changed";
}

Cell figure_cell(const JobPoint& point, MetricId id, const std::vector<Change>& changes, std::size_t job) {
  const auto& value = point.figures[id];
  if (!value) {
    return text_cell("-");
  }
  Cell cell = number_cell(*value * metric(id).scale, metric(id).decimals);
  for (const Change& change : changes) {
    if (change.job == job && change.metric == id && change.first_after == point.commit) {
      cell.missed = true;
      cell.missed_word = word_of(change.direction);
    }
  }
  return cell;
}

/// In the unit in which the metric is shown.
std::string value_text(const Change& change, double value) {
  const metrics::Metric& row = metric(change.metric.value());
  const bool is_whole = row.decimals == 0 && value * row.scale != std::round(value * row.scale);
  return format_number(value * row.scale, row.decimals + (is_whole ? 1 : 0));
}

std::string commit_text(const History& history, std::size_t number) {
  return short_name(history.commits[number]) + " (" + day_of(history.commits[number]) + ")";
}

Row change_row(const History& history, const Change& change) {
  const JobHistory& job = history.jobs[change.job];
  const bool is_failure = !change.metric;
  Row row{job.name, figure_name(change), 0, {}};
  for (const std::string& text :
       {std::string(word_of(change.direction)), is_failure ? "ok" : value_text(change, change.before),
        is_failure ? "not ok" : value_text(change, change.after), change_text(change),
        commit_text(history, change.last_before), commit_text(history, change.first_after),
        std::to_string(change.count_before) + ", " + std::to_string(change.count_after),
        is_failure ? "-" : formatted("%.2g", change.p), job.machine}) {
    row.cells.push_back(text_cell(text));
  }
  row.cells.front().reason = change.reason;
  return row;
}

}  // namespace

std::vector<MetricId> shown_metrics() {
  return {metric_id("time_ratio"),
          metric_id("time_s.mesh"),
          metric_id("peak_rss_bytes"),
          metric_id("elements"),
          metric_id("quality.min_dihedral_deg"),
          metric_id("fidelity.hausdorff_mm")};
}

Table job_table(const History& history, std::size_t job, const std::vector<MetricId>& ids,
                const std::vector<Change>& changes, std::size_t most) {
  const JobHistory& subject = history.jobs[job];
  Table table{.name = "history",
              .title = subject.name + " on " + subject.machine,
              .columns = {"mesher version", "runs"},
              .row_header = "commit",
              .figure_header = "date"};
  for (const MetricId id : ids) {
    table.columns.push_back(metrics::title(metric(id)));
  }
  const std::size_t left_out = subject.points.size() - std::min(most, subject.points.size());
  for (std::size_t n = left_out; n < subject.points.size(); ++n) {
    const JobPoint& point = subject.points[n];
    const Commit& commit = history.commits[point.commit];
    Row row{short_name(commit), day_of(commit), 0, {text_cell(joined(point.versions))}};
    row.cells.push_back(number_cell(point.runs, 0));
    for (const MetricId id : ids) {
      row.cells.push_back(figure_cell(point, id, changes, job));
    }
    row.cells.front().reason = point.failure;
    table.rows.push_back(std::move(row));
  }
  return table;
}

Table change_table(const History& history, const std::vector<Change>& changes, const std::string& name,
                   const std::string& title) {
  Table table{.name = name,
              .title = title,
              .columns = {"direction", "was", "is", "change", "last before", "first after",
                          "commits before, after", "p", "machine"},
              .row_header = "job"};
  std::vector<const Change*> order;
  order.reserve(changes.size());
  for (const Change& change : changes) {
    order.push_back(&change);
  }
  std::stable_sort(order.begin(), order.end(),
                   [](const Change* a, const Change* b) { return a->first_after < b->first_after; });
  for (const Change* change : order) {
    table.rows.push_back(change_row(history, *change));
  }
  return table;
}

std::string change_text(const Change& change) {
  if (!change.metric) {
    return "-";
  }
  const double difference = change.after - change.before;
  return change.before == 0 ? formatted("%+.4g", difference * metric(*change.metric).scale)
                            : formatted("%+.1f %%", 100 * difference / std::abs(change.before));
}

std::string figure_name(const Change& change) {
  return change.metric ? metrics::title(metric(*change.metric)) : "status";
}

}  // namespace cbc3d::reports
