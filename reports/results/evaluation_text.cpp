#include "reports/results/evaluation_text.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>

#include "metrics/catalog.hpp"
#include "reports/results/format_number.hpp"

namespace cbc3d::reports {
namespace {

using nlohmann::json;

constexpr std::size_t kMostPlaces = 5;

struct Section {
  const char* key;
  const char* words;
};
constexpr Section kSections[] = {{"counts", "Counts"},
                                 {"quality", "Shape of the elements and gradation"},
                                 {"surface", "Surface, all labels as one"},
                                 {"fidelity", "Distance to the image, worst label"},
                                 {"topology", "Topology"},
                                 {"shape", "Against the true shape"},
                                 {"solver", "Finite-element solver"}};

/// What stands at a path such as "quality.edge_ratio.max"; null where any of it is absent.
const json& at(const json& evaluation, std::string_view path) {
  static const json null;
  const json* value = &evaluation;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    const auto found =
        value->is_object() ? value->find(std::string(path.substr(begin, end - begin))) : value->end();
    if (!value->is_object() || found == value->end()) {
      return null;
    }
    value = &*found;
    begin = end + 1;
  }
  return *value;
}

std::string counted(std::int64_t count, const std::string& one, const std::string& many) {
  return format_number(static_cast<double>(count), 0) + " " + (count == 1 ? one : many);
}

/// "0.512 mm", "yes", "none" (of a list); empty where there is no figure.
std::string value_text(const json& value, const metrics::Metric& metric) {
  const std::string unit = metric.unit.empty() ? "" : " " + std::string(metric.unit);
  return value.is_boolean()  ? (value.get<bool>() ? "yes" : "no")
         : value.is_array()  ? format_number(static_cast<double>(value.size()), 0)
         : value.is_number() ? format_number(metric.scale * value.get<double>(), metric.decimals) + unit
                             : "";
}

std::string section_text(const json& evaluation, const Section& section) {
  std::string text;
  for (const metrics::Metric& metric : metrics::kCatalog) {
    const bool is_shown = !metric.tables.empty() || metric.gate != nullptr;
    if (is_shown && metric.key.starts_with(std::string(section.key) + ".")) {
      const std::string value = value_text(at(evaluation, metric.key), metric);
      text += value.empty() ? "" : "  " + std::string(metrics::words(metric)) + ": " + value + "\n";
    }
  }
  return text.empty() ? "" : std::string(section.words) + "\n" + text;
}

/// The distances that are certain.
std::string bounds_text(const json& evaluation) {
  const json& bounds = at(evaluation, "fidelity.surface_hausdorff_bounds_mm");
  return bounds.is_array() && bounds.size() == 2 && bounds[0].is_number() && bounds[1].is_number()
             ? "  surface Hausdorff distance, certain: from " + format_number(bounds[0].get<double>(), 3) +
                   " to " + format_number(bounds[1].get<double>(), 3) + " mm\n"
             : "";
}

std::string solver_reason(const json& evaluation) {
  const json& reason = at(evaluation, "solver.reason");
  return reason.is_string() && !reason.get<std::string>().empty()
             ? "Finite-element solver\n  no figures: " + reason.get<std::string>() + "\n"
             : "";
}

std::string signed_percent(const json& value) {
  return !value.is_number()
             ? "not known"
             : (value.get<double>() > 0 ? "+" : "") + format_number(value.get<double>(), 2) + " %";
}

/// "Dice 0.9841, volume error -0.54 %".
std::string label_text(const json& row) {
  return "Dice " + format_number(row.at("dice").get<double>(), 4) + ", volume error " +
         signed_percent(row.at("volume_error_percent"));
}

std::string worst_labels_text(const json& evaluation) {
  const json& rows = at(evaluation, "summary.worst_labels");
  const json& all = at(evaluation, "fidelity.per_label");
  if (!rows.is_array() || rows.empty()) {
    return "";
  }
  std::string text = "Labels: the worst of " + std::to_string(all.size()) + " by Dice and volume\n";
  for (const json& row : rows) {
    text += "  label " + row.at("label").dump() + ": " + label_text(row) + ", " +
            counted(row.at("voxels").get<std::int64_t>(), "voxel", "voxels") + "\n";
  }
  return text;
}

/// "+162 tunnels, -1 cavities".
std::string betti_text(const json& difference) {
  static constexpr std::array kNames{"parts", "tunnels", "cavities"};
  std::string text;
  for (std::size_t n = 0; n < kNames.size(); ++n) {
    const auto count = difference.at(n).get<std::int64_t>();
    if (count != 0) {
      text += (text.empty() ? "" : ", ") + std::string(count > 0 ? "+" : "") + std::to_string(count) + " " +
              kNames[n];
    }
  }
  return text;
}

std::string place_text(const json& place) {
  const json& p = place.at("at_mm");
  char where[96];
  std::snprintf(where, sizeof where, "(%.6g, %.6g, %.6g) mm", p.at(0).get<double>(), p.at(1).get<double>(),
                p.at(2).get<double>());
  std::string kind = place.at("kind").get<std::string>();
  std::replace(kind.begin(), kind.end(), '_', ' ');
  return kind + ", label " + place.at("label").dump() + ", at " + where;
}

/// The first places of a list {count, list}.
std::string places_text(const json& places) {
  const json& list = at(places, "list");
  std::string text;
  for (std::size_t n = 0; n < std::min(kMostPlaces, list.size()); ++n) {
    text += "  " + place_text(list[n]) + "\n";
  }
  const auto count = at(places, "count").is_number() ? at(places, "count").get<std::size_t>() : 0;
  return count > std::min(kMostPlaces, list.size())
             ? text + "  and " + std::to_string(count - std::min(kMostPlaces, list.size())) + " more places\n"
             : text;
}

std::string topology_text(const json& evaluation) {
  const json& total = at(evaluation, "topology.differences");
  std::string text;
  for (const char* list : {"topology.per_label", "topology.missing_labels_topology"}) {
    for (const json& row : at(evaluation, list)) {
      const json& difference = at(row, "betti_difference");
      const std::string words = difference.is_array() ? betti_text(difference) : "";
      text += words.empty() ? "" : "  label " + row.at("label").dump() + ": " + words + "\n";
    }
  }
  if (total.is_null()) {
    return "Topology against the image's: not known, for the cells of a label are no set in space or the "
           "image has "
           "too many labels\n" +
           text;
  }
  return text.empty() ? "Topology against the image's: no difference\n"
                      : "Topology, mesh less image\n" + text +
                            places_text(at(evaluation, "topology.difference_places"));
}

/// The sharp places that nothing in the image asks for.
std::string sharp_places_text(const json& evaluation) {
  json places{{"list", json::array()}, {"count", at(evaluation, "surface.places.not_asked")}};
  for (const json& place : at(evaluation, "surface.places.list")) {
    if (const json& kind = at(place, "kind"); kind == "spike" || kind == "pit") {
      places["list"].push_back(place);
    }
  }
  const std::string text = places_text(places);
  return text.empty() ? "" : "Sharp places that the image does not ask for\n" + text;
}

std::string faults_text(const json& evaluation) {
  const json& faults = at(evaluation, "faults");
  std::string text = "Faults: " + (faults.empty() ? "none" : std::to_string(faults.size())) + "\n";
  for (const json& fault : faults) {
    text += "  " + fault.get<std::string>() + "\n";
  }
  return text;
}

/// " (label 4)"; empty where it is not known.
std::string of_label(const json& label) {
  return label.is_number() ? " (label " + label.dump() + ")" : "";
}

/// Appends a figure: `words` and its value, with the label where it is the worst.
void add(std::string& line, const json& evaluation, const char* words, metrics::MetricId id,
         const char* label_key = "") {
  const std::string value = value_text(at(evaluation, metrics::metric(id).key), metrics::metric(id));
  if (!value.empty()) {
    line += std::string("; ") + words + " " + value + of_label(at(evaluation, label_key));
  }
}

}  // namespace

