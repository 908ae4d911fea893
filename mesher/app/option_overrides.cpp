#include "mesher/app/option_overrides.hpp"

#include <algorithm>
#include <cstdint>

namespace cbc3d {

const EnumNames<Connectivity> kConnectivityNames = {{"vertex", Connectivity::vertex},
                                                    {"edge", Connectivity::edge},
                                                    {"face", Connectivity::face},
                                                    {"no", Connectivity::no}};
const EnumNames<TargetPosition> kTargetPositionNames = {{"voxel-centre", TargetPosition::voxel_centre},
                                                        {"voxel-faces", TargetPosition::voxel_faces}};
const EnumNames<NoisyVoxels> kNoisyVoxelNames = {{"none", NoisyVoxels::none},
                                                 {"holes", NoisyVoxels::holes},
                                                 {"specks", NoisyVoxels::specks},
                                                 {"both", NoisyVoxels::both}};
const EnumNames<bool> kDisplacementNames = {{"normal", true}, {"full", false}};
const EnumNames<OnFailure> kOnFailureNames = {{"stop", OnFailure::stop}, {"recover", OnFailure::recover}};

namespace {

/// Adds an option whose value goes into the field that `field` picks.
template <typename Value, typename Field>
CLI::Option* add_override(CLI::App& app, Overrides& overrides, const std::string& name,
                          const std::string& text, Field field) {
  return app.add_option_function<Value>(
      name,
      [&overrides, field](const Value& value) {
        overrides.push_back([value, field](MeshImageOptions& o) { field(o) = value; });
      },
      text);
}

template <typename Enum, typename Field>
void add_choice(CLI::App& app, Overrides& overrides, const std::string& name, const std::string& text,
                const EnumNames<Enum>& names, Field field) {
  std::vector<std::string> allowed;
  for (const auto& n : names) {
    allowed.emplace_back(n.first);
  }
  app.add_option_function<std::string>(
         name,
         [&overrides, &names, field](const std::string& value) {
           const Enum chosen = std::find_if(names.begin(), names.end(), [&](const auto& n) {
                                 return value == n.first;
                               })->second;
           overrides.push_back([chosen, field](MeshImageOptions& o) { field(o) = chosen; });
         },
         text)
      ->check(CLI::IsMember(allowed));
}

}  // namespace

void add_cleaning_options(CLI::App& app, Overrides& overrides) {
  add_choice(app, overrides, "--relabel-noise",
             "isolated voxels given their neighbours' label: none, holes, specks or both [none]",
             kNoisyVoxelNames, [](MeshImageOptions& o) -> NoisyVoxels& { return o.clean.relabel_noise; });
  add_override<double>(
      app, overrides, "--region-tolerance",
      "regions below this share of their label's voxels become background [1e-4; preset quality: 0]",
      [](MeshImageOptions& o) -> double& { return o.clean.region_tolerance; })
      ->check(CLI::Range(0.0, 1.0));
  app.add_flag_callback(
      "--no-manifold-voxels",
      [&overrides] { overrides.emplace_back([](MeshImageOptions& o) { o.clean.manifold_voxels = false; }); },
      "leave voxels of a label that touch only by an edge or a vertex");
  add_override<std::uint64_t>(app, overrides, "--seed", "seed of the choice among cleaning templates [1]",
                              [](MeshImageOptions& o) -> std::uint64_t& { return o.clean.seed; });
}

void add_lattice_options(CLI::App& app, Overrides& overrides) {
  add_override<double>(app, overrides, "--lattice-spacing",
                       "edge of the coarsest lattice cubes, mm [ten times the mean voxel spacing]",
                       [](MeshImageOptions& o) -> double& { return o.lattice_spacing_mm; })
      ->check(CLI::PositiveNumber);
  add_override<double>(
      app, overrides, "--fidelity",
      "F: refine a material while its F1 or F2 is below; in (0,1] [paper: 0.95, quality: 0.01, the distance "
      "decides]",
      [](MeshImageOptions& o) -> double& { return o.refine.fidelity; })
      ->check(CLI::Range(1e-6, 1.0));
  add_override<double>(app, overrides, "--finest-spacing",
                       "the fidelity criterion makes the lattice no finer than this, mm; --max-distance may "
                       "go to a quarter of it "
                       "[the smallest voxel spacing, but half the geometric mean at least]",
                       [](MeshImageOptions& o) -> double& { return o.refine.finest_spacing_mm; })
      ->check(CLI::PositiveNumber);
  app.add_option_function<double>(
         "--max-distance",
         [&overrides](const double& distance_mm) {
           overrides.emplace_back([distance_mm](MeshImageOptions& o) {
             o.refine.max_distance_mm = distance_mm;
             o.improve.reach_mm = distance_mm;
             o.stricter.reset();
           });
         },
         "every boundary voxel has an interface vertex within so many mm: the lattice is refined for it, the "
         "improvement keeps it; 0: the lattice is not, and the improvement keeps its default [quality: 1.06 "
         "voxel diagonals, paper: off]")
      ->check(CLI::NonNegativeNumber);
  app.add_flag_callback(
      "--topology-checks",
      [&overrides] { overrides.emplace_back([](MeshImageOptions& o) { o.topology.enabled = true; }); },
      "make every label's sub-mesh a manifold without crumbs: refine there, then relabel");
}

void add_deformation_options(CLI::App& app, Overrides& overrides) {
  add_override<int>(app, overrides, "--iterations", "deformation iterations [5; mesh with preset quality: 0]",
                    [](MeshImageOptions& o) -> int& { return o.deform.iterations; })
      ->check(CLI::Range(0, 1000));
  add_choice(app, overrides, "--connectivity",
             "pattern that thins the target points: vertex, edge, face or no [no]", kConnectivityNames,
             [](MeshImageOptions& o) -> Connectivity& { return o.deform.connectivity; });
  add_choice(app, overrides, "--target-position",
             "targets at voxel-centre (half a voxel inside) or voxel-faces [quality: voxel-faces, paper: "
             "voxel-centre]",
             kTargetPositionNames,
             [](MeshImageOptions& o) -> TargetPosition& { return o.deform.displacement.target_position; });
  add_choice(app, overrides, "--displacement",
             "of a source: only along the surface's normal, or the full mean of its targets [normal]",
             kDisplacementNames,
             [](MeshImageOptions& o) -> bool& { return o.deform.displacement.along_normal; });
  app.add_flag_callback(
      "--keep-outliers",
      [&overrides] {
        overrides.emplace_back([](MeshImageOptions& o) { o.deform.displacement.reject_outliers = false; });
      },
      "let targets pull whose boundary looks the other way, as the far side of a thin wall");
  add_override<double>(
      app, overrides, "--reach",
      "a source without target in its region (the mean length of its surface edges) takes the "
      "nearest within so many of them; 1: it follows the elastic field [3]",
      [](MeshImageOptions& o) -> double& { return o.deform.displacement.reach; })
      ->check(CLI::Range(1.0, 100.0));
  add_override<double>(
      app, overrides, "--pair-distance",
      "a source or a target farther from its nearest partner is pulled so near, voxel diagonals; 0: off "
      "[quality: 0.8, paper: 0.5]",
      [](MeshImageOptions& o) -> double& { return o.deform.displacement.pair_distance; })
      ->check(CLI::NonNegativeNumber);
  add_override<int>(app, overrides, "--attempts",
                    "with --on-failure stop: solves with scaled displacements before it stops [3]",
                    [](MeshImageOptions& o) -> int& { return o.deform.attempts; })
      ->check(CLI::Range(0, 100));
  add_choice(
      app, overrides, "--on-failure",
      "where elements stay below the minimum quality: hold back only their vertices and go on (recover), or "
      "stop all, as the paper does [recover]",
      kOnFailureNames, [](MeshImageOptions& o) -> OnFailure& { return o.deform.on_failure; });
  add_override<double>(app, overrides, "--young-pa", "Young's modulus, Pa [2100]",
                       [](MeshImageOptions& o) -> double& { return o.deform.elasticity.all.young_pa; })
      ->check(CLI::PositiveNumber);
  add_override<double>(app, overrides, "--poisson", "Poisson's ratio, in [0, 0.5) [0.45]",
                       [](MeshImageOptions& o) -> double& { return o.deform.elasticity.all.poisson; })
      ->check(CLI::Range(0.0, 0.499));
  app.add_option_function<double>(
         "--min-dihedral",
         [&overrides](const double& angle_deg) {
           overrides.emplace_back([angle_deg](MeshImageOptions& o) {
             o.improve.min_dihedral_deg = angle_deg;
             o.deform.quality.min_dihedral_deg = angle_deg;
           });
         },
         "smallest dihedral angle, degrees: the goal of the improvement [quality: 20], what the deformation "
         "keeps "
         "[paper: 5]")
      ->check(CLI::Range(0.0, 60.0));
  add_override<double>(
      app, overrides, "--min-scaled-jacobian",
      "smallest scaled Jacobian of hexes and pyramids that the deformation keeps (a pyramid of the "
      "lattice has 1) [0.2]",
      [](MeshImageOptions& o) -> double& { return o.deform.quality.min_scaled_jacobian; })
      ->check(CLI::Range(0.0, 1.0));
}

void add_improvement_options(CLI::App& app, Overrides& overrides) {
  app.add_flag_callback(
      "--no-improve",
      [&overrides] { overrides.emplace_back([](MeshImageOptions& o) { o.improve.enabled = false; }); },
      "preset quality: stop before the improvement");
  add_override<int>(app, overrides, "--decimation-rounds",
                    "improvement: rounds that thin the mesh out; 0: as many tets as before; they end when "
                    "one takes less than 3 % away [6]",
                    [](MeshImageOptions& o) -> int& { return o.improve.decimation_rounds; })
      ->check(CLI::Range(0, 20));
  app.add_option_function<double>(
         "--deviation",
         [&overrides](const double& diagonals) {
           overrides.emplace_back([diagonals](MeshImageOptions& o) {
             o.improve.deviation_diagonals = diagonals;
             o.stricter.reset();
           });
         },
         "improvement: facets stay so near to the boundary, voxel diagonals [0.35]; where neither this nor "
         "--max-distance is given and faults are left, all is done once more with 0.2 and 0.9 diagonals")
      ->check(CLI::Range(0.01, 2.0));
  add_override<double>(
      app, overrides, "--smoothness",
      "improvement: how much of the pull to the boundary goes to smooth surfaces, in [0,1] [0]",
      [](MeshImageOptions& o) -> double& { return o.improve.smoothness; })
      ->check(CLI::Range(0.0, 1.0));
  add_override<double>(app, overrides, "--smoothness-cap",
                       "improvement: smoothness moves no vertex farther from the boundary, mm [0.2 voxel "
                       "diagonals, or what --deviation allows where that is less]",
                       [](MeshImageOptions& o) -> double& { return o.improve.smoothness_cap_mm; })
      ->check(CLI::PositiveNumber);
  add_override<double>(
      app, overrides, "--gradation",
      "improvement: the decimation makes no inner edge longer than the edges of the nearest surface and this "
      "times the distance to it, about; 0: as long as those [no limit]",
      [](MeshImageOptions& o) -> double& { return o.improve.gradation; })
      ->check(CLI::NonNegativeNumber);
}

void add_mixed_options(CLI::App& app, Overrides& overrides) {
  app.add_flag_callback(
      "--mixed", [&overrides] { overrides.emplace_back([](MeshImageOptions& o) { o.mixed = true; }); },
      "hexes in uniform regions, pyramids between them and the tets");
}

}  // namespace cbc3d
