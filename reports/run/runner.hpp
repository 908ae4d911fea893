// The runner: every job is a mesher on a case, meshed in one child process and evaluated in another, and gets
// a line in results.jsonl whatever becomes of it.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "baselines/core/adapter.hpp"
#include "cases/core/case.hpp"
#include "cases/manifest.hpp"
#include "mesher/core/terminal_progress.hpp"
#include "reports/results/job_result.hpp"

namespace cbc3d::reports {

/// What a run works with.
struct Bench {
  std::vector<cases::Case> cases;
  std::vector<baselines::Adapter> meshers;
  std::filesystem::path bin_dir;              ///< folder of the mesher executables
  std::vector<std::string> evaluate_command;  ///< "MESH IMAGE --json FILE --quiet" is appended, and
                                              ///< for a phantom its name and arguments
  std::vector<std::string> solve_command;     ///< see SolveJob
  std::function<cases::ResolvedImage(const cases::Case&)> resolve_image;
};

/// Every Nth job: the jobs whose number leaves the remainder `index` - 1.
struct Shard {
  int index = 1;  ///< from 1 to `count`
  int count = 1;
};

struct RunOptions {
  std::filesystem::path out_dir;  ///< gets results.jsonl, meshes/ and logs/
  std::vector<int> threads{0};    ///< thread counts; 0: all cores. Sequential meshers run once, with 1
  int repeats = 1;                ///< runs of every job
  double timeout_s = 1800;        ///< limit of each mesher's and solver's wall-clock time, s
  std::int64_t memory_limit_bytes = std::int64_t{16} << 30;  ///< limit of each child's resident memory
  std::int64_t file_limit_bytes = std::int64_t{16} << 30;    ///< limit of every file that a mesher writes
  double evaluation_timeout_s = 1800;            ///< limit of the wall-clock time of judging one mesh, s
  std::map<std::string, Parameters> parameters;  ///< by mesher: laid over the case's own parameters
  bool resume = false;                           ///< leave out jobs that have a line already
  bool rerun_changed = false;  ///< on resuming, run again what has changed instead of refusing
  bool retry_failed = false;   ///< on resuming, run again what was not ok
  bool interleaved = false;    ///< all first repeats before the second ones, so that drift hits all alike
  bool solve = false;          ///< finite-element problems on every mesh too, see solve.hpp
  bool bind_threads = false;   ///< OpenMP's threads stay each on a core of its own
  Shard shard;                 ///< the part of the jobs to run
  /// Numbers of elements: a job for each, whose mesher's size dial is turned until it has about so many.
  /// Empty: the parameters stay as they are.
  std::vector<std::int64_t> budgets;
};

struct Job {
  const cases::Case* subject = nullptr;
  const baselines::Adapter* mesher = nullptr;
  int threads = 1;
  int repeat = 0;
  Parameters parameters;               ///< with a budget: those that the size dial leaves alone decide
  std::optional<std::int64_t> budget;  ///< elements that its mesh should have
};

/// The jobs of a run: cases x meshers x budgets x threads x repeats, or of those the shard's. The parameters
/// of a case for a mesher are those under the mesher's name, overlaid by the options'. Throws InputError for
/// parameters that a mesher does not have.
std::vector<Job> plan_jobs(const Bench& bench, const RunOptions& options);

/// Runs the jobs one after the other and returns all lines of the results file. A job that fails is a line,
/// and the run goes on. Throws InputError when another runner has the folder, when the folder holds results
/// and `resume` is off, or results of jobs whose case, parameters or program have changed since; JobError
/// when a line cannot be written.
std::vector<Json> run_jobs(const Bench& bench, const RunOptions& options, TerminalProgress& progress);

}  // namespace cbc3d::reports
