// Damaged and unusual files: each is read as its standard says or refused in one line, within its time.
#include <cmath>
#include <nlohmann/json.hpp>

#include "mesher/app/testing_command.hpp"
#include "mesher/core/image_io.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

using testing::run_command;

class Faults : public testing::CommandTest {
 protected:
  [[nodiscard]] static std::string fault(const std::string& name) {
    return std::string(CBC3D_FAULTS) + "/" + name;
  }
  /// What `cbc3d info --json` says.
  [[nodiscard]] static nlohmann::json info(const std::string& file, const std::string& options = "") {
    const testing::Outcome outcome = run_command("info " + file + " --json " + options);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
    return outcome.exit_code == 0 ? nlohmann::json::parse(outcome.text) : nlohmann::json();
  }
  /// Centre of mass of the labelled voxels, mm.
  [[nodiscard]] static Vec3 centroid(const std::string& file) {
    const LabelImage image = read_label_image(file);
    Vec3 sum;
    double count = 0;
    for (std::size_t v = 0; v < image.voxels.size(); ++v) {
      if (image.voxels[v] != 0) {
        const Index3 at = image.frame.index_of(v);
        sum += image.frame.to_physical(image.frame.local_centre(at[0], at[1], at[2]));
        ++count;
      }
    }
    return sum / count;
  }
};

TEST_F(Faults, DamagedImagesAreRefused) {
  const std::pair<const char*, const char*> files[] = {
      {"truncated-half.nii.gz", "break off"},
      {"truncated_inner.nii.gz", "but the file has"},
      {"truncated-half.mha", "break off"},
      {"corrupt_byte.nii.gz", "damaged"},
      {"inr-nan-origin.inr", "TX 'nan'"},
      {"inr-nan-spacing.inr", "VX 'nan'"},
      {"inr-xdim-frac.inr", "XDIM '8.9'"},
      {"inr-overflow.inr", "more voxels than can be counted"},
      {"nrrd-long-line.nrrd", "no field 'encoding'"},
      {"mhd-format-string.mhd", "'%s%s%n'"},
      {"mha-ndims-minus1.mha", "NDims -1"},
      {"mha-nonnumber.mha", "'nan'"},
      {"nii_srow_nan.nii", "sform has an entry that is no finite number"},
      {"slow20-16.nrrd", "times as long as thick"},
      {"slow28s-default.nrrd", "times as long as thick"},
      {"fraction_shown_as_1.nii.gz", "1.0000001"}};
  for (const auto& [name, words] : files) {
    expect_refusal("mesh " + fault(name) + " --out " + at("o.vtu"), words, "o.vtu");
    expect_refusal("clean " + fault(name) + " --out " + at("o.nrrd"), words, "o.nrrd");
  }
}

TEST_F(Faults, UnusualImagesAreReadByTheirStandards) {
  EXPECT_EQ(info(fault("slope0_inter5.nii.gz"))["labels"][0]["label"], 1);
  EXPECT_EQ(info(fault("nifti2.nii.gz"))["format"], "NIfTI-2");
  EXPECT_EQ(info(fault("bzip2.nrrd"))["labels"].size(), info(fault("nifti2.nii.gz"))["labels"].size());
  EXPECT_TRUE(info(fault("C_sform_shear2e-4.nii.gz"))["warnings"].empty());
  EXPECT_EQ(info(fault("fraction_shown_as_1.nii.gz"), "--round")["labels"][0]["label"], 1);
  const auto zero = info(fault("codes_zero.nii.gz"));
  ASSERT_EQ(zero["warnings"].size(), 1U);
  EXPECT_NE(zero["warnings"][0].get<std::string>().find("neither qform nor sform"), std::string::npos);
  const auto two = info(fault("sform_ne_qform.nii.gz"));
  ASSERT_EQ(two["warnings"].size(), 1U);
  EXPECT_NE(two["warnings"][0].get<std::string>().find("mm apart"), std::string::npos);
  EXPECT_NEAR(two["origin_mm"][0].get<double>(), 30, 1e-4);  // of the sform
  const Vec3 micron = centroid(fault("nifti_micron_origin.nii.gz"));
  EXPECT_LT((micron - Vec3{-0.989, 0.093, 0.702}).norm(), 0.03)
      << micron.x << ' ' << micron.y << ' ' << micron.z;
}

