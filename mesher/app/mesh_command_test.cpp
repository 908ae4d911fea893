// `cbc3d mesh` as its users meet it: exit codes, one line for what is wrong, every option, nothing left
// behind.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "mesher/app/testing_command.hpp"
#include "mesher/core/image_io.hpp"
#include "mesher/input/input_options.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"
#include "mesher/pipeline/option_table.hpp"
#include "mesher/pipeline/presets.hpp"
#include "mesher/pipeline/testing_option_samples.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {
namespace fs = std::filesystem;

using testing::bytes_of;
using testing::Outcome;

Outcome run(const std::string& arguments) {
  return testing::run_command(arguments);
}

class MeshCommand : public testing::CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    write_label_image(testing::ball_image(24, 1, 9, 4), at("ball.nii.gz"));
  }
  void expect_refusal(const std::string& arguments, const std::string& text) const {
    CommandTest::expect_refusal(arguments, text, "m.vtu");
  }
};

TEST_F(MeshCommand, MeshesAnImageAndReports) {
  const Outcome outcome = run("mesh " + at("ball.nii.gz") + " --preset paper --out " + at("m.vtu") +
                              " --report " + at("r.json") + " --dump-stages " + at("stages"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  const Mesh mesh = read_mesh(at("m.vtu"));
  EXPECT_EQ(labels_of(mesh), (std::vector<Label>{1, 2}));
  const auto report = nlohmann::json::parse(bytes_of(at("r.json")));
  EXPECT_EQ(report["counts"]["tets"], mesh.tets.size());
  EXPECT_EQ(report["materials"].size(), 2U);
  EXPECT_EQ(report["deformation"]["iterations"].size(), 5U);
  EXPECT_GT(report["seconds"]["total"].get<double>(), 0);
  EXPECT_GT(report["seconds"]["cpu"].get<double>(), 0);
  EXPECT_GT(report["peak_rss_bytes"].get<double>(), 1e6);
  for (const char* stage : {"1_bcc_lattice", "2_candidate_mesh", "4_deformed_mesh"}) {
    EXPECT_TRUE(fs::exists(folder_ / "stages" / (std::string(stage) + ".vtu"))) << stage;
  }
}

TEST_F(MeshCommand, SameBytesAtOneAndTwoThreads) {
  ASSERT_EQ(run("mesh " + at("ball.nii.gz") + " --threads 1 --quiet --out " + at("a.vtu")).exit_code, 0);
  ASSERT_EQ(run("mesh " + at("ball.nii.gz") + " --threads 2 --quiet --out " + at("b.vtu")).exit_code, 0);
  EXPECT_EQ(bytes_of(at("a.vtu")), bytes_of(at("b.vtu")));
}

TEST_F(MeshCommand, QuietPrintsNothingAndOtherRunsPrintTheirSteps) {
  EXPECT_EQ(run("mesh " + at("ball.nii.gz") + " --quiet --fidelity 0.8 --out " + at("a.vtu")).text, "");
  EXPECT_NE(run("mesh " + at("ball.nii.gz") + " --preset paper --out " + at("a.vtu"))
                .text.find("deformation, iteration 5\n"),
            std::string::npos);
}

TEST_F(MeshCommand, RefusesBadInputWithOneLine) {
  expect_refusal("mesh " + at("absent.nii") + " --out " + at("m.vtu"), "does not exist");
  expect_refusal("mesh " + at("ball.nii.gz") + " --out " + at("none/m.vtu"), "create it first");
  expect_refusal("mesh " + at("ball.nii.gz") + " --out /proc/m.vtu", "choose another place");
  expect_refusal("mesh " + at("ball.nii.gz") + " --out " + at("m.stl"), "use .vtu, .vtk, .msh");
  expect_refusal("mesh " + at("ball.nii.gz") + " --out " + at("m.vtu") + " --fidelity 2", "--fidelity");
  expect_refusal("mesh " + at("ball.nii.gz") + " --out " + at("m.vtu") + " --material-fidelity 9=0.5",
                 "no label 9");
  expect_refusal("mesh " + at("ball.nii.gz") + " --out " + at("m.vtu") + " --lattice-spacing 1e-9",
                 "--lattice-spacing");
  expect_refusal("mesh " + at("ball.nii.gz"), "--out");
  expect_refusal("mush", "--help");
}

std::string nrrd(const std::string& fields, const std::string& data) {
  return "NRRD0004\nendian: little\nencoding: raw\n" + fields + "\n" + data;
}

TEST_F(MeshCommand, RefusesImagesThatAreNoLabelVolumes) {
  const auto expect_refused = [this](const std::string& name, const std::string& bytes,
                                     const std::string& says) {
    std::ofstream(at(name), std::ios::binary) << bytes;
    expect_refusal("mesh " + at(name) + " --out " + at("m.vtu"), says);
  };
  expect_refused("flat.nrrd", nrrd("type: uchar\ndimension: 2\nsizes: 2 2\n", "abcd"), "2-dimensional");
  expect_refused("colour.nrrd",
                 nrrd("type: uchar\ndimension: 4\nsizes: 3 2 2 2\nkinds: RGB-color domain domain domain\n",
                      std::string(24, 'a')),
                 "colour");
  expect_refused("empty.nrrd", nrrd("type: uchar\ndimension: 3\nsizes: 2 2 2\n", std::string(8, '\0')),
                 "background");
  const float half[8] = {0, 1, 2, 0.5F, 0, 0, 1, 1};
  expect_refused("half.nrrd",
                 nrrd("type: float\ndimension: 3\nsizes: 2 2 2\n",
                      std::string(reinterpret_cast<const char*>(half), sizeof(half))),
                 "0.5");
  expect_refused("short.nrrd", nrrd("type: uchar\ndimension: 3\nsizes: 20 20 20\n", "abc"), "short.nrrd");
}

/// The value that an option's text stands for, as the report has it.
nlohmann::json reported(const OptionRow& row, const std::string& text) {
  switch (row.kind) {
    case OptionKind::on_off:
      return (text == "true") != row.negates_field;
    case OptionKind::choice:
      return text;
    case OptionKind::label_numbers: {
      const auto equals = text.find('=');
      return {{text.substr(0, equals), std::stod(text.substr(equals + 1))}};
    }
    default:
      return nlohmann::json::parse(text);
  }
}

/// What the report has for an option: with a value for each label, that of the option alone.
nlohmann::json found_in(const nlohmann::json& options, const OptionRow& row) {
  if (row.label_key.empty()) {
    return options.at(report_key(row));
  }
  nlohmann::json by_label = nlohmann::json::object();
  for (const auto& [label, values] : options.at(report_key(row)).items()) {
    by_label[label] = values.at(row.label_key);
  }
  return by_label;
}

TEST_F(MeshCommand, EveryOptionIsSetByTextAndReadBackFromTheReport) {
  write_label_image(testing::ball_image(12, 1, 4.5, 2), at("small.nii.gz"));
  for (const OptionRow& row : option_table()) {
    const std::string preset = row.group == OptionGroup::improvement ? "quality" : "paper";
    const std::string sample = testing::option_sample(row, preset_options(preset, ImageFrame()));
    const std::string flag =
        " --" + row.name +
        (row.kind == OptionKind::on_off ? (sample == "true" ? "" : "=false") : " " + sample);
    const Outcome outcome = run("mesh " + at("small.nii.gz") + " --quiet --preset " + preset + flag +
                                " --out " + at("m.vtu") + " --report " + at("r.json"));
    ASSERT_EQ(outcome.exit_code, 0) << flag << ": " << outcome.text;
    const auto report = nlohmann::json::parse(bytes_of(at("r.json")));
    EXPECT_EQ(found_in(report["options"], row), reported(row, sample)) << row.name;
  }
}

TEST_F(MeshCommand, RefusesEveryValueOutOfRangeInOneLine) {
  const std::string files = "mesh " + at("ball.nii.gz") + " --out " + at("m.vtu");
  for (const OptionRow& row : option_table()) {
    if (row.kind == OptionKind::on_off) {
      expect_refusal(files + " --" + row.name + "=maybe", "--" + row.name);
      continue;
    }
    const std::string bad = row.kind == OptionKind::label_numbers ? "2=-1" : "-1";
    const Outcome outcome = run(files + " --" + row.name + " " + bad);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_LT(outcome.text.size(), 110U) << outcome.text;
    expect_refusal(files + " --" + row.name + " " + bad, "cbc3d: --" + row.name + " " + bad + ": give ");
    expect_refusal(files + " --" + row.name + " " + bad, range_text(row));
  }
}

TEST_F(MeshCommand, HelpHasUnitRangeAndDefaultBesideEachOption) {
  std::string help = run("mesh --help").text;
  help.erase(std::remove(help.begin(), help.end(), '\n'), help.end());
  for (const OptionRow& row : option_table()) {
    const std::size_t at = help.find("--" + row.name + " ");
    ASSERT_NE(at, std::string::npos) << row.name;
    const std::string line = help.substr(at, help.find("  --", at) - at);
    EXPECT_NE(line.find(row.text), std::string::npos) << line;
    EXPECT_NE(line.find(row.unit), std::string::npos) << line;
    EXPECT_NE(line.find(" ["), std::string::npos) << line;
    for (const std::string& name : row.choices) {
      EXPECT_NE(line.find(name), std::string::npos) << line;
    }
  }
  EXPECT_NE(help.find("[quality: 20, paper: 5]"), std::string::npos) << help;
}

TEST_F(MeshCommand, DescribesTheOptionsOfEveryPreset) {
  const Outcome outcome = run("mesh --describe-options");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  const auto described = nlohmann::json::parse(outcome.text)["presets"];
  ASSERT_EQ(described.size(), 2 * preset_names().size());
  for (const nlohmann::json& preset : described) {
    const MeshImageOptions options = preset_options(preset["preset"], ImageFrame());
    EXPECT_TRUE(preset["mixed"].is_boolean());
    std::size_t count = 0;
    for (const OptionRow& row : option_table()) {
      count += has_option(options, row) ? 1U : 0U;
    }
    EXPECT_EQ(preset["options"].size(), count);
    for (const nlohmann::json& option : preset["options"]) {
      const OptionRow& row = find_option(option["name"].get<std::string>());
      EXPECT_EQ(option["text"], row.text);
      EXPECT_EQ(option["unit"], row.unit);
      EXPECT_EQ(option["values"].size(), row.choices.size());
      EXPECT_FALSE(option["default_text"].get<std::string>().empty()) << row.name;
      if (option["default"].is_number()) {
        EXPECT_GE(option["default"].get<double>(), option["range"]["lowest"].get<double>()) << row.name;
      }
    }
  }
}

TEST_F(MeshCommand, TheReportSaysWhatWasChosenOfTheImage) {
  const Outcome outcome = run("mesh " + at("ball.nii.gz") + " --quiet --labels 1 --out " + at("m.vtu") +
                              " --report " + at("r.json"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_EQ(nlohmann::json::parse(bytes_of(at("r.json")))["input"], (nlohmann::json{{"labels", {1}}}));
  const auto described = nlohmann::json::parse(run("mesh --describe-options").text)["input"];
  EXPECT_EQ(described.size(), input_options().size());
}

TEST_F(MeshCommand, ASwitchThatThePresetHasOnCanBeTurnedOff) {
  const Outcome outcome = run("mesh " + at("ball.nii.gz") + " --quiet --topology-checks=false --out " +
                              at("m.vtu") + " --report " + at("r.json"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_EQ(nlohmann::json::parse(bytes_of(at("r.json")))["options"]["topology_checks"], false);
}

TEST_F(MeshCommand, LeavesAnOlderOutputAloneWhenItFails) {
  std::ofstream(at("old.vtu")) << "old";
  EXPECT_EQ(run("mesh " + at("absent.nii") + " --out " + at("old.vtu")).exit_code, 2);
  EXPECT_EQ(bytes_of(at("old.vtu")), "old");
}

}  // namespace
}  // namespace cbc3d
