// The adapters of cbc3d have the parameters of the program, whose defaults are those of the presets.
#include "baselines/cbc3d/adapter.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

#include "mesher/core/error.hpp"
#include "mesher/pipeline/option_table.hpp"
#include "mesher/pipeline/presets.hpp"

namespace cbc3d::baselines {
namespace {

namespace fs = std::filesystem;
using Argv = std::vector<std::string>;

Adapter adapter_named(const std::string& name) {
  for (const Adapter& adapter : cbc3d_adapters()) {
    if (adapter.name == name) return adapter;
  }
  ADD_FAILURE() << "no adapter " << name;
  return {};
}

Argv command_of(const std::string& mesher, std::map<std::string, std::string> parameters = {},
                const fs::path& bin_dir = CBC3D_BIN_DIR) {
  return adapter_named(mesher).command(bin_dir,
                                       {"in.nii", "out.vtu", "report.json", 3, std::move(parameters)});
}

bool has_sequence(const Argv& argv, const Argv& wanted) {
  return std::search(argv.begin(), argv.end(), wanted.begin(), wanted.end()) != argv.end();
}

/// The parameters are the options of the preset, with its defaults.
void expect_options_of(const std::string& mesher, const std::string& preset, bool mixed) {
  SCOPED_TRACE(mesher);
  ImageFrame frame;
  MeshImageOptions options = preset_options(preset, frame);
  options.mixed = mixed;
  std::set<std::string> missing;
  for (const OptionRow& row : option_table()) {
    if (has_option(options, row)) missing.insert(row.name);
  }
  for (const ParameterSpec& spec : adapter_named(mesher).parameters.in(CBC3D_BIN_DIR)) {
    EXPECT_EQ(missing.erase(spec.key), 1U) << spec.key;
    const OptionRow& row = find_option(spec.key);
    EXPECT_EQ(spec.default_value, default_text(row, options, frame.voxel_diagonal_mm())) << spec.key;
    EXPECT_EQ(spec.description, row.text);
  }
  EXPECT_TRUE(missing.empty()) << *missing.begin();
}

TEST(Cbc3dAdapters, ParametersAreTheOptionsOfThePreset) {
  expect_options_of("cbc3d", "quality", false);
  expect_options_of("cbc3d-paper", "paper", false);
  expect_options_of("cbc3d-mixed", "paper", true);
}

TEST(Cbc3dAdapters, UnitsNameWhatSwitchesAndEnumerationsTake) {
  std::map<std::string, std::string> units;
  for (const ParameterSpec& spec : adapter_named("cbc3d").parameters.in(CBC3D_BIN_DIR))
    units[spec.key] = spec.unit;
  EXPECT_EQ(units["topology-checks"], "true|false");
  EXPECT_EQ(units["on-failure"], "stop|recover");
  EXPECT_EQ(units["material-fidelity"], "LABEL=F");
  EXPECT_EQ(units["max-distance"], "mm");
  EXPECT_EQ(units["seed"], "");
}

TEST(Cbc3dAdapters, CommandTakesItsPresetFromTheName) {
  const Argv plain = command_of("cbc3d");
  const std::string program = CBC3D_BIN_DIR "/cbc3d";
  EXPECT_TRUE(has_sequence(plain, {program, "mesh", "in.nii", "--out", "out.vtu", "--report", "report.json",
                                   "--threads", "3", "--quiet", "--long-work"}));
  EXPECT_EQ(std::count(plain.begin(), plain.end(), "--preset"), 0);
  EXPECT_TRUE(has_sequence(command_of("cbc3d-paper"), {"--preset", "paper"}));
  EXPECT_TRUE(has_sequence(command_of("cbc3d-mixed"), {"--preset", "paper", "--mixed"}));
}

TEST(Cbc3dAdapters, SwitchesAreGivenBareOrAsFalse) {
  const Argv on = command_of("cbc3d", {{"topology-checks", "true"}, {"iterations", "5"}});
  EXPECT_EQ(std::count(on.begin(), on.end(), "--topology-checks"), 1);
  EXPECT_EQ(std::count(on.begin(), on.end(), "true"), 0);
  EXPECT_TRUE(has_sequence(on, {"--iterations", "5"}));
  const Argv off = command_of("cbc3d", {{"topology-checks", "false"}});
  EXPECT_EQ(std::count(off.begin(), off.end(), "--topology-checks"), 0);
  EXPECT_EQ(std::count(off.begin(), off.end(), "--topology-checks=false"), 1);
  EXPECT_THROW(command_of("cbc3d", {{"topology-checks", "yes"}}), InputError);
}

TEST(Cbc3dAdapters, WhereTheProgramIsNotBuiltTheyAreUnavailableAndJudgeNoParameter) {
  const fs::path bin = fs::path(::testing::TempDir()) / "cbc3d adapter's bin";
  fs::remove_all(bin);
  fs::create_directories(bin);
  for (const Adapter& adapter : cbc3d_adapters()) {
    EXPECT_FALSE(adapter.availability(bin).available);
    EXPECT_TRUE(adapter.parameters.in(bin).empty());
    EXPECT_NO_THROW(command_of(adapter.name, {{"anything", "1"}}, bin));
    EXPECT_NO_THROW(require_known_parameters(adapter, bin, {{"anything", "1"}}));
  }
  // A program that is no cbc3d is an error with a remedy.
  std::ofstream(bin / "cbc3d") << "#!/bin/sh\necho '{}'\n";
  fs::permissions(bin / "cbc3d", fs::perms::owner_all);
  try {
    (void)adapter_named("cbc3d").parameters.in(bin);
    ADD_FAILURE() << "took the description {}";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("build the target cbc3d again"), std::string::npos)
        << error.what();
  }
  fs::remove_all(bin);
}

}  // namespace
}  // namespace cbc3d::baselines
