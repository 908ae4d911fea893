// Files: what is written is read back, in place; what is bad is refused in one line.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "mesher/core/error.hpp"
#include "mesher/core/image_io.hpp"
#include "mesher/core/mesh_io.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {
namespace fs = std::filesystem;

class Files : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("cbc3d-io-" + std::to_string(::getpid()));
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  [[nodiscard]] fs::path file(const std::string& name) const { return folder_ / name; }
  void write(const std::string& name, const std::string& bytes) const {
    std::ofstream(file(name), std::ios::binary) << bytes;
  }
  [[nodiscard]] std::string why_not_read(const std::string& name) const {
    try {
      read_label_image(file(name));
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << "names the file";
      return error.what();
    }
    return "";
  }
  fs::path folder_;
};

LabelImage sample(const std::vector<Label>& labels) {
  LabelImage image = testing::noise_image(9, 0.5, 3);
  image.labels = labels;
  return image;
}

TEST_F(Files, ImagesKeepLabelsAndFrame) {
  for (const char* name : {"a.nii", "a.nii.gz", "a.nrrd", "a.mha"}) {
    for (const bool flipped : {false, true}) {
      LabelImage image = sample({0, 7, 300});
      image.frame.spacing_mm = {0.5, 0.75, 2};
      image.frame = testing::oblique(image.frame, flipped);
      write_label_image(image, file(name));
      const LabelImage back = read_label_image(file(name));
      EXPECT_EQ(back.labels, image.labels) << name;
      EXPECT_EQ(back.voxels, image.voxels) << name;
      for (const Index3& at : {Index3{0, 0, 0}, Index3{8, 0, 3}, Index3{2, 7, 8}}) {
        const Vec3 wanted = image.frame.to_physical(image.frame.local_centre(at[0], at[1], at[2]));
        const Vec3 got = back.frame.to_physical(back.frame.local_centre(at[0], at[1], at[2]));
        EXPECT_LT((wanted - got).norm(), 1e-4) << name << " flipped " << flipped;  // NIfTI stores floats
      }
    }
  }
}

TEST_F(Files, NegativeAndLargeLabelsSurvive) {
  write_label_image(sample({0, -5, 70000}), file("n.nrrd"));
  EXPECT_EQ(read_label_image(file("n.nrrd")).labels, (std::vector<Label>{0, -5, 70000}));
}

TEST_F(Files, InrimageIsReadInEveryByteOrder) {
  const auto header = [](const std::string& type) {
    std::string text = "#INRIMAGE-4#{\nXDIM=2\nYDIM=2\nZDIM=1\nVDIM=1\n" + type + "VX=0.5\nVY=0.5\nVZ=2\n";
    text.resize(252, '\n');
    return text + "##}\n";
  };
  write("a.inr",
        header("TYPE=unsigned fixed\nPIXSIZE=8 bits\nCPU=decm\n") + std::string("\0\x01\x02\x02", 4));
  write("b.inr",
        header("TYPE=unsigned fixed\nPIXSIZE=16 bits\nCPU=sun\n") + std::string("\0\0\0\x01\0\x02\0\x02", 8));
  for (const char* name : {"a.inr", "b.inr"}) {
    const LabelImage image = read_label_image(file(name));
    EXPECT_EQ(image.labels, (std::vector<Label>{0, 1, 2})) << name;
    ASSERT_EQ(image.voxels.size(), 4U) << name;
    for (const MaterialId expected : {0, 1, 2}) {
      EXPECT_EQ(image.voxels[expected], expected) << name;
    }
    EXPECT_EQ(image.voxels[3], 2) << name;
    EXPECT_EQ(image.frame.spacing_mm, (Vec3{0.5, 0.5, 2})) << name;
  }
  write("c.inr", header("TYPE=unsigned fixed\nPIXSIZE=16 bits\nCPU=sun\n") + "abc");
  EXPECT_NE(why_not_read("c.inr").find("truncated"), std::string::npos);
}

std::string nrrd(const std::string& fields, const std::string& data) {
  return "NRRD0004\nendian: little\nencoding: raw\n" + fields + "\n" + data;
}

