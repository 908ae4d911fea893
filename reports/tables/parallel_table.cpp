#include "reports/tables/parallel_table.hpp"

#include <algorithm>
#include <functional>
#include <set>

namespace cbc3d::reports {
namespace {

constexpr double kAskedOfJobs = 1.7, kAskedOfStages = 1.5;
constexpr double kSmallestStageShare = 0.05;

/// The points of one mesher on one case, by threads; the first has one thread.
using Sweep = std::vector<const SweepPoint*>;

std::vector<Sweep> comparable_sweeps(const std::vector<SweepPoint>& points) {
  std::vector<Sweep> sweeps;
  for (const SweepPoint& point : points) {
    const auto same = std::find_if(sweeps.begin(), sweeps.end(), [&](const Sweep& sweep) {
      return sweep.front()->case_name == point.case_name && sweep.front()->mesher == point.mesher;
    });
    (same == sweeps.end() ? *sweeps.insert(sweeps.end(), Sweep{}) : *same).push_back(&point);
  }
  for (Sweep& sweep : sweeps) {
    std::erase_if(sweep, [](const SweepPoint* point) { return point->total.seconds.empty(); });
    std::sort(sweep.begin(), sweep.end(),
              [](const SweepPoint* a, const SweepPoint* b) { return a->threads < b->threads; });
  }
  std::erase_if(sweeps, [](const Sweep& sweep) { return sweep.size() < 2 || sweep.front()->threads != 1; });
  return sweeps;
}

std::vector<int> thread_counts(const std::vector<Sweep>& sweeps) {
  std::set<int> counts;
  for (const Sweep& sweep : sweeps) {
    for (const SweepPoint* point : sweep) counts.insert(point->threads);
  }
  return {counts.begin(), counts.end()};
}

/// The median of one thing at a point; none where it was not measured.
using SecondsOf = std::function<std::optional<double>(const SweepPoint&)>;

std::optional<double> median_of(const Samples& samples) {
  return samples.seconds.empty() ? std::nullopt : std::optional(samples.median_s);
}

SecondsOf seconds_of_stage(const std::string& name) {
  return [name](const SweepPoint& point) -> std::optional<double> {
    for (const auto& [stage, samples] : point.stages) {
      if (stage == name) return median_of(samples);
    }
    return std::nullopt;
  };
}

/// The rows of one sweep in a table of these thread counts.
class SweepRows {
 public:
  SweepRows(const Sweep& sweep, const std::vector<int>& threads) : sweep_(sweep), threads_(threads) {}

  std::vector<Row> all() {
    add(
        "whole job", [](const SweepPoint& p) { return median_of(p.total); }, kAskedOfJobs);
    add(
        "whole job, files included", [](const SweepPoint& p) { return median_of(p.with_files); },
        kAskedOfJobs);
    for (const auto& [name, samples] : sweep_.front()->stages) {
      const bool large = samples.median_s > kSmallestStageShare * sweep_.front()->total.median_s;
      add(name, seconds_of_stage(name), large ? std::optional(kAskedOfStages) : std::nullopt);
    }
    return std::move(rows_);
  }

 private:
  [[nodiscard]] std::optional<double> seconds_at(int threads, const SecondsOf& seconds_of) const {
    for (const SweepPoint* point : sweep_) {
      if (point->threads == threads) return seconds_of(*point);
    }
    return std::nullopt;
  }

  void add(const std::string& what, const SecondsOf& seconds_of, std::optional<double> asked) {
    const auto one = seconds_at(1, seconds_of);
    if (!one || *one <= 0) return;
    Row row{sweep_.front()->case_name + ", " + sweep_.front()->mesher, what, 3, {}};
    for (const int threads : threads_) {
      const auto seconds = seconds_at(threads, seconds_of);
      row.cells.push_back(seconds ? number_cell(*seconds, 3) : Cell{});
    }
    row.cells.push_back(number_cell(100 * *one / sweep_.front()->total.median_s, 1));
    for (const int threads : threads_) {
      if (threads > 1) add_speed_up(row, *one, seconds_at(threads, seconds_of), threads, asked);
    }
    row.cells.push_back(asked ? number_cell(*asked, 1) : text_cell("not asked"));
    rows_.push_back(std::move(row));
  }

  static void add_speed_up(Row& row, double one, std::optional<double> seconds, int threads,
                           std::optional<double> asked) {
    if (!seconds || *seconds <= 0) {
      row.cells.insert(row.cells.end(), 2, Cell{});
      return;
    }
    const double speed_up = one / *seconds;
    row.cells.push_back(number_cell(speed_up, 2));
    row.cells.back().missed = threads == 2 && asked && speed_up < *asked;
    row.cells.push_back(number_cell(100 * serial_share(speed_up, threads), 1));
  }

  const Sweep& sweep_;
  const std::vector<int>& threads_;
  std::vector<Row> rows_;
};

}  // namespace

double serial_share(double speed_up, int threads) {
  const double shared = 1.0 / threads;
  return std::clamp((1 / speed_up - shared) / (1 - shared), 0.0, 1.0);
}

Table parallel_table(const std::vector<SweepPoint>& points) {
  const std::vector<Sweep> sweeps = comparable_sweeps(points);
  const std::vector<int> threads = thread_counts(sweeps);
  Table table{"sweep_parallel",
              "Stages over threads: median seconds, speed-up over one thread, and the serial share that it "
              "means by Amdahl's law",
              {},
              {},
              "case, mesher",
              "stage"};
  for (const int count : threads) {
    table.columns.push_back(std::to_string(count) + (count == 1 ? " thread (s)" : " threads (s)"));
  }
  table.columns.emplace_back("share of one thread's time (%)");
  for (const int count : threads) {
    if (count > 1) {
      table.columns.push_back("speed-up, " + std::to_string(count) + " threads");
      table.columns.push_back("serial share, " + std::to_string(count) + " threads (%)");
    }
  }
  table.columns.emplace_back("speed-up asked at 2 threads");
  for (const Sweep& sweep : sweeps) {
    for (Row& row : SweepRows(sweep, threads).all()) table.rows.push_back(std::move(row));
  }
  return table;
}

Table sweep_parallel_table(const TableInput& input) {
  return parallel_table(points_of_sweep(input.folder, input.results));
}

}  // namespace cbc3d::reports
