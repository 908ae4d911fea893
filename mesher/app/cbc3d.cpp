// The command `cbc3d`.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <new>
#include <string>
#include <string_view>

#include "mesher/app/clean_command.hpp"
#include "mesher/app/deform_command.hpp"
#include "mesher/app/flag_names.hpp"
#include "mesher/app/improve_command.hpp"
#include "mesher/app/info_command.hpp"
#include "mesher/app/mesh_command.hpp"
#include "mesher/app/segment_command.hpp"
#include "mesher/app/surface_command.hpp"
#include "mesher/app/tile_command.hpp"
#include "mesher/command_line/program_help.hpp"
#include "mesher/core/error.hpp"
#include "mesher/core/one_line.hpp"
#include "mesher/core/runtime.hpp"
#include "mesher/pipeline/option_table.hpp"

namespace {

cbc3d::ProgramHelp program_help() {
  return {
      .name = "cbc3d",
      .version = CBC3D_VERSION,
      .summary = "segmented images to tetrahedral or mixed meshes",
      .examples = {{"cbc3d mesh labels.nii.gz --out mesh.vtu",
                    "Meshes every label of a segmentation, with our best preset."},
                   {"cbc3d mesh labels.nrrd --out mesh.msh --elements 200000 --report report.json",
                    "About 200,000 elements for Gmsh, and a report of what was done and what is missing."},
                   {"cbc3d improve other.vtu labels.nii.gz --out better.vtu --min-dihedral 15",
                    "Repairs the bad tets of any labelled mesh, towards the boundaries of its image."}},
      .exit_codes = {"success", "not used", "bad usage or bad input", "a job that failed"}};
}

/// A name in a shell's single quotes where it has blanks or the like.
std::string shell_word(const std::string& name) {
  const std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./,:=+@%";
  return name.find_first_not_of(plain) == std::string::npos ? name : "'" + name + "'";
}

/// What was meant by a file in the place of a subcommand; empty where there is none.
std::string suggestion(int argc, char** argv) {
  if (argc < 2) {
    return "";
  }
  const std::filesystem::path file(argv[1]);
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) {
    return "";
  }
  std::filesystem::path stem = file.filename();
  for (const char* extension : {".gz", ".bz2"}) {
    stem = stem.extension() == extension ? stem.stem() : stem;
  }
  stem = stem.stem();
  stem = stem.extension() == ".seg" ? stem.stem() : stem;
  return "'" + file.string() + "' is a file, not a subcommand; to mesh it: cbc3d mesh " +
         shell_word(file.string()) + " --out " + shell_word(stem.string() + ".vtu");
}

}  // namespace

int main(int argc, char** argv) {
  cbc3d::open_standard_streams();
  cbc3d::let_waiting_threads_sleep(argv);
  cbc3d::keep_freed_memory();
  CLI::App app{"CBC3D: from a segmented multi-label image to a tetrahedral or mixed mesh"};
  app.require_subcommand(1);
  app.set_version_flag("--version", CBC3D_VERSION);
  cbc3d::add_program_help(app, program_help());
  int exit_code = cbc3d::kExitSuccess;
  try {
    cbc3d::add_mesh_command(app, exit_code);
    cbc3d::add_clean_command(app, exit_code);
    cbc3d::add_deform_command(app, exit_code);
    cbc3d::add_improve_command(app, exit_code);
    cbc3d::add_info_command(app, exit_code);
    cbc3d::add_segment_command(app, exit_code);
    cbc3d::add_surface_command(app, exit_code);
    cbc3d::add_tile_command(app, exit_code);
    app.parse(argc, argv);
  } catch (const CLI::CallForHelp& help) {
    return app.exit(help);
  } catch (const CLI::CallForAllHelp& help) {
    return app.exit(help);
  } catch (const CLI::CallForVersion& version) {
    return app.exit(version);
  } catch (const CLI::Success&) {
    return cbc3d::kExitSuccess;
  } catch (const CLI::ParseError& error) {
    if (const std::string meant = suggestion(argc, argv); !meant.empty()) {
      std::cerr << "cbc3d: " << cbc3d::one_line(meant) << '\n';
      return cbc3d::kExitBadInput;
    }
    std::cerr << "cbc3d: " << cbc3d::one_line(cbc3d::with_short_words(error.what())) << " (see --help)\n";
    return cbc3d::kExitBadInput;
  } catch (const cbc3d::OptionError& error) {
    std::cerr << "cbc3d: --" << cbc3d::one_line(error.what()) << '\n';
    return cbc3d::kExitBadInput;
  } catch (const cbc3d::InputError& error) {
    std::cerr << "cbc3d: " << cbc3d::one_line(cbc3d::with_flags(error.what())) << '\n';
    return cbc3d::kExitBadInput;
  } catch (const std::bad_alloc&) {
    std::cerr << "cbc3d: out of memory; use a larger --lattice-spacing or a machine with more memory\n";
    return cbc3d::kExitJobFailed;
  } catch (const std::exception& error) {
    std::cerr << "cbc3d: " << cbc3d::one_line(cbc3d::with_flags(error.what())) << '\n';
    return cbc3d::kExitJobFailed;
  }
  return exit_code;
}
