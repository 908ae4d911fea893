#include "reports/charts/chart.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>

#include "reports/tables/markup.hpp"
#include "reports/tables/table.hpp"

namespace cbc3d::reports {
namespace {

constexpr double kWidth = 680, kHeight = 410;
constexpr double kLeft = 70, kRight = 36, kTop = 40, kPlotBottom = 300;
constexpr double kLegendLine = 20;

/// Distinct for the colour-blind too (Okabe and Ito), then repeated.
constexpr std::array kColours{"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                              "#e69f00", "#56b4e9", "#000000", "#999933"};

std::string number(double value) {
  std::array<char, 32> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.2f", value);
  return buffer.data();
}

std::string tick_text(double value) {
  std::array<char, 32> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.6g", value);
  return buffer.data();
}

std::string attributes(std::initializer_list<std::pair<const char*, std::string>> list) {
  std::string text;
  for (const auto& [name, value] : list) {
    text += std::string(" ") + name + "=\"" + value + "\"";
  }
  return text;
}

std::string line(double x1, double y1, double x2, double y2, const std::string& colour, double width = 1,
                 bool dashed = false) {
  return "<line" +
         attributes({{"x1", number(x1)},
                     {"y1", number(y1)},
                     {"x2", number(x2)},
                     {"y2", number(y2)},
                     {"stroke", colour},
                     {"stroke-width", number(width)}}) +
         (dashed ? " stroke-dasharray=\"6 4\"" : "") + "/>\n";
}

std::string text(double x, double y, const std::string& content, const char* anchor, double size = 12,
                 double turn_deg = 0) {
  const std::string turn =
      turn_deg == 0 ? ""
                    : " transform=\"rotate(" + number(turn_deg) + " " + number(x) + " " + number(y) + ")\"";
  return "<text" +
         attributes(
             {{"x", number(x)}, {"y", number(y)}, {"text-anchor", anchor}, {"font-size", number(size)}}) +
         turn + ">" + markup_text(content) + "</text>\n";
}

/// The y axis: from values to pixels.
class Scale {
 public:
  explicit Scale(const Chart& chart) : logarithmic_(chart.logarithmic) {
    double lowest = std::numeric_limits<double>::infinity();
    double highest = 0;
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (const Series& series : chart.series) {
      for (std::size_t n = 0; n < series.values.size(); ++n) {
        if (std::isfinite(series.values[n])) {
          const double error = n < series.errors.size() ? series.errors[n] : 0;
          highest = std::max(highest, series.values[n] + error);
          least = std::min(least, series.values[n] - error);
          most = std::max(most, series.values[n] + error);
          lowest = series.values[n] > 0 ? std::min(lowest, series.values[n]) : lowest;
        }
      }
    }
    logarithmic_ = logarithmic_ && std::isfinite(lowest);
    const bool is_close = !logarithmic_ && !chart.from_zero && least <= most;
    ticks_ = is_close       ? axis_ticks_between(least, most)
             : logarithmic_ ? powers_of_ten(lowest, highest)
                            : axis_ticks(highest);
  }

  [[nodiscard]] double y(double value) const {
    const double share = logarithmic_
                             ? (std::log10(std::max(value, ticks_.front())) - std::log10(ticks_.front())) /
                                   (std::log10(ticks_.back()) - std::log10(ticks_.front()))
                             : (value - ticks_.front()) / (ticks_.back() - ticks_.front());
    return kPlotBottom - share * (kPlotBottom - kTop);
  }
  [[nodiscard]] const std::vector<double>& ticks() const { return ticks_; }

 private:
  static std::vector<double> powers_of_ten(double lowest, double highest) {
    std::vector<double> ticks;
    const int first = static_cast<int>(std::floor(std::log10(lowest)));
    for (int power = first; ticks.size() < 2 || ticks.back() < highest; ++power) {
      ticks.push_back(std::pow(10.0, power));
    }
    return ticks;
  }

  bool logarithmic_;
  std::vector<double> ticks_;
};

double slot_width(const Chart& chart) {
  return (kWidth - kLeft - kRight) / static_cast<double>(std::max<std::size_t>(chart.categories.size(), 1));
}

double slot_centre(const Chart& chart, std::size_t category) {
  return kLeft + slot_width(chart) * (static_cast<double>(category) + 0.5);
}

std::string axes(const Chart& chart, const Scale& scale) {
  std::string svg = text(kWidth / 2, 22, chart.title, "middle", 16);
  for (const double tick : scale.ticks()) {
    svg += line(kLeft, scale.y(tick), kWidth - kRight, scale.y(tick), "#d8d8d8");
    svg += text(kLeft - 6, scale.y(tick) + 4, tick_text(tick), "end", 13);
  }
  svg += line(kLeft, kPlotBottom, kWidth - kRight, kPlotBottom, "#333");
  svg += text(18, (kTop + kPlotBottom) / 2, chart.y_title, "middle", 14, -90);
  std::size_t longest = 0;
  for (const std::string& category : chart.categories) {
    longest = std::max(longest, category.size());
  }
  const bool tilt = slot_width(chart) * chart.label_every < 9.0 * static_cast<double>(longest);
  for (std::size_t c = 0; c < chart.categories.size(); c += static_cast<std::size_t>(chart.label_every)) {
    svg += text(slot_centre(chart, c), kPlotBottom + 16, chart.categories[c], tilt ? "end" : "middle", 13,
                tilt ? -30 : 0);
  }
  return svg +
         text((kLeft + kWidth - kRight) / 2, kPlotBottom + (tilt ? 62 : 38), chart.x_title, "middle", 14);
}

/// What belongs to a series, for the page's script that hides it: its marks, or its entry in the legend.
std::string group(const char* kind, std::size_t series, const std::string& content) {
  return "<g" + attributes({{"class", kind}, {"data-series", std::to_string(series)}}) + ">\n" + content +
         "</g>\n";
}

/// Nothing to be seen, but all of it can be clicked on.
std::string key_area(double x, double y, double width) {
  return "<rect" +
         attributes({{"x", number(x - 4)},
                     {"y", number(y - 14)},
                     {"width", number(width - 4)},
                     {"height", number(kLegendLine)},
                     {"fill", "none"},
                     {"pointer-events", "all"}}) +
         "/>\n";
}

/// Names of the series in rows beneath the plot, each after its sample(number, x, y), and the note. `height`
/// grows by what they need.
template <class Sample>
std::string legend(const Chart& chart, double& height, const Sample& sample) {
  std::string svg;
  double x = kLeft;
  double y = kPlotBottom + 86;
  for (std::size_t s = 0; s < chart.series.size(); ++s) {
    const double width = 36 + 7.4 * static_cast<double>(chart.series[s].name.size());
    if (x + width > kWidth - kRight && x > kLeft) {
      x = kLeft;
      y += kLegendLine;
    }
    svg += group(
        "key", s,
        key_area(x, y, width) + sample(s, x, y - 4) + text(x + 23, y, chart.series[s].name, "start", 13));
    x += width;
  }
  if (!chart.note.empty()) {
    y += kLegendLine;
    svg += text(kLeft, y, chart.note, "start", 12);
  }
  height = std::max(height, y + 14);
  return svg;
}

/// What a mark says of itself: on the first line whose it is, then its figures.
std::string tip_title(std::initializer_list<std::string> lines) {
  std::string title;
  for (const std::string& one : lines) {
    title += (title.empty() ? "" : "&#10;") + markup_text(one);
  }
  return "<title>" + title + "</title>";
}

std::string category_tip(const Chart& chart, const Series& series, std::size_t category) {
  const bool has_error = category < series.errors.size() && series.errors[category] > 0;
  return tip_title({series.name + ", " + chart.categories[category],
                    (chart.y_title.empty() ? "" : chart.y_title + ": ") + tick_text(series.values[category]) +
                        (has_error ? " ± " + tick_text(series.errors[category]) : "")});
}

std::string error_bar(double x, double low, double high) {
  return line(x, low, x, high, "#222", 1.2) + line(x - 3, low, x + 3, low, "#222", 1.2) +
         line(x - 3, high, x + 3, high, "#222", 1.2);
}

std::string error_bar_of(const Series& series, std::size_t n, double x, const Scale& scale) {
  const bool has_error = n < series.errors.size() && series.errors[n] > 0;
  return has_error ? error_bar(x, scale.y(std::max(0.0, series.values[n] - series.errors[n])),
                               scale.y(series.values[n] + series.errors[n]))
                   : "";
}

std::string bars(const Chart& chart, const Scale& scale) {
  constexpr double kFill = 0.84;  // of a category's slot
  constexpr double kWidest = 56;
  const auto count = static_cast<double>(std::max<std::size_t>(chart.series.size(), 1));
  const double width = std::min(kWidest, kFill * slot_width(chart) / count);
  std::string svg;
  for (std::size_t s = 0; s < chart.series.size(); ++s) {
    const Series& series = chart.series[s];
    std::string marks;
    for (std::size_t c = 0; c < series.values.size(); ++c) {
      if (!std::isfinite(series.values[c])) {
        continue;
      }
      const double x = slot_centre(chart, c) + width * (static_cast<double>(s) - count / 2);
      const double top = scale.y(series.values[c]);
      marks += "<rect" +
               attributes({{"class", "mark"},
                           {"x", number(x)},
                           {"y", number(top)},
                           {"width", number(width)},
                           {"height", number(std::max(0.0, kPlotBottom - top))},
                           {"fill", kColours[s % kColours.size()]}}) +
               ">" + category_tip(chart, series, c) + "</rect>\n";
      marks += error_bar_of(series, c, x + width / 2, scale);
    }
    svg += group("series", s, marks);
  }
  return svg;
}

std::string points(const Chart& chart, const Scale& scale) {
  std::string svg;
  for (std::size_t s = 0; s < chart.series.size(); ++s) {
    const Series& series = chart.series[s];
    const std::string colour = kColours[s % kColours.size()];
    std::string path, marks;
    for (std::size_t c = 0; c < series.values.size(); ++c) {
      if (!std::isfinite(series.values[c])) {
        continue;
      }
      const double x = slot_centre(chart, c);
      const double y = scale.y(series.values[c]);
      path += (path.empty() ? "M" : "L") + number(x) + " " + number(y);
      if (!series.dashed) {
        marks += error_bar_of(series, c, x, scale);
        marks += "<circle" +
                 attributes({{"class", "mark point"},
                             {"cx", number(x)},
                             {"cy", number(y)},
                             {"r", "4"},
                             {"fill", colour}}) +
                 ">" + category_tip(chart, series, c) + "</circle>\n";
      }
    }
    marks += "<path" +
             attributes({{"d", path.empty() ? "M0 0" : path},
                         {"fill", "none"},
                         {"stroke", colour},
                         {"stroke-width", "2"}}) +
             (series.dashed ? " stroke-dasharray=\"6 4\"" : "") + "/>\n";
    svg += group("series", s, marks);
  }
  return svg;
}

/// Lines across the plot with their texts, by turns at two heights, since they may stand close to each other.
std::string markers(const Chart& chart) {
  constexpr const char *kBad = "#a3240c", *kGood = "#00664b";
  std::string svg;
  for (std::size_t n = 0; n < chart.markers.size(); ++n) {
    const ChartMarker& marker = chart.markers[n];
    const double x = kLeft + slot_width(chart) * static_cast<double>(marker.category);
    const char* colour = marker.is_bad ? kBad : kGood;
    svg += "<g fill=\"" + std::string(colour) + "\"><title>" + markup_text(marker.tip) + "</title>\n";
    svg += line(x, kTop, x, kPlotBottom, colour, 1.5, true);
    svg += text(x + 4, kTop + 11 + 14 * static_cast<double>(n % 2), marker.text, "start", 12) + "</g>\n";
  }
  return svg;
}

/// `inner`: axes and marks; `below`: the legend.
std::string document(const std::string& title, double height, const std::string& inner,
                     const std::string& below) {
  return "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + number(kWidth) + " " + number(height) +
         "\" width=\"" + number(kWidth) + "\" height=\"" + number(height) +
         "\" font-family=\"sans-serif\" fill=\"#222\" role=\"img\"><title>" + markup_text(title) +
         "</title>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n" + inner + below + "</svg>\n";
}

std::string document(const Chart& chart, const Scale& scale, const std::string& marks) {
  double height = kHeight;
  const std::string below = legend(chart, height, [&](std::size_t s, double x, double y) {
    return line(x, y, x + 18, y, kColours[s % kColours.size()], 5, chart.series[s].dashed);
  });
  return document(chart.title, height, axes(chart, scale) + marks + markers(chart), below);
}

/// One axis of a plane: from values to the share of its length.
class Axis {
 public:
  Axis(const std::vector<double>& values, bool logarithmic) : logarithmic_(logarithmic) {
    const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
    ticks_ = logarithmic_ ? steps_of_125(*lowest, *highest) : axis_ticks(*highest);
  }

  [[nodiscard]] double share(double value) const {
    const auto at = [this](double v) { return logarithmic_ ? std::log10(v) : v; };
    return (at(value) - at(ticks_.front())) / (at(ticks_.back()) - at(ticks_.front()));
  }
  [[nodiscard]] const std::vector<double>& ticks() const { return ticks_; }

 private:
  /// 1, 2, 5, 10, ... from at most `lowest` to at least `highest`, only powers of ten when these are many.
  static std::vector<double> steps_of_125(double lowest, double highest) {
    constexpr std::size_t kMostTicks = 8;
    std::vector<double> steps, powers;
    const int first = static_cast<int>(std::floor(std::log10(lowest)));
    for (int power = first; powers.size() < 2 || powers.back() < highest; ++power) {
      powers.push_back(std::pow(10.0, power));
      for (const double factor : {1.0, 2.0, 5.0}) {
        steps.push_back(factor * powers.back());
      }
    }
    while (steps.size() > 2 && steps[1] <= lowest) {
      steps.erase(steps.begin());
    }
    while (steps.size() > 2 && steps[steps.size() - 2] >= highest) {
      steps.pop_back();
    }
    return steps.size() > kMostTicks ? powers : steps;
  }

  bool logarithmic_;
  std::vector<double> ticks_;
};

/// Where a plane's values lie in the picture.
struct Plane {
  Axis x_axis, y_axis;

  [[nodiscard]] double x(double value) const {
    return kLeft + x_axis.share(value) * (kWidth - kRight - kLeft);
  }
  [[nodiscard]] double y(double value) const {
    return kPlotBottom - y_axis.share(value) * (kPlotBottom - kTop);
  }
};

/// Large numbers with separators, of which none is mistaken for a tenth of it.
std::string plane_tick_text(double tick) {
  return tick < 1000 ? tick_text(tick) : format_number(tick, 0);
}

std::string plane_axes(const Scatter& scatter, const Plane& plane) {
  std::string svg = text(kWidth / 2, 22, scatter.title, "middle", 16);
  for (const double tick : plane.y_axis.ticks()) {
    svg += line(kLeft, plane.y(tick), kWidth - kRight, plane.y(tick), "#d8d8d8");
    svg += text(kLeft - 6, plane.y(tick) + 4, plane_tick_text(tick), "end", 12);
  }
  for (const double tick : plane.x_axis.ticks()) {
    svg += line(plane.x(tick), kTop, plane.x(tick), kPlotBottom, "#d8d8d8");
    svg += text(plane.x(tick), kPlotBottom + 17, plane_tick_text(tick), "middle", 13);
  }
  svg += line(kLeft, kPlotBottom, kWidth - kRight, kPlotBottom, "#333");
  svg += line(kLeft, kTop, kLeft, kPlotBottom, "#333");
  return svg + text(14, (kTop + kPlotBottom) / 2, scatter.y_title, "middle", 14, -90) +
         text((kLeft + kWidth - kRight) / 2, kPlotBottom + 40, scatter.x_title, "middle", 14);
}

/// A point of the `series`-th colour and shape; `title`: what it says of itself, or nothing.
std::string point_mark(std::size_t series, double x, double y, const std::string& title) {
  static const std::array<std::vector<std::pair<double, double>>, 4> kShapes{
      std::vector<std::pair<double, double>>{},     // a circle
      {{-5, -5}, {5, -5}, {5, 5}, {-5, 5}},         // a square
      {{0, -7}, {6.5, 5}, {-6.5, 5}},               // a triangle
      {{0, -7.5}, {7.5, 0}, {0, 7.5}, {-7.5, 0}}};  // a diamond
  const std::string look =
      attributes({{"fill", kColours[series % kColours.size()]}, {"stroke", "#fff"}, {"stroke-width", "1"}}) +
      (title.empty() ? "" : " class=\"mark point\"");
  const auto& shape = kShapes[series % kShapes.size()];
  if (shape.empty()) {
    return "<circle" + attributes({{"cx", number(x)}, {"cy", number(y)}, {"r", "6"}}) + look + ">" + title +
           "</circle>\n";
  }
  std::string corners;
  for (const auto& [dx, dy] : shape) {
    corners += (corners.empty() ? "" : " ") + number(x + dx) + "," + number(y + dy);
  }
  return "<polygon" + attributes({{"points", corners}}) + look + ">" + title + "</polygon>\n";
}

/// A line through all points of a series.
std::string joining_line(std::size_t series, const PointSeries& points, const Plane& plane) {
  std::string path;
  for (const auto& [x, y] : points.points) {
    path += (path.empty() ? "M" : "L") + number(plane.x(x)) + " " + number(plane.y(y));
  }
  return path.empty() ? ""
                      : "<path" +
                            attributes({{"d", path},
                                        {"fill", "none"},
                                        {"stroke", kColours[series % kColours.size()]},
                                        {"stroke-width", "1.5"}}) +
                            "/>\n";
}

/// The marks of a series, each with its job and both figures as its tip.
std::string points_of(const Scatter& scatter, std::size_t number, const Plane& plane) {
  const PointSeries& series = scatter.series[number];
  std::string svg = scatter.joined ? joining_line(number, series, plane) : "";
  for (std::size_t n = 0; n < series.points.size(); ++n) {
    const auto& [x, y] = series.points[n];
    const std::string owner = n < series.jobs.size() ? series.jobs[n] : series.name;
    svg += point_mark(number, plane.x(x), plane.y(y),
                      tip_title({owner, scatter.x_title + ": " + plane_tick_text(x),
                                 scatter.y_title + ": " + plane_tick_text(y)}));
  }
  return svg;
}

/// The axes that hold all points. At least one point there is.
Plane plane_of(const Scatter& scatter) {
  std::vector<double> xs, ys;
  for (const PointSeries& series : scatter.series) {
    for (const auto& [x, y] : series.points) {
      xs.push_back(x);
      ys.push_back(y);
    }
  }
  return {Axis(xs, scatter.logarithmic_x), Axis(ys, scatter.logarithmic_y)};
}

}  // namespace

std::vector<double> axis_ticks(double highest) {
  constexpr double kTicks = 5;
  if (!(highest > 0)) {
    return {0, 1};
  }
  const double power = std::pow(10.0, std::floor(std::log10(highest / kTicks)));
  double step = 10 * power;
  for (const double factor : {1.0, 2.0, 2.5, 5.0}) {
    if (factor * power * kTicks >= highest) {
      step = factor * power;
      break;
    }
  }
  std::vector<double> ticks{0};
  while (ticks.back() < highest * (1 - 1e-9)) {
    ticks.push_back(step * static_cast<double>(ticks.size()));
  }
  return ticks;
}

std::vector<double> axis_ticks_between(double lowest, double highest) {
  constexpr double kMargin = 0.05;  // of the range, or of the value where there is no range
  const double range = highest > lowest ? highest - lowest : lowest != 0 ? std::abs(lowest) : 1;
  const double step = axis_ticks(range * (1 + 2 * kMargin))[1];
  double tick = std::floor((lowest - kMargin * range) / step);
  std::vector<double> ticks{tick * step};
  while (ticks.back() < highest + kMargin * range * (1 - 1e-9)) {
    ticks.push_back(++tick * step);
  }
  return ticks;
}

std::string bar_chart(const Chart& chart) {
  const Scale scale(chart);
  return document(chart, scale, bars(chart, scale));
}

std::string line_chart(const Chart& chart) {
  const Scale scale(chart);
  return document(chart, scale, points(chart, scale));
}

std::string scatter_chart(const Scatter& scatter) {
  const Plane plane = plane_of(scatter);
  Chart names;
  names.note = scatter.note;
  std::string inner = plane_axes(scatter, plane);
  for (std::size_t s = 0; s < scatter.series.size(); ++s) {
    const PointSeries& series = scatter.series[s];
    names.series.push_back({series.name, {}, {}, false});
    inner += group("series", s, points_of(scatter, s, plane));
  }
  double height = kHeight;
  const std::string below =
      legend(names, height, [&](std::size_t s, double x, double y) { return point_mark(s, x + 12, y, ""); });
  return document(scatter.title, height, inner, below);
}

}  // namespace cbc3d::reports
