#include "reports/run/solve.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "mesher/testing/temporary_folder.hpp"

namespace cbc3d::reports {
namespace {

using cbc3d::testing::TemporaryFolder;

/// What comes of a program that is the test child in one of its modes.
nlohmann::json solved_by(std::vector<std::string> mode, double timeout_s = 0) {
  mode.insert(mode.begin(), TEST_CHILD);
  return solve({.command = mode,
                .mesh = "mesh.vtu",
                .image = "image.nrrd",
                .timeout_s = timeout_s,
                .memory_limit_bytes = std::int64_t{256} << 20});
}

TEST(Solve, FiguresAreTheProgramsOwn) {
  const nlohmann::json solver = solved_by({"solve"});
  EXPECT_EQ(solver["reason"], "");
  EXPECT_EQ(solver["poisson_p1"]["h1_relative"], 0.125);
  EXPECT_EQ(solver["poisson_p2"]["h1_relative"], 0.25);
}

TEST(Solve, EveryOtherEndIsNullWithItsReason) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> ends{
      {{"say-and-end", "2", "m.vtu: cell 3 is flat"}, "the mesh is refused: m.vtu: cell 3 is flat"},
      {{"say-and-end", "3", "no convergence"}, "not solved: no convergence"},
      {{"exit", "4"}, "exit code 4"},
      {{"exit", "0"}, "the solver ended with success but wrote no figures"},
      {{"allocate"}, "used more than 0.25 GiB"},
      {{"crash"}, "SIGSEGV (Segmentation fault); last line: about to crash"}};
  for (const auto& [mode, reason] : ends) {
    EXPECT_EQ(solved_by(mode),
              (nlohmann::json{{"poisson_p1", nullptr}, {"poisson_p2", nullptr}, {"reason", reason}}));
  }
}

TEST(Solve, ATimeLimitThatIsMetIsAReason) {
  EXPECT_EQ(solved_by({"sleep"}, .5)["reason"], "not done after 0.5 s");
}

TEST(Solve, AProgramThatIsNotBuiltIsAReason) {
  const nlohmann::json solver = solve({.command = solve_command("/nowhere"), .mesh = "m", .image = "i"});
  EXPECT_TRUE(solver["poisson_p1"].is_null());
  EXPECT_EQ(solver["reason"],
            "'/nowhere/cbc3d-solve' is not built; install GetFEM (libgetfem-dev) and build again");
}

TEST(Solve, NothingIsLeftAmongTheTemporaryFiles) {
  const TemporaryFolder folder;
  ::setenv("TMPDIR", folder.path().c_str(), 1);
  solved_by({"solve"});
  solved_by({"exit", "3"});
  ::unsetenv("TMPDIR");
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace cbc3d::reports
