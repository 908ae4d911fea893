// cbc3d-mesher-cgal and cbc3d-mesher-cgal-parallel.
#include <CGAL/version.h>

#include <limits>

#include "baselines/cgal/adapter.hpp"
#include "baselines/cgal/cgal_mesher.hpp"

namespace {

using cbc3d::baselines::CgalOptions;
using cbc3d::baselines::ParameterValues;

#ifdef CBC3D_CGAL_PARALLEL
constexpr std::size_t kMesher = 1;
#else
constexpr std::size_t kMesher = 0;
#endif

CgalOptions options_of(const ParameterValues& values) {
  constexpr double kSmallest = 1e-6;
  constexpr double kLargest = 1e6;
  CgalOptions options;
  // Refinement is proved to end up to 30 degrees only.
  options.facet_angle_deg = values.number("facet-angle", 0, 30);
  options.facet_size_mm = values.number("facet-size", kSmallest, kLargest);
  options.facet_distance_mm = values.number("facet-distance", kSmallest, kLargest);
  options.cell_radius_edge_ratio = values.number("cell-radius-edge-ratio", 1, kLargest);
  options.cell_size_mm = values.number("cell-size", kSmallest, kLargest);
  constexpr double kWidestBlur = 10;
  options.label_weights = values.number("label-weights", 0, kWidestBlur);
  constexpr int kMostIterations = 1000;
  options.odt_iterations = values.count("odt-iterations", 0, kMostIterations);
  options.lloyd_iterations = values.count("lloyd-iterations", 0, kMostIterations);
  options.perturb = values.flag("perturb");
  options.perturb_sliver_bound_deg = values.number("perturb-sliver-bound", 0, 90);
  options.exude = values.flag("exude");
  options.exude_sliver_bound_deg = values.number("exude-sliver-bound", 0, 90);
  options.time_limit_s = values.number("time-limit", 0, kLargest);
  options.seed = static_cast<unsigned>(values.count("seed", 0, std::numeric_limits<int>::max()));
  return options;
}

}  // namespace

int main(int argc, char** argv) {
  cbc3d::baselines::MesherProgram program;
  program.adapter = cbc3d::baselines::cgal_adapters().at(kMesher);
  program.versions = {{"cgal", CGAL_VERSION_STR}};
  program.check = [](const ParameterValues& values) { options_of(values); };
  program.run = [](const cbc3d::LabelImage& image, const ParameterValues& values, int threads,
                   cbc3d::StageClock& stages) {
    CgalOptions options = options_of(values);
    options.threads = threads;
    return cbc3d::baselines::mesh_with_cgal(image, options, stages);
  };
  return cbc3d::baselines::run_mesher_program(program, argc, argv);
}
