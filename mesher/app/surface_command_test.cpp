// `cbc3d surface` as its users meet it.
#include <gtest/gtest.h>

#include <filesystem>

#include "mesher/app/testing_command.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"
#include "mesher/testing/kuhn_box.hpp"

namespace cbc3d {
namespace {
namespace fs = std::filesystem;

class SurfaceCommand : public testing::CommandTest {
 protected:
  void SetUp() override {
    const testing::KuhnBox box(2);
    Mesh mesh;
    mesh.points = box.points;
    for (std::size_t t = 0; t < box.tets.size(); ++t)
      mesh.tets.add(box.tets[t], box.centroid(t).x < 1 ? 7 : 3);
    write_mesh(mesh, at("box.vtu"));
  }
  [[nodiscard]] testing::Outcome run(const std::string& arguments) const {
    return testing::run_command("surface " + at("box.vtu") + " " + arguments);
  }
};

TEST_F(SurfaceCommand, WritesAPartForEachLabelOrInterface) {
  EXPECT_EQ(run("--out " + at("s.obj")).exit_code, 0);
  const std::string text = testing::bytes_of(at("s.obj"));
  EXPECT_NE(text.find("\ng label_3\n"), std::string::npos);
  EXPECT_NE(text.find("\ng label_7\n"), std::string::npos);
  const testing::Outcome outcome = run("--per interface -o " + at("s.stl"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  EXPECT_NE(outcome.text.find("s-label_3__label_7.stl"), std::string::npos) << outcome.text;
  EXPECT_EQ(fs::file_size(at("s-label_3__label_7.stl")), 84U + 8 * 50);
  EXPECT_EQ(run("--per all --out " + at("s.ply")).exit_code, 0);
  EXPECT_TRUE(fs::exists(at("s.ply")));
  EXPECT_EQ(run("--out " + at("s.glb")).exit_code, 0);
  EXPECT_EQ(testing::bytes_of(at("s.glb")).substr(0, 4), "glTF");
}

TEST_F(SurfaceCommand, RefusesWhatItCannotDo) {
  expect_refusal("surface " + at("box.vtu") + " --out " + at("s.vtu"), "use .stl, .ply, .obj or .glb",
                 "s.vtu");
  expect_refusal("surface " + at("absent.vtu") + " --out " + at("s.stl"), "does not exist", "s.stl");
  expect_refusal("surface " + at("box.vtu") + " --label-array part --out " + at("s.stl"),
                 "name the one with the labels by --label-array", "s.stl");
}

}  // namespace
}  // namespace cbc3d
