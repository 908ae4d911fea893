#include "reports/results/evaluation_text.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace cbc3d::reports {
namespace {

using nlohmann::json;

/// A plate that came out with two tunnels and one part less.
json evaluation() {
  return {{"counts", {{"vertices", 18130}, {"tets", 49593}}},
          {"quality",
           {{"mean_ratio", {{"min", -.01}, {"p1", .12}, {"median", .485}, {"below_0_3_percent", 12.0}}},
            {"edge_ratio", nullptr},
            {"valence_max", 125}}},
          {"surface",
           {{"facet_angle_rms_deg", 28.0},
            {"places",
             {{"not_asked", 1},
              {"count", 2},
              {"list",
               {{{"kind", "pit"}, {"label", 1}, {"at_mm", {1.5, 2, 3}}},
                {{"kind", "thin_label"}, {"label", 1}, {"at_mm", {7, 7, 7}}}}}}}}},
          {"fidelity",
           {{"dice_min", .54},
            {"surface_hausdorff_bounds_mm", {2.134, 2.136}},
            {"per_label", {{{"label", 1}}, {{"label", 8}}}}}},
          {"topology",
           {{"conforming", true},
            {"differences", 3},
            {"per_label", {{{"label", 1}, {"betti_difference", {0, 2, 0}}}}},
            {"missing_labels_topology", {{{"label", 8}, {"betti_difference", {-1, 0, 0}}}}},
            {"difference_places",
             {{"count", 7},
              {"list",
               {{{"kind", "tunnel_added"}, {"label", 1}, {"at_mm", {4, 5, 6}}},
                {{"kind", "part_lost"}, {"label", 8}, {"at_mm", {0, 0, 0.25}}}}}}}}},
          {"summary",
           {{"elements", 49593},
            {"hausdorff_mm", 3.09},
            {"hausdorff_label", 1},
            {"worst_labels",
             {{{"label", 1}, {"voxels", 900}, {"dice", .54}, {"volume_error_percent", .03}},
              {{"label", 8}, {"voxels", 1}, {"dice", 0.0}, {"volume_error_percent", -100.0}}}}}},
          {"faults", {"label 8 of the image is in no cell"}}};
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(EvaluationText, SaysFiguresLabelsTopologyAndPlaces) {
  const std::string text = evaluation_text(evaluation());
  const std::string labels =
      "Labels: the worst of 2 by Dice and volume\n"
      "  label 1: Dice 0.5400, volume error +0.03 %, 900 voxels\n"
      "  label 8: Dice 0.0000, volume error -100.00 %, 1 voxel\n";
  const std::string places =
      "Topology, mesh less image\n  label 1: +2 tunnels\n  label 8: -1 parts\n"
      "  tunnel added, label 1, at (4, 5, 6) mm\n  part lost, label 8, at (0, 0, 0.25) mm\n"
      "  and 5 more places\n";
  for (const std::string& part : std::vector<std::string>{
           "Counts\n  vertices: 18,130\n", "  mean ratio, median: 0.485\n",
           "  share of elements whose mean ratio is below .3: 12.00 %\n",
           "  edges at a vertex, largest: 125\n", "  angle between neighbouring facets, rms: 28.0 deg\n",
           "certain: from 2.134 to 2.136 mm\n", "  conforming: yes\n", labels, places,
           "Sharp places that the image does not ask for\n  pit, label 1, at (1.5, 2, 3) mm\n",
           "Faults: 1\n  label 8 of the image is in no cell\n"}) {
    EXPECT_TRUE(has(text, part)) << part << "\nis not in\n" << text;
  }
  EXPECT_FALSE(has(text, "edge ratio")) << "a figure that is null is left out";
  EXPECT_FALSE(has(text, "thin label"));
  EXPECT_FALSE(has(text, "solver"));
}

TEST(EvaluationText, SummaryIsOneLine) {
  EXPECT_EQ(
      summary_of(evaluation()),
      "49,593 elements; mean ratio 1 % 0.120; mean ratio median 0.485; facet angles rms 28.0 deg; HD 3.09 mm "
      "(label 1); "
      "label 1: Dice 0.5400, volume error +0.03 %; label 8: Dice 0.0000, volume error -100.00 %; 3 topology "
      "differences; 1 fault");
}

TEST(EvaluationText, SolverOrWhyItHasNoFigures) {
  json solved = evaluation(), refused = evaluation();
  solved["solver"] = {{"poisson_p1", {{"h1_relative", .3}, {"unknowns", 1563}}}, {"reason", ""}};
  refused["solver"] = {
      {"poisson_p1", nullptr}, {"poisson_p2", nullptr}, {"reason", "the mesh is refused: flat"}};
  EXPECT_TRUE(
      has(evaluation_text(solved),
          "Finite-element solver\n  Poisson, order 1: relative error of the gradient (H1): 0.30000\n"));
  EXPECT_TRUE(has(evaluation_text(solved), "; P1 H1 error 0.30000; 1 fault\n"));
  EXPECT_TRUE(
      has(evaluation_text(refused), "Finite-element solver\n  no figures: the mesh is refused: flat\n"));
}

TEST(EvaluationText, OfNothingOrOfNoDifference) {
  EXPECT_EQ(summary_of(json::object()), "0 elements; topology differences not known; 0 faults");
  EXPECT_TRUE(has(evaluation_text(json::object()), "Faults: none\n"));
  json same = evaluation();
  same["topology"]["differences"] = 0;
  same["topology"]["per_label"][0]["betti_difference"] = {0, 0, 0};
  same["topology"]["missing_labels_topology"] = json::array();
  EXPECT_TRUE(has(evaluation_text(same), "Topology against the image's: no difference\n"));
}

}  // namespace
}  // namespace cbc3d::reports
