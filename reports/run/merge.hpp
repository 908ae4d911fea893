// Folders of runs made one: the shards of a job array, say.
#pragma once

#include <filesystem>
#include <vector>

#include "reports/results/result.hpp"

namespace cbc3d::reports {

struct MergeOptions {
  std::size_t expected = 0;  ///< jobs that there should be; 0: any number
  bool replace = false;      ///< the results that `out_dir` holds, as of a former merge
};

/// Copies results, meshes, logs and generated images of the runs in `folders` into `out_dir`, which is made,
/// and returns the joint lines. A job that several folders have with the same line is there once. Throws
/// InputError when a folder holds no results, `out_dir` holds some already, or two folders have different
/// lines of one job; JobError when there are other than the expected number of jobs, or copying fails.
/// `out_dir` gets its results last.
std::vector<Json> merge_runs(const std::vector<std::filesystem::path>& folders,
                             const std::filesystem::path& out_dir, const MergeOptions& options = {});

}  // namespace cbc3d::reports
