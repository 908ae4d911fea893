#include "reports/runner.hpp"

#include <algorithm>
#include <fstream>
#include <set>
#include <thread>

#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"
#include "reports/child_process.hpp"
#include "reports/provenance.hpp"

namespace cbc3d::reports {
namespace {
namespace fs = std::filesystem;

/// The files of one job.
struct JobFiles {
  fs::path mesh, report, evaluation, log;

  JobFiles(const fs::path& out_dir, const std::string& id)
      : mesh(out_dir / "meshes" / (id + ".vtu")),
        report(out_dir / "logs" / (id + ".report.json")),
        evaluation(out_dir / "logs" / (id + ".evaluation.json")),
        log(out_dir / "logs" / (id + ".log")) {}

  /// What an earlier run left must not be taken for this one's.
  void remove_all() const {
    std::error_code error;
    for (const fs::path& file : {mesh, report, evaluation, log}) {
      fs::remove(file, error);
    }
  }
};

void set_status(Json& result, const std::string& status, const std::string& reason) {
  result["status"] = status;
  result["reason"] = reason;
}

nlohmann::json read_json(const fs::path& file) {
  std::ifstream stream(file);
  nlohmann::json content = stream ? nlohmann::json::parse(stream, nullptr, false) : nlohmann::json();
  return content.is_object() ? content : nlohmann::json::object();
}

std::string text_at(const nlohmann::json& object, const char* key) {
  return object.contains(key) && object[key].is_string() ? object[key].get<std::string>() : std::string();
}

std::string number_text(double value) {
  std::string text = std::to_string(value);
  text.erase(text.find_last_not_of('0') + 1);
  return text.back() == '.' ? text.substr(0, text.size() - 1) : text;
}

/// Status and reason of a child that did not end with success. `report` is what the child wrote of itself.
void set_failure(Json& result, const ChildResult& child, const nlohmann::json& report,
                 const RunOptions& options) {
  const std::string line = last_line(child.stderr_tail);
  switch (child.end) {
    case ChildEnd::timeout:
      return set_status(result, "timeout", "not done after " + number_text(options.timeout_s) + " s");
    case ChildEnd::out_of_memory:
      return set_status(result, "out_of_memory",
                        "used more than " +
                            number_text(static_cast<double>(options.memory_limit_bytes) / double(1 << 30)) +
                            " GiB");
    case ChildEnd::signalled:
      return set_status(result, "crashed",
                        signal_name(child.signal) + (line.empty() ? "" : "; last line: " + line));
    case ChildEnd::not_started:
      return set_status(result, "failed", line);
    case ChildEnd::exited:
      break;
  }
  const std::string reason = text_at(report, "reason");
  const std::string fallback = line.empty() ? "exit code " + std::to_string(child.exit_code) : line;
  set_status(result, text_at(report, "status") == "out_of_memory" ? "out_of_memory" : "failed",
             reason.empty() ? fallback : reason);
}

/// Time and memory: the mesher's own figures, which leave out reading and writing; else what the system saw.
void set_costs(Json& result, const ChildResult& child, const nlohmann::json& report) {
  const nlohmann::json seconds = report.value("seconds", nlohmann::json::object());
  result["time_s"]["mesh"] = seconds.value("total", nlohmann::json());
  result["time_s"]["cpu"] = seconds.value("cpu", nlohmann::json());
  result["time_s"]["stages"] = seconds.value("stages", nlohmann::json::object());
  result["time_s"]["process_wall"] = child.wall_s;
  result["time_s"]["process_cpu"] = child.cpu_s;
  const auto reported = report.value("peak_rss_bytes", nlohmann::json());
  result["peak_rss_bytes"] =
      std::max(child.peak_rss_bytes, reported.is_number() ? reported.get<std::int64_t>() : 0);
}

/// Runs one job's two children. The mesh stays; the log stays when something went wrong.
class JobRun {
 public:
  JobRun(const Bench& bench, const RunOptions& options, const Job& job, const std::string& id)
      : bench_(bench), options_(options), job_(job), id_(id), files_(options.out_dir, id) {}

  void run(const fs::path& image, Json& result) const {
    files_.remove_all();
    if (mesh(image, result)) {
      result["mesh_file"] = "meshes/" + id_ + ".vtu";
      evaluate(image, result);
    }
    std::error_code error;
    fs::remove(files_.evaluation, error);
  }

 private:
  [[nodiscard]] ChildResult start(std::vector<std::string> argv, int threads) const {
    ChildResult child =
        run_child({std::move(argv), threads, options_.timeout_s, options_.memory_limit_bytes});
    if (!(child.end == ChildEnd::exited && child.exit_code == 0)) {
      write_text_file(files_.log, child.stderr_tail);
    }
    return child;
  }

  bool mesh(const fs::path& image, Json& result) const {
    const ChildResult child = start(job_.mesher->command(bench_.bin_dir, {image, files_.mesh, files_.report,
                                                                          job_.threads, job_.parameters}),
                                    job_.threads);
    const nlohmann::json report = read_json(files_.report);
    set_costs(result, child, report);
    if (child.end == ChildEnd::exited && child.exit_code == 0) {
      if (fs::exists(files_.mesh)) {
        return true;
      }
      set_status(result, "failed", "the mesher ended with success but wrote no mesh");
      return false;
    }
    set_failure(result, child, report, options_);
    std::error_code error;
    fs::remove(files_.mesh, error);
    return false;
  }

