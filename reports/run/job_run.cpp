#include "reports/run/job_run.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iostream>
#include <optional>

#include "cases/core/sha256.hpp"
#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"
#include "mesher/core/image_io.hpp"
#include "mesher/core/json_text.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"
#include "reports/run/child_process.hpp"
#include "reports/run/provenance.hpp"
#include "reports/run/reference_work.hpp"
#include "reports/run/solve.hpp"

namespace cbc3d::reports {
namespace {
namespace fs = std::filesystem;

/// Pools of other kinds would find themselves on the one core that the first thread is bound to.
bool binds_threads(const RunOptions& options, const Job& job) {
  return options.bind_threads && job.mesher->openmp;
}

/// The files of one job.
struct JobFiles {
  fs::path mesh, report, evaluation, log;

  JobFiles(const fs::path& out_dir, const std::string& stem, const std::string& extension)
      : mesh(out_dir / "meshes" / (stem + extension)),
        report(out_dir / "logs" / (stem + ".report.json")),
        evaluation(out_dir / "logs" / (stem + ".evaluation.json")),
        log(out_dir / "logs" / (stem + ".log")) {}

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

/// The object in a file; empty where there is none or it is broken.
nlohmann::json read_json(const fs::path& file) {
  std::ifstream stream(file);
  return json_object_or_empty<nlohmann::json>(stream);
}

std::string text_at(const nlohmann::json& object, const char* key) {
  return object.contains(key) && object[key].is_string() ? object[key].get<std::string>() : std::string();
}

nlohmann::json object_at(const nlohmann::json& object, const char* key) {
  return object.contains(key) && object[key].is_object() ? object[key] : nlohmann::json::object();
}

bool succeeded(const ChildResult& child) {
  return child.end == ChildEnd::exited && child.exit_code == 0;
}

/// Status of a result line for the end of a child that did not end with success.
const char* status_of(ChildEnd end) {
  switch (end) {
    case ChildEnd::timeout:
      return "timeout";
    case ChildEnd::out_of_memory:
      return "out_of_memory";
    case ChildEnd::signalled:
      return "crashed";
    case ChildEnd::not_started:
    case ChildEnd::exited:
      break;
  }
  return "failed";
}

/// Status and reason of a child that did not end with success. `report` is what the child wrote of itself.
void set_failure(Json& result, const ChildResult& child, const nlohmann::json& report,
                 const RunOptions& options) {
  const std::string text = failure_text(child, options.timeout_s, options.memory_limit_bytes);
  if (child.end != ChildEnd::exited) {
    return set_status(result, status_of(child.end), text);
  }
  const std::string reason = printable(text_at(report, "reason"));
  set_status(result, text_at(report, "status") == "out_of_memory" ? "out_of_memory" : "failed",
             reason.empty() ? text : reason);
}

/// Time and memory: the mesher's own figures, which leave out reading and writing. For a mesher from outside
/// that reports none, what the system saw from its start to its end.
void set_costs(Json& result, const ChildResult& child, const nlohmann::json& report, bool external) {
  const nlohmann::json seconds = object_at(report, "seconds");
  const bool whole_process = external && succeeded(child) && !seconds.contains("total");
  result["time_s"]["mesh"] =
      whole_process ? nlohmann::json(child.wall_s) : seconds.value("total", nlohmann::json());
  result["time_s"]["cpu"] =
      whole_process ? nlohmann::json(child.cpu_s) : seconds.value("cpu", nlohmann::json());
  result["time_s"]["system_cpu"] = seconds.value("system_cpu", nlohmann::json());
  result["time_s"]["stages"] = object_at(seconds, "stages");
  result["time_s"]["includes_files"] = whole_process;
  result["time_s"]["process_wall"] = child.wall_s;
  result["time_s"]["process_cpu"] = child.cpu_s;
  const auto reported = report.value("peak_rss_bytes", nlohmann::json());
  result["peak_rss_bytes"] =
      std::max(child.peak_rss_bytes, reported.is_number() ? reported.get<std::int64_t>() : 0);
}

/// A report without its long lists, and without what the result line has in other places.
nlohmann::json worth_keeping(const nlohmann::json& report) {
  constexpr std::size_t kLongestList = 64;
  nlohmann::json kept = nlohmann::json::object();
  for (const auto& [key, value] : report.items()) {
    if (value.is_object()) {
      kept[key] = worth_keeping(value);
    } else if (!value.is_array() || value.size() <= kLongestList) {
      kept[key] = value;
    }
  }
  return kept;
}

nlohmann::json mesher_report(const nlohmann::json& report) {
  nlohmann::json kept = worth_keeping(report);
  for (const char* key : {"status", "reason", "counts", "seconds", "peak_rss_bytes"}) {
    kept.erase(key);
  }
  return kept;
}

/// Digest of a program's file; null when there is none. Programs do not change during a run.
Json program_digest(const std::string& program) {
  static std::map<std::string, Json> known;
  const auto found = known.find(program);
  if (found != known.end()) {
    return found->second;
  }
  const fs::path file = baselines::find_program(program);
  Json digest;
  try {
    digest = file.empty() ? Json() : Json(cases::sha256_of_file(file));
  } catch (const InputError&) {
    digest = nullptr;  // it may be executed but not read
  }
  return known[program] = digest;
}

/// What makes the job what it is, apart from the program.
Json configuration_of(const Job& job, const std::vector<std::string>& argv) {
  Json configuration{{"case", job.subject->name},
                     {"mesher", job.mesher->name},
                     {"threads", job.threads},
                     {"parameters", job.parameters},
                     {"arguments", std::vector<std::string>(argv.begin() + 1, argv.end())}};
  if (const auto& phantom = job.subject->phantom) {
    configuration["image"] = {
        {"phantom", phantom->name},
        {"size", phantom->size},
        {"spacing_mm", {phantom->spacing_mm.x, phantom->spacing_mm.y, phantom->spacing_mm.z}},
        {"seed", phantom->seed}};
  } else {
    configuration["image"] = job.subject->image_sha256;
  }
  return configuration;
}

/// The seed that the mesher works with, by its parameter of that name.
Json seed_of(const Job& job, const std::filesystem::path& bin_dir) {
  const auto given = job.parameters.find("seed");
  if (given != job.parameters.end()) {
    return given->second;
  }
  for (const baselines::ParameterSpec& spec : job.mesher->parameters.in(bin_dir)) {
    if (spec.key == "seed") {
      return spec.default_value;
    }
  }
  return nullptr;
}

/// Options of `evaluate` that name the phantom that the image is, so that it knows the true shape.
std::vector<std::string> phantom_options(const cases::Case& subject) {
  if (!subject.phantom || subject.derive.any()) {
    return {};
  }
  const cases::Phantom& phantom = *subject.phantom;
  const Vec3& s = phantom.spacing_mm;
  const auto joined = [](const nlohmann::json& list) {  // JSON writes as many digits as it takes
    return list[0].dump() + "," + list[1].dump() + "," + list[2].dump();
  };
  return {"--phantom",         phantom.name,
          "--phantom-size",    joined(phantom.size),
          "--phantom-spacing", joined(std::vector<double>{s.x, s.y, s.z}),
          "--phantom-seed",    std::to_string(phantom.seed)};
}

/// What a mesher calls its version: by its report, or the first line that its version command prints.
Json version_of(const baselines::Adapter& mesher, const nlohmann::json& report) {
  if (mesher.version_command.empty()) {
    return report.contains("versions") ? Json(report["versions"])
                                       : Json(report.value("version", nlohmann::json()));
  }
  constexpr double kTimeoutS = 10;
  // Programs print their version to either stream; the shell only joins the two, the command is its
  // arguments.
  std::vector<std::string> argv{"/bin/sh", "-c", "exec \"$@\" 1>&2", "sh"};
  argv.insert(argv.end(), mesher.version_command.begin(), mesher.version_command.end());
  const ChildResult child = run_child({argv, 1, kTimeoutS, 0});
  const std::string text = printable(child.stderr_tail);
  return text.empty() ? Json() : Json(text.substr(0, text.find('\n')));
}

/// The mesh and the evaluation of one job. The mesh stays; the log stays when something went wrong.
class Children {
 public:
  Children(const Bench& bench, const RunOptions& options, const Job& job, const JobFiles& files)
      : bench_(bench), options_(options), job_(job), files_(files) {}

