#include "mesher/app/mesh_command.hpp"

#include <iostream>
#include <memory>
#include <new>
#include <nlohmann/json.hpp>

#include "mesher/app/coordinates_option.hpp"
#include "mesher/app/flag_names.hpp"
#include "mesher/app/mesh_files.hpp"
#include "mesher/app/mesh_report.hpp"
#include "mesher/app/option_flags.hpp"
#include "mesher/app/option_json.hpp"
#include "mesher/app/subcommand.hpp"
#include "mesher/app/warning_groups.hpp"
#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"
#include "mesher/core/json_text.hpp"
#include "mesher/core/mesh_coordinates.hpp"
#include "mesher/core/read_image.hpp"
#include "mesher/core/terminal_progress.hpp"
#include "mesher/input/image_input.hpp"
#include "mesher/input/input_json.hpp"
#include "mesher/input/input_options.hpp"
#include "mesher/input/named_text.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"
#include "mesher/mesh_formats/output_texts.hpp"
#include "mesher/pipeline/mesh_findings.hpp"
#include "mesher/pipeline/mesh_image.hpp"
#include "mesher/pipeline/presets.hpp"
#include "mesher/pipeline/work_estimate.hpp"

namespace cbc3d {
namespace {

struct MeshCommand {
  std::string image;
  std::string out;
  std::string preset = preset_names().front();
  OptionSettings settings;
  MeshFileOptions writing;
  int order = 1;
  std::string dump_stages;
  ImageInput input;
  CommonOptions common;
};

void write_failure(const MeshCommand& command, const char* status, const std::string& reason) {
  if (!command.common.report_file.empty()) {
    const nlohmann::json json = {
        {"status", status}, {"reason", reason}, {"peak_rss_bytes", process_peak_rss_bytes()}};
    write_text_file(command.common.report_file, json_text(json) + "\n");
  }
}

/// Long work needs the user's consent, but for the paper's preset, which makes elements a hundred times as
/// fast.
bool needs_consent(const MeshCommand& command) {
  return !command.input.long_work && command.preset == preset_names().front();
}

MeshImageOptions options_of(const MeshCommand& command, const LabelImage& image) {
  MeshImageOptions options = preset_options(command.preset, image.frame);
  apply_settings(command.settings, options);
  require_known_labels(options, image);
  options.dump_stages = command.dump_stages;
  if (needs_consent(command)) {
    options.work_limit_s = work_limit_s(file_bytes_of_image(command.image), command.settings);
  }
  return options;
}

void require_expected_work(const MeshCommand& command, const LabelImage& image) {
  if (!needs_consent(command)) return;
  const std::string reason = why_long_work(image, file_bytes_of_image(command.image));
  if (!reason.empty()) {
    throw InputError("'" + command.image + "': " + reason + "; if that is meant, long_work takes it");
  }
}

void from_lps(QuadraticMesh& mesh, const std::string& coordinates, const ImageFrame& frame) {
  if (cbc3d::from_lps(mesh.points, coordinates, &frame)) {
    flip_orientation(mesh);
  }
}

/// Names the file in what `work` says when it ends by the limit.
template <typename Work>
Mesh naming_image(const std::string& image, const Work& work) {
  try {
    return work();
  } catch (const InputError& error) {
    if (error.parameter() != "work_limit_s") throw;
    throw InputError("'" + image + "': " + error.what(), error.parameter());
  }
}

/// The mesh of the corners; `quadratic` gets the whole of order 2.
Mesh mesh_in_order(LabelImage image, const RunDescription& run, const Progress& progress,
                   MeshImageReport& report, QuadraticMesh& quadratic) {
  if (run.order == 1) {
    return mesh_image(std::move(image), run.options, progress, report);
  }
  quadratic = mesh_image_quadratic(std::move(image), run.options, progress, report);
  return corner_mesh(quadratic);
}

void run(MeshCommand& command) {
  require_writable_mesh_path(command.out, command.writing);
  TerminalProgress progress(command.common.quiet);
  progress.step("reading " + command.image, 0);
  const Stopwatch reading;
  LabelImage image = read_input_image(command.image, command.input);
  require_expected_work(command, image);
  require_writable_labels({image.labels.begin() + 1, image.labels.end()}, command.out);
  RunDescription description{.preset = command.preset,
                             .threads = command.common.threads,
                             .options = options_of(command, image),
                             .order = command.order,
                             .frame = image.frame,
                             .names = command.input.names,
                             .input = chosen_json(command.input),
                             .coordinates = command.writing.coordinates,
                             .reading_seconds = reading.seconds()};
  MeshImageReport report;
  QuadraticMesh quadratic;
  Mesh mesh = naming_image(command.image, [&] {
    return mesh_in_order(std::move(image), description, progress, report, quadratic);
  });
  report.warnings.insert(report.warnings.begin(), command.input.warnings.begin(),
                         command.input.warnings.end());
  for (std::string& finding : mesh_findings(mesh, report, description.frame)) {
    report.warnings.push_back(std::move(finding));
  }
  for (std::string& warning : report.warnings) {
    warning = with_flags(warning);
  }
  if (mesh.cell_count() == 0) {
    throw JobError("the mesh of '" + command.image +
                   "' is empty: no label is larger than the lattice; give a smaller --lattice-spacing");
  }
  progress.step("writing " + command.out, 0.97);
  const Stopwatch writing;
  command.writing.names = command.input.names;
  if (command.order == 2) {
    from_lps(quadratic, command.writing.coordinates, description.frame);
    write_mesh(quadratic, command.out, command.writing);
  } else {
    cbc3d::from_lps(mesh, command.writing.coordinates, &description.frame);
    write_mesh(mesh, command.out, command.writing);
  }
  description.writing_seconds = writing.seconds();
  if (!command.common.report_file.empty()) {
    write_text_file(command.common.report_file, json_text(report_json(description, report, mesh)) + "\n");
  }
  progress.done();
  for (const std::string& warning : grouped_warnings(report.warnings)) {
    progress.line("warning: " + with_names(warning, command.input.names), true);
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

void print_description() {
  std::cout << describe_options().dump(2) << '\n';
  throw CLI::Success();
}

}  // namespace

void add_mesh_command(CLI::App& app, int& exit_code) {
  auto command = std::make_shared<MeshCommand>();
  CLI::App* mesh = app.add_subcommand("mesh", "mesh a segmented image");
  mesh->add_option("image", command->image, kImageFormats)->required();
  mesh->add_option("-o,--out", command->out, written_mesh_text())->required();
  mesh->add_option("--preset", command->preset,
                   "quality: our best; paper: the published method [" + command->preset + "]")
      ->check(CLI::IsMember(preset_names()));
  for (const OptionGroup group : {OptionGroup::cleaning, OptionGroup::lattice, OptionGroup::mixed,
                                  OptionGroup::improvement, OptionGroup::deformation}) {
    add_option_flags(*mesh, group, preset_columns(), command->settings);
  }
  mesh->add_option("--order", command->order, std::string(kOrderText) + " [1]")->check(CLI::IsMember({1, 2}));
  add_mesh_file_options(*mesh, command->writing);
  add_coordinates_option(*mesh, command->writing.coordinates);
  add_input_options(*mesh, InputScope::meshing, command->input);
  add_report_option(*mesh, command->common, "JSON file with options, counts, fidelity, seconds and warnings");
  mesh->add_option("--dump-stages", command->dump_stages, "folder for the mesh after each stage")
      ->type_name("DIR");
  mesh->add_flag_callback("--describe-options", print_description,
                          "print the options of every preset as JSON and end");
  complete_command(*mesh, command->common, exit_code, [command] { run_reporting(*command); });
}

}  // namespace cbc3d