  void evaluate(const fs::path& image, Json& result) const {
    std::vector<std::string> argv = bench_.evaluate_command;
    argv.insert(argv.end(), {files_.mesh, image, "--json", files_.evaluation, "--quiet"});
    const ChildResult child = start(std::move(argv), 0);
    const nlohmann::json evaluation = read_json(files_.evaluation);
    if (child.end == ChildEnd::exited && child.exit_code == 0 && !evaluation.empty()) {
      merge_evaluation(result, evaluation);
      set_status(result, "ok", "");
      return;
    }
    set_failure(result, child, {}, options_);
    result["reason"] = "meshed, but the evaluation did not end: " + result["reason"].get<std::string>();
  }

  const Bench& bench_;
  const RunOptions& options_;
  const Job& job_;
  const std::string& id_;
  JobFiles files_;
};

Json identity_of(const Job& job) {
  Json result = empty_result();
  result["case"] = job.subject->name;
  result["mesher"] = job.mesher->name;
  result["threads"] = job.threads;
  result["repeat"] = job.repeat;
  result["parameters"] = job.parameters;
  return result;
}

/// Takes any error of one job as that job's failure: the run goes on.
Json run_job(const Bench& bench, const RunOptions& options, const Job& job) {
  Json result = identity_of(job);
  result["provenance"] = provenance();
  result["provenance"]["mesher_description"] = job.mesher->description;
  result["provenance"]["mesher_licence"] = job.mesher->licence;
  try {
    const baselines::Availability availability = job.mesher->availability(bench.bin_dir);
    if (!availability.available) {
      set_status(result, "unavailable", availability.reason);
      return result;
    }
    const cases::ResolvedImage image = bench.resolve_image(*job.subject);
    if (!image.skipped_reason.empty()) {
      set_status(result, "skipped", image.skipped_reason);
      return result;
    }
    result["provenance"]["image_file"] = fs::absolute(image.path).string();
    result["provenance"]["image_sha256"] = job.subject->image_sha256;
    JobRun(bench, options, job, result_id(result)).run(image.path, result);
  } catch (const std::exception& error) {
    set_status(result, "failed", error.what());
  }
  return result;
}

std::string progress_line(const Json& result) {
  std::string line = result_id(result) + ": " + result["status"].get<std::string>();
  if (result["time_s"]["mesh"].is_number()) {
    line +=
        ", meshed in " + number_text(std::round(100 * result["time_s"]["mesh"].get<double>()) / 100) + " s";
  }
  const std::string reason = result["reason"];
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

/// Refuses to mix two runs in one file: the lines there must be of this run's jobs, or of other ones.
void require_same_parameters(const std::vector<Json>& present, const std::vector<Job>& jobs,
                             const fs::path& file) {
  for (const Job& job : jobs) {
    const Json identity = identity_of(job);
    for (const Json& line : present) {
      if (result_id(line) == result_id(identity) && line["parameters"] != identity["parameters"]) {
        throw InputError("'" + file.string() + "': " + result_id(line) +
                         " was run with other parameters; give another --out");
      }
    }
  }
}

}  // namespace

std::vector<Job> plan_jobs(const Bench& bench, const RunOptions& options) {
  std::vector<Job> jobs;
  for (const cases::Case& subject : bench.cases) {
    for (const baselines::Adapter& mesher : bench.meshers) {
      const Parameters parameters = parameters_of(subject, mesher.name, options);
      baselines::require_known_parameters(mesher.name, mesher.parameters, {"", "", "", 1, parameters});
      for (const int threads : thread_counts(mesher, options.threads)) {
        for (int repeat = 0; repeat < options.repeats; ++repeat) {
          jobs.push_back({&subject, &mesher, threads, repeat, parameters});
        }
      }
    }
  }
  return jobs;
}

std::vector<Json> run_jobs(const Bench& bench, const RunOptions& options, Progress& progress) {
  const std::vector<Job> jobs = plan_jobs(bench, options);
  const fs::path file = options.out_dir / "results.jsonl";
  fs::create_directories(options.out_dir / "meshes");
  fs::create_directories(options.out_dir / "logs");
  drop_torn_line(file);
  std::vector<Json> results = read_results(file);
  if (!results.empty() && !options.resume) {
    throw InputError("--out '" + options.out_dir.string() +
                     "' holds results already; give --resume to go on with them, or another folder");
  }
  require_same_parameters(results, jobs, file);
  std::set<std::string> done;
  for (const Json& result : results) {
    done.insert(result_id(result));
  }
  std::size_t number = 0;
  for (const Job& job : jobs) {
    const std::string id = result_id(identity_of(job));
    const double share = static_cast<double>(number++) / static_cast<double>(jobs.size());
    if (done.contains(id)) {
      continue;
    }
    progress.step(id, share);
    results.push_back(run_job(bench, options, job));
    append_result(file, results.back());
    progress.line(progress_line(results.back()));
  }
  progress.done();
  return results;
}

std::string summary_line(const std::vector<Json>& results) {
  std::string text = std::to_string(results.size()) + (results.size() == 1 ? " job:" : " jobs:");
  const char* separator = " ";
  for (const char* status : kStatuses) {
    const auto count = std::count_if(results.begin(), results.end(), [&](const Json& result) {
      return result.value("status", "") == status;
    });
    if (count > 0) {
      text += separator + std::to_string(count) + " " + status;
      separator = ", ";
    }
  }
  return text;
}

}  // namespace cbc3d::reports
