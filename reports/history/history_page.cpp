#include "reports/history/history_page.hpp"

#include <algorithm>

#include "reports/charts/chart.hpp"
#include "reports/history/history_tables.hpp"
#include "reports/output/html.hpp"
#include "reports/tables/markup.hpp"

namespace cbc3d::reports {
namespace {

using metrics::metric;
using metrics::MetricId;

/// A name of a commit that fits below an axis.
std::string tick_name(const Commit& commit) {
  constexpr std::size_t kLongest = 10;
  return short_name(commit).substr(0, kLongest);
}

ChartMarker marker_of(const History& history, const Change& change, std::size_t category) {
  const auto name = [&](std::size_t commit) { return short_name(history.commits[commit]); };
  return {category, change_text(change),
          change_text(change) + ", after " + name(change.last_before) + ", in " + name(change.first_after) +
              (change.reason.empty() ? "" : ", " + change.reason),
          change.direction == Direction::worse};
}

Figure figure_of(const History& history, std::size_t job, MetricId id, const MetricSeries& series,
                 const std::vector<Change>& changes) {
  constexpr std::size_t kMostNames = 10;
  const JobHistory& subject = history.jobs[job];
  Chart chart;
  chart.title = metrics::title(metric(id));
  chart.x_title = "commit";
  chart.y_title = metric(id).unit.empty() ? "" : std::string(metric(id).unit);
  chart.from_zero = false;
  chart.series = {{subject.mesher, {}, {}, false}};
  for (std::size_t n = 0; n < series.values.size(); ++n) {
    const std::size_t commit = subject.points[series.points[n]].commit;
    chart.categories.push_back(tick_name(history.commits[commit]));
    chart.series[0].values.push_back(series.values[n] * metric(id).scale);
    for (const Change& change : changes) {
      if (change.job == job && change.metric == id && change.first_after == commit) {
        chart.markers.push_back(marker_of(history, change, n));
      }
    }
  }
  chart.label_every = static_cast<int>((series.values.size() + kMostNames - 1) / kMostNames);
  return {"job" + std::to_string(job) + "-" + std::string(metric(id).key), chart.title, line_chart(chart)};
}

/// The plots of a job, and beneath the names of the figures that are the same at every commit.
std::string job_html(const History& history, std::size_t job, const std::vector<Change>& changes,
                     const std::vector<MetricId>& ids) {
  std::vector<Figure> figures;
  std::string constant;
  for (const MetricId id : ids) {
    const MetricSeries series = series_of(history.jobs[job], id);
    if (series.values.empty()) {
      continue;
    }
    if (series.is_constant()) {
      constant += (constant.empty() ? "" : "; ") + metrics::title(metric(id));
    } else {
      figures.push_back(figure_of(history, job, id, series, changes));
    }
  }
  const JobHistory& subject = history.jobs[job];
  return "<h3>" + markup_text(subject.name + " on " + subject.machine) + "</h3>\n" + plots_html(figures) +
         (constant.empty()
              ? ""
              : "<p class=\"notes\">The same at every commit: " + markup_text(constant) + "</p>\n");
}

/// Commits with what ran there, newest first.
Table commit_table(const History& history) {
  Table table{.name = "commits",
              .title = "Commits of the store",
              .columns = {"machines", "mesher versions", "runs"},
              .row_header = "commit",
              .figure_header = "date (UTC)"};
  for (std::size_t commit = history.commits.size(); commit-- > 0;) {
    std::set<std::string> machines, versions;
    int runs = 0;
    for (const JobHistory& job : history.jobs) {
      for (const JobPoint& point : job.points) {
        if (point.commit == commit) {
          machines.insert(job.machine);
          versions.insert(point.versions.begin(), point.versions.end());
          runs += point.runs;
        }
      }
    }
    const auto joined = [](const std::set<std::string>& texts) {
      std::string text;
      for (const std::string& one : texts) {
        text += (text.empty() ? "" : "; ") + one;
      }
      return text.empty() ? "-" : text;
    };
    table.rows.push_back(
        {history.commits[commit].name,
         history.commits[commit].date,
         0,
         {text_cell(joined(machines)), text_cell(joined(versions)), text_cell(std::to_string(runs))}});
  }
  return table;
}

}  // namespace

std::string history_page(const std::string& title, const History& history, const std::vector<Change>& changes,
                         const std::vector<MetricId>& ids) {
  std::vector<Change> worse, others;
  for (const Change& change : changes) {
    (change.direction == Direction::worse ? worse : others).push_back(change);
  }
  std::string plots;
  for (std::size_t job = 0; job < history.jobs.size(); ++job) {
    plots += job_html(history, job, changes, ids);
  }
  const std::string lead = "<p>" + std::to_string(history.commits.size()) + " commits, " +
                           std::to_string(history.jobs.size()) + " jobs, " + std::to_string(worse.size()) +
                           " changes for the worse.</p>\n";
  const auto table = [&](const std::vector<Change>& list, const char* name, const char* text) {
    return list.empty() ? "<p>None.</p>\n" : table_html(change_table(history, list, name, text));
  };
  return html_page(
      title, lead,
      {{"worse", "Regressions", table(worse, "regressions", "Changes for the worse")},
       {"changes", "Other changes", table(others, "others", "Changes for the better, and of no direction")},
       {"plots", "Plots", plots},
       {"commits", "Commits", table_html(commit_table(history))}});
}

}  // namespace cbc3d::reports
