// Values that no option takes: one short line at once, before anything is run.
#include <gtest/gtest.h>

#include "mesher/testing/option_walk.hpp"
#include "mesher/testing/temporary_folder.hpp"
#include "reports/run/child_process.hpp"

namespace cbc3d::reports {
namespace {

struct Outcome {
  int exit_code;
  std::string text;  ///< of its standard error
};

Outcome run(const std::string& command, const std::string& flag, const std::string& value) {
  const ChildResult result = run_child({{BENCH, command, flag, value}, 1, 0, 0});
  return {result.exit_code, result.stderr_tail};
}

TEST(BenchOptionRanges, NoOptionTakesWhatIsNoNumberOrFarTooLarge) {
  const cbc3d::testing::TemporaryFolder folder;
  const std::string file = folder.file("script").string();
  run_child({{"/bin/sh", "-c", std::string(BENCH) + " --completion fish > '" + file + "'"}, 1, 0, 0});
  const auto options = cbc3d::testing::options_with_values(folder.content("script"));
  EXPECT_GT(cbc3d::testing::expect_bad_values_refused(options, run), 20);
}

TEST(BenchOptionRanges, TheLineHasTheRange) {
  EXPECT_EQ(run("run", "--timeout", "nan").text,
            "cbc3d-bench: --timeout: nan: give a number from 0.001 to 10000000 (see --help)\n");
  EXPECT_EQ(run("run", "--memory-limit", "inf").text,
            "cbc3d-bench: --memory-limit: inf: give a number from 0.001 to 1000000 (see --help)\n");
  EXPECT_EQ(run("sweep", "--threads", "1,99999999").text,
            "cbc3d-bench: --threads: 99999999: give a whole number from 0 to 1024 (see --help)\n");
}

}  // namespace
}  // namespace cbc3d::reports
