// Names of labels from the image to meshes, reports and warnings; choices of labels; coordinates.
#include <nlohmann/json.hpp>

#include "mesher/app/testing_command.hpp"
#include "mesher/core/image_io.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

using nlohmann::json;
using testing::bytes_of;
using testing::run_command;

constexpr int kSize = 30, kSegments = 7;

/// The segment of a voxel: seven boxes along x, and a label that is too small for the lattice.
int box_at(int i, int j, int k) {
  const bool inside = i >= 1 && i < kSize - 1 && j >= 2 && j < 12 && k >= 2 && k < 12;
  return inside ? 1 + (i - 1) * kSegments / (kSize - 2) : 0;
}

std::string notes_of_segment(int number, const std::string& name, int value, int layer) {
  const std::string key = "Segment" + std::to_string(number) + "_";
  return key + "ID:=" + key + "1\n" + key + "Name:=" + name + "\n" + key +
         "LabelValue:=" + std::to_string(value) + "\n" + key + "Layer:=" + std::to_string(layer) + "\n" +
         key + "Color:=0.5 0 1\n";
}

/// A file as 3D Slicer 5 writes it; `layers` values for every voxel.
template <typename ValuesAt>
std::string seg_nrrd(int layers, const std::string& notes, const ValuesAt& values_at) {
  std::string voxels;
  for (int k = 0; k < 14; ++k) {
    for (int j = 0; j < 14; ++j) {
      for (int i = 0; i < kSize; ++i) {
        for (const int value : values_at(i, j, k)) {
          voxels += static_cast<char>(value);
        }
      }
    }
  }
  const std::string sizes = std::to_string(kSize) + " 14 14\n";
  return "NRRD0004\n# Complete NRRD file format specification at:\ntype: unsigned char\ndimension: " +
         std::string(layers > 1 ? "4" : "3") + "\nspace: left-posterior-superior\nsizes: " +
         (layers > 1 ? std::to_string(layers) + " " + sizes : sizes) +
         "space directions: " + (layers > 1 ? "none " : "") +
         "(1,0,0) (0,1,0) (0,0,1)\nkinds: " + (layers > 1 ? "list " : "") +
         "domain domain domain\nencoding: raw\nspace origin: (5,6,7)\n" + notes + "\n" + voxels;
}

class Names : public testing::CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    std::string notes;
    for (int s = 0; s < kSegments; ++s) {
      notes += notes_of_segment(s, kNames[s], s + 1, 0);
    }
    write("seven.seg.nrrd",
          seg_nrrd(1, notes, [](int i, int j, int k) { return std::vector<int>{box_at(i, j, k)}; }));
    write_label_image(testing::ball_image(24, 1, 9, 4), at("ball.nii.gz"));
  }
  void write(const std::string& name, const std::string& bytes) const { temporary_.write(name, bytes); }
  [[nodiscard]] json report(const std::string& name) const { return json::parse(bytes_of(at(name))); }
  /// Expects success and gives what the command prints.
  static std::string run(const std::string& arguments) {
    const testing::Outcome outcome = run_command(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
    return outcome.text;
  }
  /// The statements of a mesh's file.
  [[nodiscard]] MeshFileOptions stated(const std::string& name) const {
    MeshFileOptions options;
    static_cast<void>(read_mesh(at(name), {}, nullptr, options));
    return options;
  }
  static constexpr const char* kNames[kSegments] = {"left lung", "right lung", "heart",       "aorta",
                                                    "trachea",   "liver",      "spleen, part"};
};

constexpr const char* kQuick = " --preset paper --iterations 0 --quiet ";

