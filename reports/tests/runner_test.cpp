#include <gtest/gtest.h>

#include <fstream>

#include "mesher/core/error.hpp"
#include "mesher/core/image_io.hpp"
#include "reports/runner.hpp"
#include "reports/tests/folder.hpp"

namespace cbc3d::reports {
namespace {

/// A mesher that is the test child in one of its modes.
baselines::Adapter fake_mesher(const std::string& mode, bool available = true) {
  baselines::Adapter adapter;
  adapter.name = mode;
  adapter.description = "a fake";
  adapter.multithreaded = true;
  adapter.parameters = {{"size", "1", "mm", "element size"}};
  adapter.availability = [available](const std::filesystem::path&) {
    return baselines::Availability{available, available ? "" : "not built; install it"};
  };
  adapter.command = [mode](const std::filesystem::path&, const baselines::MeshJob& job) {
    return std::vector<std::string>{TEST_CHILD, mode, mode == "exit" ? "0" : job.mesh.string(), job.report};
  };
  return adapter;
}

class Runner : public testing::Test {
 protected:
  Runner() {
    LabelImage image;
    image.frame.size = {8, 8, 8};
    image.labels = {0, 1};
    image.voxels.assign(image.frame.voxel_count(), 0);
    for (int n = 1; n < 7; ++n) {
      image.voxels[image.frame.offset(n, 1, 1)] = 1;
    }
    write_label_image(image, image_);
    bench_.cases.resize(1);
    bench_.cases[0].name = "box";
    bench_.cases[0].image_sha256 = "abc";
    bench_.evaluate_command = {BENCH, "evaluate"};
    bench_.resolve_image = [this](const cases::Case&) { return cases::ResolvedImage{image_, ""}; };
    options_.out_dir = folder_.path() / "out";
    options_.threads = {1};
    options_.timeout_s = 2;
    options_.memory_limit_bytes = std::int64_t{256} << 20;
  }

  std::vector<Json> run(const std::vector<std::string>& modes) {
    bench_.meshers.clear();
    for (const std::string& mode : modes) {
      bench_.meshers.push_back(fake_mesher(mode));
    }
    return run_jobs(bench_, options_, progress_);
  }
  std::vector<Json> lines() { return read_results(options_.out_dir / "results.jsonl"); }

  TemporaryFolder folder_;
  std::filesystem::path image_ = folder_.path() / "box.nrrd";
  Bench bench_;
  RunOptions options_;
  Progress progress_{true};
};

TEST_F(Runner, EveryKindOfEndIsALineAndTheRunGoesOn) {
  run({"crash", "sleep", "allocate", "fail", "exit", "mesh"});
  const std::vector<Json> results = lines();
  ASSERT_EQ(results.size(), 6U);
  const std::vector<std::pair<std::string, std::string>> expected{
      {"crashed", "SIGSEGV (Segmentation fault); last line: about to crash"},
      {"timeout", "not done after 2 s"},
      {"out_of_memory", "used more than 0.25 GiB"},
      {"failed", "no room left on the lattice"},
      {"failed", "the mesher ended with success but wrote no mesh"},
      {"ok", ""}};
  for (std::size_t n = 0; n < expected.size(); ++n) {
    EXPECT_EQ(results[n]["status"], expected[n].first);
    EXPECT_EQ(results[n]["reason"], expected[n].second);
    EXPECT_EQ(results[n]["mesh_file"].is_null(), n != 5);
  }
  EXPECT_EQ(summary_line(results), "6 jobs: 1 ok, 2 failed, 1 crashed, 1 timeout, 1 out_of_memory");
}

TEST_F(Runner, AGoodJobHasFiguresTimesAndProvenance) {
  bench_.cases[0].parameters["mesh"]["size"] = "3";
  run({"mesh"});
  const Json result = lines().at(0);
  ASSERT_EQ(result["status"], "ok") << result["reason"];
  EXPECT_EQ(result["counts"]["tets"], 1);
  EXPECT_EQ(result["counts"]["vertices"], 4);
  EXPECT_NEAR(result["quality"]["min_dihedral_deg"].get<double>(), 54.7356, 1e-3);
  EXPECT_TRUE(result["fidelity"]["hausdorff_mm"].is_number());
  EXPECT_EQ(result["time_s"]["mesh"], 1.5);
  EXPECT_EQ(result["time_s"]["cpu"], 1.25);
  EXPECT_GT(result["peak_rss_bytes"].get<double>(), 99);
  EXPECT_EQ(result["parameters"]["size"], "3");
  EXPECT_EQ(result["provenance"]["image_sha256"], "abc");
  EXPECT_GT(result["provenance"]["cores"], 0);
  EXPECT_TRUE(std::filesystem::exists(options_.out_dir / result["mesh_file"].get<std::string>()));
}

TEST_F(Runner, AbsentMeshersAndImagesAreLinesToo) {
  bench_.meshers = {fake_mesher("mesh", false)};
  run_jobs(bench_, options_, progress_);
  EXPECT_EQ(lines().at(0)["status"], "unavailable");
  EXPECT_EQ(lines().at(0)["reason"], "not built; install it");
  options_.out_dir = folder_.path() / "second";
  bench_.resolve_image = [](const cases::Case&) { return cases::ResolvedImage{"", "no such file"}; };
  run({"mesh"});
  EXPECT_EQ(lines().at(0)["status"], "skipped");
  EXPECT_EQ(lines().at(0)["reason"], "no such file");
}

TEST_F(Runner, AMeshThatCannotBeEvaluatedIsAFailure) {
  bench_.evaluate_command = {TEST_CHILD, "say"};
  run({"mesh"});
  EXPECT_EQ(lines().at(0)["status"], "failed");
  EXPECT_NE(lines().at(0)["reason"].get<std::string>().find("the evaluation did not end"), std::string::npos);
  EXPECT_EQ(lines().at(0)["time_s"]["mesh"], 1.5);
}

TEST_F(Runner, ResumeRunsOnlyWhatHasNoLine) {
  run({"mesh"});
  EXPECT_THROW(run({"mesh"}), InputError);
  options_.resume = true;
  run({"mesh", "fail"});
  ASSERT_EQ(lines().size(), 2U);
  EXPECT_EQ(lines()[1]["mesher"], "fail");
  options_.parameters["mesh"]["size"] = "5";
  EXPECT_THROW(run({"mesh"}), InputError);
  EXPECT_EQ(lines().size(), 2U);
}

TEST_F(Runner, PlansThreadsRepeatsAndParameters) {
  bench_.meshers = {fake_mesher("mesh"), fake_mesher("fail")};
  bench_.meshers[1].multithreaded = false;
  bench_.cases[0].parameters["mesh"]["size"] = "3";
  options_.threads = {1, 2, 2};
  options_.repeats = 2;
  std::vector<Job> jobs = plan_jobs(bench_, options_);
  ASSERT_EQ(jobs.size(), 6U);  // 2 x 2 of the first, 2 of the sequential one
  EXPECT_EQ(jobs[2].threads, 2);
  EXPECT_EQ(jobs[3].repeat, 1);
  EXPECT_EQ(jobs[4].threads, 1);
  EXPECT_EQ(jobs[0].parameters.at("size"), "3");
  EXPECT_TRUE(jobs[4].parameters.empty());
  options_.parameters["mesh"]["size"] = "4";
  EXPECT_EQ(plan_jobs(bench_, options_)[0].parameters.at("size"), "4");
  options_.parameters["mesh"]["sise"] = "4";
  EXPECT_THROW(plan_jobs(bench_, options_), InputError);
}

}  // namespace
}  // namespace cbc3d::reports
