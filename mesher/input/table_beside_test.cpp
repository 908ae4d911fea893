#include "mesher/input/table_beside.hpp"

#include <gtest/gtest.h>

#include "mesher/testing/temporary_folder.hpp"

namespace cbc3d {
namespace {
namespace fs = std::filesystem;

class TableBeside : public ::testing::Test {
 protected:
  [[nodiscard]] std::string found(const std::string& image) const {
    const auto table = table_beside(folder_.file(image));
    return table ? fs::relative(*table, folder_.path()).string() : "";
  }
  testing::TemporaryFolder folder_{"beside"};
};

TEST_F(TableBeside, HasTheNameOfTheImage) {
  folder_.write("a.txt", "");
  folder_.write("b.label", "");
  EXPECT_EQ(found("a.nii.gz"), "a.txt");
  folder_.write("a.tsv", "");
  EXPECT_EQ(found("a.nii.gz"), "a.tsv") << "the first of the kinds";
  EXPECT_EQ(found("b.seg.nrrd"), "b.label");
  EXPECT_EQ(found("c.nii"), "");
}

TEST_F(TableBeside, OfBidsLiesInAFolderAbove) {
  fs::create_directories(folder_.file("data/sub-01/anat"));
  folder_.write("dseg.tsv", "");
  folder_.write("data/dataset_description.json", "{}");
  EXPECT_EQ(found("data/sub-01/anat/sub-01_dseg.nii.gz"), "") << "beyond the data set";
  folder_.write("data/dseg.tsv", "");
  EXPECT_EQ(found("data/sub-01/anat/sub-01_desc-aseg_dseg.nii.gz"), "data/dseg.tsv");
  folder_.write("data/desc-aseg_dseg.tsv", "");
  folder_.write("data/desc-other_dseg.tsv", "");
  EXPECT_EQ(found("data/sub-01/anat/sub-01_desc-aseg_dseg.nii.gz"), "data/desc-aseg_dseg.tsv");
  EXPECT_EQ(found("data/sub-01/anat/sub-01_T1w.nii.gz"), "") << "no segmentation";
  folder_.write("data/sub-01/anat/sub-01_desc-aseg_dseg.tsv", "");
  EXPECT_EQ(found("data/sub-01/anat/sub-01_desc-aseg_dseg.nii.gz"),
            "data/sub-01/anat/sub-01_desc-aseg_dseg.tsv");
}

}  // namespace
}  // namespace cbc3d
