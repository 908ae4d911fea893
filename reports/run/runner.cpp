#include "reports/run/runner.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <thread>

#include "mesher/core/error.hpp"
#include "reports/results/format_number.hpp"
#include "reports/run/folder_lock.hpp"
#include "reports/run/job_run.hpp"
#include "reports/run/resume.hpp"

namespace cbc3d::reports {
namespace {
namespace fs = std::filesystem;

std::string progress_line(const Json& result) {
  std::string line = result_id(result) + ": " + result["status"].get<std::string>();
  if (result["time_s"]["mesh"].is_number()) {
    line += ", meshed in " + format_number(result["time_s"]["mesh"].get<double>(), 2) + " s";
  }
  const Json shortfall = figure(result, {"size_search", "reason"});
  const std::string reason = shortfall.is_string() && result["reason"] == "" && shortfall != ""
                                 ? "budget not met: " + shortfall.get<std::string>()
                                 : result["reason"].get<std::string>();
  return reason.empty() ? line : line + " (" + reason + ")";
}

std::vector<int> thread_counts(const baselines::Adapter& mesher, const std::vector<int>& wanted) {
  if (!mesher.multithreaded) {
    return {1};
  }
  std::vector<int> counts;
  for (const int count : wanted) {
    const int effective =
        count > 0 ? count : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
    if (std::find(counts.begin(), counts.end(), effective) == counts.end()) {
      counts.push_back(effective);
    }
  }
  return counts;
}

Parameters parameters_of(const cases::Case& subject, const std::string& mesher, const RunOptions& options) {
  const auto overlay = options.parameters.find(mesher);
  Parameters parameters = overlay == options.parameters.end() ? Parameters{} : overlay->second;
  const auto base = subject.parameters.find(mesher);
  if (base != subject.parameters.end()) {
    parameters.insert(base->second.begin(), base->second.end());
  }
  return parameters;
}

/// The budgets of a run; one that is none where it has no budgets.
std::vector<std::optional<std::int64_t>> budgets_of(const RunOptions& options) {
  return options.budgets.empty()
             ? std::vector<std::optional<std::int64_t>>(1)
             : std::vector<std::optional<std::int64_t>>(options.budgets.begin(), options.budgets.end());
}

std::vector<Job> all_jobs(const Bench& bench, const RunOptions& options) {
  std::vector<Job> jobs;
  for (const cases::Case& subject : bench.cases) {
    for (const baselines::Adapter& mesher : bench.meshers) {
      const Parameters parameters = parameters_of(subject, mesher.name, options);
      baselines::require_known_parameters(mesher, bench.bin_dir, parameters);
      for (const auto& budget : budgets_of(options)) {
        for (const int threads : thread_counts(mesher, options.threads)) {
          for (int repeat = 0; repeat < options.repeats; ++repeat) {
            jobs.push_back({&subject, &mesher, threads, repeat, parameters, budget});
          }
        }
      }
    }
  }
  return jobs;
}

void make_folders(const fs::path& out_dir) {
  for (const char* name : {"meshes", "logs"}) {
    std::error_code error;
    fs::create_directories(out_dir / name, error);
    if (error) {
      throw InputError("--out '" + out_dir.string() + "': cannot create the folder '" + name +
                       "' in it: " + error.message() + "; choose another place");
    }
  }
}

}  // namespace

std::vector<Job> plan_jobs(const Bench& bench, const RunOptions& options) {
  std::vector<Job> jobs = all_jobs(bench, options);
  if (options.interleaved) {
    std::stable_sort(jobs.begin(), jobs.end(),
                     [](const Job& a, const Job& b) { return a.repeat < b.repeat; });
  }
  std::vector<Job> part;
  for (std::size_t n = 0; n < jobs.size(); ++n) {
    if (static_cast<int>(n % static_cast<std::size_t>(options.shard.count)) == options.shard.index - 1) {
      part.push_back(jobs[n]);
    }
  }
  return part;
}

std::vector<Json> run_jobs(const Bench& bench, const RunOptions& options, TerminalProgress& progress) {
  const std::vector<Job> jobs = plan_jobs(bench, options);
  const fs::path file = options.out_dir / "results.jsonl";
  make_folders(options.out_dir);
  const FolderLock lock(options.out_dir);
  std::vector<Json> results = lines_to_keep(file, jobs, bench, options, progress);
  std::set<std::string> done;
  for (const Json& result : results) {
    done.insert(result_id(result));
  }
  JobRunner runner(bench, options);
  for (const Json& result : results) {
    runner.learn(result);
  }
  std::size_t number = 0;
  for (const Job& job : jobs) {
    const std::string id = result_id(identity_of(job, bench));
    const double share = static_cast<double>(number++) / static_cast<double>(jobs.size());
    if (done.contains(id)) {
      continue;
    }
    progress.step(id, share);
    results.push_back(runner.run(job));
    append_result(file, results.back());
    progress.line(progress_line(results.back()));
  }
  progress.done();
  return results;
}

}  // namespace cbc3d::reports
