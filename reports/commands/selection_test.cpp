#include "reports/commands/selection.hpp"

#include <gtest/gtest.h>

#include "mesher/testing/error_of.hpp"
#include "mesher/testing/temporary_folder.hpp"

namespace cbc3d::reports {
namespace {

using cbc3d::testing::error_of;

/// Two cases in a folder: `shells` in the suites small and all, `torus` in all.
class SelectionTest : public ::testing::Test {
 protected:
  SelectionTest() {
    const std::map<std::string, std::vector<std::string>> suites_of{{"shells", {"small", "all"}},
                                                                    {"torus", {"all"}}};
    for (const auto& [name, suites] : suites_of) {
      const nlohmann::json phantom{
          {"name", "shells"}, {"size", {16, 16, 16}}, {"spacing_mm", {1, 1, 1}}, {"seed", 1}};
      const nlohmann::json manifest{
          {"name", name}, {"title", "A phantom"}, {"suites", suites}, {"image", {{"phantom", phantom}}}};
      folder_.write(name + ".json", manifest.dump());
    }
    selection_.manifests = folder_.path();
  }
  [[nodiscard]] std::vector<std::string> chosen() const {
    std::vector<std::string> names;
    for (const cases::Case& subject : make_bench(selection_, folder_.path()).cases) {
      names.push_back(subject.name);
    }
    return names;
  }
  [[nodiscard]] std::string refusal() const {
    return error_of([&] { make_bench(selection_, folder_.path()); });
  }

  cbc3d::testing::TemporaryFolder folder_{"selection"};
  Selection selection_;
};

using Names = std::vector<std::string>;

TEST_F(SelectionTest, ASuiteIsItsCasesAndNoneIsTakenTwice) {
  selection_.suites = {"small", "all"};
  EXPECT_EQ(chosen(), (Names{"shells", "torus"}));
  selection_.suites = {"small"};
  EXPECT_EQ(chosen(), Names{"shells"});
}

TEST_F(SelectionTest, CasesComeInTheOrderGiven) {
  selection_.cases = {"torus", "shells", "torus"};
  EXPECT_EQ(chosen(), (Names{"torus", "shells"}));
}

TEST_F(SelectionTest, WhatIsUnknownIsNamedWithWhatThereIs) {
  EXPECT_NE(refusal().find("give either --suite or --case"), std::string::npos) << refusal();
  selection_.cases = {"nidus"};
  EXPECT_EQ(refusal(), "--case 'nidus' is unknown; there are shells, torus");
  selection_.suites = {"large"};
  EXPECT_NE(refusal().find("give either --suite or --case"), std::string::npos) << refusal();
  selection_.cases.clear();
  EXPECT_NE(refusal().find("--suite 'large' is unknown"), std::string::npos) << refusal();
  selection_.suites = {"all"};
  selection_.meshers = {"nonsense"};
  EXPECT_NE(refusal().find("--mesher 'nonsense' is unknown; there are cbc3d"), std::string::npos)
      << refusal();
}

TEST_F(SelectionTest, MeshersAreAllOrThoseGiven) {
  selection_.suites = {"all"};
  EXPECT_EQ(make_bench(selection_, folder_.path()).meshers.size(), all_meshers({}).size());
  selection_.meshers = {"cgal", "cbc3d", "cgal"};
  const Bench bench = make_bench(selection_, folder_.path());
  ASSERT_EQ(bench.meshers.size(), 2U);
  EXPECT_EQ(bench.meshers[0].name, "cgal");
  EXPECT_EQ(bench.meshers[1].name, "cbc3d");
}

TEST_F(SelectionTest, SettingsAreByMesherAndMayHoldAnyText) {
  selection_.settings = {"cgal.cell-size=2", "cgal.facet-size=a=b.c", "cbc3d.preset=paper"};
  const std::map<std::string, Parameters> expected{{"cgal", {{"cell-size", "2"}, {"facet-size", "a=b.c"}}},
                                                   {"cbc3d", {{"preset", "paper"}}}};
  EXPECT_EQ(parse_settings(selection_), expected);
  for (const char* bad : {"cgal", "cgal.size", "cgal=2", ".size=2", "cgal=2.5"}) {
    selection_.settings = {bad};
    EXPECT_NE(error_of([&] { parse_settings(selection_); }).find("give MESHER.KEY=VALUE"), std::string::npos)
        << bad;
  }
  selection_.settings = {"nonsense.size=2"};
  EXPECT_NE(error_of([&] { parse_settings(selection_); }).find("mesher 'nonsense' is unknown"),
            std::string::npos);
}

TEST(ParseShard, TakesOneOfN) {
  const Shard shard = parse_shard("2/8");
  EXPECT_EQ(shard.index, 2);
  EXPECT_EQ(shard.count, 8);
  EXPECT_EQ(parse_shard("1/1").count, 1);
  for (const char* bad : {"", "2", "/", "2/", "/8", "0/8", "9/8", "2/8x", "a/b", "-1/3", "2 /8"}) {
    EXPECT_NE(error_of([&] { parse_shard(bad); }).find("give I/N with I from 1 to N"), std::string::npos)
        << bad;
  }
}

TEST(LimitOptions, TheCommandLineGivesThreadsRepeatsAndLimits) {
  CLI::App app;
  RunOptions run;
  double memory_limit_gib = 16;
  add_limit_options(&app, run, memory_limit_gib);
  app.parse(
      "--threads 1,2,0 --repeat 3 --timeout 2.5 --memory-limit 0.5 --evaluation-timeout 7 --file-limit 0.25");
  EXPECT_EQ(run.threads, (std::vector<int>{1, 2, 0}));
  EXPECT_EQ(run.repeats, 3);
  EXPECT_EQ(run.timeout_s, 2.5);
  EXPECT_EQ(memory_limit_gib, 0.5);
  EXPECT_THROW(app.parse("--repeat 0"), CLI::ValidationError);
  EXPECT_EQ(run.evaluation_timeout_s, 7);
  EXPECT_EQ(run.file_limit_bytes, std::int64_t{1} << 28);
  for (const char* const bad :
       {"--timeout -1", "--timeout nan", "--memory-limit inf", "--file-limit 1e300"}) {
    EXPECT_THROW(app.parse(bad), CLI::ValidationError) << bad;
  }
}

}  // namespace
}  // namespace cbc3d::reports
