#include "baselines/external.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "mesher/core/error.hpp"
#include "mesher/testing/temporary_folder.hpp"

namespace cbc3d::baselines {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

class External : public ::testing::Test {
 protected:
  fs::path write(const std::string& text) const {
    std::ofstream(folder_ / "tool.json") << text;
    return folder_ / "tool.json";
  }
  std::string error_of(const std::string& text) const {
    try {
      load_external_mesher(write(text));
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("tool.json"), std::string::npos);
      return error.what();
    }
    return "";
  }

  cbc3d::testing::TemporaryFolder temporary_{"external"};
  fs::path folder_ = temporary_.path();
  json good_{{"name", "tool"},
             {"description", "a tool"},
             {"licence", "MIT"},
             {"command", {"./bin/tool", "in={image}", "{mesh}", "-j{threads}", "{{{size}}", "it's \"$x\""}},
             {"output", "msh"},
             {"parameters", {{{"key", "size"}, {"default", "2"}, {"unit", "mm"}, {"description", "size"}}}}};
};

TEST_F(External, ACommandIsFilledInWithoutAShell) {
  const Adapter adapter = load_external_mesher(write(good_.dump()));
  EXPECT_EQ(adapter.name, "external:tool");
  EXPECT_EQ(adapter.mesh_extension, ".msh");
  EXPECT_FALSE(adapter.multithreaded);
  EXPECT_FALSE(adapter.openmp);
  EXPECT_TRUE(adapter.deterministic);
  const MeshJob job{"a b.nii", "o'ut.msh", "r.json", 3, {{"size", "1.5"}}};
  EXPECT_EQ(adapter.command("", job), (std::vector<std::string>{(folder_ / "bin/tool").string(), "in=a b.nii",
                                                                "o'ut.msh", "-j3", "{1.5}", "it's \"$x\""}));
  EXPECT_EQ(adapter.command("", {"i", "m", "r", 1, {}})[4], "{2}");
  EXPECT_THROW(adapter.command("", {"i", "m", "r", 1, {{"sise", "1"}}}), InputError);
}

TEST_F(External, AMissingOrForbiddenProgramIsSaidWithItsRemedy) {
  const Adapter adapter = load_external_mesher(write(good_.dump()));
  EXPECT_NE(adapter.availability("").reason.find("is no file; install it"), std::string::npos);
  fs::create_directory(folder_ / "bin");
  std::ofstream(folder_ / "bin" / "tool") << "#!/bin/sh\n";
  EXPECT_NE(adapter.availability("").reason.find("chmod +x"), std::string::npos);
  fs::permissions(folder_ / "bin" / "tool", fs::perms::owner_all);
  EXPECT_TRUE(adapter.availability("").available);
  good_["command"][0] = "surely-no-such-program";
  EXPECT_NE(load_external_mesher(write(good_.dump())).availability("").reason.find("nowhere in PATH"),
            std::string::npos);
}

TEST_F(External, AProbeSaysWhetherTheMesherCanRun) {
  good_["command"][0] = "/bin/true";
  const auto asked = [this](const std::string& script, const std::string& argument) {
    good_["probe"] = {"/bin/sh", "-c", script, "sh", argument};
    return load_external_mesher(write(good_.dump())).availability("");
  };
  EXPECT_TRUE(asked("echo whatever; exit 0", "").available);
  const Availability absent = asked(R"(printf '%s is \033[31mnot here\nmore\n' "$1"; exit 3)", "it's $x");
  EXPECT_FALSE(absent.available);
  EXPECT_EQ(absent.reason, "it's $x is [31mnot here") << "the first line, without control characters";
  EXPECT_EQ(asked("echo said >&2; exit 1", "").reason, "said");
  EXPECT_NE(asked("exit 1", "").reason.find("gave no reason"), std::string::npos);
  EXPECT_LE(asked("head -c 100000 /dev/zero | tr '\\0' x; exit 1", "").reason.size(), 300U);
}

