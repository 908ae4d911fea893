#include "reports/results/result.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <regex>

#include "mesher/core/error.hpp"
#include "mesher/testing/temporary_folder.hpp"
#include "metrics/catalog.hpp"

namespace cbc3d::reports {
namespace {

using cbc3d::testing::TemporaryFolder;

Json line(const std::string& case_name, int repeat) {
  Json result = empty_result();
  result["case"] = case_name;
  result["mesher"] = "cgal";
  result["threads"] = 2;
  result["repeat"] = repeat;
  return result;
}

TEST(Result, ComesBackAsItWasAppended) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "results.jsonl";
  EXPECT_TRUE(read_results(file).empty());
  Json first = line("liver", 0);
  first["reason"] = "two\nlines and \"quotes\"";
  append_result(file, first);
  append_result(file, line("liver", 1));
  const std::vector<Json> results = read_results(file);
  ASSERT_EQ(results.size(), 2U);
  EXPECT_EQ(results[0], first);
  EXPECT_EQ(result_id(results[1]), "liver-cgal-t2-r1");
}

TEST(Result, HasEveryKeyOfALine) {
  const Json result = empty_result();
  for (const char* key :
       {"case", "mesher", "threads", "repeat", "parameters", "status", "reason", "mesh_file", "counts",
        "quality", "fidelity", "topology", "time_s", "peak_rss_bytes", "provenance"}) {
    EXPECT_TRUE(result.contains(key)) << key;
  }
  for (const metrics::Metric& metric : metrics::kCatalog) {
    EXPECT_EQ(metric.source == metrics::Source::line,
              result.contains(Json::json_pointer(
                  "/" + std::regex_replace(std::string(metric.key), std::regex("\\."), "/"))))
        << metric.key;
  }
  EXPECT_TRUE(figure(result, {"fidelity", "hausdorff_mm"}).is_null());
  EXPECT_TRUE(figure(result, {"no", "such", "figure"}).is_null());
}

TEST(Result, TakesOnlyTheFiguresOfAnEvaluation) {
  Json result = line("liver", 0);
  merge_evaluation(result, {{"counts", {{"tets", 7}}}, {"case", "another"}, {"topology", nullptr}});
  EXPECT_EQ(result["counts"]["tets"], 7);
  EXPECT_TRUE(result["counts"]["hexes"].is_null());
  EXPECT_EQ(result["case"], "liver");
  EXPECT_TRUE(result["topology"].is_object());
  merge_evaluation(result,
                   {{"shape", {{"figure", 1}}}, {"image", {{"size", {1, 2, 3}}}}, {"colour", {{"a", 1}}}});
  EXPECT_EQ(result["shape"]["figure"], 1);
  EXPECT_EQ(result["image"]["size"].size(), 3U);
  EXPECT_FALSE(result.contains("colour"));
}

TEST(Result, PathsAreSplitAtTheirDots) {
  EXPECT_EQ(split_path("fidelity.hausdorff_mm"), (std::vector<std::string>{"fidelity", "hausdorff_mm"}));
  EXPECT_EQ(split_path("threads"), std::vector<std::string>{"threads"});
}

TEST(Result, LinesOfSeveralWritersDoNotMix) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "results.jsonl";
  constexpr int kWriters = 4;
  constexpr int kLines = 50;
  for (int writer = 0; writer < kWriters; ++writer) {
    if (::fork() == 0) {
      for (int n = 0; n < kLines; ++n) {
        Json result = line("case" + std::to_string(writer), n);
        result["reason"] = std::string(20000, 'x');
        append_result(file, result);
      }
      std::_Exit(0);
    }
  }
  while (::wait(nullptr) > 0) {
  }
  EXPECT_EQ(read_results(file).size(), static_cast<std::size_t>(kWriters * kLines));
}

TEST(Result, ALineThatWasCutOffIsLeftOutAndRemoved) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "results.jsonl";
  append_result(file, line("liver", 0));
  std::ofstream(file, std::ios::app) << "{\"case\":\"li";
  EXPECT_EQ(read_results(file).size(), 1U);
  drop_torn_line(file);
  append_result(file, line("liver", 1));
  EXPECT_EQ(read_results(file).size(), 2U);
}

TEST(Result, ALineThatIsNoObjectIsNamed) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "results.jsonl";
  append_result(file, line("liver", 0));
  std::ofstream(file, std::ios::app) << "oops\n";
  try {
    read_results(file);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("line 2"), std::string::npos);
  }
}

TEST(Result, AFileThatCannotBeWrittenIsAnError) {
  EXPECT_THROW(append_result("/nowhere/results.jsonl", line("liver", 0)), JobError);
  if (std::filesystem::exists("/dev/full")) {
    EXPECT_THROW(append_result("/dev/full", line("liver", 0)), JobError);
  }
}

}  // namespace
}  // namespace cbc3d::reports
