#include "reports/tables/scaling_table.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "reports/statistics/robust.hpp"
#include "reports/tables/cells.hpp"

namespace cbc3d::reports {
namespace {

using metrics::metric_id;

constexpr double kFlatPercent = 20;
constexpr double kSmallestStageShare = 0.05;

/// One image of a series.
struct Size {
  double voxels = 0, elements = 0;
  Runs runs;  ///< of one column
};

struct Series {
  std::string name;         ///< of the images
  std::string column;       ///< mesher, with threads where it ran with several
  std::vector<Size> sizes;  ///< by voxels
};

double voxel_count(const cases::Case& subject) {
  double voxels = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    voxels *= static_cast<double>(subject.phantom.value().size[axis]) * subject.derive.repeat[axis];
  }
  return voxels;
}

/// Images that differ in their size alone: the resolutions of a phantom, or copies of one side by side.
struct ImageFamily {
  std::string name;
  std::uint64_t seed;
  std::optional<Index3> size;  ///< of what is repeated; none: resolutions

  [[nodiscard]] bool holds(const cases::Case& subject) const {
    const auto& phantom = subject.phantom;
    return phantom && phantom->name == name && phantom->seed == seed &&
           (size ? phantom->size == *size : !subject.derive.repeats());
  }
  [[nodiscard]] std::string title() const { return size ? name + " side by side" : name; }
  auto operator<=>(const ImageFamily&) const = default;
};

/// Of the cases that ran, in their order.
std::vector<ImageFamily> families_of(const std::vector<cases::Case>& cases,
                                     const std::vector<std::string>& ran) {
  std::vector<ImageFamily> families;
  for (const cases::Case& subject : cases) {
    if (!subject.phantom || std::find(ran.begin(), ran.end(), subject.name) == ran.end()) {
      continue;
    }
    const cases::Phantom& phantom = *subject.phantom;
    ImageFamily family{phantom.name, phantom.seed, {}};
    if (subject.derive.repeats()) {
      family.size = phantom.size;
    }
    if (std::find(families.begin(), families.end(), family) == families.end()) {
      families.push_back(std::move(family));
    }
  }
  return families;
}

FigureOf stage_seconds(const std::string& name) {
  return [name](const JobResult& result) { return result.stage(name); };
}

/// The results of a column on every case of a family, good ones with elements alone.
Series series_of(const Columns& columns, const std::string& column, const std::vector<cases::Case>& cases,
                 const ImageFamily& family) {
  const FigureOf seconds = shown_figure(metric_id("time_s.mesh"));
  Series series{family.title(), column, {}};
  for (const cases::Case& subject : cases) {
    if (family.holds(subject)) {
      const auto runs = columns.runs(subject.name, column);
      const auto elements = median_of(runs, shown_figure(metric_id("elements")));
      if (elements.value_or(0) > 0 && median_of(runs, seconds)) {
        series.sizes.push_back({voxel_count(subject), elements.value(), runs});
      }
    }
  }
  std::sort(series.sizes.begin(), series.sizes.end(),
            [](const Size& a, const Size& b) { return a.voxels < b.voxels; });
  return series;
}

std::vector<Series> all_series(const TableInput& input) {
  const Columns columns(input.results);
  std::vector<Series> list;
  for (const ImageFamily& family : families_of(input.cases, case_names(input.results))) {
    for (const std::string& column : columns.names()) {
      Series series = series_of(columns, column, input.cases, family);
      if (series.sizes.size() > 1 && series.sizes.front().voxels < series.sizes.back().voxels) {
        list.push_back(std::move(series));
      }
    }
  }
  return list;
}

/// Voxels of a size as a multiple of the series' smallest image, to the nearest whole number.
int multiple(const Series& series, const Size& size) {
  return static_cast<int>(std::lround(size.voxels / series.sizes.front().voxels));
}

/// Stages of more than the smallest share of the time at any size, in the order in which they ran.
std::vector<std::string> costly_stages(const Series& series) {
  std::vector<std::string> names;
  for (const Size& size : series.sizes) {
    const double total = median_of(size.runs, shown_figure(metric_id("time_s.mesh"))).value_or(0);
    for (const auto& [name, unused] : size.runs.front()->stage_seconds) {
      const double seconds = median_of(size.runs, stage_seconds(name)).value_or(0);
      if (seconds > kSmallestStageShare * total && std::find(names.begin(), names.end(), name) == names.end())
        names.push_back(name);
    }
  }
  return names;
}

/// The largest distance of a value from the median, percent of the median.
double spread_percent(const std::vector<double>& values) {
  const double middle = median(values);
  double farthest = 0;
  for (const double value : values) farthest = std::max(farthest, std::abs(value - middle));
  return 100 * farthest / middle;
}

/// Rows of the series of a table with these multiples as columns.
class SeriesRows {
 public:
  SeriesRows(const Series& series, const std::vector<int>& multiples)
      : series_(series), multiples_(multiples) {}

