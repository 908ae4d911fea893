#include "baselines/core/driver.hpp"

#include <sys/resource.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <iostream>
#include <new>
#include <nlohmann/json.hpp>

#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"
#include "mesher/core/image_io.hpp"
#include "mesher/core/json_text.hpp"
#include "mesher/core/runtime.hpp"
#include "mesher/core/terminal_progress.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"

namespace cbc3d::baselines {

ParameterValues::ParameterValues(const std::vector<ParameterSpec>& specs) {
  for (const ParameterSpec& spec : specs) values_[spec.key] = spec.default_value;
}

namespace {

// The whole of `text` as a finite number.
bool parse_number(const std::string& text, double& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && end == text.data() + text.size() && std::isfinite(number);
}

std::string as_text(double number) {
  std::ostringstream out;
  out << number;
  return out.str();
}

}  // namespace

double ParameterValues::number(const std::string& key, double lowest, double highest) const {
  const std::string& value = values_.at(key);
  double result = 0;
  if (!parse_number(value, result) || result < lowest || result > highest) {
    throw InputError("--" + key + " " + value + ": give a number from " + as_text(lowest) + " to " +
                     as_text(highest));
  }
  return result;
}

int ParameterValues::count(const std::string& key, int lowest, int highest) const {
  const double result = number(key, lowest, highest);
  if (result != std::floor(result))
    throw InputError("--" + key + " " + values_.at(key) + ": give a whole number");
  return static_cast<int>(result);
}

const std::string& ParameterValues::one_of(const std::string& key,
                                           const std::vector<std::string>& choices) const {
  const std::string& value = values_.at(key);
  if (std::find(choices.begin(), choices.end(), value) == choices.end()) {
    std::string known = choices.front();
    for (std::size_t c = 1; c < choices.size(); ++c)
      known += (c + 1 < choices.size() ? ", " : " or ") + choices[c];
    throw InputError("--" + key + " " + value + ": give " + known);
  }
  return value;
}

bool ParameterValues::flag(const std::string& key) const {
  return one_of(key, {"true", "false"}) == "true";
}

void print_warnings(const std::vector<std::string>& notes) {
  for (const std::string& note : notes) std::cerr << "warning: " << note << '\n';
}

namespace {

struct Request {
  MeshJob job;
  bool quiet = false;
};

// How a run ended, for its report.
struct Outcome {
  int exit_code = kExitSuccess;
  std::string status = "ok";
  std::string reason;
  double total_s = 0;
  double cpu_s = 0;
  StageClock stages;
  std::size_t vertices = 0;
  std::size_t tets = 0;
};

rusage children_usage() {
  rusage usage{};
  ::getrusage(RUSAGE_CHILDREN, &usage);
  return usage;
}

double cpu_seconds_with_children() {
  const rusage usage = children_usage();
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return process_cpu_seconds() + seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// A forked child shares its parent's pages, so the run took the larger of the two.
std::int64_t peak_rss_bytes_with_children() {
  return std::max(process_peak_rss_bytes(), static_cast<std::int64_t>(children_usage().ru_maxrss) * 1024);
}

void add_options(CLI::App& app, Request& request, ParameterValues& values,
                 const std::vector<ParameterSpec>& specs) {
  app.add_option("--image", request.job.image, "label image to mesh")->required();
  app.add_option("--out", request.job.mesh, "mesh to write: .vtu, .vtk or .msh")->required();
  app.add_option("--report", request.job.report, "JSON report to write");
  app.add_option("--threads", request.job.threads, "threads; 0: all cores")
      ->default_val(0)
      ->check(CLI::NonNegativeNumber);
  app.add_flag("--quiet", request.quiet, "no progress on standard error");
  for (const ParameterSpec& spec : specs) {
    app.add_option("--" + spec.key, values.text(spec.key),
                   spec.description + (spec.unit.empty() ? "" : " [" + spec.unit + "]"))
        ->default_str(spec.default_value);
  }
}

nlohmann::ordered_json json_value(const std::string& text) {
  double number = 0;
  if (text == "true" || text == "false") return text == "true";
  if (parse_number(text, number)) return number;
  return text;
}

void write_report(const MesherProgram& program, const Request& request, const ParameterValues& values,
                  const Outcome& outcome) {
  nlohmann::ordered_json stages = nlohmann::ordered_json::object();
  for (const auto& [name, seconds] : outcome.stages.seconds()) stages[name] = seconds;
  nlohmann::ordered_json parameters = nlohmann::ordered_json::object();
  for (const auto& [key, text] : values.all()) parameters[key] = json_value(text);
  parameters["threads"] = request.job.threads;
  const nlohmann::ordered_json report{
      {"status", outcome.status},
      {"reason", outcome.reason},
      {"seconds", {{"total", outcome.total_s}, {"cpu", outcome.cpu_s}, {"stages", stages}}},
      {"peak_rss_bytes", peak_rss_bytes_with_children()},
      {"counts", {{"vertices", outcome.vertices}, {"tets", outcome.tets}}},
      {"parameters", parameters},
      {"versions", program.versions}};
  write_text_file(request.job.report, json_text(report) + "\n");
}

Mesh timed_run(const MesherProgram& program, const LabelImage& image, const ParameterValues& values,
               int threads, Outcome& outcome) {
  const double cpu_before = cpu_seconds_with_children();
  const Stopwatch watch;
  const auto take_times = [&] {
    outcome.stages.stop();
    outcome.total_s = watch.seconds();
    outcome.cpu_s = cpu_seconds_with_children() - cpu_before;
  };
  try {
    Mesh mesh = program.run(image, values, threads, outcome.stages);
    take_times();
    return mesh;
  } catch (...) {
    take_times();
    throw;
  }
}

void mesh_the_image(const MesherProgram& program, Request& request, const ParameterValues& values,
                    Outcome& outcome) {
  TerminalProgress progress(request.quiet);
  request.job.threads = set_thread_count(request.job.threads);
  program.check(values);
  require_writable_mesh_path(request.job.mesh);
  progress.step("read image", 0);
  const LabelImage image = read_label_image(request.job.image);
  progress.step("mesh", 0.05);
  const Mesh mesh = timed_run(program, image, values, request.job.threads, outcome);
  outcome.vertices = mesh.points.size();
  outcome.tets = mesh.tets.size();
  progress.step("write mesh", 0.95);
  write_mesh(mesh, request.job.mesh);
  progress.done();
}

void fail(Outcome& outcome, int exit_code, const std::string& status, const std::string& reason) {
  outcome.exit_code = exit_code;
  outcome.status = status;
  outcome.reason = reason;
}

// Runs the job; the outcome has what went wrong.
Outcome attempt(const MesherProgram& program, Request& request, const ParameterValues& values) {
  Outcome outcome;
  try {
    mesh_the_image(program, request, values, outcome);
  } catch (const InputError& error) {
    fail(outcome, kExitBadInput, "failed", error.what());
  } catch (const std::bad_alloc&) {
    fail(outcome, kExitJobFailed, "out_of_memory", "out of memory");
  } catch (const std::exception& error) {
    fail(outcome, kExitJobFailed, "failed", error.what());
  } catch (...) {
    fail(outcome, kExitJobFailed, "failed", "the mesher threw something that is no exception of C++'s");
  }
  return outcome;
}

}  // namespace

int run_mesher_program(const MesherProgram& program, int argc, char** argv) {
  open_standard_streams();
  const Adapter& adapter = program.adapter;
  const ParameterSpecs& specs = adapter.parameters.in({});
  ParameterValues values(specs);
  Request request;
  CLI::App app(adapter.description + " (licence: " + adapter.licence + ")");
  add_options(app, request, values, specs);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kExitSuccess : kExitBadInput;
  }
  try {
    if (!request.job.report.empty()) require_writable(request.job.report);
    const Outcome outcome = attempt(program, request, values);
    if (outcome.exit_code != kExitSuccess) std::cerr << "error: " << outcome.reason << '\n';
    if (!request.job.report.empty()) write_report(program, request, values, outcome);
    return outcome.exit_code;
  } catch (const InputError& error) {
    std::cerr << "error: " << error.what() << '\n';
    return kExitBadInput;
  } catch (const std::exception& error) {
    std::cerr << "error: " << error.what() << '\n';
    return kExitJobFailed;
  }
}

}  // namespace cbc3d::baselines
