#include "reports/sweep/sweep.hpp"

#include <gtest/gtest.h>

#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"
#include "reports/charts/chart.hpp"
#include "reports/output/html.hpp"
#include "reports/output/output.hpp"
#include "reports/results/statistics.hpp"
#include "reports/results/testing_folder.hpp"
#include "reports/tables/markup.hpp"
#include "reports/tables/setting_tables.hpp"

namespace cbc3d::reports {
namespace {

Json sample(int threads, int repeat, double seconds) {
  Json line = empty_result();
  line["case"] = "box";
  line["mesher"] = "cbc3d";
  line["threads"] = threads;
  line["repeat"] = repeat;
  line["status"] = "ok";
  line["time_s"] = {{"mesh", seconds},
                    {"cpu", seconds},
                    {"stages", {{"lattice", seconds / 4}, {"deformation", seconds / 2}}}};
  return line;
}

std::vector<Json> sweep() {
  std::vector<Json> lines;
  const std::vector<double> one{4.0, 4.1, 3.9, 4.0, 9.0};
  const std::vector<double> two{2.5, 2.4, 2.6, 2.5, 2.5};
  for (int repeat = 0; repeat < 5; ++repeat) {
    lines.push_back(sample(1, repeat, one[static_cast<std::size_t>(repeat)]));
    lines.push_back(sample(2, repeat, two[static_cast<std::size_t>(repeat)]));
  }
  return lines;
}

TEST(Statistics, AreThoseOfTheTextbook) {
  EXPECT_EQ(median({3, 1, 2}), 2);
  EXPECT_EQ(median({4, 1, 2, 3}), 2.5);
  EXPECT_NEAR(spread({1, 2, 3, 4, 100}), 1.4826, 1e-9);
  EXPECT_EQ(median_error({7}), 0);
  EXPECT_NEAR(median_error({1, 2, 3, 4, 5}), 1.2533 * 1.4826 / std::sqrt(5.0), 1e-9);
  EXPECT_EQ(outliers({1, 2, 90}), std::vector<bool>(3, false));
  EXPECT_EQ(outliers({1, 1.1, 0.9, 1, 90}), (std::vector<bool>{false, false, false, false, true}));
}

TEST(Sweep, SpeedUpAndEfficiencyComeWithTheirErrors) {
  const std::vector<SweepPoint> points = sweep_points(sweep());
  ASSERT_EQ(points.size(), 2U);
  EXPECT_FALSE(points[0].has_speed_up);
  EXPECT_EQ(points[0].total.seconds.size(), 5U);
  EXPECT_TRUE(points[0].total.outlier[4]);
  EXPECT_DOUBLE_EQ(points[1].speed_up.value, 4.0 / 2.5);
  EXPECT_DOUBLE_EQ(points[1].efficiency.value, 0.8);
  const double relative = points[0].total.error_s / 4.0;
  EXPECT_GT(relative, 0);
  EXPECT_NEAR(points[1].speed_up.error, 1.6 * std::hypot(relative, points[1].total.error_s / 2.5), 1e-12);
  ASSERT_EQ(points[1].stages.size(), 2U);
  EXPECT_DOUBLE_EQ(points[1].stages[1].second.median_s, 1.25);
  ASSERT_EQ(points[1].stage_speed_ups.size(), 2U);
  EXPECT_DOUBLE_EQ(points[1].stage_speed_ups[0].value, 1.6);
}

TEST(Sweep, AllSamplesAreKeptAndOutliersFlagged) {
  const Json json = to_json(sweep_points(sweep()));
  EXPECT_EQ(json[0]["seconds"]["samples"], Json({4.0, 4.1, 3.9, 4.0, 9.0}));
  EXPECT_EQ(json[0]["seconds"]["outlier"][4], true);
  EXPECT_TRUE(json[0]["speed_up"].is_null());
  const std::string text = to_markdown(sweep_tables(sweep_points(sweep()))[0]);
  EXPECT_NE(text.find("9.000 (#5)"), std::string::npos) << text;
  EXPECT_NE(text.find("1.60 ±"), std::string::npos) << text;
}

TEST(Sweep, AFailedSampleIsSaid) {
  std::vector<Json> lines = sweep();
  lines[1]["status"] = "crashed";
  lines[1]["reason"] = "SIGSEGV";
  const std::vector<SweepPoint> points = sweep_points(lines);
  EXPECT_EQ(points[1].total.seconds.size(), 4U);
  EXPECT_EQ(points[1].failure, "crashed: SIGSEGV");
}

TEST(Sweep, FiguresAreOneForTimesSpeedUpAndStages) {
  const std::vector<Figure> figures = sweep_figures(sweep_points(sweep()));
  ASSERT_EQ(figures.size(), 3U);
  EXPECT_EQ(figures[1].name, "sweep-speed-up-box");
  for (const Figure& figure : figures) {
    EXPECT_EQ(figure.svg.find("nan"), std::string::npos) << figure.name;
    EXPECT_NE(figure.svg.find("</svg>"), std::string::npos);
  }
}

TEST(Sweep, MicrobenchmarksAreATable) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "micro.json";
  write_text_file(file, R"({"benchmarks": [{"name": "lattice/48", "run_type": "iteration", "iterations": 7,
    "real_time": 2.5, "cpu_time": 2000.0, "time_unit": "ms", "items_per_second": 12000.0}]})");
  const auto other = folder.path() / "other.json";
  write_text_file(other, R"({"benchmarks": [{"name": "copy", "of_bandwidth": 0.425}]})");
  const Table table = microbenchmark_table(read_microbenchmarks({file, other}));
  ASSERT_EQ(table.rows.size(), 2U);
  EXPECT_EQ(table.rows[1].case_name, "copy");
  EXPECT_EQ(cell_text(table.rows[1].cells[5], 3), "42.50");
  EXPECT_FALSE(table.rows[0].cells[5].value.has_value());
  EXPECT_EQ(table.rows[0].cells[0].value, 2.5);
  EXPECT_EQ(table.rows[0].cells[3].value, 12000);
  EXPECT_FALSE(table.rows[0].cells[4].value.has_value());
  write_text_file(file, "[]");
  EXPECT_THROW(read_microbenchmarks({other, file}), InputError);
  EXPECT_THROW(read_microbenchmarks({folder.path() / "none"}), InputError);
}

