#include "mesher/formats/file_list.hpp"

#include <gtest/gtest.h>

namespace cbc3d::formats {
namespace {

using Names = std::vector<std::string>;

TEST(FileList, PatternsHaveOneNumber) {
  EXPECT_EQ(names_of_pattern({"s%03d.raw", "1", "5", "2"}), (Names{"s001.raw", "s003.raw", "s005.raw"}));
  EXPECT_EQ(names_of_pattern({"s%d", "2", "1", "-1"}), (Names{"s2", "s1"}));
  EXPECT_TRUE(is_file_pattern({"s%03d.raw", "1", "5", "2"}));
  EXPECT_FALSE(is_file_pattern({"s.raw"}));
  for (const char* pattern : {"%s%s%n", "%s", "%", "%999999999999d", "%-3d", "%d%d", "none", "%*d"}) {
    EXPECT_THROW(names_of_pattern({pattern, "1", "8", "1"}), FormatError) << pattern;
  }
  EXPECT_THROW(names_of_pattern({"s%d", "1", "8", "0"}), FormatError);
  EXPECT_THROW(names_of_pattern({"s%d", "1", "x", "1"}), FormatError);
  EXPECT_THROW(names_of_pattern({"s%d", "1", "1000000000", "1"}), FormatError);
  EXPECT_THROW(names_of_pattern({"s%d", "8", "1", "1"}), FormatError);
}

TEST(FileList, FilesLieBesideTheHeader) {
  EXPECT_EQ(files_beside("/data/a.mhd", {"b.raw"})[0].path, "/data/b.raw");
  EXPECT_EQ(files_beside("/data/a.mhd", {"/else/b.raw"})[0].path, "/else/b.raw");
  EXPECT_THROW(files_beside("a.mhd", {" "}), FormatError);
}

}  // namespace
}  // namespace cbc3d::formats
