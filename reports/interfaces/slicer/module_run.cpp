#include "reports/interfaces/slicer/module_run.hpp"

#include <fstream>
#include <iterator>
#include <utility>

#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"
#include "mesher/core/progress.hpp"
#include "mesher/core/runtime.hpp"
#include "mesher/input/named_text.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"
#include "mesher/pipeline/mesh_findings.hpp"
#include "mesher/pipeline/mesh_image.hpp"
#include "mesher/pipeline/presets.hpp"

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

/// Meshes and writes; returns the mesh, of order 2 that of the corners.
Mesh mesh_and_write(const ModuleRun& run, LabelImage image, const MeshImageOptions& options,
                    const Progress& progress, MeshImageReport& report) {
  QuadraticMesh quadratic;
  Mesh mesh;
  if (run.order == 2) {
    quadratic = mesh_image_quadratic(std::move(image), options, progress, report);
    mesh = corner_mesh(quadratic);
  } else {
    mesh = mesh_image(std::move(image), options, progress, report);
  }
  if (mesh.cell_count() == 0) {
    throw JobError("the mesh is empty: no label is larger than the lattice; give a smaller lattice spacing");
  }
  progress.step("writing", 0.97);
  if (run.order == 2) {
    write_mesh(quadratic, run.model, run.writing);
  } else {
    write_mesh(mesh, run.model, run.writing);
  }
  return mesh;
}

}  // namespace

std::vector<std::string> run_module(ModuleRun& run, std::ostream& out) {
  require_writable_mesh_path(run.model, run.writing);
  FilterLines lines(out);
  const auto step = [&lines](std::string_view stage, double fraction) {
    lines.step(stage, fraction);
    return true;
  };
  step("reading", 0);
  LabelImage image = read_input_image(run.label_map.string(), run.input);
  run.writing.names = run.input.names;
  const ImageFrame frame = image.frame;
  MeshImageOptions options = preset_options(run.preset, frame);
  apply_settings(run.settings, options);
  require_known_labels(options, image);
  MeshImageReport report;
  const Mesh mesh = mesh_and_write(run, std::move(image), options, Progress(step), report);
  if (run.model.extension() == ".vtk") {
    state_lps(run.model);
  }
  step("done", 1);
  std::vector<std::string> warnings = run.input.warnings;
  warnings.insert(warnings.end(), report.warnings.begin(), report.warnings.end());
  for (std::string& finding : mesh_findings(mesh, report, frame)) {
    warnings.push_back(std::move(finding));
  }
  for (std::string& warning : warnings) warning = with_names(warning, run.input.names);
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
