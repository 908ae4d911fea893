// The command `cbc3d` as its users meet it: exit codes, one line for what is wrong, nothing left behind.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "mesher/core/image_io.hpp"
#include "mesher/core/mesh_io.hpp"
#include "mesher/testing/run_command.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {
namespace fs = std::filesystem;

using testing::bytes_of;
using testing::Outcome;

Outcome run(const std::string& arguments) {
  return testing::run_command(arguments);
}

class Command : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("cbc3d-command-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
    write_label_image(testing::ball_image(24, 1, 9, 4), folder_ / "ball.nii.gz");
  }
  void TearDown() override { fs::remove_all(folder_); }
  [[nodiscard]] std::string at(const std::string& name) const { return (folder_ / name).string(); }

  /// Expects exit 2, one line on the fault and no output file.
  void expect_refusal(const std::string& arguments, const std::string& says) const {
    const Outcome outcome = run(arguments + " --quiet");
    EXPECT_EQ(outcome.exit_code, 2) << outcome.text;
    EXPECT_NE(outcome.text.find(says), std::string::npos) << outcome.text;
    EXPECT_EQ(std::count(outcome.text.begin(), outcome.text.end(), '\n'), 1) << outcome.text;
    EXPECT_FALSE(fs::exists(folder_ / "m.vtu"));
  }
  fs::path folder_;
};

TEST_F(Command, MeshesAnImageAndReports) {
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

TEST_F(Command, SameBytesAtOneAndTwoThreads) {
  ASSERT_EQ(run("mesh " + at("ball.nii.gz") + " --threads 1 --quiet --out " + at("a.vtu")).exit_code, 0);
  ASSERT_EQ(run("mesh " + at("ball.nii.gz") + " --threads 2 --quiet --out " + at("b.vtu")).exit_code, 0);
  EXPECT_EQ(bytes_of(at("a.vtu")), bytes_of(at("b.vtu")));
}

TEST_F(Command, QuietSaysNothingAndLinesAreSaidElsewhere) {
  EXPECT_EQ(run("mesh " + at("ball.nii.gz") + " --quiet --fidelity 0.8 --out " + at("a.vtu")).text, "");
  EXPECT_NE(run("mesh " + at("ball.nii.gz") + " --preset paper --out " + at("a.vtu"))
                .text.find("deformation, iteration 5\n"),
            std::string::npos);
}

TEST_F(Command, RefusesBadInputWithOneLine) {
  expect_refusal("mesh " + at("absent.nii") + " --out " + at("m.vtu"), "does not exist");
  expect_refusal("mesh " + at("ball.nii.gz") + " --out " + at("none/m.vtu"), "create it first");
  expect_refusal("mesh " + at("ball.nii.gz") + " --out /proc/m.vtu", "choose another place");
  expect_refusal("mesh " + at("ball.nii.gz") + " --out " + at("m.stl"), "use .vtu, .vtk or .msh");
  expect_refusal("mesh " + at("ball.nii.gz") + " --out " + at("m.vtu") + " --fidelity 2", "--fidelity");
  expect_refusal("mesh " + at("ball.nii.gz") + " --out " + at("m.vtu") + " --material-fidelity 9=0.5",
                 "no label 9");
  expect_refusal("mesh " + at("ball.nii.gz") + " --out " + at("m.vtu") + " --lattice-spacing 1e-9",
                 "--lattice-spacing");
  expect_refusal("mesh " + at("ball.nii.gz"), "--out");
  expect_refusal("mush", "--help");
}

TEST_F(Command, WarningsNameFlags) {
  const Outcome outcome =
      run("mesh " + at("ball.nii.gz") + " --topology-checks --no-manifold-voxels --quiet " +
          "--preset paper --out " + at("m.vtu") + " --report " + at("r.json"));
  const std::string says = "--topology-checks with --no-manifold-voxels: contacts";
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.text.find(says), std::string::npos) << outcome.text;
  EXPECT_NE(bytes_of(at("r.json")).find(says), std::string::npos);
}

std::string nrrd(const std::string& fields, const std::string& data) {
  return "NRRD0004\nendian: little\nencoding: raw\n" + fields + "\n" + data;
}

TEST_F(Command, RefusesImagesThatAreNoLabelVolumes) {
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

TEST_F(Command, CleansAnImageAndTellsWhatItChanged) {
  LabelImage image = testing::ball_image(24, 1, 8);
  image.voxels[image.frame.offset(1, 1, 1)] = image.voxels[image.frame.offset(2, 2, 1)] =
      1;  // an edge contact
  write_label_image(image, at("edge.nii.gz"));
  const Outcome outcome = run("clean " + at("edge.nii.gz") + " --region-tolerance 0 --out " +
                              at("clean.nii.gz") + " --report " + at("c.json"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_NE(outcome.text.find("1 edge contacts removed"), std::string::npos) << outcome.text;
  const LabelImage clean = read_label_image(at("clean.nii.gz"));
  EXPECT_EQ(clean.voxels_per_material()[1], image.voxels_per_material()[1] + 1);
  EXPECT_DOUBLE_EQ(nlohmann::json::parse(bytes_of(at("c.json")))["labels"][0]["volume_change_mm3"], 1);
}

TEST_F(Command, LeavesAnOlderOutputAloneWhenItFails) {
  std::ofstream(at("old.vtu")) << "old";
  EXPECT_EQ(run("mesh " + at("absent.nii") + " --out " + at("old.vtu")).exit_code, 2);
  EXPECT_EQ(bytes_of(at("old.vtu")), "old");
}

}  // namespace
}  // namespace cbc3d
