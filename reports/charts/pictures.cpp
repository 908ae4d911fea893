#include "reports/charts/pictures.hpp"

#include <set>

#include "reports/charts/picture_kinds.hpp"
#include "reports/results/format_number.hpp"
#include "reports/run/child_process.hpp"

namespace cbc3d::reports {
namespace {
namespace fs = std::filesystem;

constexpr double kTimeoutS = 180;
constexpr std::int64_t kMemoryLimitBytes = std::int64_t{8} << 30;
constexpr int kPicturesPerMesh = 4;

std::string caption_of(const JobResult& result) {
  const double elements = result.figures[metrics::metric_id("elements")].value_or(0);
  return result.case_name + "  -  " + result.mesher + "  -  " + format_number(elements, 0) + " elements";
}

/// Every kind of picture of a mesh, and small copies for the report in figures/small. `mixed`: a mesh of
/// mixed elements to put beside it; null: none.
ChildResult draw(const fs::path& out_dir, const JobResult& result, const JobResult* mixed,
                 const fs::path& bin_dir) {
  const std::string stem = picture_stem(result.case_name, result.mesher);
  std::vector<std::string> argv{"xvfb-run",
                                "-a",
                                "--server-args=-screen 0 1280x1024x24",
                                bin_dir / "cbc3d-picture",
                                out_dir / result.mesh_file,
                                "--image",
                                result.image_file,
                                "--caption",
                                caption_of(result),
                                "--small",
                                out_dir / "figures" / "small",
                                "--quiet"};
  for (const PictureKind& kind : picture_kinds()) {
    if (std::string(kind.name) != "beside") {
      argv.insert(argv.end(),
                  {std::string("--") + kind.name, out_dir / "figures" / (stem + "-" + kind.name + ".png")});
    } else if (mixed != nullptr) {
      argv.insert(argv.end(), {"--beside", out_dir / "figures" / (stem + "-beside.png"), "--mixed-mesh",
                               out_dir / mixed->mesh_file, "--mixed-caption", caption_of(*mixed)});
    }
  }
  return run_child({argv, 0, kTimeoutS, kMemoryLimitBytes});
}

bool can_be_drawn(const JobResult& result) {
  return result.is_ok() && !result.mesh_file.empty() && !result.image_file.empty();
}

/// The mesh of mixed elements of the same case, for the mesher with the paper's settings.
const JobResult* mixed_partner(const std::vector<JobResult>& results, const JobResult& result) {
  if (result.mesher != "cbc3d-paper") {
    return nullptr;
  }
  for (const JobResult& other : results) {
    if (other.case_name == result.case_name && other.mesher == "cbc3d-mixed" && can_be_drawn(other)) {
      return &other;
    }
  }
  return nullptr;
}

std::string failure_text(const ChildResult& child) {
  const std::string line = printable(last_line(child.stderr_tail));
  switch (child.end) {
    case ChildEnd::timeout:
      return "not done after " + format_number(kTimeoutS, 0) + " s";
    case ChildEnd::out_of_memory:
      return "too large";
    case ChildEnd::signalled:
      return signal_name(child.signal);
    default:
      return line.empty() ? "exit code " + std::to_string(child.exit_code) : line;
  }
}

}  // namespace

int draw_pictures(const fs::path& out_dir, const std::vector<JobResult>& results, const fs::path& bin_dir,
                  TerminalProgress& progress) {
  if (!fs::exists(bin_dir / "cbc3d-picture")) {
    progress.line("no pictures: cbc3d-picture is not built; install VTK's rendering modules and build again");
    return 0;
  }
  fs::create_directories(out_dir / "figures" / "small");
  std::set<std::pair<std::string, std::string>> drawn;
  for (const JobResult& result : results) {
    const std::pair key{result.case_name, result.mesher};
    if (!can_be_drawn(result) || drawn.contains(key)) {
      continue;
    }
    progress.step("pictures: " + key.first + ", " + key.second, 1);
    const ChildResult child = draw(out_dir, result, mixed_partner(results, result), bin_dir);
    if (child.end == ChildEnd::not_started) {
      progress.line("no pictures: " + printable(last_line(child.stderr_tail)) + "; install xvfb");
      return 0;
    }
    if (child.end == ChildEnd::exited && child.exit_code == 0) {
      drawn.insert(key);
    } else {
      progress.line("no picture of " + key.first + ", " + key.second + ": " + failure_text(child));
    }
  }
  progress.done();
  return kPicturesPerMesh * static_cast<int>(drawn.size());
}

}  // namespace cbc3d::reports
