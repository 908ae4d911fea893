// A run as the scripts of engines that spread jobs over a cluster.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace cbc3d::reports {

/// A job as a call of `cbc3d-bench run` that has just this one.
struct ClusterJob {
  std::string id;                      ///< as result_id
  std::vector<std::string> arguments;  ///< behind `run`, without --out and --resume
  int threads = 1;
};

struct ClusterPlan {
  std::string bench;          ///< the program, absolute
  std::filesystem::path out;  ///< absolute
  std::vector<ClusterJob> jobs;
  int memory_mb = 0;      ///< that a job asks the engine for
  int minutes = 0;        ///< likewise
  std::string scripts{};  ///< how the scripts are made again, for their heads
};

/// A text as one word of a shell, whatever is in it.
std::string shell_word(const std::string& text);

/// `job.sh N [OPTIONS OF RUN]` runs job N into OUT/jobs/N. A job that has its line is left alone; one whose
/// former process lives yet waits for that.
std::string job_script(const ClusterPlan& plan);
/// `merge.sh` joins all jobs in OUT; while some are missing it names them and ends with 1.
std::string merge_script(const ClusterPlan& plan);
/// A job array of Slurm.
std::string slurm_script(const ClusterPlan& plan);
/// The same jobs and the merge for Snakemake.
std::string snakefile(const ClusterPlan& plan);

/// Writes job.sh, merge.sh, array.sbatch, Snakefile and the list jobs.tsv into the plan's folder, which is
/// made. Throws InputError when the folder has a list of other jobs, or a name that Slurm cannot take.
void write_cluster_scripts(const ClusterPlan& plan);

}  // namespace cbc3d::reports