  /// True when there is a mesh.
  bool mesh(const fs::path& image, const Parameters& parameters, Json& result) const {
    const std::vector<std::string> argv =
        job_.mesher->command(bench_.bin_dir, {image, files_.mesh, files_.report, job_.threads, parameters});
    const ChildResult child = run_child({argv, job_.threads, options_.timeout_s, options_.memory_limit_bytes,
                                         binds_threads(options_, job_), options_.file_limit_bytes});
    const nlohmann::json report = read_json(files_.report);
    const bool external = job_.mesher->name.rfind("external:", 0) == 0;
    set_costs(result, child, report, external);
    result["mesher_report"] = mesher_report(report);
    result["counts"].update(object_at(report, "counts"));
    result["provenance"]["mesher_version"] = version_of(*job_.mesher, report);
    if (succeeded(child) && fs::exists(files_.mesh)) {
      return true;
    }
    std::error_code error;
    fs::remove(files_.mesh, error);  // before the log, which needs its room where it filled the disk
    if (succeeded(child)) {
      set_status(result, "failed", "the mesher ended with success but wrote no mesh");
    } else {
      set_failure(result, child, report, options_);
      write_log(child);
    }
    return false;
  }

  /// The evaluation; empty when it did not end well, and then the line says why and keeps what the mesher
  /// reported, its counts and seconds.
  nlohmann::json evaluate(const fs::path& image, Json& result) const {
    std::vector<std::string> argv = bench_.evaluate_command;
    argv.insert(argv.end(), {files_.mesh, image, "--json", files_.evaluation, "--quiet"});
    const std::vector<std::string> phantom = phantom_options(*job_.subject);
    argv.insert(argv.end(), phantom.begin(), phantom.end());
    const ChildResult child =
        run_child({argv, 0, options_.evaluation_timeout_s, options_.memory_limit_bytes});
    nlohmann::json evaluation = read_json(files_.evaluation);
    std::error_code error;
    fs::remove(files_.evaluation, error);
    if (succeeded(child) && !evaluation.empty()) {
      return evaluation;
    }
    write_log(child);
    set_not_judged(result, child);
    return nlohmann::json::object();
  }

