#include "reports/charts/pictures.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "mesher/testing/temporary_folder.hpp"
#include "reports/charts/picture_kinds.hpp"
#include "reports/tables/testing_tables.hpp"

namespace cbc3d::reports {
namespace {

namespace fs = std::filesystem;

/// A program for drawing and an X server that only write down how they were called.
class Pictures : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(bin_dir_);
    folder_.write("bin/cbc3d-picture", "");
    script("exit 0");
    path_ = std::getenv("PATH");
    ::setenv("PATH", (bin_dir_.string() + ":" + path_).c_str(), 1);
  }
  void TearDown() override { ::setenv("PATH", path_.c_str(), 1); }

  void script(const std::string& end) {
    folder_.write("bin/xvfb-run",
                  "#!/bin/sh\necho \"$@\" >> '" + folder_.file("calls").string() + "'\n" + end + "\n");
    fs::permissions(bin_dir_ / "xvfb-run", fs::perms::owner_all);
  }
  static Json meshed(const std::string& case_name, const std::string& mesher, int repeat = 0) {
    Json line = job_line(case_name, mesher, 1000, repeat);
    line["mesh_file"] = "meshes/" + case_name + "-" + mesher + "-r" + std::to_string(repeat) + ".vtu";
    line["provenance"]["image_file"] = "/images/" + case_name + ".nrrd";
    return line;
  }
  int draw(std::vector<Json> lines) {
    return draw_pictures(folder_.path(), decode_lines(std::move(lines)), bin_dir_, progress_);
  }
  [[nodiscard]] std::vector<std::string> calls() const {
    std::istringstream all(folder_.content("calls"));
    std::vector<std::string> lines;
    for (std::string line; std::getline(all, line);) {
      lines.push_back(line);
    }
    return lines;
  }
  static bool has(const std::string& call, const std::string& part) {
    return call.find(part) != std::string::npos;
  }

  cbc3d::testing::TemporaryFolder folder_{"pictures"};
  fs::path bin_dir_ = folder_.path() / "bin";
  TerminalProgress progress_{true};
  std::string path_;
};

TEST_F(Pictures, TheFirstGoodRunOfEveryCaseAndMesherHasFour) {
  EXPECT_EQ(draw({crashed_line("nidus", "cgal", "oops"), meshed("nidus", "cgal", 1),
                  meshed("nidus", "cgal", 2), meshed("knee", "cgal"), job_line("knee", "tetgen", 10)}),
            8);
  ASSERT_EQ(calls().size(), 2U);
  EXPECT_TRUE(has(calls()[0], "meshes/nidus-cgal-r1.vtu --image /images/nidus.nrrd")) << calls()[0];
  EXPECT_TRUE(has(calls()[0], "--caption nidus  -  cgal  -  1,000 elements")) << calls()[0];
  for (const char* kind : {"cut", "surface", "close-up", "overlay"}) {
    EXPECT_TRUE(has(calls()[0], std::string("--") + kind + " " +
                                    (folder_.path() / "figures" / "nidus-cgal-").string() + kind + ".png"))
        << calls()[0];
  }
  EXPECT_FALSE(has(calls()[0], "--beside"));
  EXPECT_TRUE(has(calls()[1], "knee-cgal-r0.vtu"));
}

TEST_F(Pictures, MixedElementsStandBesideThePapersTets) {
  EXPECT_EQ(draw({meshed("nidus", "cbc3d-paper"), meshed("nidus", "cbc3d-mixed")}), 8);
  EXPECT_TRUE(has(calls().at(0), "nidus-cbc3d-paper-beside.png --mixed-mesh")) << calls()[0];
  EXPECT_TRUE(has(calls().at(0), "nidus-cbc3d-mixed-r0.vtu --mixed-caption nidus  -  cbc3d-mixed"))
      << calls()[0];
  EXPECT_FALSE(has(calls().at(1), "--beside"));
}

TEST_F(Pictures, AFailedDrawingIsTriedWithTheNextRun) {
  script("case \"$*\" in *-r0.vtu*) exit 3;; esac");
  EXPECT_EQ(draw({meshed("nidus", "cgal", 0), meshed("nidus", "cgal", 1)}), 4);
  EXPECT_EQ(calls().size(), 2U);
}

TEST_F(Pictures, WithoutTheProgramNothingIsDrawn) {
  fs::remove(bin_dir_ / "cbc3d-picture");
  EXPECT_EQ(draw({meshed("nidus", "cgal")}), 0);
  EXPECT_TRUE(calls().empty());
  EXPECT_FALSE(fs::exists(folder_.path() / "figures"));
}

TEST_F(Pictures, WithoutAnXServerNothingIsDrawn) {
  ::setenv("PATH", "/nowhere", 1);
  EXPECT_EQ(draw({meshed("nidus", "cgal")}), 0);
}

TEST(PictureKinds, FileNamesHaveNeitherColonsNorSlashes) {
  EXPECT_EQ(picture_stem("a/b", "external:mine"), "a_b-external_mine");
  EXPECT_EQ(picture_kinds().size(), 5U);
}

}  // namespace
}  // namespace cbc3d::reports
