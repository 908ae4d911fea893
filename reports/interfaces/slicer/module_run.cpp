#include "reports/interfaces/slicer/module_run.hpp"

#include <fstream>
#include <iterator>
#include <utility>

#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"
#include "mesher/core/image_io.hpp"
#include "mesher/core/progress.hpp"
#include "mesher/core/runtime.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"
#include "mesher/pipeline/mesh_findings.hpp"
#include "mesher/pipeline/mesh_image.hpp"
#include "mesher/pipeline/presets.hpp"
#include "mesher/preprocess/grey_check.hpp"

namespace cbc3d::slicer {
namespace {

/// The lines of one run: start, progress, end.
class FilterLines {
 public:
  explicit FilterLines(std::ostream& out) : out_(out) {
    out_ << "<filter-start>\n<filter-name>CBC3D</filter-name>\n<filter-comment>label map to "
            "mesh</filter-comment>\n</filter-start>\n"
         << std::flush;
  }
  ~FilterLines() {
    out_ << "<filter-end>\n<filter-name>CBC3D</filter-name>\n<filter-time>" << watch_.seconds()
         << "</filter-time>\n</filter-end>\n"
         << std::flush;
  }
  FilterLines(const FilterLines&) = delete;
  FilterLines& operator=(const FilterLines&) = delete;

  void step(std::string_view stage, double fraction) {
    out_ << "<filter-progress>" << fraction << "</filter-progress>\n<filter-progress-text progress=\""
         << fraction << "\">" << stage << "</filter-progress-text>\n"
         << std::flush;
  }

 private:
  std::ostream& out_;
  Stopwatch watch_;
};

LabelImage read(const ModuleRun& run, std::vector<std::string>& warnings) {
  LabelImage image = read_label_image(run.label_map, {}, &warnings);
  if (const std::string reason = why_grey(image); !reason.empty()) {
    throw InputError("'" + run.label_map.string() + "': " + reason +
                     "; choose a label map or segmentation, not a grey volume");
  }
  return image;
}

}  // namespace

std::vector<std::string> run_module(const ModuleRun& run, std::ostream& out) {
  require_writable_mesh_path(run.model);
  FilterLines lines(out);
  const auto step = [&lines](std::string_view stage, double fraction) {
    lines.step(stage, fraction);
    return true;
  };
  step("reading", 0);
  std::vector<std::string> warnings;
  LabelImage image = read(run, warnings);
  const ImageFrame frame = image.frame;
  MeshImageOptions options = preset_options(run.preset, frame);
  apply_settings(run.settings, options);
  require_known_labels(options, image);
  MeshImageReport report;
  const Mesh mesh = mesh_image(std::move(image), options, Progress(step), report);
  if (mesh.cell_count() == 0) {
    throw JobError("the mesh is empty: no label is larger than the lattice; give a smaller lattice spacing");
  }
  step("writing", 0.97);
  write_mesh(mesh, run.model);
  if (run.model.extension() == ".vtk") {
    state_lps(run.model);
  }
  step("done", 1);
  warnings.insert(warnings.end(), report.warnings.begin(), report.warnings.end());
  for (std::string& finding : mesh_findings(mesh, report, frame)) {
    warnings.push_back(std::move(finding));
  }
  return warnings;
}

void state_lps(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  // The second line is the title, of no more than 256 characters.
  const std::size_t begin = bytes.find('\n') + 1, end = bytes.find('\n', begin);
  if (begin == 0 || end == std::string::npos) {
    throw JobError("'" + file.string() + "': it has no title to say the coordinates in");
  }
  bytes.replace(begin, end - begin, "CBC3D mesh, mm. SPACE=LPS");
  write_text_file(file, bytes);
}

}  // namespace cbc3d::slicer
