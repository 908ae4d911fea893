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

Argv names_of_registry() {
  Argv names;
  for (const Adapter& adapter : registry()) names.push_back(adapter.name);
  return names;
}

TEST(Registry, HoldsEveryMesherOnceAndThoseOfTheTablesInTheirOrder) {
  const Argv names = names_of_registry();
  EXPECT_EQ(std::set<std::string>(names.begin(), names.end()).size(), names.size());
  auto next = names.begin();
  for (const char* name :
       {"cbc3d", "cbc3d-paper", "cbc3d-mixed", "cgal", "cgal-parallel", "cleaver", "ld", "podm", "tetgen"}) {
    next = std::find(next, names.end(), name);
    ASSERT_NE(next, names.end()) << name;
  }
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
    for (const ParameterSpec& spec : adapter.parameters.in(CBC3D_BIN_DIR)) {
      EXPECT_TRUE(keys.insert(spec.key).second) << spec.key;
      EXPECT_FALSE(spec.default_value.empty()) << spec.key;
      EXPECT_FALSE(spec.description.empty()) << spec.key;
    }
    EXPECT_FALSE(keys.empty());
  }
}

TEST(Registry, UnknownParameterNamesTheKnownOnes) {
  for (const Adapter& adapter : registry()) {
    try {
      (void)adapter.command(CBC3D_BIN_DIR, job_with({{"facet-sise", "2"}}));
      ADD_FAILURE() << adapter.name << " took an unknown parameter";
    } catch (const InputError& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find("facet-sise"), std::string::npos) << message;
      EXPECT_NE(message.find(adapter.parameters.in(CBC3D_BIN_DIR).back().key), std::string::npos) << message;
    }
    EXPECT_THROW(require_known_parameters(adapter, CBC3D_BIN_DIR, {{"facet-sise", "2"}}), InputError);
  }
}

TEST(Registry, EveryMesherHasASizeDialAmongItsParameters) {
  for (const Adapter& adapter : registry()) {
    SCOPED_TRACE(adapter.name);
    const SizeDial dial = size_dial_of(adapter, CBC3D_BIN_DIR).value();
    EXPECT_NO_THROW(require_known_parameters(
        adapter, CBC3D_BIN_DIR, with_size(dial, dial.first, adapter.parameters.in(CBC3D_BIN_DIR), {})));
    EXPECT_NE(dial.exponent, 0);
    EXPECT_LE(dial.lowest, dial.first);
    EXPECT_LE(dial.first, dial.highest);
  }
}

TEST(Registry, ParameterSetsNameKnownParameters) {
  for (const Adapter& adapter : registry()) {
    for (const auto& [set, parameters] : adapter.parameter_sets) {
      EXPECT_NO_THROW(require_known_parameters(adapter, CBC3D_BIN_DIR, parameters))
          << adapter.name << " " << set;
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
