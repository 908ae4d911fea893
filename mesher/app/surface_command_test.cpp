// `cbc3d surface` as its users meet it.
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "mesher/app/testing_command.hpp"
#include "mesher/core/image_io.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"
#include "mesher/testing/kuhn_box.hpp"
#include "mesher/testing/test_images.hpp"

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

/// The first vertex of a surface's file in Wavefront's format.
Vec3 first_vertex(const std::string& text) {
  Vec3 p;
  std::istringstream(text.substr(text.find("\nv ") + 3)) >> p.x >> p.y >> p.z;
  return p;
}

TEST_F(SurfaceCommand, TakesItsPointsToOtherCoordinatesAndSaysSo) {
  LabelImage image = testing::ball_image(12, 1, 4);
  image.frame.spacing_mm = {0.5, 2, 4};
  image.frame.origin_mm = {-1, 3, 5};
  image.frame.direction(2, 2) = -1;  // left-handed
  write_label_image(image, at("ball.nrrd"));
  Vec3 lps;
  for (const std::string coordinates : {"lps", "ras", "voxel"}) {
    const std::string image_option = coordinates == "voxel" ? " --image " + at("ball.nrrd") : "";
    ASSERT_EQ(run("--coordinates " + coordinates + image_option + " -o " + at("s.obj")).exit_code, 0);
    const std::string text = testing::bytes_of(at("s.obj"));
    const std::string said = coordinates == "voxel" ? "voxel" : coordinates == "ras" ? "RAS" : "LPS";
    EXPECT_NE(text.find("coordinates " + said + "\n"), std::string::npos) << text.substr(0, 80);
    const Vec3 p = first_vertex(text);
    if (coordinates == "lps") lps = p;
    const Vec3 expected = coordinates == "lps"   ? lps
                          : coordinates == "ras" ? Vec3{-lps.x, -lps.y, lps.z}
                                                 : Vec3{(lps.x + 1) / 0.5, (lps.y - 3) / 2, (lps.z - 5) / -4};
    EXPECT_NEAR((p - expected).norm(), 0, 1e-9) << coordinates;
  }
  expect_refusal("surface " + at("box.vtu") + " --coordinates voxel --out " + at("n.stl"),
                 "name it by --image", "n.stl");
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
