#include "mesher/formats/nrrd_frame.hpp"

#include "mesher/formats/testing_headers.hpp"

namespace cbc3d::formats {
namespace {

class NrrdFrame : public testing::Headers {};
using testing::nrrd;

const std::string kDirections = "space directions: (0,2,0) (1,0,0) (0,0,3)\nspace origin: (1,2,3)\n";

TEST_F(NrrdFrame, SpacesInEverySpelling) {
  const struct {
    const char* name;
    double x, y;
  } spaces[] = {{"left-posterior-superior", 1, 1},   {"LPS", 1, 1},   {"lps", 1, 1},
                {"right-anterior-superior", -1, -1}, {"RAS", -1, -1}, {"Right-Anterior-Superior", -1, -1},
                {"left-anterior-superior", 1, -1},   {"LAS", 1, -1}};
  for (const auto& [name, x, y] : spaces) {
    const ImageHeader header = header_of("a.nrrd", nrrd("space: " + std::string(name) + "\n" + kDirections));
    EXPECT_EQ(header.origin_mm, (Triple{x, 2 * y, 3})) << name;
    EXPECT_EQ(header.axes[0], (Triple{0, y, 0})) << name;
    EXPECT_EQ(header.axes[1], (Triple{x, 0, 0})) << name;
    EXPECT_EQ(header.spacing_mm, (Triple{2, 1, 3})) << name;
    EXPECT_TRUE(header.warnings.empty()) << name;
  }
  EXPECT_EQ(header_of("b.nrrd", nrrd("space: 3D-right-handed\n" + kDirections)).warnings.size(), 1U);
  expect_refusal("c.nrrd", nrrd("space: left-up-superior\n" + kDirections),
                 "its space is 'left-up-superior'");
}

TEST_F(NrrdFrame, UnitsScaleEverything) {
  const ImageHeader header =
      header_of("a.nrrd", nrrd("space: LPS\nspace units: \"um\" \"um\" \"micrometers\"\n" + kDirections));
  EXPECT_DOUBLE_EQ(header.spacing_mm[0], 0.002);
  EXPECT_DOUBLE_EQ(header.origin_mm[2], 0.003);
  const ImageHeader plain = header_of("b.nrrd", nrrd("spacings: 1 2 3\nunits: \"cm\" \"cm\" \"cm\"\n"));
  EXPECT_EQ(plain.spacing_mm, (Triple{10, 20, 30}));
  EXPECT_EQ(header_of("c.nrrd", nrrd("space: LPS\nspace units: \"mm\" \"mm\" \"ells\"\n" + kDirections))
                .warnings.size(),
            1U);
}

TEST_F(NrrdFrame, SpacingsAndMinsOfCellsAndNodes) {
  const ImageHeader cells = header_of("a.nrrd", nrrd("spacings: 1 2 4\naxis mins: 10 20 30\n"));
  EXPECT_EQ(cells.origin_mm, (Triple{10.5, 21, 32}));
  const ImageHeader nodes =
      header_of("b.nrrd", nrrd("spacings: 1 2 4\naxis mins: 10 20 30\ncenterings: node node node\n"));
  EXPECT_EQ(nodes.origin_mm, (Triple{10, 20, 30}));
  EXPECT_EQ(header_of("c.nrrd", nrrd("axis mins: 0 0 0\naxis maxs: 4 3 8\n")).spacing_mm, (Triple{2, 1, 2}));
}

TEST_F(NrrdFrame, AxesOutsideSpace) {
  const std::string voxels = nrrd("").substr(nrrd("").size() - 24);
  const auto four = [&](const std::string& sizes, const std::string& lines) {
    return "NRRD0004\ntype: uchar\ndimension: 4\nsizes: " + sizes + "\nencoding: raw\n" + lines + "\n" +
           voxels;
  };
  const std::string frame =
      "space: LPS\nspace directions: none (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\n";
  EXPECT_EQ(header_of("a.nrrd", four("1 2 3 4", frame)).size, (std::array<std::size_t, 3>{2, 3, 4}));
  const ImageHeader layers =
      header_of("b.nrrd", four("2 2 2 3", frame + "kinds: list domain domain domain\n"));
  EXPECT_EQ(layers.size, (std::array<std::size_t, 3>{2, 2, 3}));
  EXPECT_EQ(layers.volumes, 2U);
  EXPECT_TRUE(layers.volumes_interleaved);
  expect_refusal("c.nrrd", four("3 2 2 2", frame + "kinds: RGB-color domain domain domain\n"),
                 "3 components");
  const ImageHeader volumes = header_of("d.nrrd", four("2 2 2 3", ""));
  EXPECT_EQ(volumes.volumes, 3U);
  EXPECT_FALSE(volumes.volumes_interleaved);
  expect_refusal("e.nrrd", four("2 2 2 3", "kinds: domain list domain domain\n"), "between others");
}

TEST_F(NrrdFrame, WhatIsNoFrameIsRefused) {
  expect_refusal("a.nrrd", nrrd("spacings: nan 1 1\n"), "spacing");
  expect_refusal("b.nrrd", nrrd("spacings: inf 1 1\n"), "spacing");
  expect_refusal("c.nrrd", nrrd("spacings: 0 1 1\n"), "spacing");
  expect_refusal("d.nrrd", nrrd("spacings: 1 1\n"), "not 3 numbers");
  const std::string space = "space: LPS\nspace origin: (0,0,0)\nspace directions: ";
  expect_refusal("e.nrrd", nrrd(space + "(nan,0,0) (0,1,0) (0,0,1)\n"), "no direction");
  expect_refusal("f.nrrd", nrrd(space + "(0,0,0) (0,1,0) (0,0,1)\n"), "no direction");
  expect_refusal("g.nrrd", nrrd(space + "(1e300,0,0) (0,1,0) (0,0,1)\n"), "no direction");
  expect_refusal("h.nrrd", nrrd(space + "(1,0) (0,1,0) (0,0,1)\n"), "has 2 numbers");
  expect_refusal("i.nrrd", nrrd(space + "(1,0,0) (0,1,0)\n"), "are 2, but it has 3 axes");
  expect_refusal("j.nrrd", nrrd(space + "(1,0,0) (0,1,0) none\n"), "only 2 of its axes");
  expect_refusal("k.nrrd",
                 nrrd("space: LPS\nspace directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (nan,0,0)\n"),
                 "origin");
  expect_refusal("l.nrrd", nrrd("space directions: (1,0,0) (0,1,0) (0,0,1)\n"), "no 'space'");
}

}  // namespace
}  // namespace cbc3d::formats
