#include "mesher/app/clean_command.hpp"

#include <memory>

#include "mesher/app/mesh_report.hpp"
#include "mesher/app/option_overrides.hpp"
#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"
#include "mesher/core/image_io.hpp"
#include "mesher/core/terminal_progress.hpp"

namespace cbc3d {
namespace {

struct CleanCommand {
  std::string image;
  std::string out;
  Overrides overrides;
  std::string report_file;
  int threads = 0;
  bool quiet = false;
};

void run(const CleanCommand& command) {
  set_thread_count(command.threads);
  require_writable(command.out);
  if (!command.report_file.empty()) {
    require_writable(command.report_file);
  }
  TerminalProgress progress(command.quiet);
  progress.step("reading " + command.image, 0);
  LabelImage image = read_label_image(command.image);
  MeshImageOptions options;
  for (const auto& apply : command.overrides) {
    apply(options);
  }
  progress.step("cleaning", 0.3);
  const CleanReport report = clean_image(image, options.clean, false);
  progress.step("writing " + command.out, 0.7);
  write_label_image(image, command.out);
  const nlohmann::json json = cleaning_json(report, image.frame);
  if (!command.report_file.empty()) {
    write_text_file(command.report_file, json.dump(2) + "\n");
  }
  progress.done();
  for (const LabelChange& change : report.labels) {
    if (change.voxels_before != change.voxels_after) {
      progress.line("label " + std::to_string(change.label) + ": " + std::to_string(change.voxels_before) +
                        " -> " + std::to_string(change.voxels_after) + " voxels",
                    change.voxels_after == 0);
    }
  }
  progress.line("wrote " + command.out + ": " + std::to_string(report.contacts.vertex_contacts) +
                " vertex and " + std::to_string(report.contacts.edge_contacts) + " edge contacts removed, " +
                std::to_string(report.removed.regions_removed) + " small regions removed");
}

}  // namespace

void add_clean_command(CLI::App& app, int& exit_code) {
  auto command = std::make_shared<CleanCommand>();
  CLI::App* clean = app.add_subcommand("clean", "the image pre-processing alone");
  clean->add_option("image", command->image, "label image: NIfTI, NRRD, MHA/MHD or INRIMAGE")->required();
  clean->add_option("--out", command->out, "label image: .nii, .nii.gz, .nrrd or .mha")->required();
  add_cleaning_options(*clean, command->overrides);
  clean->add_option("--report", command->report_file, "JSON file with what was changed");
  clean->add_option("--threads", command->threads, "threads of all pools [all cores]")
      ->check(CLI::Range(0, 1024));
  clean->add_flag("--quiet", command->quiet, "no progress");
  clean->callback([command, &exit_code] {
    run(*command);
    exit_code = kExitSuccess;
  });
}

}  // namespace cbc3d