TEST_F(Names, OfSevenSegmentsAreInTheMeshTheReportAndInfo) {
  for (const char* const mesh : {"m.vtu", "m.vtk", "m.msh", "m.inp", "m.mesh"}) {
    run("mesh " + at("seven.seg.nrrd") + kQuick + "-o " + at(mesh) + " --report " + at("r.json"));
    const LabelNames names = stated(mesh).names;
    ASSERT_EQ(names.entries().size(), 7U) << mesh;
    for (int s = 0; s < kSegments; ++s) {
      EXPECT_EQ(names.find(s + 1)->name, kNames[s]) << mesh;
      EXPECT_EQ(names.find(s + 1)->colour, (std::array<std::uint8_t, 3>{128, 0, 255}));
    }
    EXPECT_EQ(report("r.json")["label_names"]["2"], "right lung");
    EXPECT_EQ(report("r.json")["materials"][1]["name"], "right lung");
    EXPECT_EQ(report("r.json")["coordinates"], "LPS");
  }
  EXPECT_NE(run("info " + at("seven.seg.nrrd")).find("  2 right lung: "), std::string::npos);
  EXPECT_EQ(json::parse(run("info --json " + at("seven.seg.nrrd")))["labels"][1]["name"], "right lung");
}

TEST_F(Names, AreGroupsAndPartsOfOtherFormats) {
  for (const char* const mesh : {"m.msh", "m.inp", "m.feb"}) {
    run("mesh " + at("seven.seg.nrrd") + kQuick + "-o " + at(mesh));
    EXPECT_NE(bytes_of(at(mesh)).find("right_lung"), std::string::npos) << mesh;
  }
  run("mesh " + at("seven.seg.nrrd") + kQuick + "-o " + at("m.vtu"));
  for (const char* const mesh : {"m.vtu", "m.msh", "m.inp"}) {
    run("surface " + at(mesh) + " --quiet -o " + at("s.obj"));
    EXPECT_NE(bytes_of(at("s.obj")).find("right_lung"), std::string::npos) << mesh;
  }
}

TEST_F(Names, AreInWarningsAndInWhatCleanSays) {
  std::string bytes =
      seg_nrrd(1, notes_of_segment(0, "heart", 1, 0) + notes_of_segment(1, "right lung", 5, 0),
               [](int i, int j, int k) {
                 const bool speck = i == 20 && j == 7 && k == 7;
                 return std::vector<int>{speck ? 5 : box_at(i, j, k) > 0 ? 1 : 0};
               });
  write("speck.seg.nrrd", bytes);
  const std::string text =
      run("mesh " + at("speck.seg.nrrd") + " --preset paper --iterations 0 --relabel-noise both -o " +
          at("m.vtu") + " --report " + at("r.json"));
  EXPECT_NE(text.find("right lung (5)"), std::string::npos) << text;
  const json warnings = report("r.json")["warnings"];
  bool named = false;
  for (const json& warning : warnings) {
    named = named || warning.get<std::string>().find("right lung (5)") != std::string::npos;
  }
  EXPECT_TRUE(named) << warnings;
  EXPECT_NE(run("clean " + at("speck.seg.nrrd") + " --relabel-noise both -o " + at("c.nrrd"))
                .find("right lung (5): 1 -> 0 voxels"),
            std::string::npos);
}

TEST_F(Names, OverlappingLayersFollowTheRule) {
  // The tumour lies within the lung and over its border; the later segment of the file has the voxel.
  const auto values = [](int i, int j, int k) {
    const int box = box_at(i, j, k);
    return std::vector<int>{box > 0 ? 1 : 0, i >= 10 && i < 20 && box > 0 ? 1 : 0};
  };
  write("two.seg.nrrd",
        seg_nrrd(2, notes_of_segment(0, "lung", 1, 0) + notes_of_segment(1, "tumour", 1, 1), values));
  const std::string text =
      run("mesh " + at("two.seg.nrrd") + " --preset paper --iterations 0 -o " + at("m.vtu"));
  EXPECT_NE(
      text.find("1000 voxels lie in several segments (tumour (2) over lung (1)); each has the one that comes "
                "last in the file, --layer N takes one layer alone"),
      std::string::npos)
      << text;
  EXPECT_NE(text.find("same values for different segments"), std::string::npos);
  EXPECT_EQ(labels_of(read_mesh(at("m.vtu"))), (std::vector<Label>{1, 2}));
  EXPECT_EQ(stated("m.vtu").names.text(2), "tumour (2)");
  run("clean " + at("two.seg.nrrd") + " --layer 1 --quiet -o " + at("tumour.nrrd"));
  const LabelImage tumour = read_label_image(at("tumour.nrrd"));
  EXPECT_EQ(tumour.voxels_per_material()[1], 1000U);
  expect_refusal("mesh " + at("two.seg.nrrd") + " --layer 2 -o " + at("n.vtu"), "no layer 2", "n.vtu");
}

