#include <gtest/gtest.h>

#include <algorithm>

#include "cases/manifest.hpp"
#include "mesher/core/error.hpp"
#include "mesher/testing/temporary_folder.hpp"

namespace cbc3d::cases {
namespace {

using cbc3d::testing::TemporaryFolder;
using nlohmann::json;

json good_manifest() {
  return {{"name", "one"},
          {"title", "One"},
          {"suites", {"demo"}},
          {"image", {{"file", "one.nrrd"}, {"sha256", std::string(64, 'a')}, {"source", "somewhere (MIT)"}}},
          {"derive", {{"fill_holes", true}, {"repeat", {2, 1, 3}}}},
          {"parameters", {{"cgal", {{"cell-size", 2.5}, {"mode", "x"}}}}},
          {"parameter_sets", {{"fine", {{"cgal", {{"cell-size", 1}}}}}}},
          {"deformation_pattern", {{"pattern", "face"}, {"image", "as it is"}, {"before", "one"}}},
          {"paper", {{"note", "none"}}}};
}

json phantom_manifest() {
  json manifest = good_manifest();
  manifest.erase("deformation_pattern");
  manifest["image"] = {{"phantom",
                        {{"name", "organs"},
                         {"size", {16, 17, 18}},
                         {"spacing_mm", {1, 1.5, 2}},
                         {"seed", 3},
                         {"sha256", std::string(64, 'b')}}}};
  return manifest;
}

std::string error_of(const json& manifest) {
  const TemporaryFolder folder("manifest");
  folder.write("bad.json", manifest.is_string() ? manifest.get<std::string>() : manifest.dump());
  try {
    load_cases(folder.path());
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("bad.json"), std::string::npos);
    return error.what();
  }
  return "";
}

TEST(Manifest, InstancesOfAPhantomAreCasesWithSeedsOfTheirOwn) {
  const TemporaryFolder folder("manifest");
  json many = phantom_manifest();
  many["image"]["phantom"].erase("sha256");
  many["instances"] = 12;
  folder.write("many.json", many.dump());
  const auto cases = load_cases(folder.path());
  ASSERT_EQ(cases.size(), 12U);
  EXPECT_EQ(cases[0].name, "one-000");
  EXPECT_EQ(cases[11].name, "one-011");
  const auto seed_of = [](const Case& one) { return one.phantom ? one.phantom->seed : 0; };
  EXPECT_EQ(seed_of(cases[0]), 3U);
  EXPECT_EQ(seed_of(cases[11]), 14U);
}

TEST(Manifest, InstancesAreANumberOfPhantoms) {
  json manifest = phantom_manifest();
  manifest["instances"] = 2;  // but all would have one sha256
  EXPECT_NE(error_of(manifest).find("instances"), std::string::npos);
  manifest["image"]["phantom"].erase("sha256");
  EXPECT_EQ(error_of(manifest), "");
  for (const json& bad : {json(0), json(-1), json(1001), json("3"), json(2.5)}) {
    manifest["instances"] = bad;
    EXPECT_NE(error_of(manifest).find("instances"), std::string::npos) << bad;
  }
  json file = good_manifest();
  file["instances"] = 2;
  EXPECT_NE(error_of(file).find("instances"), std::string::npos);
}

TEST(Manifest, EveryKeyIsRead) {
  const TemporaryFolder folder("manifest");
  json second = phantom_manifest();
  second["name"] = "two";
  folder.write("b.json", good_manifest().dump());
  folder.write("a.json", second.dump());
  folder.write("notes.txt", "no manifest");
  const auto cases = load_cases(folder.path());
  ASSERT_EQ(cases.size(), 2U);
  EXPECT_EQ(cases[0].name, "two");  // sorted by file name
  EXPECT_EQ(cases[1].title, "One");
  EXPECT_EQ(cases[1].suites, std::vector<std::string>{"demo"});
  EXPECT_EQ(cases[1].image_file, "one.nrrd");
  EXPECT_EQ(cases[1].image_sha256, std::string(64, 'a'));
  EXPECT_EQ(cases[1].image_source, "somewhere (MIT)");
  EXPECT_TRUE(cases[1].derive.fill_holes);
  EXPECT_EQ(cases[1].derive.repeat, (Index3{2, 1, 3}));
  EXPECT_FALSE(cases[1].phantom);
  EXPECT_EQ(cases[1].parameters.at("cgal").at("cell-size"), "2.5");
  EXPECT_EQ(cases[1].parameters.at("cgal").at("mode"), "x");
  EXPECT_EQ(cases[1].parameter_sets.at("fine").at("cgal").at("cell-size"), "1");
  EXPECT_EQ(cases[1].paper.at("note"), "none");
  const DeformationPattern pattern = cases[1].deformation_pattern.value();
  EXPECT_EQ(pattern.pattern, "face");
  EXPECT_EQ(pattern.image, "as it is");
  EXPECT_EQ(pattern.before, "one");
  EXPECT_FALSE(cases[0].image_file);
  const Phantom phantom = cases[0].phantom.value();
  EXPECT_EQ(phantom.name, "organs");
  EXPECT_EQ(phantom.size, (Index3{16, 17, 18}));
  EXPECT_EQ(phantom.spacing_mm, (Vec3{1, 1.5, 2}));
  EXPECT_EQ(phantom.seed, 3U);
  EXPECT_EQ(phantom.sha256, std::string(64, 'b'));
}

struct BadKey {
  const char* pointer;  // of the value that is replaced
  json value;
  const char* named;  // what the message must name
};

class BadManifest : public ::testing::TestWithParam<BadKey> {};

TEST_P(BadManifest, IsRefusedByKey) {
  json manifest = std::string(GetParam().pointer).find("phantom") == std::string::npos ? good_manifest()
                                                                                       : phantom_manifest();
  ASSERT_EQ(error_of(manifest), "");
  manifest[json::json_pointer(GetParam().pointer)] = GetParam().value;
  EXPECT_NE(error_of(manifest).find(GetParam().named), std::string::npos) << error_of(manifest);
}

INSTANTIATE_TEST_SUITE_P(
    Keys, BadManifest,
    ::testing::Values(BadKey{"/name", 7, "\"name\" is 7"}, BadKey{"/title", "", "\"title\""},
                      BadKey{"/name", "../x", "\"name\" is \"../x\""}, BadKey{"/name", "..", "\"name\""},
                      BadKey{"/name", "", "\"name\""}, BadKey{"/name", "a\nb", "\"name\" is \"a\\nb\""},
                      BadKey{"/name", "a/b", "\"name\""}, BadKey{"/name", std::string(300, 'x'), "1 to 80"},
                      BadKey{"/title", "two\nlines", "not one line"}, BadKey{"/suites", "demo", "\"suites\""},
                      BadKey{"/suites", json::array(), "\"suites\""},
                      BadKey{"/image", "one.nrrd", "\"image\""}, BadKey{"/colour", "red", "\"colour\""},
                      BadKey{"/image/sha", "aa", "\"image.sha\""},
                      BadKey{"/image/sha256", "ABC", "\"image.sha256\""},
                      BadKey{"/image/file", "/etc/one.nrrd", "\"image.file\""},
                      BadKey{"/image/file", "a/../../one.nrrd", "within a data folder"},
                      BadKey{"/parameters/cgal", 3, "\"parameters.cgal\""},
                      BadKey{"/parameters/cgal/cell-size", {1, 2}, "\"parameters.cgal.cell-size\""},
                      BadKey{"/paper", {1, 2}, "\"paper\""}, BadKey{"/derive", true, "\"derive\""},
                      BadKey{"/derive/fill_holes", 1, "\"derive.fill_holes\""},
                      BadKey{"/derive", {{"dilate", true}}, "\"derive.dilate\""},
                      BadKey{"/derive/repeat", {2, 0, 1}, "\"derive.repeat\""},
                      BadKey{"/deformation_pattern", "face", "\"deformation_pattern\""},
                      BadKey{"/deformation_pattern/pattern", "corner", "vertex, edge, face, no"},
                      BadKey{"/deformation_pattern/before", "ghost", "which no manifest has"},
                      BadKey{"/image/phantom/name", "ghost", "organs, shells"},
                      BadKey{"/image/phantom/size", {16, 17}, "\"image.phantom.size\""},
                      BadKey{"/image/phantom/size", {16, 17, 1.5}, "\"image.phantom.size\""},
                      BadKey{"/image/phantom/spacing_mm", {1, 1, 0}, "\"image.phantom.spacing_mm\""},
                      BadKey{"/parameter_sets/fine/cgal", 3, "\"parameter_sets.fine.cgal\""},
                      BadKey{"/image/phantom/sha256", "ABC", "\"image.phantom.sha256\""},
                      BadKey{"/image/phantom/seed", -1, "\"image.phantom.seed\""}));

TEST(Manifest, MissingKeysAreNamed) {
  for (const char* key : {"name", "title", "suites", "image"}) {
    json manifest = good_manifest();
    manifest.erase(key);
    EXPECT_NE(error_of(manifest).find("\"" + std::string(key) + "\" is missing"), std::string::npos);
  }
  EXPECT_NE(error_of("{ no json").find("is no JSON"), std::string::npos);
  EXPECT_NE(error_of(std::string(80000, '[')).find("deep, more than"), std::string::npos);
}

TEST(Manifest, ParameterSetIsLaidOver) {
  Case one;
  one.name = "one";
  one.parameters = {{"cgal", {{"cell-size", "2"}, {"facet-size", "3"}}}, {"cbc3d", {{"fidelity", "1"}}}};
  one.parameter_sets = {{"fine", {{"cgal", {{"cell-size", "1"}}}, {"tetgen", {{"max-volume", "4"}}}}}};
  use_parameter_set(one, "fine");
  EXPECT_EQ(one.parameters.at("cgal").at("cell-size"), "1");
  EXPECT_EQ(one.parameters.at("cgal").at("facet-size"), "3");
  EXPECT_EQ(one.parameters.at("cbc3d").at("fidelity"), "1");
  EXPECT_EQ(one.parameters.at("tetgen").at("max-volume"), "4");
  try {
    use_parameter_set(one, "coarse");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "case 'one' has no parameter set 'coarse'; it has fine");
  }
}

