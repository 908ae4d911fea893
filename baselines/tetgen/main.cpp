// cbc3d-mesher-tetgen.
#include "baselines/tetgen/adapter.hpp"
#include "baselines/tetgen/tetgen_mesher.hpp"

namespace {

using cbc3d::baselines::ParameterValues;
using cbc3d::baselines::TetgenOptions;

TetgenOptions options_of(const ParameterValues& values) {
  constexpr double kLargest = 1e9;
  TetgenOptions options;
  // Below 1 TetGen's refinement does not end.
  options.radius_edge_ratio = values.number("radius-edge-ratio", 1, 100);
  options.max_volume_mm3 = values.number("max-volume", 1e-6, kLargest);
  // Beyond 30 degrees hardly any refinement ends.
  options.min_dihedral_deg = values.number("min-dihedral", 0, 30);
  options.optimization_level = values.count("optimization-level", 0, 10);
  options.smoothing_steps = values.count("smoothing-steps", 0, 10000);
  options.reach = values.number("reach", 0, 0.49);
  options.repair_rounds = values.count("repair-rounds", 0, 1000);
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  cbc3d::baselines::MesherProgram program;
  program.adapter = cbc3d::baselines::tetgen_adapters().front();
  program.versions = {{"tetgen", CBC3D_TETGEN_VERSION}};
  program.check = [](const ParameterValues& values) { options_of(values); };
  program.run = [](const cbc3d::LabelImage& image, const ParameterValues& values, int,
                   cbc3d::StageClock& stages) {
    return cbc3d::baselines::mesh_with_tetgen(image, options_of(values), stages);
  };
  return cbc3d::baselines::run_mesher_program(program, argc, argv);
}
