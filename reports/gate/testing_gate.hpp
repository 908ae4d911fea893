// Runs that the gate knows the answer for, for tests.
#pragma once

#include <vector>

#include "reports/gate/gate.hpp"

namespace cbc3d::reports {

inline Json good_line(int repeat = 0) {
  Json line = empty_result();
  line["case"] = "box";
  line["mesher"] = "cbc3d";
  line["threads"] = 1;
  line["repeat"] = repeat;
  line["status"] = "ok";
  line["mesh_sha256"] = "aa";
  line["counts"] = {{"vertices", 10}, {"tets", 20}, {"pyramids", 0}, {"wedges", 0}, {"hexes", 0}};
  line["quality"] = {
      {"min_dihedral_deg", 12.0}, {"max_dihedral_deg", 150.0}, {"min_scaled_jacobian", 0.2}, {"inverted", 0}};
  line["fidelity"]["hausdorff_mm"] = 2.0;
  line["fidelity"]["surface_hausdorff_mm"] = 1.5;
  line["fidelity"]["dice_min"] = 0.95;
  line["fidelity"]["missing_labels"] = Json::array();
  line["fidelity"]["per_label"] = {{{"label", 1}, {"volume_error_percent", -2.0}}};
  line["topology"]["conforming"] = true;
  line["topology"]["self_intersections"] = 0;
  line["time_s"] = {{"mesh", 1.0}, {"cpu", 1.0}, {"stages", Json::object()}, {"reference_cpu", 0.02}};
  line["peak_rss_bytes"] = 100'000'000;
  line["provenance"]["mesher_deterministic"] = true;
  return line;
}

inline std::vector<Json> good_run() {
  return {good_line(0), good_line(1)};
}

inline Verdict compare_lines(const std::vector<Json>& lines, const Json& baseline,
                             const CompareOptions& options = {}) {
  return compare(decode_lines(lines), baseline, options);
}

inline Json baseline() {
  return make_baseline(decode_lines(good_run()), Json(), "the first");
}

}  // namespace cbc3d::reports
