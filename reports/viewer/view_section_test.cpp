#include "reports/viewer/view_section.hpp"

#include <gtest/gtest.h>

#include "mesher/core/testing_mesh.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"
#include "mesher/testing/count_of.hpp"
#include "mesher/testing/temporary_folder.hpp"
#include "reports/viewer/scripts.hpp"

namespace cbc3d::reports {
namespace {

using cbc3d::testing::count_of;
using cbc3d::testing::TemporaryFolder;

Json line_of(const char* mesher, int repeat, const char* mesh_file) {
  Json line = empty_result();
  line["case"] = "box";
  line["mesher"] = mesher;
  line["threads"] = 1;
  line["repeat"] = repeat;
  line["status"] = "ok";
  line["mesh_file"] = mesh_file;
  line["image"] = {{"size", {2, 2, 2}},
                   {"spacing_mm", {1, 1, 1}},
                   {"labels", {3, 4, 5, 6}},
                   {"label_names", {{"3", "</script><script>alert(1)</script>"}}}};
  return line;
}

TEST(ViewSection, HoldsEveryMeshOnceAndEscapesNames) {
  const TemporaryFolder folder;
  write_mesh(cbc3d::testing::one_of_each(), folder.path() / "mesh.vtu");
  const std::vector<JobResult> jobs = decode_lines(
      {line_of("one", 0, "mesh.vtu"), line_of("one", 1, "mesh.vtu"), line_of("two", 0, "<none>.vtu")});
  const std::string html = view_section(folder.path(), jobs, {});
  if (view_script().empty()) {
    EXPECT_NE(html.find("Not in this report"), std::string::npos);
    GTEST_SKIP() << "built without the packages of the viewer";
  }
  EXPECT_EQ(count_of(html, "id=\"view-mesh-"), 1U) << html;
  EXPECT_EQ(count_of(html, "<script"), 2U) << "headers and the mesh; none of a name";
  EXPECT_NE(html.find("\\u003c/script>\\u003cscript>alert(1)"), std::string::npos);
  EXPECT_NE(html.find("12 tets, all shown"), std::string::npos);
  EXPECT_NE(html.find("Not shown:"), std::string::npos);
  EXPECT_NE(html.find("box-two-t1-r0"), std::string::npos);
  EXPECT_EQ(html.find("<none>"), std::string::npos);
}

TEST(ViewSection, MeshesOfTheSameBytesShareTheirData) {
  if (view_script().empty()) {
    GTEST_SKIP() << "built without the packages of the viewer";
  }
  const TemporaryFolder folder;
  write_mesh(cbc3d::testing::one_of_each(), folder.path() / "mesh.vtu");
  std::vector<Json> lines{line_of("one", 0, "mesh.vtu"), line_of("two", 0, "mesh.vtu")};
  for (Json& line : lines) {
    line["mesh_sha256"] = std::string(64, 'a');
  }
  const std::string html = view_section(folder.path(), decode_lines(lines), {});
  EXPECT_EQ(count_of(html, "id=\"view-mesh-"), 1U) << html;
  EXPECT_EQ(count_of(html, "\"data\":0"), 2U);
}

TEST(ViewSection, WithoutRoomThereIsNone) {
  EXPECT_EQ(view_section("/nowhere", {}, {.megabytes = 0}), "");
}

}  // namespace
}  // namespace cbc3d::reports
