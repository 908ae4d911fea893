#include "mesher/app/deform_command.hpp"

#include <memory>
#include <nlohmann/json.hpp>

#include "mesher/app/material_options.hpp"
#include "mesher/app/mesh_report.hpp"
#include "mesher/app/option_overrides.hpp"
#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"
#include "mesher/core/image_io.hpp"
#include "mesher/core/mesh_io.hpp"
#include "mesher/core/runtime.hpp"
#include "mesher/core/terminal_progress.hpp"
#include "mesher/pipeline/presets.hpp"

namespace cbc3d {
namespace {

struct DeformCommand {
  std::string mesh, image, out;
  std::string preset = "quality";
  Overrides overrides;
  MaterialOptions materials;
  std::string report_file;
  int threads = 0;
  bool quiet = false;
};

MeshImageOptions options_of(const DeformCommand& command, const LabelImage& image) {
  MeshImageOptions options = preset_options(command.preset, image.frame, true);
  for (const auto& apply : command.overrides) {
    apply(options);
  }
  // A mesh from a file may be deformed already, so that no tet of it is red to the last digit.
  options.mix.red_only = false;
  options.mix.min_scaled_jacobian = options.deform.quality.min_scaled_jacobian;
  apply_material_options(command.materials, image, options.deform.elasticity);
  return options;
}

void write_report(const DeformCommand& command, const MeshImageOptions& options, const MixReport& mix,
                  const DeformReport& deform, const Mesh& mesh) {
  const nlohmann::json json = {{"status", "ok"},
                               {"reason", ""},
                               {"version", CBC3D_VERSION},
                               {"options", deformation_options_json(options)},
                               {"counts", counts_json(mesh)},
                               {"mixed_elements", options.mixed ? mix_json(mix) : nlohmann::json()},
                               {"deformation", deformation_json(deform)},
                               {"peak_rss_bytes", process_peak_rss_bytes()}};
  write_text_file(command.report_file, json.dump(2) + "\n");
}

void run(const DeformCommand& command) {
  set_thread_count(command.threads);
  require_writable_mesh_path(command.out);
  if (!command.report_file.empty()) {
    require_writable(command.report_file);
  }
  TerminalProgress progress(command.quiet);
  progress.step("reading " + command.mesh, 0);
  const LabelImage image = read_label_image(command.image);
  const MeshImageOptions options = options_of(command, image);
  MaterialMesh mesh = to_material_mesh(read_mesh(command.mesh), image);
  MixReport mix;
  if (options.mixed) {
    progress.step("mixed elements", 0.1);
    mix = mix_elements(mesh, options.mix);
  }
  const DeformReport deform = deform_mesh(mesh, image, options.deform, [&](int i) {
    progress.step("deformation, iteration " + std::to_string(i + 1),
                  0.2 + 0.7 * i / std::max(1, options.deform.iterations));
  });
  progress.step("writing " + command.out, 0.95);
  const Mesh out = to_physical_mesh(mesh, image);
  write_mesh(out, command.out);
  if (!command.report_file.empty()) {
    write_report(command, options, mix, deform, out);
  }
  progress.done();
  if (deform.stopped_early) {
    progress.line("warning: the deformation stopped after " + std::to_string(deform.iterations.size()) +
                      " iterations: elements stay below the minimum quality; --on-failure recover goes on",
                  true);
  }
  progress.line("wrote " + command.out + ": " + counts_text(out));
}

}  // namespace

void add_deform_command(CLI::App& app, int& exit_code) {
  auto command = std::make_shared<DeformCommand>();
  CLI::App* deform = app.add_subcommand("deform",
                                        "the deformation alone, on a given mesh with cell labels; with "
                                        "--mixed --iterations 0 the mixed elements alone");
  deform->add_option("mesh", command->mesh, "mesh of tets, pyramids, hexes: .vtu, .vtk or .msh")->required();
  deform->add_option("image", command->image, "label image that the mesh was made from")->required();
  deform->add_option("--out", command->out, "mesh file: .vtu, .vtk or .msh")->required();
  deform
      ->add_option("--preset", command->preset,
                   "quality: our best so far; paper: the published method [quality]")
      ->check(CLI::IsMember(preset_names()));
  add_mixed_options(*deform, command->overrides);
  add_deformation_options(*deform, command->overrides);
  add_material_options(*deform, command->materials);
  deform->add_option("--report", command->report_file,
                     "JSON file with options, counts and per-iteration figures");
  deform->add_option("--threads", command->threads, "threads of all pools [all cores]")
      ->check(CLI::Range(0, 1024));
  deform->add_flag("--quiet", command->quiet, "no progress");
  deform->callback([command, &exit_code] {
    run(*command);
    exit_code = kExitSuccess;
  });
}

}  // namespace cbc3d