TEST_F(Names, ComeFromTablesAndSurviveImprovement) {
  write("ball.label", "    1   255    0    0        1  1  1    \"shell\"\n    2  0 255 0 1 1 1 \"core\"\n");
  run("mesh " + at("ball.nii.gz") + kQuick + "-o " + at("m.vtu"));
  EXPECT_EQ(stated("m.vtu").names.text(1), "shell (1)");
  run("improve " + at("m.vtu") + " --quiet -o " + at("i.vtk") + " --report " + at("i.json"));
  EXPECT_EQ(stated("i.vtk").names.text(2), "core (2)") << "from the mesh";
  EXPECT_EQ(report("i.json")["labels"][0]["name"], "shell");
  for (const char* const mesh : {"i.msh", "i.inp", "i.mesh"}) {
    run("improve " + at("i.vtk") + " --coordinates ras --quiet -o " + at(mesh));
    EXPECT_EQ(stated(mesh).names.text(2), "core (2)") << mesh;
    EXPECT_EQ(stated(mesh).names.find(1)->colour, (std::array<std::uint8_t, 3>{255, 0, 0})) << mesh;
    EXPECT_EQ(stated(mesh).coordinates, "RAS") << mesh;
    run("improve " + at(mesh) + " --quiet -o " + at("again.vtu") + " --report " + at("i.json"));
    EXPECT_EQ(report("i.json")["labels"][1]["name"], "core") << mesh;
  }
  run("deform " + at("m.vtu") + " " + at("ball.nii.gz") + " --iterations 1 --quiet -o " + at("d.vtu"));
  EXPECT_EQ(stated("d.vtu").names.text(2), "core (2)");
  write("other.json", R"({"1": "rind"})");
  run("mesh " + at("ball.nii.gz") + kQuick + "--names " + at("other.json") + " -o " + at("m.vtu"));
  EXPECT_EQ(stated("m.vtu").names.text(1), "rind (1)");
  EXPECT_EQ(stated("m.vtu").names.entries().size(), 1U) << "the table alone";
  write("bad.csv", "1,a\nx,b\n");
  expect_refusal("mesh " + at("ball.nii.gz") + " --names " + at("bad.csv") + " -o " + at("n.vtu"),
                 "bad.csv': line 2 'x,b' has no whole number where the label stands", "n.vtu");
}

TEST_F(Names, WithoutThemTheBytesAreThoseWithoutStatements) {
  run("mesh " + at("ball.nii.gz") + kQuick + "-o " + at("m.vtu"));
  EXPECT_EQ(bytes_of(at("m.vtu")).find("FieldData"), std::string::npos);
}

TEST_F(Names, LabelsAreChosen) {
  run("mesh " + at("seven.seg.nrrd") + kQuick + "--labels 2,5,7 -o " + at("m.vtu"));
  EXPECT_EQ(labels_of(read_mesh(at("m.vtu"))), (std::vector<Label>{2, 5, 7}));
  EXPECT_EQ(stated("m.vtu").names.entries().size(), 3U);
  run("mesh " + at("seven.seg.nrrd") + kQuick + "--labels 2 --keep-rest -o " + at("m.vtu"));
  EXPECT_EQ(labels_of(read_mesh(at("m.vtu"))), (std::vector<Label>{2, 8}));
  EXPECT_EQ(stated("m.vtu").names.text(8), "rest (8)");
  const json info = json::parse(run("info --json --background 0,1,2 " + at("seven.seg.nrrd")));
  EXPECT_EQ(info["labels"].size(), 5U);
  expect_refusal("mesh " + at("seven.seg.nrrd") + " --labels 2,9 -o " + at("n.vtu"),
                 "has no label 9, which --labels names; it has 1, 2, 3, 4, 5, 6, 7", "n.vtu");
  expect_refusal("clean " + at("seven.seg.nrrd") + " --background 9 -o " + at("n.nrrd"), "has no label 9",
                 "n.nrrd");
}

