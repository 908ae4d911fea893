// `cbc3d improve` as its users meet it: what it takes, what it refuses, what it keeps.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "mesher/app/testing_command.hpp"
#include "mesher/core/image_io.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"
#include "mesher/testing/test_images.hpp"
#include "mesher/topology/cell_quality.hpp"
#include "mesher/topology/labelled_tets.hpp"
#include "mesher/topology/orient_tets.hpp"

namespace cbc3d {
namespace {
namespace fs = std::filesystem;

using testing::bytes_of;
using testing::Outcome;

Outcome run(const std::string& arguments) {
  return testing::run_command("improve " + arguments);
}

/// Voxel (i, j, k) of a block of n^3 cubes: label -7 in a smaller block within, else 2000000000.
Label block_label(int n, int i, int j, int k) {
  const bool inner = std::min({i, j, k}) >= n / 4 && std::max({i, j, k}) < n - n / 4;
  return inner ? -7 : 2000000000;
}

/// n^3 cubes of six tets each; what is inside a label is shaken by `shake` of the cubes' size, surfaces stay.
Mesh shaken_block(int n, double shake) {
  Mesh mesh;
  std::mt19937 random(5);
  const auto id = [n](int i, int j, int k) { return static_cast<VertexId>((k * (n + 1) + j) * (n + 1) + i); };
  for (int k = 0; k <= n; ++k) {
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= n; ++i) {
        bool inside = true;
        for (int c = 0; c < 8; ++c) {
          const int x = i - (c & 1);
          const int y = j - (c >> 1 & 1);
          const int z = k - (c >> 2);
          inside = inside && std::min({x, y, z}) >= 0 && std::max({x, y, z}) < n &&
                   block_label(n, x, y, z) ==
                       block_label(n, std::min(i, n - 1), std::min(j, n - 1), std::min(k, n - 1));
        }
        Vec3 p = {1.0 * i, 1.0 * j, 1.0 * k};
        for (int axis = 0; axis < 3; ++axis) {
          p[axis] += (inside ? shake : 0) * (random() / 2147483648.0 - 1);
        }
        mesh.points.push_back(p);
      }
    }
  }
  constexpr std::array<std::array<int, 2>, 6> kPaths = {{{1, 3}, {1, 5}, {2, 3}, {2, 6}, {4, 5}, {4, 6}}};
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const auto corner = [&](int c) { return id(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2)); };
        for (const auto& [first, second] : kPaths) {  // any node order: the command puts it right
          mesh.tets.add({corner(0), corner(first), corner(second), corner(7)}, block_label(n, i, j, k));
        }
      }
    }
  }
  return mesh;
}

class ImproveCommand : public testing::CommandTest {
 protected:
  void expect_refusal(const std::string& arguments, const std::string& text) const {
    CommandTest::expect_refusal("improve " + arguments + " --out " + at("out.vtu"), text, "out.vtu");
  }
};

TEST_F(ImproveCommand, RefusesInOneLineWhatItCannotTake) {
  Mesh mesh = shaken_block(2, 0);
  write_mesh(mesh, at("good.vtu"));
  expect_refusal(at("none.vtu"), "does not exist");
  expect_refusal(at("good.vtu") + " --min-dihedral 80", "--min-dihedral 80: give a number in [0, 60]");
  expect_refusal(at("good.vtu") + " --max-deviation -1", "max-deviation");
  expect_refusal(at("good.vtu") + " " + at("none.nii.gz"), "none.nii.gz");
  mesh.pyramids.add({0, 1, 4, 3, 9}, 1);
  write_mesh(mesh, at("mixed.vtu"));
  expect_refusal(at("mixed.vtu"), "1 pyramids");
  mesh = shaken_block(2, 0);
  mesh.tets.add(mesh.tets.nodes[0], 3);
  write_mesh(mesh, at("twice.vtu"));
  expect_refusal(at("twice.vtu"), "more than two tets");
  mesh = shaken_block(2, 0);
  mesh.points[3].x = std::nan("");
  write_mesh(mesh, at("nan.vtu"));
  expect_refusal(at("nan.vtu"), "nan.vtu");
  write_label_image(testing::ball_image(8, 1, 3), at("ball.nii.gz"));
  expect_refusal(at("good.vtu") + " " + at("ball.nii.gz"), "label -7");
}