  std::vector<Row> all() {
    rows_.push_back(row_of("elements", 0, [](const Size& size) { return std::optional(size.elements); }));
    add_costs("wall time", shown_figure(metric_id("time_s.mesh")), true);
    add_costs("CPU time", shown_figure(metric_id("time_s.cpu")), true);
    for (const std::string& stage : costly_stages(series_)) {
      add_costs(stage, stage_seconds(stage), false);
    }
    return std::move(rows_);
  }

 private:
  template <class Value>
  Row row_of(const std::string& figure, int decimals, Value value) {
    Row row{series_.name + ", " + series_.column, figure, decimals, std::vector<Cell>(multiples_.size() + 1)};
    for (const Size& size : series_.sizes) {
      const auto column = std::find(multiples_.begin(), multiples_.end(), multiple(series_, size));
      if (const auto found = value(size)) {
        row.cells[static_cast<std::size_t>(column - multiples_.begin())] = number_cell(*found, decimals);
      }
    }
    return row;
  }

  /// Seconds per voxel and per element, each with its spread.
  void add_costs(const std::string& what, const FigureOf& seconds, bool limited) {
    add_cost(what + " (ns per voxel)", seconds, limited, [](const Size& s) { return 1e9 / s.voxels; });
    add_cost(what + " (us per element)", seconds, limited, [](const Size& s) { return 1e6 / s.elements; });
  }

  template <class Factor>
  void add_cost(const std::string& figure, const FigureOf& seconds, bool limited, Factor factor) {
    std::vector<double> costs;
    Row row = row_of(figure, 2, [&](const Size& size) -> std::optional<double> {
      const auto value = median_of(size.runs, seconds);
      if (!value) return std::nullopt;
      costs.push_back(*value * factor(size));
      return costs.back();
    });
    if (costs.size() > 1 && median(costs) > 0) {
      row.cells.back() = number_cell(spread_percent(costs), 1);
      row.cells.back().missed = limited && spread_percent(costs) > kFlatPercent;
    }
    if (!costs.empty()) rows_.push_back(std::move(row));
  }

  const Series& series_;
  const std::vector<int>& multiples_;
  std::vector<Row> rows_;
};

}  // namespace

Table scaling_table(const TableInput& input) {
  const std::vector<Series> list = all_series(input);
  std::set<int> found;
  for (const Series& series : list) {
    for (const Size& size : series.sizes) found.insert(multiple(series, size));
  }
  const std::vector<int> multiples(found.begin(), found.end());
  Table table{"scaling",
              "Cost over the image's size (voxels as multiples of the smallest image's)",
              {},
              {},
              "phantom, mesher",
              "figure"};
  for (const int factor : multiples) table.columns.push_back(std::to_string(factor) + "x");
  table.columns.push_back("spread (%), at most 20");
  for (const Series& series : list) {
    for (Row& row : SeriesRows(series, multiples).all()) table.rows.push_back(std::move(row));
  }
  return table;
}

}  // namespace cbc3d::reports
