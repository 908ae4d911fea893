// The formats of meshes as users of `mesh`, `improve` and `deform` meet them.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "mesher/app/testing_command.hpp"
#include "mesher/core/image_io.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {
namespace fs = std::filesystem;
using testing::bytes_of;

class MeshFiles : public testing::CommandTest {
 protected:
  void SetUp() override { write_label_image(testing::ball_image(20, 1, 7, 4), at("ball.nrrd")); }
  void expect_success(const std::string& arguments) const {
    const testing::Outcome outcome = testing::run_command(arguments + " --quiet");
    EXPECT_EQ(outcome.exit_code, 0) << arguments << '\n' << outcome.text;
  }
};

TEST_F(MeshFiles, EveryFormatIsWrittenAndAllButFebioReadAgain) {
  expect_success("mesh " + at("ball.nrrd") + " --out " + at("m.vtu"));
  const std::size_t cells = read_mesh(at("m.vtu")).cell_count();
  std::string before = at("m.vtu");
  for (const auto& [name, format] :
       {std::pair{"a.vtk", "vtk-ascii"}, std::pair{"b.vtk", "vtk"}, std::pair{"c.msh", "gmsh41"},
        std::pair{"d.msh", "gmsh22"}, std::pair{"e.inp", "abaqus"}, std::pair{"f.mesh", "medit"},
        std::pair{"g.feb", "febio"}}) {
    expect_success("deform " + before + " " + at("ball.nrrd") + " --iterations 0 --format " + format +
                   " --out " + at(name));
    if (fs::path(name).extension() == ".feb") continue;
    EXPECT_EQ(read_mesh(at(name)).cell_count(), cells) << name;
    before = at(name);
  }
  expect_success("improve " + before + " --out " + at("improved.inp"));
  EXPECT_EQ(labels_of(read_mesh(at("improved.inp"))), (std::vector<Label>{1, 2}));
}

TEST_F(MeshFiles, QuadraticTetsFollowTheBoundary) {
  expect_success("mesh " + at("ball.nrrd") + " --order 2 --report " + at("r.json") + " --out " + at("q.inp"));
  const auto report = nlohmann::json::parse(bytes_of(at("r.json")));
  EXPECT_EQ(report["options"]["order"], 2);
  const auto& quadratic = report["quadratic"];
  EXPECT_GT(quadratic["curved_edges"].get<int>(), quadratic["boundary_edges"].get<int>() / 2) << quadratic;
  EXPECT_GE(quadratic["least_relative_jacobian"].get<double>(), 0.5);
  EXPECT_NE(bytes_of(at("q.inp")).find("TYPE=C3D10, ELSET=label_1"), std::string::npos);
  expect_refusal("mesh " + at("ball.nrrd") + " --order 2 --mixed --out " + at("x.vtu"), "order 1", "x.vtu");
  expect_refusal("mesh " + at("ball.nrrd") + " --order 3 --out " + at("x.vtu"), "--order", "x.vtu");
}

TEST_F(MeshFiles, SplitInterfacesHaveTheirNodesApart) {
  expect_success("mesh " + at("ball.nrrd") + " --out " + at("m.vtu"));
  expect_success("mesh " + at("ball.nrrd") + " --split-interfaces --out " + at("s.vtu"));
  const Mesh shared = read_mesh(at("m.vtu")), split = read_mesh(at("s.vtu"));
  EXPECT_GT(split.points.size(), shared.points.size());
  std::vector<Label> label_of(split.points.size(), 0);
  for (std::size_t t = 0; t < split.tets.size(); ++t) {
    for (const VertexId v : split.tets.nodes[t]) {
      EXPECT_TRUE(label_of[v] == 0 || label_of[v] == split.tets.labels[t]);
      label_of[v] = split.tets.labels[t];
    }
  }
}

TEST_F(MeshFiles, RefusesFormatsThatDoNotGoWithTheFile) {
  const std::string mesh = "mesh " + at("ball.nrrd");
  expect_refusal(mesh + " --format gmsh41 --out " + at("x.vtu"), "has the extension .msh", "x.vtu");
  expect_refusal(mesh + " --format step --out " + at("x.vtu"), "--format", "x.vtu");
  expect_refusal("improve " + at("x.feb") + " --out " + at("x.vtu"), "written alone", "x.vtu");
}

}  // namespace
}  // namespace cbc3d
