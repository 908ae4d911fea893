#include <gtest/gtest.h>

#include <fstream>

#include "mesher/core/error.hpp"
#include "mesher/testing/error_of.hpp"
#include "mesher/testing/temporary_folder.hpp"
#include "reports/run/folder_lock.hpp"
#include "reports/run/merge.hpp"
#include "reports/run/runner.hpp"
#include "reports/run/testing_mesher.hpp"
#include "reports/run/testing_processes.hpp"

namespace cbc3d::reports {
namespace {

using cbc3d::testing::error_of;
using cbc3d::testing::TemporaryFolder;
using test::fake_mesher;

class Runner : public ::testing::Test {
 protected:
  Runner() {
    test::write_row_image(image_);
    bench_.cases.resize(1);
    bench_.cases[0].name = "box";
    bench_.cases[0].image_sha256 = "abc";
    bench_.evaluate_command = {BENCH, "evaluate"};
    bench_.resolve_image = [this](const cases::Case&) { return cases::ResolvedImage{image_, ""}; };
    options_.out_dir = folder_.path() / "out";
    options_.threads = {1};
    options_.timeout_s = test::kNoTimeLimit;
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
  TerminalProgress progress_{true};
};

TEST_F(Runner, AMesherGetsTheImageInTheFormatThatItAsksFor) {
  baselines::Adapter mesher = fake_mesher("mesh");
  const std::string log = folder_.path() / "image";
  mesher.image_extension = ".nii.gz";
  mesher.command = [log](const std::filesystem::path&, const baselines::MeshJob& job) {
    return std::vector<std::string>{"/bin/sh",  "-c",      R"(cp "$1" "$2".nii.gz; exec "$3" mesh "$4" "$5")",
                                    "sh",       job.image, log,
                                    TEST_CHILD, job.mesh,  job.report};
  };
  bench_.meshers = {mesher};
  options_.repeats = 2;
  for (const Json& line : run_jobs(bench_, options_, progress_)) {
    EXPECT_EQ(line["status"], "ok") << line["reason"];
    EXPECT_EQ(line["provenance"]["image_file"], image_.string()) << "the judge has the case's own";
  }
  const LabelImage given = read_label_image(log + ".nii.gz");
  const LabelImage own = read_label_image(image_);
  EXPECT_EQ(given.voxels, own.voxels);
  EXPECT_EQ(given.frame.size, own.frame.size);
}

TEST_F(Runner, EveryKindOfEndIsALineAndTheRunGoesOn) {
  options_.timeout_s = 0.3;
  run({"sleep"});
  options_.timeout_s = test::kNoTimeLimit;
  options_.resume = true;
  run({"crash", "allocate", "fail", "exit", "mesh"});
  const std::vector<Json> results = lines();
  ASSERT_EQ(results.size(), 6U);
  const std::vector<std::pair<std::string, std::string>> expected{
      {"timeout", "not done after 0.3 s"},
      {"crashed", "SIGSEGV (Segmentation fault); last line: about to crash"},
      {"out_of_memory", "used more than 0.25 GiB"},
      {"failed", "no room left on the lattice"},
      {"failed", "the mesher ended with success but wrote no mesh"},
      {"ok", ""}};
  for (std::size_t n = 0; n < expected.size(); ++n) {
    EXPECT_EQ(results[n]["status"], expected[n].first);
    EXPECT_EQ(results[n]["reason"], expected[n].second);
    EXPECT_EQ(results[n]["mesh_file"].is_null(), n != 5);
  }
  EXPECT_EQ(summary_line(decode_lines(results)),
            "6 jobs: 1 ok, 2 failed, 1 crashed, 1 timeout, 1 out_of_memory");
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

TEST_F(Runner, AMeshThatIsNotJudgedInTimeKeepsItsCountsAndSeconds) {
  bench_.evaluate_command = {TEST_CHILD, "sleep"};
  options_.evaluation_timeout_s = 0.3;
  run({"mesh"});
  const Json result = lines().at(0);
  EXPECT_EQ(result["status"], "failed");
  EXPECT_EQ(result["reason"],
            "meshed, but the evaluation did not end: not done after 0.3 s; --evaluation-timeout sets that");
  EXPECT_EQ(result["time_s"]["mesh"], 1.5);
  EXPECT_EQ(result["counts"]["tets"], 1);
  EXPECT_EQ(result["counts"]["vertices"], 4);
  EXPECT_TRUE(std::filesystem::exists(options_.out_dir / result["mesh_file"].get<std::string>()));
}

TEST_F(Runner, AFileBeyondTheLimitIsAReasonAndGoes) {
  options_.file_limit_bytes = 1000;
  run({"garbage"});
  const Json result = lines().at(0);
  EXPECT_EQ(result["status"], "crashed");
  EXPECT_EQ(result["reason"], "wrote a file beyond its limit; --file-limit sets that");
  EXPECT_TRUE(result["mesh_file"].is_null());
  EXPECT_TRUE(std::filesystem::is_empty(options_.out_dir / "meshes"));
}

TEST_F(Runner, ASolverIsAskedOnRequestAndItsLackIsNoFailure) {
  bench_.solve_command = {TEST_CHILD, "solve"};
  run({"mesh"});
  EXPECT_TRUE(lines().at(0)["solver"]["poisson_p1"]["h1_relative"].is_null());
  EXPECT_TRUE(lines().at(0)["solver"]["reason"].is_null());
  options_.solve = true;
  options_.out_dir = folder_.path() / "solved";
  options_.repeats = 2;  // the same bytes are solved once
  run({"mesh"});
  for (const Json& line : lines()) {
    EXPECT_EQ(line["solver"]["poisson_p1"]["h1_relative"], 0.125);
    EXPECT_EQ(line["solver"]["reason"], "");
  }
  options_.out_dir = folder_.path() / "absent";
  bench_.solve_command = {"/nowhere/cbc3d-solve"};
  run({"mesh"});
  const JobResult absent = decode(lines().at(0));
  EXPECT_TRUE(absent.is_ok());
  EXPECT_EQ(absent.line["counts"]["tets"], 1);
  EXPECT_TRUE(absent.line["solver"]["poisson_p1"].is_null());
  EXPECT_NE(absent.solver_reason.find("is not built"), std::string::npos);
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

TEST_F(Runner, ResumeNoticesAnotherImageAndRunsAgainOnlyWhenTold) {
  run({"mesh", "fail"});
  options_.resume = true;
  bench_.cases[0].image_sha256 = "def";
  const std::string error = error_of([&] { run({"mesh", "fail"}); });
  EXPECT_NE(error.find("2 of the jobs"), std::string::npos) << error;
  EXPECT_NE(error.find("its case or its command line"), std::string::npos) << error;
  EXPECT_NE(error.find("--rerun-changed"), std::string::npos) << error;
  options_.rerun_changed = true;
  EXPECT_EQ(run({"mesh", "fail"}).size(), 2U);
  EXPECT_EQ(lines()[0]["provenance"]["image_sha256"], "def");
  EXPECT_EQ(read_results(options_.out_dir / "results.superseded.jsonl").size(), 2U);
}

TEST_F(Runner, ResumeNoticesAnotherBuildOfTheMesher) {
  const auto program = folder_.path() / "program";
  std::filesystem::copy_file(TEST_CHILD, program);
  bench_.meshers = {fake_mesher("mesh")};
  bench_.meshers[0].command = [program](const std::filesystem::path&, const baselines::MeshJob& job) {
    return std::vector<std::string>{program, "mesh", job.mesh, job.report};
  };
  run_jobs(bench_, options_, progress_);
  std::vector<Json> before = lines();
  before[0]["provenance"]["program_sha256"] = "0123";
  replace_results(options_.out_dir / "results.jsonl", before);
  options_.resume = true;
  EXPECT_NE(error_of([&] { run_jobs(bench_, options_, progress_); }).find("is another build now"),
            std::string::npos);
}

TEST_F(Runner, FailedJobsAreRetriedWhenTold) {
  run({"mesh", "fail"});
  options_.resume = options_.retry_failed = true;
  EXPECT_EQ(run({"mesh", "fail"}).size(), 2U);
  const auto superseded = read_results(options_.out_dir / "results.superseded.jsonl");
  ASSERT_EQ(superseded.size(), 1U);
  EXPECT_EQ(superseded[0]["mesher"], "fail");
}

TEST_F(Runner, ASecondRunnerOnAFolderIsRefused) {
  std::filesystem::create_directories(options_.out_dir);
  {
    const FolderLock lock(options_.out_dir);
    EXPECT_NE(error_of([&] { run({"mesh"}); }).find("in use by another runner (process "), std::string::npos);
  }
  EXPECT_EQ(run({"mesh"}).size(), 1U);
}

TEST_F(Runner, TheSameMeshIsEvaluatedOnce) {
  options_.repeats = 2;
  const auto count = folder_.path() / "count";
  std::ofstream(folder_.path() / "evaluate")
      << "#!/bin/sh\necho x >> " << count.string() << "\nexec " BENCH " evaluate \"$@\"\n";
  std::filesystem::permissions(folder_.path() / "evaluate", std::filesystem::perms::owner_all);
  bench_.evaluate_command = {folder_.path() / "evaluate"};
  run({"mesh"});
  EXPECT_EQ(lines().at(1)["counts"]["tets"], 1);
  EXPECT_EQ(lines().at(0)["mesh_sha256"], lines().at(1)["mesh_sha256"]);
  EXPECT_EQ(std::filesystem::file_size(count), 2U);
}

TEST_F(Runner, ShardsPartTheJobsAndMergeJoinsThem) {
  std::vector<std::filesystem::path> folders;
  for (int index = 1; index <= 2; ++index) {
    options_.shard = {index, 2};
    options_.out_dir = folder_.path() / ("shard" + std::to_string(index));
    folders.push_back(options_.out_dir);
    run({"mesh", "fail", "exit"});
    EXPECT_EQ(lines().size(), index == 1 ? 2U : 1U);
  }
  const auto joint = folder_.path() / "joint";
  EXPECT_EQ(merge_runs(folders, joint).size(), 3U);
  EXPECT_EQ(read_results(joint / "results.jsonl").size(), 3U);
  EXPECT_TRUE(std::filesystem::exists(joint / "meshes" / "box-mesh-t1-r0.vtu"));
  EXPECT_THROW(merge_runs(folders, joint), InputError);
  EXPECT_THROW(merge_runs({folder_.path() / "none"}, folder_.path() / "joint2"), InputError);
  std::vector<Json> other = read_results(folders[0] / "results.jsonl");
  other[0]["threads"] = 1;
  other[0]["reason"] = "another";
  replace_results(folders[1] / "results.jsonl", other);
  EXPECT_NE(error_of([&] { merge_runs(folders, folder_.path() / "joint3"); }).find("different lines"),
            std::string::npos);
}

TEST_F(Runner, ALineTellsWhereItsFiguresComeFrom) {
  bench_.cases[0].parameters["mesh"]["size"] = "3";
  run({"mesh"});
  const Json origin = lines().at(0)["provenance"];
  for (const char* key :
       {"git_commit", "git_dirty", "compiler", "compiler_flags", "libraries", "cpu", "cores", "load_1min",
        "image_sha256", "configuration_sha256", "program_sha256", "utc"}) {
    EXPECT_TRUE(origin.contains(key) && !origin[key].is_null()) << key;
  }
  EXPECT_TRUE(origin.contains("seed"));
  EXPECT_EQ(origin["configuration_sha256"].get<std::string>().size(), 64U);
  EXPECT_GT(lines()[0]["time_s"]["reference_cpu"].get<double>(), 0);
}

/// A pool of another kind would find itself on one core.
TEST_F(Runner, BindsTheThreadsOfOpenmpMeshersAlone) {
  bench_.meshers = {fake_mesher("mesh"), fake_mesher("fail")};
  bench_.meshers[0].openmp = true;
  options_.bind_threads = true;
  for (const Json& line : run_jobs(bench_, options_, progress_)) {
    EXPECT_EQ(line["provenance"]["threads_bound"], line["mesher"] == "mesh");
  }
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
