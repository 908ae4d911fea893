// What the registry says of cbc3d's parameters is what the program takes.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "baselines/registry.hpp"
#include "mesher/pipeline/presets.hpp"

namespace cbc3d::baselines {
namespace {

std::string output_of(const std::string& command) {
  std::FILE* pipe = ::popen(command.c_str(), "r");
  std::string text;
  std::array<char, 4096> buffer;
  while (std::fgets(buffer.data(), buffer.size(), pipe) != nullptr) text += buffer.data();
  EXPECT_EQ(::pclose(pipe), 0) << command;
  return text;
}

TEST(Cbc3dAdapter, TheProgramHasEveryParameterAndPreset) {
  const std::string help = output_of("'" CBC3D_BIN_DIR "/cbc3d' mesh --help");
  for (const char* name : {"cbc3d", "cbc3d-paper", "cbc3d-mixed"}) {
    const Adapter& adapter = *find_adapter(name);
    EXPECT_TRUE(adapter.availability(CBC3D_BIN_DIR).available);
    for (const ParameterSpec& spec : adapter.parameters) {
      EXPECT_NE(help.find("--" + spec.key + " "), std::string::npos) << spec.key;
    }
  }
  EXPECT_NE(help.find("paper"), std::string::npos);
}

std::string default_of(const std::string& mesher, const std::string& key) {
  for (const ParameterSpec& spec : find_adapter(mesher)->parameters) {
    if (spec.key == key) return spec.default_value;
  }
  return "no parameter " + key;
}

/// The numbers of a preset's options by the parameter that sets them.
std::map<std::string, double> numbers_of(const MeshImageOptions& options) {
  return {{"region-tolerance", options.clean.region_tolerance},
          {"fidelity", options.refine.fidelity},
          {"iterations", options.deform.iterations},
          {"reach", options.deform.displacement.reach},
          {"pair-distance", options.deform.displacement.pair_distance},
          {"attempts", options.deform.attempts},
          {"young-pa", options.deform.elasticity.all.young_pa},
          {"poisson", options.deform.elasticity.all.poisson},
          {"min-scaled-jacobian", options.deform.quality.min_scaled_jacobian}};
}

TEST(Cbc3dAdapter, DefaultsAreThoseOfThePreset) {
  ImageFrame frame;
  frame.spacing_mm = {1, 1, 1};
  const MeshImageOptions quality = preset_options("quality", frame), paper = preset_options("paper", frame);
  auto of_quality = numbers_of(quality);
  of_quality["min-dihedral"] = quality.improve.min_dihedral_deg;
  of_quality["decimation-rounds"] = quality.improve.decimation_rounds;
  of_quality["deviation"] = quality.improve.deviation_diagonals;
  of_quality["max-distance"] = quality.refine.max_distance_mm / frame.voxel_diagonal_mm();  // in diagonals
  auto of_paper = numbers_of(paper);
  of_paper["min-dihedral"] = paper.deform.quality.min_dihedral_deg;
  of_paper["max-distance"] = paper.refine.max_distance_mm;
  for (const auto& [key, value] : of_quality) {
    EXPECT_DOUBLE_EQ(std::atof(default_of("cbc3d", key).c_str()), value) << key;
  }
  for (const auto& [key, value] : of_paper) {
    EXPECT_DOUBLE_EQ(std::atof(default_of("cbc3d-paper", key).c_str()), value) << key;
    EXPECT_EQ(default_of("cbc3d-paper", key), default_of("cbc3d-mixed", key));
  }
  EXPECT_TRUE(quality.topology.enabled);
  EXPECT_FALSE(paper.topology.enabled);
  EXPECT_FALSE(quality.clean.manifold_voxels);
  EXPECT_TRUE(paper.clean.manifold_voxels);
  EXPECT_EQ(default_of("cbc3d", "topology-checks"), "true (always)");
  EXPECT_EQ(default_of("cbc3d", "no-manifold-voxels"), "true (always)");
}

}  // namespace
}  // namespace cbc3d::baselines