TEST(Chart, TicksAreThoseAPersonWouldChoose) {
  EXPECT_EQ(axis_ticks(0), (std::vector<double>{0, 1}));
  EXPECT_EQ(axis_ticks(10), (std::vector<double>{0, 2, 4, 6, 8, 10}));
  EXPECT_EQ(axis_ticks(0.9).size(), 6U);
  EXPECT_GE(axis_ticks(123).back(), 123);
}

TEST(Chart, TextIsEscapedAndGapsAreLeftOut) {
  Chart chart;
  chart.title = "a < b & \"c\"";
  chart.categories = {"x", "y"};
  chart.series = {{"<one>", {1, std::numeric_limits<double>::quiet_NaN()}, {0.5, 0}, false}};
  for (const bool logarithmic : {false, true}) {
    chart.logarithmic = logarithmic;
    for (const std::string& svg : {bar_chart(chart), line_chart(chart)}) {
      EXPECT_NE(svg.find("a &lt; b &amp; &quot;c&quot;"), std::string::npos);
      EXPECT_EQ(svg.find("<one>"), std::string::npos);
      EXPECT_EQ(svg.find("nan"), std::string::npos);
    }
  }
}

TEST(Markup, Base64IsThatOfTheStandard) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
}

Json deformed(const std::string& case_name, const std::string& iterations, double distance) {
  Json line = sample(1, 0, 2);
  line["case"] = case_name;
  line["mesher"] = "cbc3d-paper";
  line["parameters"] = {{"iterations", iterations}};
  line["fidelity"]["hausdorff_mm"] = distance;
  line["mesher_report"]["deformation"] = {{"targets", 2801}};
  return line;
}

