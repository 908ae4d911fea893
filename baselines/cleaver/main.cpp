// cbc3d-mesher-cleaver.
#include "baselines/cleaver/adapter.hpp"
#include "baselines/cleaver/cleaver_mesher.hpp"
#include "baselines/core/driver.hpp"
#include "mesher/core/runtime.hpp"

namespace {

using cbc3d::baselines::ParameterValues;
using cbc3d::baselines::cleaver::CleaverOptions;

CleaverOptions options_of(const ParameterValues& values) {
  CleaverOptions options;
  options.sampling_rate = values.number("sampling-rate", 0.01, 16);
  options.lipschitz = values.number("lipschitz", 0.01, 10);
  options.feature_scaling = values.number("feature-scaling", 0.01, 100);
  if (values.all().at("blur") != "voxel") options.blur_mm = values.number("blur", 1e-6, 1e6);
  options.graded = values.one_of("lattice", {"graded", "uniform"}) == "graded";
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  cbc3d::let_waiting_threads_sleep(argv);
  cbc3d::keep_freed_memory();
  cbc3d::baselines::MesherProgram program;
  program.adapter = cbc3d::baselines::cleaver_adapters().front();
  program.versions = {{"cleaver", "of this project"}};
  program.check = [](const ParameterValues& values) { options_of(values); };
  program.run = [](const cbc3d::LabelImage& image, const ParameterValues& values, int,
                   cbc3d::StageClock& stages) {
    auto result = cbc3d::baselines::cleaver::mesh_with_cleaver(image, options_of(values), stages);
    cbc3d::baselines::print_warnings(result.notes);
    return std::move(result.mesh);
  };
  return cbc3d::baselines::run_mesher_program(program, argc, argv);
}