TEST(Manifest, FolderAndNamesAreChecked) {
  const TemporaryFolder folder("manifest");
  EXPECT_THROW(load_cases(folder.path() / "absent"), InputError);
  EXPECT_THROW(load_cases(folder.path()), InputError);
  folder.write("a.json", good_manifest().dump());
  EXPECT_EQ(load_cases(folder.path()).size(), 1U);
  folder.write("b.json", good_manifest().dump());
  EXPECT_THROW(load_cases(folder.path()), InputError);
}

TEST(Manifest, OursAreGood) {
  const auto cases = load_cases(CBC3D_MANIFESTS);
  const auto in_suite = [&](const std::string& suite) {
    return std::count_if(cases.begin(), cases.end(), [&](const Case& one) {
      return std::find(one.suites.begin(), one.suites.end(), suite) != one.suites.end();
    });
  };
  EXPECT_GE(in_suite("demo"), 2);
  EXPECT_GE(in_suite("real"), 11);
  EXPECT_EQ(in_suite("paper"), 4);
  EXPECT_EQ(in_suite("paper-half"), 4);
  EXPECT_EQ(in_suite("paper-quarter"), 4);
  EXPECT_EQ(in_suite("nidus"), 15)
      << "lattice and four patterns: as it is, holes filled, targets between voxels";
  for (const Case& one : cases) {
    if (std::find(one.suites.begin(), one.suites.end(), "nidus") != one.suites.end()) {
      EXPECT_EQ(one.parameters.at("cbc3d-paper").at("fidelity"), "0.97") << one.name;
    } else {
      EXPECT_EQ(one.parameters.at("cgal").at("facet-angle"), "30") << one.name;
    }
    EXPECT_EQ(one.image_file.has_value(), !one.phantom.has_value()) << one.name;
  }
}

}  // namespace
}  // namespace cbc3d::cases
