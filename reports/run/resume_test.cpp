#include "reports/run/resume.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "mesher/testing/error_of.hpp"
#include "mesher/testing/temporary_folder.hpp"
#include "reports/run/job_run.hpp"
#include "reports/run/testing_mesher.hpp"

namespace cbc3d::reports {
namespace {

/// A folder with the lines of two jobs, of the meshers `mesh` (ok) and `fail` (failed).
class Resume : public ::testing::Test {
 protected:
  Resume() {
    bench_.cases.resize(1);
    bench_.cases[0].name = "box";
    bench_.meshers = {test::fake_mesher("mesh"), test::fake_mesher("fail")};
    bench_.evaluate_command = {TEST_CHILD, "evaluate"};
    options_.threads = {1};
    options_.resume = true;
    std::vector<Json> lines;
    for (const Job& job : plan_jobs(bench_, options_)) {
      lines.push_back(identity_of(job, bench_));
      lines.back()["status"] = job.mesher->name == "mesh" ? "ok" : "failed";
    }
    replace_results(file_, lines);
  }

  std::vector<std::string> kept() {
    std::vector<std::string> ids;
    for (const Json& line : lines_to_keep(file_, plan_jobs(bench_, options_), bench_, options_, progress_)) {
      ids.push_back(result_id(line));
    }
    return ids;
  }
  [[nodiscard]] std::string refusal() {
    return cbc3d::testing::error_of([&] { kept(); });
  }
  [[nodiscard]] std::vector<Json> superseded() const {
    return read_results(folder_.path() / "results.superseded.jsonl");
  }

  const cbc3d::testing::TemporaryFolder folder_{"resume"};
  const std::filesystem::path file_ = folder_.path() / "results.jsonl";
  Bench bench_;
  RunOptions options_;
  TerminalProgress progress_{true};
};

using Ids = std::vector<std::string>;
const Ids kBoth{"box-mesh-t1-r0", "box-fail-t1-r0"};

TEST_F(Resume, LinesOfUnchangedJobsStay) {
  EXPECT_EQ(kept(), kBoth);
  EXPECT_TRUE(superseded().empty());
}

TEST_F(Resume, LinesOfJobsThatAreNotPlannedStay) {
  bench_.meshers.pop_back();
  EXPECT_EQ(kept(), kBoth);
}

TEST_F(Resume, AFolderWithLinesIsRefusedUnlessTold) {
  options_.resume = false;
  EXPECT_NE(refusal().find("give --resume to go on with them"), std::string::npos) << refusal();
  std::filesystem::remove(file_);
  EXPECT_EQ(kept(), Ids());
}

TEST_F(Resume, AnotherParameterIsRefusedUnlessTold) {
  options_.parameters["mesh"]["size"] = "5";
  EXPECT_NE(refusal().find("1 of the jobs there would be others now, first box-mesh-t1-r0: its parameters "
                           "were {} and are {\"size\":\"5\"}; give --rerun-changed"),
            std::string::npos)
      << refusal();
  EXPECT_TRUE(superseded().empty());
  options_.rerun_changed = true;
  EXPECT_EQ(kept(), Ids{"box-fail-t1-r0"});
  ASSERT_EQ(superseded().size(), 1U);
  EXPECT_EQ(result_id(superseded()[0]), "box-mesh-t1-r0");
  EXPECT_EQ(read_results(file_).size(), 1U);
}

TEST_F(Resume, FailedJobsAreSupersededWhenTold) {
  options_.retry_failed = true;
  EXPECT_EQ(kept(), Ids{"box-mesh-t1-r0"});
  EXPECT_EQ(superseded().size(), 1U);
}

TEST_F(Resume, AHalfLineAtTheEndIsDropped) {
  std::ofstream(file_, std::ios::app) << R"({"case": "box", "mesh)";
  EXPECT_EQ(kept(), kBoth);
  EXPECT_EQ(read_results(file_).size(), 2U);
}

}  // namespace
}  // namespace cbc3d::reports
