// cbc3d-bench phantom: a generated label image as a file.
#include <iostream>

#include "cases/phantoms/registry.hpp"
#include "mesher/command_line/number_range.hpp"
#include "mesher/core/error.hpp"
#include "mesher/core/runtime.hpp"
#include "reports/commands/commands.hpp"

namespace cbc3d::reports {
namespace {

struct PhantomOptions {
  std::string name, out;
  std::vector<int> size;
  std::vector<double> spacing_mm;
  std::uint64_t seed = 0;
  int threads = 0;
  bool quiet = false;
};

int write_phantom(const PhantomOptions& options) {
  const cases::PhantomKind* kind = cases::find_phantom(options.name);
  if (kind == nullptr) {
    throw InputError("phantom '" + options.name + "' is unknown; there are " + cases::phantom_names());
  }
  cases::Phantom phantom{options.name, kind->size, kind->spacing_mm, options.seed, ""};
  if (!options.size.empty()) {
    phantom.size = {options.size[0], options.size[1], options.size[2]};
  }
  if (!options.spacing_mm.empty()) {
    phantom.spacing_mm = {options.spacing_mm[0], options.spacing_mm[1], options.spacing_mm[2]};
  }
  set_thread_count(options.threads);
  const std::string sha256 = cases::write_phantom(phantom, options.out);
  if (!options.quiet) {
    std::cout << "wrote " << options.out << ": " << phantom.size[0] << " x " << phantom.size[1] << " x "
              << phantom.size[2] << " voxels; their labels' sha256 is " << sha256 << '\n';
  }
  return kExitSuccess;
}

std::string names_help() {
  std::string text = "generator:";
  for (const cases::PhantomKind& kind : cases::phantom_kinds()) {
    text += "\n" + std::string(kind.name) + ": " + std::string(kind.description);
  }
  return text;
}

}  // namespace

Command add_phantom_command(CLI::App& app) {
  auto options = std::make_shared<PhantomOptions>();
  CLI::App* parser = app.add_subcommand("phantom", "Writes a generated label image");
  parser->add_option("NAME", options->name, names_help())->required();
  parser->add_option("-o,--out", options->out, "image file: .nii, .nii.gz, .nrrd, .mha or .mhd")->required();
  parser->add_option("--size", options->size, "voxels along each axis, X,Y,Z; default: the generator's own")
      ->delimiter(',')
      ->expected(3)
      ->check(whole_number_between(1, 100000));
  parser
      ->add_option("--spacing", options->spacing_mm, "voxel spacing, mm, X,Y,Z; default: the generator's own")
      ->delimiter(',')
      ->expected(3)
      ->check(number_between(1e-6, 1e6));
  parser->add_option("--seed", options->seed, "seed of the random choices")
      ->check(seed_value())
      ->capture_default_str();
  add_threads_option(parser, options->threads);
  parser->add_flag("--quiet", options->quiet, "print nothing");
  return {parser, [options] { return write_phantom(*options); }};
}

}  // namespace cbc3d::reports
