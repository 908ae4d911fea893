// One job: its identity, and its two child processes.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "reports/run/dial_search.hpp"
#include "reports/run/runner.hpp"

namespace cbc3d::reports {

/// The result line of a job before it has run: what it is, and the digests by which a later run finds out
/// whether it would still be the same job (provenance.configuration_sha256 and program_sha256).
Json identity_of(const Job& job, const Bench& bench);

/// Runs jobs. What is the same for several jobs (digests of programs, evaluations of the same mesh) is done
/// once.
class JobRunner {
 public:
  JobRunner(const Bench& bench, const RunOptions& options) : bench_(bench), options_(options) {}

  /// Any error of the job is its failure: the line says so.
  Json run(const Job& job);

  /// Takes the tries of a former job with a budget, so that searches begin with them.
  void learn(const Json& result);

 private:
  void run_children(const Job& job, const std::filesystem::path& image, Json& result);
  bool mesh_to_budget(const Job& job, std::int64_t budget, const std::filesystem::path& image, Json& result);

  const Bench& bench_;
  const RunOptions& options_;
  std::map<std::string, nlohmann::json> evaluations_;  ///< by digests of image and mesh
  std::map<std::string, std::vector<DialTry>> tries_;  ///< by what the searches have in common
};

}  // namespace cbc3d::reports
