#include "mesher/app/mesh_command.hpp"

#include <functional>
#include <memory>
#include <new>
#include <nlohmann/json.hpp>

#include "mesher/app/flag_names.hpp"
#include "mesher/app/label_values.hpp"
#include "mesher/app/material_options.hpp"
#include "mesher/app/mesh_report.hpp"
#include "mesher/app/option_overrides.hpp"
#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"
#include "mesher/core/image_io.hpp"
#include "mesher/core/mesh_io.hpp"
#include "mesher/core/terminal_progress.hpp"
#include "mesher/pipeline/mesh_image.hpp"
#include "mesher/pipeline/presets.hpp"

namespace cbc3d {
namespace {

struct MeshCommand {
  std::string image;
  std::string out;
  RunDescription run{"quality", 0, {}, {}, 0, 0};
  std::vector<std::string> material_fidelity;
  std::vector<std::string> sizes;
  MaterialOptions materials;
  Overrides overrides;
  std::string report_file;
  std::string dump_stages;
  bool quiet = false;
};

void write_failure(const MeshCommand& command, const char* status, const std::string& reason) {
  if (!command.report_file.empty()) {
    const nlohmann::json json = {
        {"status", status}, {"reason", reason}, {"peak_rss_bytes", process_peak_rss_bytes()}};
    write_text_file(command.report_file, json.dump(2) + "\n");
  }
}

void run(MeshCommand& command) {
  command.run.threads = set_thread_count(command.run.threads);
  require_writable_mesh_path(command.out);
  if (!command.report_file.empty()) {
    require_writable(command.report_file);
  }
  TerminalProgress progress(command.quiet);
  progress.step("reading " + command.image, 0);
  const Stopwatch reading;
  LabelImage image = read_label_image(command.image);
  command.run.reading_seconds = reading.seconds();
  command.run.frame = image.frame;
  auto& options = command.run.options;
  MeshImageOptions asked;
  for (const auto& apply : command.overrides) {
    apply(asked);
  }
  options = preset_options(command.run.preset, image.frame, asked.mixed);
  for (const auto& apply : command.overrides) {
    apply(options);
  }
  options.dump_stages = command.dump_stages;
  options.refine.material_fidelity =
      parse_label_values("--material-fidelity", command.material_fidelity, image,
                         {[](double f) { return f > 0 && f <= 1; }, "F with F in (0, 1], for example 2=0.9"});
  options.refine.size_mm = parse_label_values(
      "--size", command.sizes, image,
      {[](double size_mm) { return size_mm > 0; }, "MM with a length above 0, for example 2=1.5"});
  options.improve.size_mm = options.refine.size_mm;
  apply_material_options(command.materials, image, options.deform.elasticity);
  MeshImageReport report;
  const Mesh mesh = mesh_image(std::move(image), options, progress, report);
  for (std::string& warning : report.warnings) {
    warning = with_flags(warning);
  }
  if (mesh.cell_count() == 0) {
    throw JobError("the mesh of '" + command.image +
                   "' is empty: no label is larger than the lattice; give a smaller --lattice-spacing");
  }
  progress.step("writing " + command.out, 0.97);
  const Stopwatch writing;
  write_mesh(mesh, command.out);
  command.run.writing_seconds = writing.seconds();
  if (!command.report_file.empty()) {
    write_text_file(command.report_file, report_json(command.run, report, mesh).dump(2) + "\n");
  }
  progress.done();
  for (const std::string& warning : report.warnings) {
    progress.line("warning: " + warning, true);
  }
  progress.line("wrote " + command.out + ": " + counts_text(mesh));
}

void run_reporting(MeshCommand& command) {
  try {
    run(command);
  } catch (const std::bad_alloc&) {
    write_failure(command, "out_of_memory", "out of memory");
    throw;
  } catch (const JobError& error) {
    write_failure(command, "failed", with_flags(error.what()));
    throw;
  }
}

}  // namespace

void add_mesh_command(CLI::App& app, int& exit_code) {
  auto command = std::make_shared<MeshCommand>();
  CLI::App* mesh = app.add_subcommand("mesh", "mesh a segmented image");
  mesh->add_option("image", command->image, "label image: NIfTI, NRRD, MHA/MHD or INRIMAGE")->required();
  mesh->add_option("--out", command->out, "mesh file: .vtu, .vtk or .msh")->required();
  mesh->add_option("--preset", command->run.preset,
                   "quality: our best; paper: the published method [quality]")
      ->check(CLI::IsMember(preset_names()));
  add_cleaning_options(*mesh, command->overrides);
  add_lattice_options(*mesh, command->overrides);
  mesh->add_option("--material-fidelity", command->material_fidelity,
                   "LABEL=F: the fidelity of one label (repeatable)");
  mesh->add_option("--size", command->sizes,
                   "LABEL=MM: the edges of this label's elements are no longer, about (repeatable)");
  add_mixed_options(*mesh, command->overrides);
  add_improvement_options(*mesh, command->overrides);
  add_deformation_options(*mesh, command->overrides);
  add_material_options(*mesh, command->materials);
  mesh->add_option("--report", command->report_file,
                   "JSON file with options, counts, fidelity, seconds and warnings");
  mesh->add_option("--dump-stages", command->dump_stages, "folder for the mesh after each stage");
  mesh->add_option("--threads", command->run.threads, "threads of all pools [all cores]")
      ->check(CLI::Range(0, 1024));
  mesh->add_flag("--quiet", command->quiet, "no progress");
  mesh->callback([command, &exit_code] {
    run_reporting(*command);
    exit_code = kExitSuccess;
  });
}

}  // namespace cbc3d