TEST_F(Faults, DamagedMeshesAreRefusedByEveryCommand) {
  write_label_image(testing::ball_image(12, 1, 4, 1), at("ball.nii.gz"));
  for (const char* name : {"tet_of_0.vtu", "hex_as_tet.vtu", "v51b.vtk", "conn_oob.vtu", "app8.vtu",
                           "lab_few.vtu", "nc_neg.vtu", "sz0.vtk", "sz3.vtk", "cntbig.vtk", "app12.vtu",
                           "vtu-hang.vtu", "tags_huge.msh", "lab_frac.vtu", "pts_nan.vtu"}) {
    expect_refusal("improve " + fault(name) + " --out " + at("o.vtu"), name, "o.vtu");
    expect_refusal("deform " + fault(name) + " " + at("ball.nii.gz") + " --out " + at("o.vtu"), name,
                   "o.vtu");
  }
}

TEST_F(Faults, AMeshInAMirroredFrameIsRefusedWithTheFrameThatFits) {
  for (const char* command : {"improve ", "deform "}) {
    expect_refusal(command + fault("foreign_mesh_ras.vtu") + " " + fault("foreign_mesh_ras_image.nii.gz") +
                       " --out " + at("o.vtu"),
                   "RAS coordinates", "o.vtu");
  }
}

TEST_F(Faults, WhatCannotBeWrittenIsKnownBefore) {
  LabelImage image = testing::ball_image(12, 1, 4, 1);
  image.labels = {0, -5};
  write_label_image(image, at("negative.nrrd"));
  expect_refusal("mesh " + at("negative.nrrd") + " --out " + at("o.msh"), "o.msh': Gmsh's physical groups",
                 "o.msh");
  expect_refusal("clean " + at("negative.nrrd") + " --out " + at("o.xyz"), "unknown image format", "o.xyz");
  EXPECT_EQ(run_command("mesh " + at("negative.nrrd") + " --preset paper --iterations 0 --quiet --out " +
                        at("o.vtu"))
                .exit_code,
            0);
  expect_refusal("improve " + at("o.vtu") + " --out " + at("p.msh"), "Gmsh's physical groups", "p.msh");
}

TEST_F(Faults, AGreyImageIsRefusedUnlessManyLabelsAreMeant) {
  LabelImage image;
  image.frame.size = {12, 12, 12};
  for (int label = 1; label < 200; ++label) {
    image.labels.push_back(label);
  }
  image.voxels.resize(image.frame.voxel_count());
  for (std::size_t v = 0; v < image.voxels.size(); ++v) {
    image.voxels.set(v, static_cast<MaterialId>(v * 7919 % 200));
  }
  write_label_image(image, at("grey.nrrd"));
  expect_refusal("mesh " + at("grey.nrrd") + " --out " + at("o.vtu"), "--many-labels takes it", "o.vtu");
  EXPECT_EQ(
      run_command("clean " + at("grey.nrrd") + " --many-labels --quiet --out " + at("o.nrrd")).exit_code, 0);
}

TEST_F(Faults, StiffnessesBeyondReasonAreRefused) {
  expect_refusal("mesh " + fault("slow-3-93.nrrd") + " --mixed --young-pa 1e150 --out " + at("o.vtu"),
                 "--young-pa 1e150", "o.vtu");
}

TEST_F(Faults, SlicesOf32BitsAreReadAsTheyAre) {
  ASSERT_EQ(run_command("tile " + fault("int32_slice.tif") + " --spacing 1,1,1 --quiet --out " + at("t.nrrd"))
                .exit_code,
            0);
  EXPECT_GT(info(at("t.nrrd"))["labels"].size(), 0U);
}

}  // namespace
}  // namespace cbc3d
