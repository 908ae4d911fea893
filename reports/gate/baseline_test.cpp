#include "reports/gate/baseline.hpp"

#include <gtest/gtest.h>

#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"
#include "mesher/testing/error_of.hpp"
#include "mesher/testing/temporary_folder.hpp"
#include "reports/gate/testing_gate.hpp"

namespace cbc3d::reports {
namespace {

using cbc3d::testing::error_of;
using cbc3d::testing::TemporaryFolder;

const std::string kJob = "box, cbc3d, 1 thread";

Json with_known(Json former, const std::string& job, const std::string& figure) {
  former["known_failures"].push_back({{"job", job}, {"figure", figure}, {"reason", "issue of the tracker"}});
  return former;
}

std::vector<Json> of_case(const std::string& name, int tets = 20) {
  std::vector<Json> run = good_run();
  for (Json& line : run) {
    line["case"] = name;
    line["counts"]["tets"] = tets;
  }
  return run;
}

std::vector<Json> crashed(const std::string& name) {
  std::vector<Json> run = of_case(name);
  for (Json& line : run) {
    line["status"] = "crashed";
    line["reason"] = "SIGSEGV";
  }
  return run;
}

std::vector<Json> joined(std::vector<Json> a, const std::vector<Json>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

TEST(Baseline, HasASampleOfTimeForEveryRepeat) {
  const Json entry = baseline()["jobs"][0];
  EXPECT_EQ(entry["samples"]["time_ratio"], Json({50.0, 50.0}));
  EXPECT_EQ(entry["samples"]["time_s.cpu"], Json({1.0, 1.0}));
  EXPECT_EQ(name_of_entry(entry), kJob);
}

TEST(Baseline, APartialUpdateTakesInTheRunsJobsAlone) {
  const Json former =
      make_baseline(decode_lines(joined(of_case("box"), of_case("ball"))), Json(), "the first");
  const auto run = decode_lines(joined(of_case("ball", 25), of_case("new")));
  const Json next = make_baseline(run, former, "ball alone", true);
  ASSERT_EQ(next["jobs"].size(), 3U);
  EXPECT_EQ(next["jobs"][0], former["jobs"][0]);
  EXPECT_EQ(next["jobs"][1]["case"], "ball");
  EXPECT_EQ(next["jobs"][1]["figures"]["counts.tets"], 25);
  EXPECT_EQ(next["jobs"][2]["case"], "new");
  EXPECT_EQ(next["history"][1]["jobs"], Json({"ball, cbc3d, 1 thread", "new, cbc3d, 1 thread"}));
  EXPECT_EQ(make_baseline(run, former, "all")["jobs"].size(), 2U);
}

TEST(Baseline, APartialRunFallsByItsOwnJobsAlone) {
  const Json former = make_baseline(decode_lines(joined(of_case("box"), of_case("ball"))), Json(), "why");
  const Verdict whole = compare_lines(of_case("box"), former),
                part = compare_lines(of_case("box"), former, {.is_partial = true});
  EXPECT_EQ(whole.fallen(), 1U);
  EXPECT_TRUE(part.holds());
  EXPECT_EQ(part.notes, std::vector<std::string>{"ball, cbc3d, 1 thread: not run"});
  EXPECT_FALSE(compare_lines(of_case("box", 21), former, {.is_partial = true}).holds());
}

TEST(KnownFailures, DoNotFallAndAreNamed) {
  const Json known = with_known(baseline(), kJob, "counts.tets");
  const Verdict verdict = compare_lines(of_case("box", 21), known);
  EXPECT_TRUE(verdict.holds());
  EXPECT_NE(to_text(verdict).find("known   " + kJob +
                                  ": tetrahedra was 20, is 21 (+1, +5.0 %; allowed 0) "
                                  "(known: issue of the tracker)\n"),
            std::string::npos)
      << to_text(verdict);
  EXPECT_NE(to_text(verdict).find("0 fell, 1 known to fail: the gate holds"), std::string::npos);
  EXPECT_NE(to_junit(verdict).find("failures=\"0\" errors=\"0\" skipped=\"1\""), std::string::npos);
  EXPECT_NE(to_junit(verdict).find("<skipped message=\"tetrahedra was 20"), std::string::npos);
  EXPECT_NE(to_step_summary(verdict).find("| counts.tets | tetrahedra was 20"), std::string::npos);
}

TEST(KnownFailures, AnotherFigureStillFalls) {
  const Json known = with_known(baseline(), kJob, "counts.vertices");
  EXPECT_FALSE(compare_lines(of_case("box", 21), known).holds());
}

TEST(KnownFailures, OneThatPassesIsSaid) {
  const Verdict verdict = compare_lines(good_run(), with_known(baseline(), kJob, "counts.tets"));
  EXPECT_TRUE(verdict.holds());
  const std::string text = to_text(verdict);
  EXPECT_NE(text.find("passes  " + kJob), std::string::npos) << text;
  EXPECT_NE(text.find("(it was known to fail: issue of the tracker; take it off \"known_failures\")"),
            std::string::npos);
}

TEST(KnownFailures, OneOfNoJobIsNoted) {
  const Verdict verdict = compare_lines(good_run(), with_known(baseline(), "ball, cgal, 1 thread", "labels"));
  EXPECT_EQ(verdict.notes,
            std::vector<std::string>{"ball, cgal, 1 thread: its known failure of labels was not compared"});
}

TEST(KnownFailures, AJobThatAlwaysFailedNeedsNoFigures) {
  const Json known = with_known(baseline(), "ball, cbc3d, 1 thread", "status");
  const Verdict fails = compare_lines(joined(good_run(), crashed("ball")), known);
  EXPECT_TRUE(fails.holds()) << to_text(fails);
  EXPECT_NE(to_text(fails).find("known   ball, cbc3d, 1 thread: is crashed: SIGSEGV"), std::string::npos);
  const Verdict passes = compare_lines(joined(good_run(), of_case("ball")), known);
  EXPECT_EQ(passes.count(Known::passes), 1U) << to_text(passes);
}

TEST(KnownFailures, AnUpdateKeepsThemAndWhatTheFigureShouldBe) {
  const Json known =
      with_known(with_known(baseline(), kJob, "counts.tets"), "ball, cbc3d, 1 thread", "status");
  const auto run = decode_lines(joined(of_case("box", 21), crashed("ball")));
  const Json next = make_baseline(run, known, "why");
  ASSERT_EQ(next["jobs"].size(), 1U);
  EXPECT_EQ(next["jobs"][0]["figures"]["counts.tets"], 20);
  EXPECT_EQ(next["known_failures"], known["known_failures"]);
  EXPECT_THROW(make_baseline(run, baseline(), "why"), InputError);  // nobody knows of the crash
}

TEST(Baseline, BadKnownFailuresAndSamplesAreRefusedByFileAndKey) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "b.json";
  const auto error_at = [&](const char* pointer, const Json& value) {
    Json bad = with_known(baseline(), kJob, "counts.tets");
    bad[Json::json_pointer(pointer)] = value;
    write_text_file(file, bad.dump());
    return error_of([&] { read_baseline(file); });
  };
  EXPECT_NE(error_at("/known_failures/0/figure", 3).find("\"known_failures[0].figure\" is 3; give a text"),
            std::string::npos);
  EXPECT_NE(error_at("/known_failures", "x").find("\"known_failures\" is \"x\"; give a list"),
            std::string::npos);
  EXPECT_NE(error_at("/jobs/0/samples/time_ratio", "x").find("samples.time_ratio\" is \"x\"; give a list"),
            std::string::npos);
  EXPECT_NE(error_at("/jobs/0/parameters_in_force", 1).find("parameters_in_force\" is 1; give an object"),
            std::string::npos);
  EXPECT_EQ(error_at("/jobs/0/samples/time_ratio", {1.0, 2.0}), "");
}

}  // namespace
}  // namespace cbc3d::reports
