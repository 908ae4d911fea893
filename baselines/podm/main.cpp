// cbc3d-mesher-podm.
#include <CGAL/version.h>

#include "baselines/core/driver.hpp"
#include "baselines/podm/adapter.hpp"
#include "baselines/podm/podm_mesher.hpp"
#include "mesher/core/runtime.hpp"

namespace {

using cbc3d::baselines::ParameterValues;
using cbc3d::baselines::podm::PodmOptions;

PodmOptions options_of(const ParameterValues& values) {
  constexpr double kSmallest = 1e-6, kLargest = 1e6;
  PodmOptions options;
  auto& refinement = options.refinement;
  options.delta_by_voxel = values.all().at("delta") == "voxel";
  if (!options.delta_by_voxel) refinement.delta_mm = values.number("delta", kSmallest, kLargest);
  // Refinement is proved to end from the ratio of sqrt(sqrt(3) + 2) and up to the angle of 30 degrees.
  refinement.radius_edge_ratio = values.number("radius-edge-ratio", 1.94, 1000);
  refinement.facet_angle_deg = values.number("facet-angle", 0, 30);
  refinement.size_mm = values.number("size", 0, kLargest);
  refinement.min_dihedral_deg = values.number("min-dihedral", 0, 30);
  options.smooth = values.one_of("surface", {"voxels", "smooth"}) == "smooth";
  refinement.remove_free = values.flag("remove-free");
  refinement.removals_per_surface_vertex = values.number("removal-cap", 0, kLargest);
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  cbc3d::let_waiting_threads_sleep(argv);
  cbc3d::keep_freed_memory();
  cbc3d::baselines::MesherProgram program;
  program.adapter = cbc3d::baselines::podm_adapters().front();
  program.versions = {{"cgal", CGAL_VERSION_STR}, {"podm", "of this project"}};
  program.check = [](const ParameterValues& values) { options_of(values); };
  program.run = [](const cbc3d::LabelImage& image, const ParameterValues& values, int threads,
                   cbc3d::StageClock& stages) {
    PodmOptions options = options_of(values);
    options.refinement.threads = threads;
    auto result = cbc3d::baselines::podm::mesh_with_podm(image, options, stages);
    cbc3d::baselines::print_warnings(result.notes);
    return std::move(result.mesh);
  };
  return cbc3d::baselines::run_mesher_program(program, argc, argv);
}
