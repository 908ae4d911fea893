#include "reports/gate/gate.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"
#include "mesher/testing/temporary_folder.hpp"
#include "reports/gate/gate_job.hpp"
#include "reports/gate/testing_gate.hpp"
#include "reports/run/child_process.hpp"

namespace cbc3d::reports {
namespace {

using cbc3d::testing::TemporaryFolder;

TEST(Gate, HoldsForTheSameRun) {
  const Verdict verdict = compare_lines(good_run(), baseline());
  EXPECT_TRUE(verdict.holds()) << to_text(verdict);
  EXPECT_GT(verdict.checks.size(), 12U);
}

struct Planted {
  const char* pointer;
  Json value;
  const char* words;  // that the text must have
};

class PlantedRegression : public ::testing::TestWithParam<Planted> {};

TEST_P(PlantedRegression, Falls) {
  std::vector<Json> run = good_run();
  for (Json& line : run) {
    line[Json::json_pointer(GetParam().pointer)] = GetParam().value;
  }
  const Verdict verdict = compare_lines(run, baseline());
  ASSERT_EQ(verdict.fallen(), 1U) << to_text(verdict);
  EXPECT_TRUE(verdict.checks[0].fell);
  EXPECT_NE(to_text(verdict).find(GetParam().words), std::string::npos) << to_text(verdict);
  EXPECT_NE(to_junit(verdict).find("failures=\"1\""), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, PlantedRegression,
    ::testing::Values(
        Planted{"/counts/tets", 21, "tetrahedra was 20, is 21 (+1, +5.0 %; allowed 0)"},
        Planted{"/counts/vertices", 9, "vertices was 10, is 9"},
        Planted{"/quality/min_dihedral_deg", 11.0, "smallest dihedral angle was 12 deg, is 11 deg"},
        Planted{"/quality/max_dihedral_deg", 153.0, "largest dihedral angle"},
        Planted{"/quality/inverted", 1, "inverted elements was 0, is 1"},
        Planted{"/fidelity/hausdorff_mm", 2.2, "Hausdorff distance (the paper's) was 2 mm, is 2.2000 mm"},
        Planted{"/fidelity/per_label/0/volume_error_percent", 2.5, "largest volume error"},
        Planted{"/fidelity/missing_labels", {7}, "label 7 was in the mesh and is not any more"},
        Planted{"/topology/conforming", false, "conforming was 1, is 0"},
        Planted{"/topology/self_intersections", 1, "self-intersections was 0, is 1 (+1; allowed 0)"},
        Planted{"/peak_rss_bytes", 200'000'000, "peak memory was 100.0 MB, is 200.0 MB"},
        Planted{"/time_s/cpu", 1.5, "CPU time over the reference work's was 50, is 75"},
        Planted{"/status", "crashed", "was ok, is crashed"},
        Planted{"/parameters", {{"size", "2"}}, "run as the baseline was, or --update"}));

TEST(Gate, LetsPassWhatIsWithinBothTolerances) {
  std::vector<Json> run = good_run();
  for (Json& line : run) {
    line["quality"]["min_dihedral_deg"] = 11.6;  // -3 %, but only .4 degrees
    line["fidelity"]["hausdorff_mm"] = 2.09;
    line["peak_rss_bytes"] = 140'000'000;
    line["time_s"]["cpu"] = 1.35;
  }
  EXPECT_TRUE(compare_lines(run, baseline()).holds()) << to_text(compare_lines(run, baseline()));
}

TEST(Gate, AMachineHalfAsFastIsNoRegression) {
  std::vector<Json> run = good_run();
  for (Json& line : run) {
    line["time_s"]["cpu"] = 2.0;
    line["time_s"]["reference_cpu"] = 0.04;
  }
  EXPECT_TRUE(compare_lines(run, baseline()).holds());
}

TEST(Gate, ThePriceOfMemoryPagesIsTheMachines) {
  std::vector<Json> run = good_run();
  for (Json& line : run) {
    line["time_s"]["cpu"] = 2.0;
    line["time_s"]["system_cpu"] = 1.0;
  }
  EXPECT_TRUE(compare_lines(run, baseline()).holds());
}

TEST(Gate, RepeatsOfADeterministicMesherMustBeTheSame) {
  std::vector<Json> run = good_run();
  run[1]["mesh_sha256"] = "bb";
  const Verdict verdict = compare_lines(run, baseline());
  EXPECT_EQ(verdict.fallen(), 1U);
  EXPECT_NE(to_text(verdict).find("mesh_sha256 is \"aa\" in repeat 0 and \"bb\" in repeat 1"),
            std::string::npos);
  EXPECT_THROW(make_baseline(decode_lines(run), Json(), "no"), InputError);
}

TEST(Gate, CountsOfOtherMeshersHaveATolerance) {
  std::vector<Json> run = good_run();
  for (Json& line : run) {
    line["provenance"]["mesher_deterministic"] = false;
    line["counts"]["tets"] = 1000;
  }
  const Json free = make_baseline(decode_lines(run), Json(), "free");
  run[1]["mesh_sha256"] = "bb";
  for (Json& line : run) {
    line["counts"]["tets"] = 1040;
  }
  EXPECT_TRUE(compare_lines(run, free).holds()) << to_text(compare_lines(run, free));
  for (Json& line : run) {
    line["counts"]["tets"] = 1060;
  }
  EXPECT_FALSE(compare_lines(run, free).holds());
}

TEST(Gate, TheWorstComesFirstAndBetterIsSaid) {
  std::vector<Json> run = good_run();
  for (Json& line : run) {
    line["fidelity"]["hausdorff_mm"] = 2.2;
    line["peak_rss_bytes"] = 1'000'000'000;
    line["quality"]["min_dihedral_deg"] = 20.0;
  }
  const Verdict verdict = compare_lines(run, baseline());
  ASSERT_EQ(verdict.fallen(), 2U);
  EXPECT_EQ(verdict.checks[0].figure, "peak_rss_bytes");
  EXPECT_EQ(verdict.checks[1].figure, "fidelity.hausdorff_mm");
  EXPECT_NE(to_text(verdict).find("better  box, cbc3d, 1 thread: smallest dihedral angle"),
            std::string::npos);
}

TEST(Gate, JobsThatAreMissingFallAndNewOnesAreNoted) {
  std::vector<Json> run = good_run();
  for (Json& line : run) {
    line["threads"] = 2;
  }
  const Verdict verdict = compare_lines(run, baseline());
  EXPECT_EQ(verdict.fallen(), 1U);
  EXPECT_EQ(verdict.checks[0].text, "is in the baseline and was not run");
  ASSERT_EQ(verdict.notes.size(), 1U);
}

TEST(Gate, AFigureThatTheBaselineLacksIsNotedAndDoesNotFall) {
  std::vector<Json> run = good_run();
  for (Json& line : run) {
    line["quality"]["mean_ratio"] = {{"min", -1.0}, {"p1", 0.0}, {"median", 0.1}};
    line["topology"]["differences"] = 99;
  }
  Json written = baseline();
  written["tolerances"].erase("shape");  // a class that it does not know either
  const TemporaryFolder folder;
  write_text_file(folder.path() / "older.json", written.dump());
  const Json older = read_baseline(folder.path() / "older.json");
  const Verdict verdict = compare_lines(run, older);
  EXPECT_TRUE(verdict.holds()) << to_text(verdict);
  EXPECT_EQ(verdict.notes, std::vector<std::string>{
                               "box, cbc3d, 1 thread: not compared, for the baseline lacks "
                               "quality.mean_ratio.min, quality.mean_ratio.p1, quality.mean_ratio.median, "
                               "topology.differences; --update takes them in"});
  const Json newer = make_baseline(decode_lines(run), older, "the new figures");
  EXPECT_TRUE(compare_lines(run, newer).notes.empty());
  for (Json& line : run) {
    line["topology"]["differences"] = 100;
  }
  EXPECT_EQ(compare_lines(run, newer).fallen(), 1U);
}

TEST(Gate, EveryFigureOfShapeSurfaceAndTopologyThatMayNotFallIsGated) {
  for (const char* key :
       {"quality.mean_ratio.min", "quality.mean_ratio.p1", "quality.mean_ratio.median",
        "quality.edge_ratio.p99", "quality.edge_ratio.max", "quality.neighbour_size_ratio.p99",
        "quality.valence_max", "surface.facet_angle_rms_deg", "surface.facets_over_90_deg",
        "surface.places.not_asked", "topology.differences"}) {
    EXPECT_TRUE(find_gated_metric(key).has_value()) << key;
  }
}

TEST(Gate, AnUpdateKeepsTolerancesAndHistory) {
  Json former = baseline();
  former["tolerances"]["time"]["relative"] = 0.1;
  const Json next = make_baseline(decode_lines(good_run()), former, "better angles");
  EXPECT_EQ(next["tolerances"]["time"]["relative"], 0.1);
  ASSERT_EQ(next["history"].size(), 2U);
  EXPECT_EQ(next["history"][1]["reason"], "better angles");
}

TEST(Gate, EveryToleranceOfTheCatalogIsThere) {
  const Json tolerances = baseline()["tolerances"];
  EXPECT_EQ(tolerances["distance"]["relative"], 0.05);
  EXPECT_EQ(tolerances["memory"]["absolute"], 16777216);
  EXPECT_FALSE(tolerances.contains("exact"));
  for (const char* name :
       {"counts", "angle", "jacobian", "shape", "ratio", "distance", "dice", "volume", "memory", "time"}) {
    EXPECT_TRUE(tolerances.contains(name)) << name;
  }
}

TEST(Gate, BadBaselinesAreRefusedByFileAndKey) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "baseline.json";
  const auto error_of = [&](const std::string& text) {
    write_text_file(file, text);
    try {
      read_baseline(file);
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("baseline.json"), std::string::npos);
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(error_of(baseline().dump()), "");
  EXPECT_NE(error_of("{").find("is no JSON"), std::string::npos);
  EXPECT_NE(error_of(std::string(80000, '[')).find("deep, more than"), std::string::npos);
  const std::string good = baseline().dump();
  const std::size_t at = good.find("\"relative\":") + std::string("\"relative\":").size();
  for (const char* number : {"1e999", "-1e999", "NaN", "Infinity"}) {
    const std::string bad = good.substr(0, at) + number + good.substr(good.find_first_of(",}", at));
    EXPECT_NE(error_of(bad).find(number), std::string::npos) << error_of(bad);
  }
  const std::vector<std::pair<std::string, Json>> wrong{{"/format", "x"},
                                                        {"/tolerances", 3},
                                                        {"/tolerances/colour", 3},
                                                        {"/tolerances/time/relative", -1},
                                                        {"/jobs", Json::array()},
                                                        {"/jobs/0/case", 3},
                                                        {"/jobs/0/missing_labels", {"x"}},
                                                        {"/jobs/0/figures/counts.tets", "many"},
                                                        {"/jobs/0/figures/colour", 1}};
  for (const auto& [pointer, value] : wrong) {
    Json bad = baseline();
    bad[Json::json_pointer(pointer)] = value;
    const std::string key = pointer.substr(pointer.rfind('/') + 1);
    EXPECT_NE(error_of(bad.dump()).find(key), std::string::npos) << pointer;
  }
  EXPECT_THROW(read_baseline(folder.path() / "none.json"), InputError);
}

TEST(Gate, TheCommandWritesForJUnitAndGitHub) {
  const TemporaryFolder folder;
  for (const Json& line : good_run()) {
    append_result(folder.path() / "results.jsonl", line);
  }
  const auto call = [&](std::vector<std::string> more) {
    std::vector<std::string> argv{BENCH, "gate", folder.path(), "--baseline", folder.path() / "b.json"};
    argv.insert(argv.end(), more.begin(), more.end());
    return run_child({argv, 1, 0, 0}).exit_code;
  };
  EXPECT_EQ(call({}), 2);  // there is no baseline yet
  EXPECT_EQ(call({"--update", " "}), 2);
  EXPECT_EQ(call({"--update", "the first"}), 0);
  EXPECT_EQ(call({}), 0);
  std::vector<Json> run = good_run();
  run[0]["counts"]["tets"] = run[1]["counts"]["tets"] = 21;
  replace_results(folder.path() / "results.jsonl", run);
  ::setenv("GITHUB_STEP_SUMMARY", (folder.path() / "summary.md").c_str(), 1);
  EXPECT_EQ(call({"--junit", folder.path() / "gate.xml"}), 1);
  ::unsetenv("GITHUB_STEP_SUMMARY");
  const auto text_of = [&](const char* name) {
    std::ifstream stream(folder.path() / name);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  };
  EXPECT_NE(text_of("summary.md").find("| box, cbc3d, 1 thread | counts.tets | tetrahedra was 20"),
            std::string::npos);
  EXPECT_NE(text_of("gate.xml").find("<failure message=\"tetrahedra was 20"), std::string::npos);
  EXPECT_EQ(to_annotations(compare_lines(run, baseline())),
            "::error title=cbc3d-bench gate::box, cbc3d, 1 thread: tetrahedra was 20, is 21 (+1, +5.0 %25; "
            "allowed 0)\n");
}

}  // namespace
}  // namespace cbc3d::reports
