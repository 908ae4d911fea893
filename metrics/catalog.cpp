#include "metrics/catalog.hpp"

#include <cmath>
#include <cstdio>

namespace cbc3d::metrics {
namespace {

std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

const char* worse_text(Worse worse) {
  switch (worse) {
    case Worse::higher:
      return "higher";
    case Worse::lower:
      return "lower";
    case Worse::other:
      return "any change";
    case Worse::neither:
      break;
  }
  return "";
}

std::string gate_text(const Metric& metric) {
  const Tolerance* gate = metric.gate;
  return gate == nullptr   ? ""
         : gate == &kExact ? "exact"
                           : std::string(gate->name) + ": " + number_text(100 * gate->relative) + " % or " +
                                 number_text(gate->absolute);
}

}  // namespace

std::optional<double> element_count(const Figures& figures) {
  std::optional<double> sum;
  for (const MetricId kind : {metric_id("counts.tets"), metric_id("counts.pyramids"),
                              metric_id("counts.wedges"), metric_id("counts.hexes")}) {
    if (const auto& count = figures[kind]) {
      sum = sum.value_or(0) + *count;
    }
  }
  return sum;
}

std::optional<double> elements_per_second(const Figures& figures) {
  const auto elements = element_count(figures), seconds = figures[metric_id("time_s.mesh")];
  return elements && seconds && *seconds > 0 ? std::optional(*elements / *seconds) : std::nullopt;
}

std::optional<double> dice_shortfall(const Figures& figures) {
  const auto dice = figures[metric_id("fidelity.dice_min")];
  return dice ? std::optional(1 - *dice) : std::nullopt;
}

std::optional<double> time_ratio(const Figures& figures) {
  const auto cpu = figures[metric_id("time_s.cpu")], unit = figures[metric_id("time_s.reference_cpu")];
  const double system = figures[metric_id("time_s.system_cpu")].value_or(0);
  return cpu && unit && *unit > 0 ? std::optional((*cpu - system) / *unit) : std::nullopt;
}

void Figures::derive() {
  for (const MetricId id : all_metrics()) {
    if (metric(id).source == Source::derived) {
      (*this)[id] = metric(id).derive(*this);
    }
  }
}

std::string title(const Metric& metric) {
  const std::string name(metric.name);
  return metric.unit.empty() ? name : name + " (" + std::string(metric.unit) + ")";
}

std::string_view words(const Metric& metric) {
  return metric.long_name.empty() ? metric.name : metric.long_name;
}

bool is_shown_in(const Metric& metric, std::string_view table) {
  for (std::string_view rest = metric.tables; !rest.empty();) {
    const std::size_t end = std::min(rest.find(' '), rest.size());
    if (rest.substr(0, end) == table) {
      return true;
    }
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  return false;
}

const char* words(Purpose purpose) {
  switch (purpose) {
    case Purpose::distance:
      return "distance";
    case Purpose::smooth:
      return "smooth";
    case Purpose::shape:
      return "shape";
    case Purpose::solver:
      return "solver";
    case Purpose::topology:
      return "topology";
    case Purpose::labels:
      return "labels";
    case Purpose::count:
      return "count";
    case Purpose::time:
      return "time";
    case Purpose::hard_fault:
      return "hard fault";
    case Purpose::none:
      break;
  }
  return "";
}

std::string catalog_text() {
  std::string text =
      "| key | figure | worse | gate | purpose | tables | per label |\n|---|---|---|---|---|---|---|\n";
  for (const Metric& metric : kCatalog) {
    const std::string unit = metric.unit.empty() ? "" : " (" + std::string(metric.unit) + ")";
    text += "| `" + std::string(metric.key) + "` | " + std::string(words(metric)) + unit + " | " +
            worse_text(metric.worse) + " | " + gate_text(metric) + " | " + words(metric.purpose) + " | " +
            std::string(metric.tables) + " | " + (metric.per_label.empty() ? "" : "yes") + " |\n";
  }
  return text;
}

}  // namespace cbc3d::metrics