TEST_F(Files, BadImagesAreRefusedWithOneLine) {
  EXPECT_NE(why_not_read("absent.nii").find("does not exist"), std::string::npos);
  write("text.nii", "hello");
  EXPECT_NE(why_not_read("text.nii"), "");
  write("flat.nrrd", nrrd("type: uchar\ndimension: 2\nsizes: 2 2\n", "abcd"));
  EXPECT_NE(why_not_read("flat.nrrd").find("2-dimensional"), std::string::npos);
  write("colour.nrrd",
        nrrd("type: uchar\ndimension: 4\nsizes: 3 2 2 2\nkinds: RGB-color domain domain domain\n",
             std::string(24, 'a')));
  EXPECT_NE(why_not_read("colour.nrrd").find("3 components"), std::string::npos);
  write("empty.nrrd", nrrd("type: uchar\ndimension: 3\nsizes: 2 2 2\n", std::string(8, '\0')));
  EXPECT_NE(why_not_read("empty.nrrd").find("background"), std::string::npos);
  const float half[8] = {0, 1, 2, 0.5F, 0, 0, 1, 1};
  write("half.nrrd", nrrd("type: float\ndimension: 3\nsizes: 2 2 2\n",
                          std::string(reinterpret_cast<const char*>(half), sizeof(half))));
  EXPECT_NE(why_not_read("half.nrrd").find("0.5"), std::string::npos);
  write("short.nrrd", nrrd("type: uchar\ndimension: 3\nsizes: 20 20 20\n", "abc"));
  EXPECT_NE(why_not_read("short.nrrd"), "");
}

TEST_F(Files, FloatImagesWithWholeLabelsAreRead) {
  const float whole[8] = {0, 1, 2, 2, 0, 0, 1, 1};
  write("whole.nrrd", nrrd("type: float\ndimension: 3\nsizes: 2 2 2\n",
                           std::string(reinterpret_cast<const char*>(whole), sizeof(whole))));
  EXPECT_EQ(read_label_image(file("whole.nrrd")).labels, (std::vector<Label>{0, 1, 2}));
}

TEST_F(Files, FourthDimensionOfOneIsNoDimension) {
  write("four.nrrd", nrrd("type: uchar\ndimension: 4\nsizes: 2 2 2 1\n", std::string("\0\1\2\0\1\2\0\1", 8)));
  EXPECT_EQ(read_label_image(file("four.nrrd")).frame.size, (Index3{2, 2, 2}));
  write("five.nrrd", nrrd("type: uchar\ndimension: 4\nsizes: 2 2 1 2\n", std::string("\0\1\2\0\1\2\0\1", 8)));
  EXPECT_NE(why_not_read("five.nrrd").find("2 volumes"), std::string::npos);
}

Mesh one_of_each() {
  Mesh mesh;
  for (int z = 0; z <= 2; ++z) {
    for (int y = 0; y <= 1; ++y) {
      for (int x = 0; x <= 1; ++x) {
        mesh.points.push_back({1.5 * x, 1.0 * y, 0.1 + z});
      }
    }
  }
  mesh.points.push_back({0.7, 0.5, -1});
  mesh.tets.add({0, 1, 3, 5}, 3);
  mesh.pyramids.add({0, 2, 3, 1, 12}, 4);
  mesh.wedges.add({0, 1, 2, 4, 5, 6}, 5);
  mesh.hexes.add({4, 5, 7, 6, 8, 9, 11, 10}, 6);
  return mesh;
}

TEST_F(Files, MeshesKeepNodesOrderAndLabels) {
  const Mesh mesh = one_of_each();
  for (const char* name : {"m.vtu", "m.vtk", "m.msh"}) {
    write_mesh(mesh, file(name));
    const Mesh back = read_mesh(file(name));
    EXPECT_EQ(back.points, mesh.points) << name;
    EXPECT_EQ(back.tets.nodes, mesh.tets.nodes) << name;
    EXPECT_EQ(back.pyramids.nodes, mesh.pyramids.nodes) << name;
    EXPECT_EQ(back.wedges.nodes, mesh.wedges.nodes) << name;
    EXPECT_EQ(back.hexes.nodes, mesh.hexes.nodes) << name;
    EXPECT_EQ(labels_of(back), (std::vector<Label>{3, 4, 5, 6})) << name;
  }
}

TEST_F(Files, LegacyVtkIsWrittenAsVersion42) {
  write_mesh(one_of_each(), file("m.vtk"));
  std::string first;
  std::ifstream in(file("m.vtk"));
  std::getline(in, first);
  EXPECT_NE(first.find("4.2"), std::string::npos) << first;
}

TEST_F(Files, BadMeshPathsAreRefusedAndLeaveNothing) {
  EXPECT_THROW(write_mesh(one_of_each(), file("m.stl")), InputError);
  EXPECT_THROW(write_mesh(one_of_each(), folder_ / "no" / "m.vtu"), InputError);
  EXPECT_THROW(read_mesh(file("absent.vtu")), InputError);
  write("broken.vtu", "<VTKFile");
  EXPECT_THROW(read_mesh(file("broken.vtu")), InputError);
  write("broken.msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n");
  EXPECT_THROW(read_mesh(file("broken.msh")), InputError);
  std::size_t files = 0;
  for ([[maybe_unused]] const auto& entry : fs::directory_iterator(folder_)) ++files;
  EXPECT_EQ(files, 2U);  // the two broken ones
}

}  // namespace
}  // namespace cbc3d
