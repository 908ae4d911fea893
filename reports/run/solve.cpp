#include "reports/run/solve.hpp"

#include <cstdlib>
#include <fstream>

#include "baselines/core/adapter.hpp"
#include "mesher/core/error.hpp"
#include "mesher/core/json_text.hpp"
#include "reports/run/child_process.hpp"

namespace cbc3d::reports {
namespace {
namespace fs = std::filesystem;

/// A new folder among the temporary files, removed at the end.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string name = fs::temp_directory_path() / "cbc3d-solve-XXXXXX";
    if (::mkdtemp(name.data()) == nullptr) {
      throw JobError("cannot make the folder '" + name + "'; make room there or set TMPDIR");
    }
    path_ = name;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

nlohmann::json without_figures(const std::string& reason) {
  return {{"poisson_p1", nullptr}, {"poisson_p2", nullptr}, {"reason", reason}};
}

/// Why there are no figures.
std::string reason_of(const ChildResult& child, const SolveJob& job) {
  const std::string text = failure_text(child, job.timeout_s, job.memory_limit_bytes);
  const bool by_itself = child.end == ChildEnd::exited;
  return by_itself && child.exit_code == kExitBadInput    ? "the mesh is refused: " + text
         : by_itself && child.exit_code == kExitJobFailed ? "not solved: " + text
         : by_itself && child.exit_code == 0 ? "the solver ended with success but wrote no figures"
                                             : text;
}

/// Section `solver` of a report; null where there is none.
nlohmann::json figures_in(const fs::path& file) {
  std::ifstream stream(file);
  const auto report = json_object_or_empty<nlohmann::json>(stream);
  return report.contains("solver") && report["solver"].is_object() ? report["solver"] : nlohmann::json();
}

}  // namespace

std::vector<std::string> solve_command(const fs::path& bin_dir) {
  return {bin_dir / "cbc3d-solve"};
}

nlohmann::json solve(const SolveJob& job) {
  if (baselines::find_program(job.command.front()).empty()) {
    return without_figures("'" + job.command.front() +
                           "' is not built; install GetFEM (libgetfem-dev) and build again");
  }
  const ScratchFolder folder;
  const fs::path json = folder.path() / "solver.json";
  std::vector<std::string> argv = job.command;
  argv.insert(argv.end(), {job.mesh, "--image", job.image, "--quiet", "--json", json});
  if (job.threads > 0) {
    argv.insert(argv.end(), {"--threads", std::to_string(job.threads)});
  }
  const ChildResult child = run_child({argv, job.threads, job.timeout_s, job.memory_limit_bytes});
  nlohmann::json figures = figures_in(json);
  if (child.end != ChildEnd::exited || child.exit_code != 0 || figures.is_null()) {
    return without_figures(reason_of(child, job));
  }
  figures["reason"] = "";
  return figures;
}

}  // namespace cbc3d::reports