std::string summary_of(const json& evaluation) {
  using metrics::metric_id;
  const json& elements = at(evaluation, "summary.elements");
  std::string line = counted(elements.is_number() ? elements.get<std::int64_t>() : 0, "element", "elements");
  add(line, evaluation, "mean ratio 1 %", metric_id("quality.mean_ratio.p1"));
  add(line, evaluation, "mean ratio median", metric_id("quality.mean_ratio.median"));
  add(line, evaluation, "facet angles rms", metric_id("surface.facet_angle_rms_deg"));
  add(line, evaluation, "HD", metric_id("summary.hausdorff_mm"), "summary.hausdorff_label");
  for (const json& row : at(evaluation, "summary.worst_labels")) {
    line += "; label " + row.at("label").dump() + ": " + label_text(row);
  }
  const json& differences = at(evaluation, "topology.differences");
  line += "; " + (differences.is_number() ? counted(differences.get<std::int64_t>(), "topology difference",
                                                    "topology differences")
                                          : std::string("topology differences not known"));
  add(line, evaluation, "P1 H1 error", metric_id("solver.poisson_p1.h1_relative"));
  const auto faults = static_cast<std::int64_t>(at(evaluation, "faults").size());
  return line + "; " + counted(faults, "fault", "faults");
}

std::string evaluation_text(const json& evaluation) {
  std::string text;
  for (const Section& section : kSections) {
    text += section_text(evaluation, section);
    text += section.key == std::string("fidelity") ? bounds_text(evaluation) : "";
  }
  return text + solver_reason(evaluation) + worst_labels_text(evaluation) + topology_text(evaluation) +
         sharp_places_text(evaluation) + faults_text(evaluation) + "Summary: " + summary_of(evaluation) +
         "\n";
}

}  // namespace cbc3d::reports