  /// The section `solver`; what it lacks is no failure of the job.
  [[nodiscard]] nlohmann::json solve(const fs::path& image) const {
    return reports::solve(
        {bench_.solve_command, files_.mesh, image, 0, options_.timeout_s, options_.memory_limit_bytes});
  }

 private:
  void write_log(const ChildResult& child) const {
    try {
      write_text_file(files_.log, printable(child.stderr_tail));
    } catch (const std::exception& error) {
      std::cerr << "warning: " << error.what() << '\n';  // the disk may be full; the run goes on
    }
  }

  /// The mesher kept its limits, so a judge that did not keep its own is no timeout of the mesher.
  void set_not_judged(Json& result, const ChildResult& child) const {
    RunOptions limits;
    limits.timeout_s = options_.evaluation_timeout_s;
    limits.memory_limit_bytes = options_.memory_limit_bytes;
    set_failure(result, child, {}, limits);
    if (child.end == ChildEnd::timeout) {
      result["status"] = "failed";
    }
    result["reason"] = "meshed, but the evaluation did not end: " + result["reason"].get<std::string>() +
                       (child.end == ChildEnd::timeout ? "; --evaluation-timeout sets that" : "");
  }

  const Bench& bench_;
  const RunOptions& options_;
  const Job& job_;
  const JobFiles& files_;
};

constexpr const char* kElementKinds[] = {"tets", "pyramids", "wedges", "hexes"};

/// Elements of the mesh of a job: by its mesher's report, else by its file. 0 where there are none.
double count_elements(const Json& result, const fs::path& mesh_file) {
  double elements = 0;
  for (const char* kind : kElementKinds) {
    const Json count = figure(result, {"counts", kind});
    elements += count.is_number() ? count.get<double>() : 0;
  }
  if (elements == 0) {
    const Mesh mesh = read_mesh(mesh_file);
    elements =
        static_cast<double>(mesh.tets.size() + mesh.pyramids.size() + mesh.wedges.size() + mesh.hexes.size());
  }
  return elements;
}

/// Counts of a mesh that was not judged, where its mesher reported none; none of one that cannot be read.
void count_unjudged(Json& result, const fs::path& mesh_file) {
  if (figure(result, {"counts", "tets"}).is_number() && figure(result, {"counts", "tets"}) != 0) {
    return;
  }
  try {
    const Mesh mesh = read_mesh(mesh_file);
    result["counts"] = {{"vertices", mesh.points.size()},
                        {"tets", mesh.tets.size()},
                        {"pyramids", mesh.pyramids.size()},
                        {"wedges", mesh.wedges.size()},
                        {"hexes", mesh.hexes.size()}};
  } catch (const InputError& error) {
    return;  // the reason why it was not judged says so
  }
}

/// The command of a job with names in the place of its files.
std::vector<std::string> nameless_command(const Job& job, const fs::path& bin_dir,
                                          const Parameters& parameters) {
  return job.mesher->command(bin_dir, {"IMAGE", "MESH", "REPORT", job.threads, parameters});
}

/// The image in the format that the mesher asks for: the case's own file, or a copy, kept for other jobs.
fs::path image_for(const baselines::Adapter& mesher, const fs::path& image, const std::string& sha256,
                   const fs::path& out_dir) {
  const std::string& extension = mesher.image_extension;
  if (extension.empty() || image.string().ends_with(extension)) {
    return image;
  }
  const fs::path copy = out_dir / "images" / (sha256 + extension);
  if (!fs::is_regular_file(copy)) {
    fs::create_directories(copy.parent_path());
    write_label_image(read_label_image(image), copy);
  }
  return copy;
}

/// What the searches of several budgets have in common, and so their tries.
std::string common_key(const Job& job, const fs::path& bin_dir) {
  const std::vector<std::string> argv = nameless_command(job, bin_dir, job.parameters);
  return cases::sha256_of_text(configuration_of(job, argv).dump() + program_digest(argv.front()).dump());
}

Json to_json(const std::vector<DialTry>& tries) {
  Json list = Json::array();
  for (const DialTry& one : tries) {
    list.push_back({{"value", one.value}, {"elements", one.has_mesh() ? Json(one.elements) : Json()}});
    if (!one.has_mesh()) {
      list.back()["failure"] = one.failure;
    }
  }
  return list;
}

/// The meshes of a search: each try is a whole job of the mesher, and the one nearest to the budget stays.
class SizeSearch {
 public:
  SizeSearch(const Job& job, double budget, baselines::SizeDial dial, const fs::path& bin_dir,
             std::vector<DialTry> known)
      : job_(job),
        dial_(std::move(dial)),
        bin_dir_(bin_dir),
        known_count_(known.size()),
        search_(dial_, budget, std::move(known)) {}

