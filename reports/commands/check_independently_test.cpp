// The figures of `cbc3d-bench evaluate --solve` against metrics/check_independently, which computes them with
// VTK's reader, numpy and scipy alone.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "mesher/core/atomic_file.hpp"
#include "mesher/testing/temporary_folder.hpp"
#include "reports/results/result.hpp"
#include "reports/run/child_process.hpp"

namespace cbc3d::reports {
namespace {

constexpr const char* kPython = "/usr/bin/python3";

std::string text_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

ChildResult run(const std::vector<std::string>& argv) {
  return run_child({argv, 1, 0, std::int64_t{4} << 30});
}

class CheckIndependently : public ::testing::Test {
 protected:
  /// Meshes a small phantom of several labels and judges the mesh.
  void SetUp() override {
    if (std::string(SOLVE).empty()) {
      GTEST_SKIP() << "there is no cbc3d-solve";
    }
    if (run({kPython, "-c", "import numpy, scipy, vtk"}).exit_code != 0) {
      GTEST_SKIP() << "python3-numpy, python3-scipy or python3-vtk9 is not installed";
    }
    expect_success({BENCH, "phantom", "organs", "--out", image_, "--size", "32,32,24"});
    expect_success({MESHER, "mesh", image_, "--out", mesh_, "--preset", "paper", "--quiet"});
    expect_success({BENCH, "evaluate", mesh_, image_, "--solve", "--no-smooth", "--no-certified", "--json",
                    json_, "--quiet"});
  }
  static void expect_success(const std::vector<std::string>& argv) {
    const ChildResult child = run(argv);
    ASSERT_EQ(child.exit_code, 0) << argv[1] << ": " << child.stderr_tail;
  }
  /// Exit code and output of the script.
  [[nodiscard]] int check() const {
    const std::string command = std::string(CHECK) + " " + mesh_ + " " + json_ + " > " + report_ + " 2>&1";
    return run({"/bin/sh", "-c", command}).exit_code;
  }
  [[nodiscard]] std::string report() const { return text_of(report_); }

  const cbc3d::testing::TemporaryFolder folder_;
  const std::string image_ = folder_.path() / "image.nrrd", mesh_ = folder_.path() / "mesh.vtu",
                    json_ = folder_.path() / "ours.json", report_ = folder_.path() / "report.txt";
};

TEST_F(CheckIndependently, AllFiguresAgreeToThreeDigits) {
  EXPECT_EQ(check(), 0) << report();
  for (const char* figure :
       {"quality.mean_ratio.median", "quality.radius_ratio.p1", "quality.edge_ratio.max",
        "quality.min_dihedral_deg", "quality.valence_max", "quality.inner_vertices_percent",
        "quality.neighbour_size_ratio.max", "surface.facet_angle_rms_deg", "label 4: mesh_volume_mm3",
        "label 4: parts, tunnels, cavities", "solver.poisson_p1.h1_relative"}) {
    EXPECT_NE(report().find(figure), std::string::npos) << figure;
  }
}

TEST_F(CheckIndependently, AFigureThatIsOffIsFound) {
  Json ours = Json::parse(text_of(json_));
  ours["solver"]["poisson_p1"]["h1_relative"] =
      1.001 * ours["solver"]["poisson_p1"]["h1_relative"].get<double>();
  ours["quality"]["valence_max"] = ours["quality"]["valence_max"].get<int>() + 1;
  write_text_file(json_, ours.dump());
  EXPECT_EQ(check(), 1);
  EXPECT_NE(report().find(", 2 differ"), std::string::npos) << report();
}

}  // namespace
}  // namespace cbc3d::reports
