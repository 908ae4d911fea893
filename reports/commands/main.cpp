// cbc3d-bench: meshers on cases, measured alike.
#include <iostream>
#include <string_view>

#include "mesher/command_line/program_help.hpp"
#include "mesher/core/error.hpp"
#include "mesher/core/one_line.hpp"
#include "mesher/core/runtime.hpp"
#include "reports/commands/commands.hpp"

namespace {

cbc3d::ProgramHelp program_help() {
  return {
      .name = "cbc3d-bench",
      .version = CBC3D_VERSION,
      .summary = "runs meshers on segmented images and judges the meshes",
      .examples = {{"cbc3d-bench evaluate mesh.vtu labels.nii.gz --json figures.json",
                    "Judges any mesh against its segmentation."},
                   {"cbc3d-bench run --case phantom-shells --mesher cbc3d cgal --out out",
                    "Compares two meshers on one case; tables and pictures are in out/."},
                   {"cbc3d-bench report out --out report.html", "Makes one page of a run."}},
      .exit_codes = {"success", "a gate that does not hold", "bad usage or bad input", "a job that failed"}};
}

}  // namespace

int main(int argc, char** argv) {
  cbc3d::open_standard_streams();
  // Not for `run`: the meshers that it starts keep the environment they were given.
  if (argc > 1 && std::string_view(argv[1]) == "evaluate") {
    cbc3d::let_waiting_threads_sleep(argv);
  }
  using namespace cbc3d;
  CLI::App app{
      "Runs meshers on segmented images, judges the meshes and writes comparison tables.\n"
      "Exit codes: 0 success, 1 a gate that does not hold, 2 bad usage or input, 3 a job failed."};
  app.require_subcommand(1);
  add_program_help(app, program_help());
  const std::vector<reports::Command> commands{
      reports::add_list_command(app),    reports::add_run_command(app),    reports::add_evaluate_command(app),
      reports::add_tables_command(app),  reports::add_merge_command(app),  reports::add_gate_command(app),
      reports::add_report_command(app),  reports::add_sweep_command(app),  reports::add_phantom_command(app),
      reports::add_history_command(app), reports::add_cluster_command(app)};
  try {
    app.parse(argc, argv);
    for (const reports::Command& command : commands) {
      if (command.parser->parsed()) {
        return command.run();
      }
    }
    return kExitBadInput;
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) {  // what --help and --version asked for
      return app.exit(error);
    }
    std::cerr << "cbc3d-bench: " << one_line(with_short_words(error.what())) << " (see --help)\n";
    return kExitBadInput;
  } catch (const InputError& error) {
    std::cerr << one_line(error.what()) << '\n';
    return kExitBadInput;
  } catch (const std::bad_alloc&) {
    std::cerr << "out of memory\n";
    return kExitJobFailed;
  } catch (const std::exception& error) {
    std::cerr << one_line(error.what()) << '\n';
    return kExitJobFailed;
  }
}
