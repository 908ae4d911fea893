// The store of a history: plain files of JSON lines, one file for each commit.
//
// DIR/COMMIT.jsonl has a line for every run of a job:
// {"format": "cbc3d-history-1", "commit": "...", "date": "2026-11-29T08:05:09Z", "machine": "...",
//  "case": "...", "mesher": "...", "mesher_version": "...", "threads": 1, "repeat": 0, "budget": null,
//  "parameters": {}, "image_sha256": "...", "utc": "...", "status": "ok", "reason": "",
//  "figures": {"counts.tets": 123, ...}}                         keys of metrics/catalog.hpp, units of a
//  result line
// Lines are sorted and each is there once, so that the file's bytes do not depend on the order in which runs
// were added. Branches that add different commits have different files; two that add runs of one commit join
// by git's union driver, which DIR/.gitattributes names.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "reports/history/commit.hpp"
#include "reports/results/job_result.hpp"

namespace cbc3d::reports {

/// A run of a job at a commit.
struct HistoryRun {
  Commit commit;
  std::string machine;
  std::string case_name, mesher, mesher_version;
  int threads = 1;
  int repeat = 0;
  std::optional<std::int64_t> budget;
  Parameters parameters;
  std::string image_sha256;
  std::string utc;  ///< when it ran
  std::string status, reason;
  metrics::Figures figures;  ///< none of a job that is not ok

  [[nodiscard]] bool is_ok() const { return status == "ok"; }
};

/// What a machine is called where it is given no name: "AMD EPYC 7763, 4 cores".
std::string machine_of(const JobResult& result);

struct Added {
  std::size_t added = 0;
  std::size_t known = 0;  ///< were there already
};

/// Adds results to the store in `folder`, which is made. `machine` empty: machine_of each. Two that add at
/// the same time wait for each other. Throws InputError where the folder cannot be made or its file of the
/// commit is damaged, JobError where it cannot be written.
Added add_to_store(const std::filesystem::path& folder, const std::vector<JobResult>& results,
                   const Commit& commit, const std::string& machine);

/// All runs of a store, by file name and line. Throws InputError where there are none, or naming file and
/// line of what is damaged.
std::vector<HistoryRun> read_store(const std::filesystem::path& folder);

}  // namespace cbc3d::reports