TEST_F(ImproveCommand, LiftsSliversAndKeepsLabelsVolumesAndSurfaces) {
  const Mesh before = shaken_block(8, 0.36);
  write_mesh(before, at("block.vtu"));
  const Outcome outcome = run(at("block.vtu") + " --quiet --no-decimation --min-dihedral 15 --out " +
                              at("out.vtk") + " --report " + at("r.json"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  const Mesh after = read_mesh(at("out.vtk"));
  EXPECT_GE(testing::smallest_dihedral_deg(after), 15 - 1e-6);
  EXPECT_EQ(labels_of(after), (std::vector<Label>{-7, 2000000000}));
  EXPECT_NEAR(testing::volume_of(after, -7), 64, 0.64);
  EXPECT_NEAR(testing::volume_of(after, 2000000000), 448, 4.48);
  const nlohmann::json report = nlohmann::json::parse(std::ifstream(at("r.json")));
  EXPECT_LT(report["before"]["min_dihedral_deg"], 6);
  EXPECT_NEAR(report["after"]["min_dihedral_deg"], testing::smallest_dihedral_deg(after), 1e-3);
  EXPECT_EQ(report["before"]["tets"], before.tets.size());
  EXPECT_EQ(report["after"]["tets"], after.tets.size());
}

TEST_F(ImproveCommand, ThinsOutAMeshAndGivesTheSameBytesAtAnyThreadCount) {
  write_mesh(shaken_block(12, 0.2), at("block.vtu"));
  for (const char* threads : {"1", "2"}) {
    ASSERT_EQ(run(at("block.vtu") + " --quiet --decimate --threads " + threads + " --out " + at("t") +
                  threads + ".vtu")
                  .exit_code,
              0);
  }
  EXPECT_EQ(bytes_of(at("t1.vtu")), bytes_of(at("t2.vtu")));
  const Mesh after = read_mesh(at("t1.vtu"));
  EXPECT_LT(after.tets.size(), 0.85 * 6 * 12 * 12 * 12);
  EXPECT_NEAR(testing::volume_of(after, -7), 216, 0.02 * 216);
}

TEST_F(ImproveCommand, FollowsAnImageInItsOwnFrame) {
  LabelImage image = testing::ball_image(24, 1, 9, 4);
  image.frame = testing::oblique(image.frame, true);
  write_label_image(image, at("ball.nrrd"));
  ASSERT_EQ(std::system((std::string(CBC3D_COMMAND) + " mesh " + at("ball.nrrd") +
                         " --preset paper --quiet --out " + at("ball.vtu"))
                            .c_str()),
            0);
  const Outcome outcome =
      run(at("ball.vtu") + " " + at("ball.nrrd") + " --quiet --decimate --out " + at("out.vtu"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  const Mesh before = read_mesh(at("ball.vtu"));
  const Mesh after = read_mesh(at("out.vtu"));
  EXPECT_EQ(labels_of(after), (std::vector<Label>{1, 2}));
  EXPECT_GE(testing::smallest_dihedral_deg(after), 20 - 1e-3);
  EXPECT_LT(after.tets.size(), before.tets.size());
  const std::vector<std::size_t> voxels = image.voxels_per_material();
  for (const Label label : {1, 2}) {
    const auto wanted = static_cast<double>(voxels[static_cast<std::size_t>(label)]);
    EXPECT_NEAR(testing::volume_of(after, label), wanted, 0.03 * wanted) << label;
  }
}

TEST_F(ImproveCommand, UntanglesWhatIsInsideOutAndFlat) {
  Mesh mesh = shaken_block(6, 0.1);
  mesh.points[(3 * 7 + 3) * 7 + 3] += Vec3{1.3, 0.2, 0.1};  // through its neighbours
  mesh.points[(1 * 7 + 1) * 7 + 1] = Vec3{1, 1, 0.0};       // onto a face
  mesh.tets.add({0, 1, 1, 2}, -7);                          // a node twice
  write_mesh(mesh, at("tangled.vtu"));
  const Outcome outcome =
      run(at("tangled.vtu") + " --quiet --out " + at("out.vtu") + " --report " + at("r.json"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_NE(outcome.text.find("1 tets had a node twice"), std::string::npos) << outcome.text;
  const nlohmann::json report = nlohmann::json::parse(std::ifstream(at("r.json")));
  EXPECT_GT(report["before"]["not_positive"], 2);
  EXPECT_EQ(report["after"]["not_positive"], 0);
  EXPECT_GT(testing::smallest_dihedral_deg(read_mesh(at("out.vtu"))), 10);
}

TEST_F(ImproveCommand, SaysWhatCannotBeUntangled) {
  Mesh mesh;  // one flat tet and a good one beside it: nothing may move
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {5, 0, 0}, {6, 0, 0}, {5, 1, 0}, {5, 0, 1}};
  mesh.tets.add({0, 1, 2, 3}, 4);
  mesh.tets.add({4, 5, 6, 7}, 4);
  write_mesh(mesh, at("flat.vtu"));
  const Outcome outcome = run(at("flat.vtu") + " --quiet --max-deviation 0.01 --out " + at("out.vtu"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_NE(outcome.text.find("warning"), std::string::npos) << outcome.text;
  EXPECT_TRUE(fs::exists(folder_ / "out.vtu"));
}

}  // namespace
}  // namespace cbc3d
