// Jobs with a budget of elements.
#include <gtest/gtest.h>

#include "mesher/core/error.hpp"
#include "mesher/core/image_io.hpp"
#include "mesher/testing/temporary_folder.hpp"
#include "reports/run/runner.hpp"

namespace cbc3d::reports {
namespace {

using cbc3d::testing::TemporaryFolder;

/// A mesher with 1000 / size^3 tets, at least 20; or, with the mode "fail", with none.
baselines::Adapter sized_mesher(const std::string& mode = "tets") {
  baselines::Adapter adapter;
  adapter.name = mode;
  adapter.description = "a fake";
  adapter.parameters = {{"size", "1", "mm", "element size"}, {"other", "7", "", "something"}};
  adapter.availability = [](const std::filesystem::path&) { return baselines::Availability{true, ""}; };
  adapter.size_dial = [](const std::filesystem::path&) {
    return baselines::SizeDial{
        .parameter = "size", .exponent = -2, .first = 1, .lowest = 0.1, .highest = 100};
  };
  adapter.command = [mode](const std::filesystem::path&, const baselines::MeshJob& job) {
    const auto size = job.parameters.find("size");
    return std::vector<std::string>{TEST_CHILD, mode, job.mesh.string(), job.report.string(),
                                    size == job.parameters.end() ? "1" : size->second};
  };
  return adapter;
}

class Budgets : public ::testing::Test {
 protected:
  Budgets() {
    LabelImage image;
    image.frame.size = {8, 8, 8};
    image.labels = {0, 1};
    image.voxels.assign(image.frame.voxel_count(), 0);
    image.voxels[image.frame.offset(3, 1, 1)] = 1;
    write_label_image(image, image_);
    bench_.cases.resize(1);
    bench_.cases[0].name = "box";
    bench_.cases[0].image_sha256 = "abc";
    bench_.evaluate_command = {BENCH, "evaluate"};
    bench_.resolve_image = [this](const cases::Case&) { return cases::ResolvedImage{image_, ""}; };
    bench_.meshers = {sized_mesher()};
    options_.out_dir = folder_.path() / "out";
    options_.threads = {1};
  }
  std::vector<Json> run() { return run_jobs(bench_, options_, progress_); }

  TemporaryFolder folder_;
  std::filesystem::path image_ = folder_.path() / "box.nrrd";
  Bench bench_;
  RunOptions options_;
  TerminalProgress progress_{true};
};

TEST_F(Budgets, AMetBudgetIsAnOrdinaryLine) {
  options_.budgets = {100};
  options_.parameters["tets"]["other"] = "8";
  const Json line = run().at(0);
  ASSERT_EQ(line["status"], "ok") << line["reason"];
  EXPECT_EQ(line["budget"], 100);
  EXPECT_NEAR(line["counts"]["tets"].get<double>(), 100, 10);
  EXPECT_EQ(line["parameters"]["other"], "8");
  EXPECT_NE(line["parameters"]["size"], nullptr);
  EXPECT_EQ(line["size_search"]["met"], true);
  EXPECT_EQ(line["size_search"]["given_parameters"], (Json{{"other", "8"}}));
  EXPECT_GE(line["size_search"]["tries"].size(), 2U);
  EXPECT_EQ(line["provenance"]["command"][4], line["parameters"]["size"]);
  EXPECT_EQ(line["mesh_file"], "meshes/box-tets-n100-t1-r0.vtu");
  EXPECT_TRUE(std::filesystem::exists(options_.out_dir / line["mesh_file"].get<std::string>()));
  const JobResult result = decode(line);
  EXPECT_EQ(result.id, "box-tets-n100-t1-r0");
  EXPECT_EQ(result.budget, 100);
  EXPECT_EQ(result.budget_shortfall, "");
  for (const auto& entry : std::filesystem::directory_iterator(options_.out_dir / "meshes"))
    EXPECT_EQ(entry.path().extension(), ".vtu");
}

TEST_F(Budgets, AFloorIsALineWithItsReason) {
  options_.budgets = {5};
  const Json line = run().at(0);
  EXPECT_EQ(line["status"], "ok");
  EXPECT_EQ(line["counts"]["tets"], 20);
  EXPECT_EQ(line["size_search"]["met"], false);
  EXPECT_NE(decode(line).budget_shortfall.find("no fewer than 20 elements at size="), std::string::npos)
      << decode(line).budget_shortfall;
}

TEST_F(Budgets, ResumeKeepsThemAndRunsTheOthers) {
  options_.budgets = {100};
  run();
  options_.resume = true;
  options_.budgets = {100, 400};
  std::vector<Json> lines = run();
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_EQ(lines[1]["budget"], 400);
  EXPECT_NEAR(lines[1]["counts"]["tets"].get<double>(), 400, 40);
  options_.parameters["tets"]["other"] = "8";
  EXPECT_THROW(run(), InputError);
}

TEST_F(Budgets, RepeatsTakeTheValueThatWasFound) {
  options_.budgets = {100};
  options_.repeats = 2;
  const std::vector<Json> lines = run();
  EXPECT_EQ(lines.at(1)["size_search"]["tries"].size(), 1U);
  EXPECT_EQ(lines[1]["parameters"], lines[0]["parameters"]);
  EXPECT_EQ(lines[1]["mesh_sha256"], lines[0]["mesh_sha256"]);
}

TEST_F(Budgets, MeshersThatFailOrHaveNoDialSaySo) {
  bench_.meshers = {sized_mesher("fail"), sized_mesher()};
  bench_.meshers[0].command = [](const std::filesystem::path&, const baselines::MeshJob& job) {
    return std::vector<std::string>{TEST_CHILD, "fail", job.mesh.string(), job.report.string()};
  };
  bench_.meshers[1].size_dial = nullptr;
  options_.budgets = {100};
  const std::vector<Json> lines = run();
  EXPECT_EQ(lines.at(0)["status"], "failed");
  EXPECT_EQ(lines[0]["reason"], "no room left on the lattice");
  EXPECT_TRUE(lines[0]["mesh_file"].is_null());
  EXPECT_EQ(lines.at(1)["status"], "skipped");
  EXPECT_NE(lines[1]["reason"].get<std::string>().find("no size dial"), std::string::npos);
}

}  // namespace
}  // namespace cbc3d::reports
