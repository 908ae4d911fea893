// cbc3d-mesher-ld.
#include "baselines/core/driver.hpp"
#include "baselines/ld/adapter.hpp"
#include "baselines/ld/lattice_decimation.hpp"
#include "mesher/core/error.hpp"

namespace {

using cbc3d::baselines::ParameterValues;
using cbc3d::baselines::ld::LatticeDecimationOptions;

LatticeDecimationOptions options_of(const ParameterValues& values) {
  constexpr double kFarthest = 1e6;
  LatticeDecimationOptions options;
  auto& decimation = options.decimation;
  decimation.distances.image_to_mesh_mm = values.number("image-to-mesh", 0, kFarthest);
  decimation.distances.mesh_to_image_mm = values.number("mesh-to-image", 0, kFarthest);
  // Beyond 44 degrees not even cubes can be filled, below 60 of the largest nothing.
  decimation.min_dihedral_deg = values.number("min-dihedral", 0, 44);
  decimation.max_dihedral_deg = values.number("max-dihedral", 121, 180);
  decimation.first_min_dihedral_deg = values.number("first-min-dihedral", 0, 44);
  options.clean = values.flag("clean");
  options.block = values.count("block", 2, 1024);
  if ((options.block & (options.block - 1)) != 0) {
    throw cbc3d::InputError("--block " + values.all().at("block") + ": give a power of two");
  }
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  cbc3d::baselines::MesherProgram program;
  program.adapter = cbc3d::baselines::ld_adapters().front();
  program.versions = {{"cbc3d-mesher-ld", "1"}};
  program.check = [](const ParameterValues& values) { options_of(values); };
  program.run = [](const cbc3d::LabelImage& image, const ParameterValues& values, int,
                   cbc3d::StageClock& stages) {
    return cbc3d::baselines::ld::mesh_by_lattice_decimation(image, options_of(values), stages);
  };
  return cbc3d::baselines::run_mesher_program(program, argc, argv);
}
