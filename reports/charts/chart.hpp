// Charts as SVG: bars in groups, lines with error bars, and points in a plane. For the page's script
// (reports/viewer/page/live_plots.js) marks are of the class `mark`, single points of `point` too, within a
// group `series`; each entry of the legend is a group `key` with the same data-series. A mark's <title> says
// whose it is and its figures.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cbc3d::reports {

/// One row of values; NaN leaves a gap.
struct Series {
  std::string name;
  std::vector<double> values;
  std::vector<double> errors;  ///< half lengths of error bars; empty: none
  bool dashed = false;         ///< a line for comparison, without marks
};

/// A line across the plot, in front of the category with that number.
struct ChartMarker {
  std::size_t category = 0;
  std::string text;  ///< at its top
  std::string tip;   ///< shown while the mouse rests on it
  bool is_bad = false;
};

struct Chart {
  std::string title;
  std::string x_title, y_title;
  std::vector<std::string> categories;  ///< of the bars or points, in order
  std::vector<Series> series;
  bool logarithmic = false;  ///< y axis in powers of ten; values must be > 0
  int label_every = 1;       ///< write the name of every Nth category
  std::string note;          ///< small, beneath
  bool from_zero = true;     ///< of a linear y axis; false: from near the lowest value
  std::vector<ChartMarker> markers = {};
};

/// A stand-alone SVG document whose size follows its width, so that it can be put into a page as it is.
std::string bar_chart(const Chart& chart);
/// As above, with points joined by lines instead of bars.
std::string line_chart(const Chart& chart);

/// Points of one name.
struct PointSeries {
  std::string name;
  std::vector<std::pair<double, double>> points;
  std::vector<std::string> jobs = {};  ///< whose each point is, for its tip; where there is none, the name
};

/// Points in the plane of two figures.
struct Scatter {
  std::string title;
  std::string x_title, y_title;
  std::vector<PointSeries> series;
  bool logarithmic_x = false, logarithmic_y = false;  ///< then values must be > 0
  bool joined = false;                                ///< lines from point to point, in their order
  std::string note;                                   ///< small, beneath
};

/// As the others; every series has its own colour and shape.
std::string scatter_chart(const Scatter& scatter);

/// Ticks that a person would choose, from 0 or below to at least `highest`.
std::vector<double> axis_ticks(double highest);
/// The same from at most `lowest` to at least `highest`, whatever their signs.
std::vector<double> axis_ticks_between(double lowest, double highest);

}  // namespace cbc3d::reports
