// Where the voxels of a NRRD file begin.
#include <gtest/gtest.h>

#include <string>

#include "mesher/core/nrrd_header.hpp"
#include "mesher/testing/temporary_folder.hpp"

namespace cbc3d {
namespace {

TEST(NrrdHeader, SaysWhereVoxelsBeginOrNothing) {
  const testing::TemporaryFolder folder("nrrd");
  const auto offset = [&](const std::string& text, std::size_t component_bytes) {
    folder.write("a.nrrd", text + "voxels");
    return nrrd_voxel_offset(folder.file("a.nrrd"), component_bytes, {"gzip", "gz"});
  };
  const std::string bytes = "NRRD0004\ntype: uchar\nencoding: gzip\n\n";
  EXPECT_EQ(offset(bytes, 1), bytes.size());
  EXPECT_EQ(offset("NRRD0004\n# a comment\nencoding: gz\n\n", 1), 35U);
  EXPECT_EQ(offset("NRRD0004\nencoding: raw\n\n", 1), 0U);  // another encoding
  EXPECT_EQ(offset("NRRD0004\nencoding: gzipped\n\n", 1), 0U);
  EXPECT_EQ(offset("NRRD0004\n\n", 1), 0U);  // none
  EXPECT_EQ(offset(bytes, 2), 0U);           // in no order of bytes
  EXPECT_EQ(offset("NRRD0004\nendian: big\nencoding: gzip\n\n", 2), 0U);
  EXPECT_GT(offset("NRRD0004\nendian: little\nencoding: gzip\n\n", 2), 0U);
  EXPECT_EQ(offset("NRRD0004\nencoding: gzip\ndata file: b.raw\n\n", 1), 0U);  // they are elsewhere
  EXPECT_EQ(offset("NRRD0004\nencoding: gzip\nbyte skip: 8\n\n", 1), 0U);
  EXPECT_EQ(offset("NIFTI\nencoding: gzip\n\n", 1), 0U);
  EXPECT_EQ(nrrd_voxel_offset(folder.file("absent.nrrd"), 1, {"gzip"}), 0U);
  folder.write("cut.nrrd", "NRRD0004\nencoding: gzip\n");  // the header has no end
  EXPECT_EQ(nrrd_voxel_offset(folder.file("cut.nrrd"), 1, {"gzip"}), 0U);
}

}  // namespace
}  // namespace cbc3d
