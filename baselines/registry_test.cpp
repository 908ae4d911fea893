#include "baselines/registry.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

#include "mesher/core/error.hpp"

namespace cbc3d::baselines {
namespace {

using Argv = std::vector<std::string>;

MeshJob job_with(std::map<std::string, std::string> parameters) {
  return {"in.nii", "out.vtu", "report.json", 3, std::move(parameters)};
}

Argv command_of(const std::string& mesher, std::map<std::string, std::string> parameters = {}) {
  return find_adapter(mesher)->command("bin", job_with(std::move(parameters)));
}

bool has_sequence(const Argv& argv, const Argv& wanted) {
  return std::search(argv.begin(), argv.end(), wanted.begin(), wanted.end()) != argv.end();
}

TEST(Registry, HoldsEveryMesherOnceInTableOrder) {
  Argv names;
  for (const Adapter& adapter : registry()) names.push_back(adapter.name);
  EXPECT_EQ(names, (Argv{"cbc3d", "cbc3d-paper", "cbc3d-mixed", "cgal", "cgal-parallel", "tetgen"}));
  EXPECT_EQ(find_adapter("gmsh"), nullptr);
}

TEST(Registry, EveryAdapterIsComplete) {
  for (const Adapter& adapter : registry()) {
    SCOPED_TRACE(adapter.name);
    EXPECT_EQ(find_adapter(adapter.name), &adapter);
    EXPECT_FALSE(adapter.description.empty());
    EXPECT_FALSE(adapter.licence.empty());
    ASSERT_TRUE(adapter.availability);
    ASSERT_TRUE(adapter.command);
    std::set<std::string> keys;
    for (const ParameterSpec& spec : adapter.parameters) {
      EXPECT_TRUE(keys.insert(spec.key).second) << spec.key;
      EXPECT_FALSE(spec.default_value.empty()) << spec.key;
      EXPECT_FALSE(spec.description.empty()) << spec.key;
    }
  }
}

TEST(Registry, OnlyTheParallelPeerIsNotRepeatable) {
  for (const Adapter& adapter : registry()) EXPECT_EQ(adapter.deterministic, adapter.name != "cgal-parallel");
}

TEST(Registry, CommandsCarryTheWholeJob) {
  const Argv expected{"bin/cbc3d-mesher-cgal", "--image",   "in.nii", "--out",   "out.vtu",     "--report",
                      "report.json",           "--threads", "3",      "--quiet", "--cell-size", "4"};
  EXPECT_EQ(command_of("cgal", {{"cell-size", "4"}}), expected);
}

TEST(Registry, CommandOfCbc3dTakesItsPresetFromTheName) {
  const Argv plain = command_of("cbc3d");
  EXPECT_TRUE(
      has_sequence(plain, {"bin/cbc3d", "mesh", "in.nii", "--out", "out.vtu", "--report", "report.json"}));
  EXPECT_TRUE(has_sequence(plain, {"--threads", "3", "--quiet"}));
  EXPECT_EQ(std::count(plain.begin(), plain.end(), "--preset"), 0);
  EXPECT_TRUE(has_sequence(command_of("cbc3d-paper"), {"--preset", "paper"}));
  EXPECT_TRUE(has_sequence(command_of("cbc3d-mixed"), {"--preset", "paper", "--mixed"}));
}

TEST(Registry, SwitchesOfCbc3dAreGivenBare) {
  const Argv on = command_of("cbc3d", {{"topology-checks", "true"}, {"iterations", "5"}});
  EXPECT_EQ(std::count(on.begin(), on.end(), "--topology-checks"), 1);
  EXPECT_EQ(std::count(on.begin(), on.end(), "true"), 0);
  EXPECT_TRUE(has_sequence(on, {"--iterations", "5"}));
  const Argv off = command_of("cbc3d", {{"topology-checks", "false"}});
  EXPECT_EQ(std::count(off.begin(), off.end(), "--topology-checks"), 0);
  EXPECT_THROW(command_of("cbc3d", {{"topology-checks", "yes"}}), InputError);
}

TEST(Registry, UnknownParameterNamesTheKnownOnes) {
  for (const Adapter& adapter : registry()) {
    try {
      (void)adapter.command("bin", job_with({{"facet-sise", "2"}}));
      ADD_FAILURE() << adapter.name << " took an unknown parameter";
    } catch (const InputError& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find("facet-sise"), std::string::npos) << message;
      EXPECT_NE(message.find(adapter.parameters.back().key), std::string::npos) << message;
    }
  }
}

TEST(Registry, AvailableOnlyWhereTheExecutableIs) {
  const std::filesystem::path bin = std::filesystem::path(::testing::TempDir()) / "cbc3d_registry_bin";
  std::filesystem::remove_all(bin);
  std::filesystem::create_directories(bin);
  for (const Adapter& adapter : registry()) {
    const Availability absent = adapter.availability(bin);
    EXPECT_FALSE(absent.available) << adapter.name;
    EXPECT_FALSE(absent.reason.empty()) << adapter.name;
  }
  std::ofstream(bin / "cbc3d-mesher-tetgen") << "x";
  const Availability present = find_adapter("tetgen")->availability(bin);
  EXPECT_TRUE(present.available);
  EXPECT_TRUE(present.reason.empty());
  std::filesystem::remove_all(bin);
}

}  // namespace
}  // namespace cbc3d::baselines
