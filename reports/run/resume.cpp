#include "reports/run/resume.hpp"

#include <algorithm>
#include <map>

#include "mesher/core/error.hpp"
#include "reports/run/job_run.hpp"

namespace cbc3d::reports {
namespace {
namespace fs = std::filesystem;

bool differs(const Json& line, const Json& identity, const char* key) {
  const Json was = figure(line, {"provenance", key});
  const Json is = figure(identity, {"provenance", key});
  return was.is_string() && is.is_string() && was != is;
}

/// Those that a job was given; of one with a budget before its size dial was turned.
Json given_parameters(const Json& line) {
  const Json before = figure(line, {"size_search", "given_parameters"});
  return before.is_object() ? before : line.value("parameters", Json::object());
}

/// What of a job is no longer what it was for its line; empty: nothing.
std::string change_of(const Json& line, const Json& identity) {
  if (given_parameters(line) != identity["parameters"]) {
    return "its parameters were " + given_parameters(line).dump() + " and are " +
           identity["parameters"].dump();
  }
  if (differs(line, identity, "configuration_sha256")) {
    return "its case or its command line is another now";
  }
  if (differs(line, identity, "program_sha256")) {
    return "its program '" + identity["provenance"]["command"][0].get<std::string>() +
           "' is another build now";
  }
  return "";
}

struct Sorted {
  std::vector<Json> kept, superseded;
  std::vector<std::string> changes;  ///< "JOB: what"
  bool other_evaluator = false;
};

Sorted sort_lines(const std::vector<Json>& lines, const std::map<std::string, Json>& identities,
                  const RunOptions& options) {
  Sorted sorted;
  for (const Json& line : lines) {
    const auto found = identities.find(result_id(line));
    const std::string change = found == identities.end() ? "" : change_of(line, found->second);
    const bool retry = options.retry_failed && found != identities.end() && line.value("status", "") != "ok";
    if (!change.empty()) {
      sorted.changes.push_back(result_id(line) + ": " + change);
    }
    (change.empty() && !retry ? sorted.kept : sorted.superseded).push_back(line);
    sorted.other_evaluator = sorted.other_evaluator ||
                             (found != identities.end() && differs(line, found->second, "evaluator_sha256"));
  }
  return sorted;
}

}  // namespace

std::vector<Json> lines_to_keep(const fs::path& file, const std::vector<Job>& jobs, const Bench& bench,
                                const RunOptions& options, TerminalProgress& progress) {
  drop_torn_line(file);
  const std::vector<Json> lines = read_results(file);
  if (!lines.empty() && !options.resume) {
    throw InputError("--out '" + options.out_dir.string() +
                     "' holds results already; give --resume to go on with them, or another folder");
  }
  std::map<std::string, Json> identities;
  for (const Job& job : jobs) {
    Json identity = identity_of(job, bench);
    const std::string id = result_id(identity);
    identities.emplace(id, std::move(identity));
  }
  const Sorted sorted = sort_lines(lines, identities, options);
  if (!sorted.changes.empty() && !options.rerun_changed) {
    throw InputError("'" + file.string() + "': " + std::to_string(sorted.changes.size()) +
                     " of the jobs there would be others now, first " + sorted.changes.front() +
                     "; give --rerun-changed to run them again, or another --out");
  }
  if (sorted.other_evaluator) {
    progress.line("note: the results there were evaluated by another build of cbc3d-bench", true);
  }
  if (!sorted.superseded.empty()) {
    for (const Json& line : sorted.superseded) {
      append_result(file.parent_path() / "results.superseded.jsonl", line);
    }
    replace_results(file, sorted.kept);
  }
  return sorted.kept;
}

}  // namespace cbc3d::reports
