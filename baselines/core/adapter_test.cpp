#include "baselines/core/adapter.hpp"

#include <gtest/gtest.h>

#include "mesher/core/error.hpp"

namespace cbc3d::baselines {
namespace {

using Argv = std::vector<std::string>;

TEST(ParameterSource, AsksForEachFolderOnce) {
  std::vector<std::filesystem::path> asked;
  const ParameterSource source([&](const std::filesystem::path& bin_dir) {
    asked.push_back(bin_dir);
    return ParameterSpecs{{bin_dir.string(), "1", "", "x"}};
  });
  EXPECT_TRUE(asked.empty());
  const std::vector<ParameterSource> copies{source, source};
  EXPECT_EQ(source.in("a").front().key, "a");
  EXPECT_EQ(copies[0].in("a").front().key, "a");
  EXPECT_EQ(copies[1].in("b").front().key, "b");
  EXPECT_EQ(asked, (std::vector<std::filesystem::path>{"a", "b"}));
}

TEST(ParameterSource, AListIsTheSameInEveryFolder) {
  const ParameterSource source{{"size", "2", "mm", "a length"}};
  EXPECT_EQ(source.in("a").front().key, "size");
  EXPECT_EQ(source.in("b").size(), 1U);
  EXPECT_TRUE(ParameterSource().in("a").empty());
}

Adapter adapter_of(ParameterSource parameters, bool available) {
  Adapter adapter;
  adapter.name = "tool";
  adapter.parameters = std::move(parameters);
  adapter.availability = [available](const std::filesystem::path&) {
    return Availability{available, available ? "" : "absent"};
  };
  return adapter;
}

TEST(RequireKnownParameters, OnlyAProgramThatIsNotThereIsTrusted) {
  const ParameterSpecs known{{"size", "2", "mm", "a length"}};
  EXPECT_NO_THROW(require_known_parameters(adapter_of(ParameterSource(known), true), "", {{"size", "1"}}));
  EXPECT_THROW(require_known_parameters(adapter_of(ParameterSource(known), true), "", {{"sise", "1"}}),
               InputError);
  EXPECT_THROW(require_known_parameters(adapter_of(ParameterSource(known), false), "", {{"sise", "1"}}),
               InputError);
  EXPECT_THROW(require_known_parameters(adapter_of(ParameterSource(), true), "", {{"sise", "1"}}),
               InputError);
  EXPECT_NO_THROW(require_known_parameters(adapter_of(ParameterSource(), false), "", {{"sise", "1"}}));
}

TEST(ProtocolCommand, CarriesTheWholeJob) {
  const ParameterSpecs known{{"size", "2", "mm", "a length"}};
  const Argv expected{"bin/tool", "--image",   "in.nii", "--out",   "out.vtu", "--report",
                      "r.json",   "--threads", "3",      "--quiet", "--size",  "4"};
  EXPECT_EQ(protocol_command("bin/tool", "tool", known, {"in.nii", "out.vtu", "r.json", 3, {{"size", "4"}}}),
            expected);
}

TEST(ProgramAdapter, TheRestFollowsFromTheName) {
  const Adapter adapter = program_adapter({.name = "tool", .parameters = {{"size", "2", "mm", "a length"}}},
                                          {.parameter = "size", .first = 2});
  EXPECT_EQ(adapter.command("bin", {.parameters = {{"size", "4"}}}).front(), "bin/cbc3d-mesher-tool");
  EXPECT_THROW(adapter.command("bin", {.parameters = {{"sise", "4"}}}), InputError);
  EXPECT_EQ(adapter.availability("bin").reason, "not built: build the target cbc3d-mesher-tool");
  EXPECT_EQ(size_dial_of(adapter, "bin").value().parameter, "size");
  EXPECT_EQ(program_adapter({.name = "tool"}, {}, "buy it").availability("bin").reason, "buy it");
}

}  // namespace
}  // namespace cbc3d::baselines
