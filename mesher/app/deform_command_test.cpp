// `cbc3d deform` as its users meet it.
#include <nlohmann/json.hpp>

#include "mesher/app/testing_command.hpp"
#include "mesher/core/image_io.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

class DeformCommand : public testing::CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    write_label_image(testing::ball_image(20, 1, 7, 3), at("ball.nii.gz"));
    const testing::Outcome meshed = testing::run_command(
        "mesh " + at("ball.nii.gz") + " --preset paper --iterations 0 --quiet --out " + at("b.vtu"));
    ASSERT_EQ(meshed.exit_code, 0) << meshed.text;
  }
};

TEST_F(DeformCommand, MovesVerticesAndReportsItsOptions) {
  const testing::Outcome outcome =
      testing::run_command("deform " + at("b.vtu") + " " + at("ball.nii.gz") +
                           " --quiet --iterations 2 --material-young 2=6900 --poisson 0.25 --out " +
                           at("d.vtu") + " --report " + at("r.json"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.text;
  const Mesh before = read_mesh(at("b.vtu"));
  const Mesh after = read_mesh(at("d.vtu"));
  EXPECT_EQ(before.tets.nodes, after.tets.nodes);
  EXPECT_NE(before.points.front(), after.points.front());
  const auto report = nlohmann::json::parse(testing::bytes_of(at("r.json")));
  EXPECT_EQ(report["options"]["iterations"], 2);
  EXPECT_EQ(report["options"]["target_position"], "voxel-faces");
  EXPECT_EQ(report["options"]["min_dihedral_deg"], 5);
  EXPECT_EQ(report["options"]["material_elasticity"],
            (nlohmann::json{{"2", {{"young_pa", 6900}, {"poisson", 0.25}}}}));
  EXPECT_FALSE(report["options"].contains("fidelity"));
  EXPECT_EQ(report["deformation"]["iterations"].size(), 2U);
}

TEST_F(DeformCommand, RefusesBadInputInOneLine) {
  const std::string files = "deform " + at("b.vtu") + " " + at("ball.nii.gz") + " --out " + at("d.vtu");
  expect_refusal(files + " --poisson 0.5", "--poisson 0.5: give a number in [0, 0.499]", "d.vtu");
  expect_refusal(files + " --material-young 9=1", "--material-young 9=1: the image has no label 9", "d.vtu");
  expect_refusal(files + " --fidelity 0.5", "--fidelity", "d.vtu");
}

}  // namespace
}  // namespace cbc3d
