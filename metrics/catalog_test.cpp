#include "metrics/catalog.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "metrics/testing.hpp"

namespace cbc3d::metrics {
namespace {

TEST(Catalog, KeysAreUniqueAndRowsComplete) {
  std::set<std::string_view> keys;
  for (const Metric& metric : kCatalog) {
    EXPECT_TRUE(keys.insert(metric.key).second) << metric.key << " stands twice";
    EXPECT_FALSE(metric.name.empty()) << metric.key;
    EXPECT_EQ(metric.source == Source::derived, metric.derive != nullptr) << metric.key;
    EXPECT_TRUE(metric.source != Source::labels || !metric.per_label.empty()) << metric.key;
    EXPECT_TRUE(metric.gate == nullptr || metric.worse != Worse::neither) << metric.key;
    EXPECT_TRUE(metric.purpose == Purpose::none || metric.worse != Worse::neither) << metric.key;
    EXPECT_EQ(metric.purpose == Purpose::none, !is_shown_in(metric, "targets")) << metric.key;
    EXPECT_NE(metric.scale, 0) << metric.key;
  }
}

TEST(Catalog, TolerancesOfOneNameAreOne) {
  std::map<std::string_view, const Tolerance*> classes;
  for (const Metric& metric : kCatalog) {
    if (metric.gate != nullptr) {
      EXPECT_EQ(classes.try_emplace(metric.gate->name, metric.gate).first->second, metric.gate);
    }
  }
}

TEST(Catalog, RowsAreFoundByTheirKeys) {
  constexpr MetricId kTets = metric_id("counts.tets");
  EXPECT_EQ(metric(kTets).name, "tetrahedra");
  EXPECT_EQ(all_metrics().size(), kMetricCount);
  EXPECT_EQ(all_metrics()[static_cast<std::size_t>(kTets)], kTets);
}

TEST(Catalog, FiguresAreDerivedFromOthers) {
  Figures figures;
  figures.derive();
  EXPECT_FALSE(figures[metric_id("elements")].has_value());
  EXPECT_FALSE(figures[metric_id("time_ratio")].has_value());
  figures[metric_id("counts.tets")] = 30;
  figures[metric_id("counts.hexes")] = 10;
  figures[metric_id("time_s.mesh")] = 4;
  figures[metric_id("time_s.cpu")] = 6;
  figures[metric_id("time_s.reference_cpu")] = 0;
  figures.derive();
  EXPECT_EQ(figures[metric_id("elements")], 40);
  EXPECT_EQ(figures[metric_id("elements_per_second")], 10);
  EXPECT_FALSE(figures[metric_id("time_ratio")].has_value());  // nothing to divide by
  figures[metric_id("time_s.reference_cpu")] = 2;
  figures.derive();
  EXPECT_EQ(figures[metric_id("time_ratio")], 3);
  EXPECT_FALSE(figures[metric_id("dice_shortfall")].has_value());
  figures[metric_id("fidelity.dice_min")] = .75;
  figures.derive();
  EXPECT_EQ(figures[metric_id("dice_shortfall")], .25);
}

TEST(Catalog, TitlesAndTables) {
  const Metric& distance = metric(metric_id("fidelity.hausdorff_mm"));
  EXPECT_EQ(title(distance), "HD (mm)");
  EXPECT_EQ(words(distance), "Hausdorff distance (the paper's)");
  EXPECT_TRUE(is_shown_in(distance, "fidelity"));
  EXPECT_TRUE(is_shown_in(distance, "speed"));
  EXPECT_FALSE(is_shown_in(distance, "fid"));
  EXPECT_FALSE(is_shown_in(distance, ""));
  EXPECT_EQ(title(metric(metric_id("threads"))), "threads");
  EXPECT_EQ(words(metric(metric_id("threads"))), "threads");
}

TEST(Catalog, TextHasARowForEveryMetric) {
  const std::string text = catalog_text();
  EXPECT_EQ(static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')), kMetricCount + 2);
  EXPECT_NE(text.find("| `fidelity.hd95_mm` | 95 % surface distance (mm) | higher | distance: 5 % or 0.01 | "
                      "distance | fidelity deformation_patterns targets | yes |\n"),
            std::string::npos)
      << text;
}

/// "/quality/edge_ratio/max".
nlohmann::json::json_pointer pointer_to(std::string_view key) {
  std::string path = "/" + std::string(key);
  std::replace(path.begin(), path.end(), '.', '/');
  return nlohmann::json::json_pointer(path);
}

/// Every metric that evaluate() gives, and not a job, has its key in what evaluate() returns, of each label
/// too.
TEST(Catalog, KeysAreThoseOfAnEvaluation) {
  const nlohmann::json evaluation = test::judge(test::kuhn_mesh(test::two_boxes()), test::two_boxes());
  for (const Metric& metric : kCatalog) {
    const std::string section(metric.key.substr(0, metric.key.find('.')));
    if (section != "shape" && evaluation.contains(section) && section.size() < metric.key.size()) {
      EXPECT_TRUE(evaluation.contains(pointer_to(metric.key))) << metric.key;
    }
    if (section != "shape" && !metric.per_label.empty()) {
      std::string path(metric.per_label);
      path.replace(path.find(".per_label."), 11, ".per_label.0.");
      EXPECT_TRUE(evaluation.contains(pointer_to(path))) << path;
    }
    if (!metric.worst_label.empty()) {
      EXPECT_TRUE(evaluation["summary"].contains(std::string(metric.worst_label.substr(8))))
          << metric.worst_label;
    }
  }
}

}  // namespace
}  // namespace cbc3d::metrics