  /// The line of the job whose mesh stays in the place of `files`, with the record of the search; without a
  /// mesh that of the last try.
  Json run(const Children& children, const JobFiles& files, const fs::path& image, const Json& identity) {
    std::error_code error;
    fs::remove(kept_file(files), error);
    while (const auto value = search_.next()) {
      attempt(*value, children, files, image, identity);
    }
    const DialTry* best = search_.best();
    if (best != nullptr && best->value != kept_value_) {  // a former job's try was nearer
      attempt(best->value, children, files, image, identity);
    }
    if (kept_value_) {
      fs::rename(kept_file(files), files.mesh);
    }
    kept_["size_search"] = record();
    return kept_;
  }
  [[nodiscard]] bool has_mesh() const { return kept_value_.has_value(); }
  [[nodiscard]] const std::vector<DialTry>& tries() const { return search_.tries(); }

 private:
  static fs::path kept_file(const JobFiles& files) { return files.mesh.string() + ".kept"; }

  void attempt(double value, const Children& children, const JobFiles& files, const fs::path& image,
               const Json& identity) {
    Json line = identity;
    const Parameters parameters =
        with_size(dial_, value, job_.mesher->parameters.in(bin_dir_), job_.parameters);
    line["parameters"] = parameters;
    line["provenance"]["command"] = nameless_command(job_, bin_dir_, parameters);
    files.remove_all();
    DialTry one{.value = value, .elements = 0, .failure = ""};
    if (children.mesh(image, parameters, line)) {
      one.elements = count_elements(line, files.mesh);
    }
    one.failure = one.has_mesh() ? "" : line["status"].is_null() ? "no element" : text_at(line, "reason");
    search_.add(one);
    const DialTry* best = search_.best();
    if (one.has_mesh() && (best->value == value || !kept_value_)) {
      fs::rename(files.mesh, kept_file(files));
      kept_value_ = value;
      kept_ = line;
    } else if (!kept_value_) {
      kept_ = line;
    }
  }

  [[nodiscard]] Json record() const {
    const std::vector<DialTry>& all = search_.tries();
    const auto first_own = all.begin() + static_cast<std::ptrdiff_t>(known_count_);
    return {{"parameter", dial_.parameter},
            {"met", search_.is_met()},
            {"reason", search_.reason()},
            {"given_parameters", job_.parameters},
            {"tries", to_json({first_own, all.end()})}};
  }

