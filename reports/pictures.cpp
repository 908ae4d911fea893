#include "reports/pictures.hpp"

#include <set>

#include "reports/child_process.hpp"
#include "reports/table.hpp"

namespace cbc3d::reports {
namespace {
namespace fs = std::filesystem;

constexpr double kTimeoutS = 180;
constexpr std::int64_t kMemoryLimitBytes = std::int64_t{8} << 30;
constexpr int kPicturesPerMesh = 2;

std::string caption_of(const Json& result) {
  std::string text = result.value("case", "") + "  -  " + result.value("mesher", "");
  double elements = 0;
  for (const char* kind : {"tets", "pyramids", "wedges", "hexes"}) {
    const Json count = figure(result, {"counts", kind});
    elements += count.is_number() ? count.get<double>() : 0;
  }
  return text + "  -  " + format_number(elements, 0) + " elements";
}

ChildResult draw(const fs::path& out_dir, const Json& result, const fs::path& bin_dir) {
  const std::string stem = result.value("case", "") + "-" + result.value("mesher", "");
  const fs::path figures = out_dir / "figures";
  const std::string image = figure(result, {"provenance", "image_file"}).get<std::string>();
  return run_child({{"xvfb-run", "-a", "--server-args=-screen 0 1280x1024x24", bin_dir / "cbc3d-picture",
                     out_dir / result["mesh_file"].get<std::string>(), "--image", image, "--cut",
                     figures / (stem + "-cut.png"), "--surface", figures / (stem + "-surface.png"),
                     "--caption", caption_of(result), "--quiet"},
                    0,
                    kTimeoutS,
                    kMemoryLimitBytes});
}

bool can_be_drawn(const Json& result) {
  return result.value("status", "") == "ok" && figure(result, {"mesh_file"}).is_string() &&
         figure(result, {"provenance", "image_file"}).is_string();
}

std::string failure_text(const ChildResult& child) {
  const std::string line = last_line(child.stderr_tail);
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

int draw_pictures(const fs::path& out_dir, const std::vector<Json>& results, const fs::path& bin_dir,
                  Progress& progress) {
  if (!fs::exists(bin_dir / "cbc3d-picture")) {
    progress.line("no pictures: cbc3d-picture is not built; install VTK's rendering modules and build again");
    return 0;
  }
  fs::create_directories(out_dir / "figures");
  std::set<std::pair<std::string, std::string>> drawn;
  for (const Json& result : results) {
    const std::pair key{result.value("case", ""), result.value("mesher", "")};
    if (!can_be_drawn(result) || drawn.contains(key)) {
      continue;
    }
    progress.step("pictures: " + key.first + ", " + key.second, 1);
    const ChildResult child = draw(out_dir, result, bin_dir);
    if (child.end == ChildEnd::not_started) {
      progress.line("no pictures: " + last_line(child.stderr_tail) + "; install xvfb");
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