TEST_F(Names, AVolumeIsChosenAndProbabilitiesAreRefused) {
  write("four.nrrd", "NRRD0004\ntype: uchar\ndimension: 4\nsizes: 2 2 2 2\nencoding: raw\n\n" +
                         std::string("\1\1\1\1\1\1\1\1\2\2\2\2\2\2\2\2", 16));
  EXPECT_EQ(json::parse(run("info --json --volume 1 " + at("four.nrrd")))["labels"][0]["label"], 2);
  expect_refusal("info " + at("four.nrrd"), "--volume N takes one of them, from 0 to 1", "n.vtu");
  const float map[8] = {0, 0.5F, 1, 0, 0.25F, 0, 1, 0};
  write("p.nrrd", "NRRD0004\ntype: float\ndimension: 3\nsizes: 2 2 2\nencoding: raw\nendian: little\n\n" +
                      std::string(reinterpret_cast<const char*>(map), sizeof map));
  expect_refusal("mesh " + at("p.nrrd") + " -o " + at("n.vtu"), "a probability map; threshold it", "n.vtu");
}

TEST_F(Names, CoordinatesAreStatedAndTakenBack) {
  run("mesh " + at("seven.seg.nrrd") + kQuick + "-o " + at("lps.vtu"));
  const Mesh lps = read_mesh(at("lps.vtu"));
  for (const std::string coordinates : {"ras", "voxel"}) {
    run("mesh " + at("seven.seg.nrrd") + kQuick + "--coordinates " + coordinates + " -o " + at("o.vtu") +
        " --report " + at("r.json"));
    const LabelImage image = read_label_image(at("seven.seg.nrrd"));
    MeshFileOptions said;
    const Mesh back = read_mesh(at("o.vtu"), {}, &image.frame, said);
    EXPECT_EQ(said.coordinates, coordinates == "ras" ? "RAS" : "voxel");
    EXPECT_EQ(report("r.json")["coordinates"], said.coordinates);
    ASSERT_EQ(back.points.size(), lps.points.size());
    double largest = 0;
    for (std::size_t v = 0; v < lps.points.size(); ++v) {
      largest = std::max(largest, (back.points[v] - lps.points[v]).norm());
    }
    EXPECT_LT(largest, 1e-9) << coordinates;
    run("improve " + at("o.vtu") + " " + at("seven.seg.nrrd") + " --quiet -o " + at("i.vtu"));
    run("deform " + at("o.vtu") + " " + at("seven.seg.nrrd") + " --iterations 1 --coordinates " +
        coordinates + " --quiet -o " + at("d.vtk"));
  }
  expect_refusal("improve " + at("lps.vtu") + " --coordinates voxel -o " + at("n.vtu"), "needs the image",
                 "n.vtu");
  expect_refusal("improve " + at("o.vtu") + " -o " + at("n.vtu"), "states its coordinates", "n.vtu");
  expect_refusal("mesh " + at("ball.nii.gz") + " --coordinates mni -o " + at("n.vtu"), "--coordinates",
                 "n.vtu");
}

TEST_F(Names, AFileInPlaceOfASubcommandIsAnswered) {
  expect_refusal(
      at("seven.seg.nrrd"),
      "is a file, not a subcommand; to mesh it: cbc3d mesh " + at("seven.seg.nrrd") + " --out seven.vtu",
      "seven.vtu");
}

}  // namespace
}  // namespace cbc3d
