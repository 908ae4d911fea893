#include "mesher/mesh_formats/text_file.hpp"

#include <gtest/gtest.h>

#include "mesher/core/atomic_file.hpp"
#include "mesher/testing/temporary_folder.hpp"

namespace cbc3d {
namespace {

TEST(TextFile, WritesNumbersWithoutLoss) {
  const testing::TemporaryFolder folder("text");
  TextFile file(folder.file("t"));
  file.add("a ", 12, ' ', std::size_t{7}, '\n');
  file.add_point({0.1, -2, 1.0 / 3}, ", ");
  file.close();
  EXPECT_EQ(folder.content("t"), "a 12 7\n0.1, -2, 0.3333333333333333");
}

TEST(TextFile, WritesAsManyDigitsAsItIsTold) {
  const testing::TemporaryFolder folder("text");
  TextFile file(folder.file("t"), 12);
  file.add_point({0.1, -1.2345678901234567e-9, 1.0 / 3}, ",");
  file.close();
  EXPECT_EQ(folder.content("t"), "0.1,-1.23456789012e-09,0.333333333333");
}

TEST(TextFile, SaysThatItCannotWrite) {
  EXPECT_THROW(TextFile("/nonexistent/folder/t"), JobError);
  TextFile full("/dev/full");
  full.add("text");
  try {
    full.close();
    FAIL() << "a full disk was written to";
  } catch (const WriteError& error) {
    EXPECT_STREQ(error.what(),
                 "cannot write '/dev/full': the disk is full; free some space or choose another place");
  }
}

}  // namespace
}  // namespace cbc3d
