// cbc3d-bench cluster: a run as scripts of engines that spread jobs over a cluster.
#include <algorithm>
#include <cmath>
#include <iostream>

#include "mesher/command_line/number_range.hpp"
#include "mesher/core/error.hpp"
#include "reports/cluster/cluster_scripts.hpp"
#include "reports/commands/commands.hpp"
#include "reports/commands/selection.hpp"
#include "reports/run/dial_search.hpp"
#include "reports/run/job_run.hpp"
#include "reports/run/workplace.hpp"

namespace cbc3d::reports {
namespace {

struct ClusterOptions {
  Selection selection;
  std::string out;
  RunOptions run;
  double memory_limit_gib = 16;
  bool quiet = false;
};

/// As jobs are run elsewhere, files have their whole names.
std::string absolute(const std::string& path) {
  return std::filesystem::absolute(path).lexically_normal().string();
}

std::string number_text(double value) {
  return nlohmann::json(value).dump();
}

/// The options that all jobs have in common.
std::vector<std::string> common_arguments(const ClusterOptions& options) {
  const Selection& selection = options.selection;
  const double file_limit_gib = static_cast<double>(options.run.file_limit_bytes) / (1 << 30);
  std::vector<std::string> list{"--timeout",
                                number_text(options.run.timeout_s),
                                "--evaluation-timeout",
                                number_text(options.run.evaluation_timeout_s),
                                "--file-limit",
                                number_text(file_limit_gib),
                                "--memory-limit",
                                number_text(options.memory_limit_gib)};
  const auto add = [&](const char* flag, const std::string& value) {
    list.insert(list.end(), {flag, value});
  };
  for (const std::string& file : selection.externals) add("--external", absolute(file));
  for (const std::string& folder : selection.data) add("--data", absolute(folder));
  for (const std::string& setting : selection.settings) add("--set", setting);
  if (!selection.manifests.empty()) add("--manifests", absolute(selection.manifests));
  if (!selection.parameter_set.empty()) add("--parameter-set", selection.parameter_set);
  if (selects_front(selection)) add("--suite", std::string(kFrontSuite));
  if (options.run.bind_threads) list.emplace_back("--bind-threads");
  if (options.run.solve) list.emplace_back("--solve");
  return list;
}

/// Of the repeats of a job the shards are the single ones.
ClusterJob cluster_job(const Job& job, const Bench& bench, const ClusterOptions& options) {
  const std::string repeats = std::to_string(options.run.repeats);
  ClusterJob one{result_id(identity_of(job, bench)), common_arguments(options), job.threads};
  one.arguments.insert(one.arguments.end(), {"--case", job.subject->name, "--mesher", job.mesher->name,
                                             "--threads", std::to_string(job.threads), "--repeat", repeats,
                                             "--shard", std::to_string(job.repeat + 1) + "/" + repeats});
  if (job.budget) {
    one.arguments.insert(one.arguments.end(), {"--budgets", std::to_string(*job.budget)});
  }
  return one;
}

/// What a job may take if each of its processes takes all it may: the mesher, with a budget several times,
/// the evaluation and the solver.
int most_minutes(const ClusterOptions& options) {
  constexpr double kSecondsPerMinute = 60;
  constexpr int kStart = 5;
  const int processes = (options.run.budgets.empty() ? 1 : kMostTries) + (options.run.solve ? 1 : 0);
  const double seconds = processes * options.run.timeout_s + options.run.evaluation_timeout_s;
  return static_cast<int>(std::ceil(seconds / kSecondsPerMinute)) + kStart;
}

int write(ClusterOptions options) {
  constexpr double kMbPerGib = 1024;
  constexpr int kBenchMb = 512;
  if (std::find(options.run.threads.begin(), options.run.threads.end(), 0) != options.run.threads.end()) {
    throw InputError("--threads 0: how many cores a node has is not known here; give thread counts");
  }
  options.run.parameters = parse_settings(options.selection);
  if (options.run.budgets.empty() && selects_front(options.selection)) {
    options.run.budgets = kFrontBudgets;
  }
  ClusterPlan plan;
  plan.out = absolute(options.out);
  plan.bench = executable_file();
  plan.memory_mb = static_cast<int>(std::ceil(options.memory_limit_gib * kMbPerGib)) + kBenchMb;
  plan.minutes = most_minutes(options);
  plan.scripts = "cbc3d-bench cluster";
  const Bench bench = make_bench(options.selection, plan.out);
  for (const Job& job : plan_jobs(bench, options.run)) {
    plan.jobs.push_back(cluster_job(job, bench, options));
  }
  write_cluster_scripts(plan);
  if (!options.quiet) {
    std::cout << plan.jobs.size() << " jobs in '" << plan.out.string()
              << "': sbatch array.sbatch, then merge.sh; or snakemake --cores N --keep-going\n";
  }
  return kExitSuccess;
}

void add_engine(CLI::App* parent, const char* name, const char* text,
                const std::shared_ptr<ClusterOptions>& options) {
  CLI::App* parser = parent->add_subcommand(name, text);
  add_selection_options(parser, options->selection);
  parser->add_option("-o,--out", options->out, "folder for the scripts, and for the results of the jobs")
      ->required();
  parser->add_option("--budgets", options->run.budgets, "numbers of elements, as those of `run`")
      ->delimiter(',')
      ->check(whole_number_between(1, 1000000000));
  add_limit_options(parser, options->run, options->memory_limit_gib);
  parser->add_flag("--solve", options->run.solve, "solve Poisson's equation on every mesh");
  parser->add_flag("--quiet", options->quiet, "no summary on the screen");
}

}  // namespace

Command add_cluster_command(CLI::App& app) {
  CLI::App* parser = app.add_subcommand(
      "cluster",
      "Writes a run as scripts, one job for each of its jobs: job.sh, array.sbatch, Snakefile, merge.sh");
  parser->require_subcommand(1);
  const auto options = std::make_shared<ClusterOptions>();
  options->run.threads = {1};
  add_engine(parser, "slurm", "A job array of Slurm, and the other scripts", options);
  add_engine(parser, "snakemake", "A workflow of Snakemake, and the other scripts", options);
  return {parser, [options] { return write(*options); }};
}

}  // namespace cbc3d::reports