  const Job& job_;
  baselines::SizeDial dial_;
  const fs::path& bin_dir_;
  std::size_t known_count_;
  DialSearch search_;
  std::optional<double> kept_value_;
  Json kept_;
};

}  // namespace

Json identity_of(const Job& job, const Bench& bench) {
  Json result = empty_result();
  result["case"] = job.subject->name;
  result["mesher"] = job.mesher->name;
  result["threads"] = job.threads;
  result["repeat"] = job.repeat;
  if (job.budget) {
    result["budget"] = *job.budget;
  }
  result["parameters"] = job.parameters;
  const std::vector<std::string> argv = nameless_command(job, bench.bin_dir, job.parameters);
  Json configuration = configuration_of(job, argv);
  if (job.budget) {
    configuration["budget"] = *job.budget;
  }
  Json& origin = result["provenance"];
  origin["configuration_sha256"] = cases::sha256_of_text(configuration.dump());
  origin["program_sha256"] = program_digest(argv.front());
  origin["evaluator_sha256"] = program_digest(bench.evaluate_command.front());
  origin["command"] = argv;
  origin["seed"] = seed_of(job, bench.bin_dir);
  origin["mesher_description"] = job.mesher->description;
  origin["mesher_licence"] = job.mesher->licence;
  origin["mesher_deterministic"] = job.mesher->deterministic;
  return result;
}

Json JobRunner::run(const Job& job) {
  Json result = identity_of(job, bench_);
  result["provenance"].update(provenance());
  result["provenance"]["threads_bound"] = binds_threads(options_, job);
  try {
    const baselines::Availability availability = job.mesher->availability(bench_.bin_dir);
    if (!availability.available) {
      set_status(result, "unavailable", availability.reason);
      return result;
    }
    const cases::ResolvedImage image = bench_.resolve_image(*job.subject);
    if (!image.skipped_reason.empty()) {
      set_status(result, "skipped", image.skipped_reason);
      return result;
    }
    result["provenance"]["image_file"] = fs::absolute(image.path).string();
    result["provenance"]["image_sha256"] =
        job.subject->image_sha256.empty() ? cases::sha256_of_file(image.path) : job.subject->image_sha256;
    run_children(job, image.path, result);
  } catch (const std::exception& error) {
    set_status(result, "failed", error.what());
  }
  return result;
}

void JobRunner::learn(const Json& result) {
  const Json key = figure(result, {"size_search", "common_sha256"});
  const Json tries = figure(result, {"size_search", "tries"});
  if (!key.is_string() || !tries.is_array()) {
    return;
  }
  for (const Json& one : tries) {
    const Json elements = figure(one, {"elements"});
    if (elements.is_number()) {
      tries_[key.get<std::string>()].push_back({one.at("value").get<double>(), elements.get<double>(), ""});
    }
  }
}

bool JobRunner::mesh_to_budget(const Job& job, std::int64_t budget, const fs::path& image, Json& result) {
  const auto dial = baselines::size_dial_of(*job.mesher, bench_.bin_dir);
  if (!dial) {
    set_status(result, "skipped", "the mesher names no size dial, so no budget can be met");
    return false;
  }
  const JobFiles files(options_.out_dir, file_stem(result), job.mesher->mesh_extension);
  const Children children(bench_, options_, job, files);
  const std::string key = common_key(job, bench_.bin_dir);
  SizeSearch search(job, static_cast<double>(budget), *dial, bench_.bin_dir, tries_[key]);
  result = search.run(children, files, image, result);
  result["size_search"]["common_sha256"] = key;
  learn(result);
  return search.has_mesh();
}

void JobRunner::run_children(const Job& job, const fs::path& image, Json& result) {
  const std::string stem = file_stem(result);
  const JobFiles files(options_.out_dir, stem, job.mesher->mesh_extension);
  files.remove_all();
  const Children children(bench_, options_, job, files);
  const double reference_before_s = reference_cpu_seconds(job.threads);
  const fs::path given =
      image_for(*job.mesher, image, result["provenance"]["image_sha256"], options_.out_dir);
  const bool meshed = job.budget ? mesh_to_budget(job, *job.budget, given, result)
                                 : children.mesh(given, job.parameters, result);
  result["time_s"]["reference_cpu"] = std::min(reference_before_s, reference_cpu_seconds(job.threads));
  if (!meshed) {
    return;
  }
  result["mesh_file"] = "meshes/" + stem + job.mesher->mesh_extension;
  result["mesh_sha256"] = cases::sha256_of_file(files.mesh);
  // The same bytes need no second judgement: repeats and thread counts mostly give the same mesh.
  const std::string key = result["provenance"]["image_sha256"].get<std::string>() +
                          result["mesh_sha256"].get<std::string>() + job.mesher->mesh_extension;
  if (!evaluations_.contains(key)) {
    const nlohmann::json evaluation = children.evaluate(image, result);
    if (evaluation.empty()) {
      count_unjudged(result, files.mesh);
      return;
    }
    evaluations_[key] = evaluation;
    if (options_.solve) {
      evaluations_[key]["solver"] = children.solve(image);
    }
  }
  merge_evaluation(result, evaluations_[key]);
  set_status(result, "ok", "");
}

}  // namespace cbc3d::reports