TEST(SettingTables, PatternsStandBesideThePapers) {
  cases::Case subject;
  subject.name = "nidus-vertex";
  subject.deformation_pattern = {"vertex", "as it is", "nidus-lattice"};
  const std::vector<Json> results{deformed("nidus-lattice", "0", 1.8), deformed("nidus-vertex", "10", 0.9)};
  const Table table = deformation_pattern_table(results, {subject});
  ASSERT_EQ(table.rows.size(), 1U);
  EXPECT_EQ(table.rows[0].figure, "vertex, as it is");
  EXPECT_EQ(cell_text(table.rows[0].cells[0], 2), "2,801 (paper: 2,770)");
  EXPECT_EQ(cell_text(table.rows[0].cells[1], 2), "1.80 (paper: 1.79)");
  EXPECT_EQ(cell_text(table.rows[0].cells[2], 2), "0.90 (paper: 0.97)");
  EXPECT_EQ(cell_text(table.rows[0].cells.back(), 2), "1.00 (paper: 21.01)");
  const Table lone = deformation_pattern_table({results[1]}, {subject});
  EXPECT_NE(lone.rows[0].cells[1].reason.find("nidus-lattice"), std::string::npos);
}

TEST(SettingTables, ImageDataAndParametersStandBesideThePapers) {
  Json line = deformed("box", "7", 1);
  line["image"] = {{"size", {8, 9, 10}}, {"spacing_mm", {0.5, 0.5, 1.25}}, {"labels", {1, 4}}};
  const Table images = image_data_table({line}, {});
  ASSERT_EQ(images.rows.size(), 5U);
  EXPECT_EQ(images.rows[0].cells[0].text, "anisotropic");
  EXPECT_EQ(images.rows[0].cells[2].text, "0.50 x 0.50 x 1.25");
  EXPECT_EQ(images.rows[4].cells[3].text, "1001 x 1001 x 4182");
  const std::string text = to_markdown(input_parameter_table({line}));
  EXPECT_NE(text.find("| cbc3d-paper "), std::string::npos);
  EXPECT_NE(text.find("5 (cases 1-3), 7 (case 4)"), std::string::npos);
  EXPECT_NE(text.find("podm (not run)"), std::string::npos);
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) {
    ++found;
  }
  return found;
}

TEST(Html, HoldsEverythingAndAsksForNothing) {
  const TemporaryFolder folder;
  write_text_file(folder.path() / "sweep.json", "[]");
  std::filesystem::create_directories(folder.path() / "small");
  write_text_file(folder.path() / "small" / "box-cbc3d-cut.jpg", "no real picture");
  std::vector<Json> results = sweep();
  results[3]["status"] = "crashed";
  results[3]["reason"] = "<script>alert(\"x\")</script> & more";
  results[0]["provenance"] = {{"git_commit", "0123abc"}, {"compiler", "GNU"}, {"seed", "1"}};
  const std::string html = to_html({"A \"title\"",
                                    results,
                                    {},
                                    all_tables(folder.path(), results, {}),
                                    all_figures(folder.path(), results),
                                    folder.path() / "small"});
  EXPECT_EQ(count(html, "<script"), 0U);
  EXPECT_EQ(count(html, "http://") - count(html, "xmlns=\"http://"), 0U);
  EXPECT_EQ(count(html, "https://"), 0U);
  EXPECT_EQ(count(html, "<link"), 0U);
  EXPECT_EQ(count(html, "src=\"data:image/jpeg;base64,"), 1U);
  EXPECT_EQ(count(html, "src="), 1U);
  EXPECT_NE(html.find("&lt;script&gt;alert(&quot;x&quot;)"), std::string::npos);
  EXPECT_NE(html.find("width=device-width"), std::string::npos);
  EXPECT_NE(html.find("@media print"), std::string::npos);
  for (const char* tag :
       {"table", "section", "figure", "svg", "div", "tr", "h2", "ol", "dl", "thead", "tbody"}) {
    const std::string name = tag;
    EXPECT_EQ(count(html, "<" + name + " ") + count(html, "<" + name + ">"), count(html, "</" + name + ">"))
        << tag;
  }
  // Provenance comes last.
  EXPECT_GT(html.find("id=\"provenance\""), html.find("id=\"failed\""));
  EXPECT_GT(html.rfind("0123abc"), html.find("id=\"provenance\""));
}

}  // namespace
}  // namespace cbc3d::reports