TEST_F(External, AProbeIsAskedOnce) {
  good_["command"][0] = "/bin/true";
  good_["probe"] = {"/bin/sh", "-c", "echo asked >> \"$1\"", "sh", (folder_ / "log").string()};
  const Adapter adapter = load_external_mesher(write(good_.dump()));
  EXPECT_FALSE(fs::exists(folder_ / "log"));
  EXPECT_TRUE(adapter.availability("").available);
  EXPECT_TRUE(adapter.availability("").available);
  EXPECT_EQ(fs::file_size(folder_ / "log"), std::string("asked\n").size());
}

TEST_F(External, AnImageFormatMayBeAskedFor) {
  EXPECT_EQ(load_external_mesher(write(good_.dump())).image_extension, "");
  good_["image"] = "nii.gz";
  EXPECT_EQ(load_external_mesher(write(good_.dump())).image_extension, ".nii.gz");
}

TEST_F(External, ASizeDialIsReadAndChecked) {
  EXPECT_FALSE(size_dial_of(load_external_mesher(write(good_.dump())), ""));
  good_["size_dial"] = {
      {"parameter", "size"}, {"exponent", -3}, {"first", 2}, {"lowest", 0.1}, {"highest", 50}};
  const SizeDial dial = size_dial_of(load_external_mesher(write(good_.dump())), "").value();
  EXPECT_EQ(dial.parameter, "size");
  EXPECT_EQ(dial.exponent, -3);
  EXPECT_EQ(dial.highest, 50);
  for (const auto& [key, value, named] :
       {std::tuple("parameter", json("sise"), "is no parameter"),
        std::tuple("exponent", json(0), "other than 0"),
        std::tuple("first", json(100), "lowest <= first <= highest"),
        std::tuple("lowest", json("x"), "give a number"), std::tuple("colour", json(1), "is not a key")}) {
    json bad = good_;
    bad["size_dial"][key] = value;
    EXPECT_NE(error_of(bad.dump()).find(named), std::string::npos) << error_of(bad.dump());
  }
}

TEST_F(External, BadFilesAreRefusedByKey) {
  EXPECT_THROW(load_external_mesher(folder_ / "none.json"), InputError);
  EXPECT_NE(error_of("{ no json").find("is no JSON"), std::string::npos);
  EXPECT_NE(error_of(std::string(80000, '[')).find("deep, more than"), std::string::npos);
  EXPECT_NE(error_of(R"({"name": 1e999})").find("1e999"), std::string::npos);
  EXPECT_NE(error_of("[]").find("no JSON object"), std::string::npos);
  for (const char* key : {"name", "description", "licence", "command", "output"}) {
    json without = good_;
    without.erase(key);
    EXPECT_NE(error_of(without.dump()).find("\"" + std::string(key) + "\" is missing; give"),
              std::string::npos);
  }
  const std::vector<std::pair<json, std::string>> wrong{
      {{{"name", "a/b"}}, "\"name\""},
      {{{"name", ".."}}, "\"name\" is \"..\""},
      {{{"name", std::string(300, 'x')}}, "1 to 80"},
      {{{"colour", "red"}}, "\"colour\" is not a key"},
      {{{"output", "stl"}}, "give vtu, vtk or msh"},
      {{{"image", "dicom"}}, "give nii, nii.gz, nrrd or mha"},
      {{{"probe", "true"}}, "\"probe\" is \"true\"; give a list of texts"},
      {{{"command", "tool {image} {mesh}"}}, "give a list of texts"},
      {{{"command", {"tool", "{image}", "{size}"}}}, "lacks {mesh}"},
      {{{"command", {"tool", "{image}", "{mesh}", "{size}", "{colour}"}}}, "names {colour}"},
      {{{"command", {"tool", "{image}", "{mesh}"}}}, "lacks {size}"},
      {{{"multithreaded", 1}}, "give true or false"},
      {{{"openmp", "yes"}}, "give true or false"},
      {{{"parameters", {{{"key", "size"}}}}}, "\"default\" is missing"}};
  for (const auto& [change, named] : wrong) {
    json bad = good_;
    bad.update(change);
    EXPECT_NE(error_of(bad.dump()).find(named), std::string::npos) << error_of(bad.dump());
  }
}

}  // namespace
}  // namespace cbc3d::baselines
