// The finite-element judge: `cbc3d-solve` on a mesh, in a child process under limits.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace cbc3d::reports {

struct SolveJob {
  std::vector<std::string> command;  ///< "MESH --image IMAGE --quiet --json FILE" is appended
  std::filesystem::path mesh, image;
  int threads = 0;                      ///< 0: all cores
  double timeout_s = 0;                 ///< limit of wall-clock time, s; 0: none
  std::int64_t memory_limit_bytes = 0;  ///< limit of resident memory; 0: none
};

/// The command of this installation: the program in `bin_dir`, which is only built where GetFEM is.
std::vector<std::string> solve_command(const std::filesystem::path& bin_dir);

/// The section `solver` of an evaluation: the program's own figures (metrics/solver/README.md) with `reason`
/// "". When the program is absent, refuses the mesh, does not solve it, or meets a limit, `reason` says so in
/// one line and poisson_p1 and poisson_p2 are null. Throws JobError when no process can be made at all.
nlohmann::json solve(const SolveJob& job);

}  // namespace cbc3d::reports
