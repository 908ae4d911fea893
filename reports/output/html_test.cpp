#include "reports/output/html.hpp"

#include <gtest/gtest.h>

#include "mesher/core/atomic_file.hpp"
#include "mesher/testing/count_of.hpp"
#include "mesher/testing/temporary_folder.hpp"
#include "reports/output/output.hpp"
#include "reports/sweep/testing_sweep.hpp"
#include "reports/tables/tables.hpp"

namespace cbc3d::reports {
namespace {

using cbc3d::testing::count_of;
using cbc3d::testing::TemporaryFolder;

TEST(Html, HoldsEverythingAndAsksForNothing) {
  const TemporaryFolder folder;
  write_text_file(folder.path() / "sweep.json", "[]");
  std::filesystem::create_directories(folder.path() / "small");
  write_text_file(folder.path() / "small" / "box-cbc3d-cut.jpg", "no real picture");
  std::vector<Json> lines = sweep_lines();
  lines[3]["status"] = "crashed";
  lines[3]["reason"] = "<script>alert(\"x\")</script> & more";
  lines[0]["provenance"] = {{"git_commit", "0123abc"}, {"compiler", "GNU"}, {"seed", "1"}};
  const std::vector<JobResult> results = decode_lines(lines);
  const std::string html = to_html({"A \"title\"", results, build_tables({results, {}, folder.path()}),
                                    all_figures(folder.path(), results), folder.path() / "small"});
  EXPECT_EQ(count_of(html, "<script"), 2U) << "ours alone: that of a reason is escaped";
  EXPECT_EQ(count_of(html, "'sha256-"), 2U) << "and no other may run";
  EXPECT_NE(html.find("default-src 'none'"), std::string::npos);
  EXPECT_EQ(count_of(html, "http://") - count_of(html, "xmlns=\"http://"), 0U);
  EXPECT_EQ(count_of(html, "https://"), 0U);
  EXPECT_EQ(count_of(html, "<link"), 0U);
  EXPECT_EQ(count_of(html, "src=\"data:image/jpeg;base64,"), 1U);
  EXPECT_EQ(count_of(html, "src="), 1U);
  EXPECT_NE(html.find("&lt;script&gt;alert(&quot;x&quot;)"), std::string::npos);
  EXPECT_NE(html.find("width=device-width"), std::string::npos);
  EXPECT_NE(html.find("@media print"), std::string::npos);
  for (const char* tag :
       {"table", "section", "figure", "svg", "div", "tr", "h2", "ol", "dl", "thead", "tbody"}) {
    const std::string name = tag;
    EXPECT_EQ(count_of(html, "<" + name + " ") + count_of(html, "<" + name + ">"),
              count_of(html, "</" + name + ">"))
        << tag;
  }
  // Provenance comes last.
  EXPECT_GT(html.find("id=\"provenance\""), html.find("id=\"failed\""));
  EXPECT_GT(html.rfind("0123abc"), html.find("id=\"provenance\""));
}

}  // namespace
}  // namespace cbc3d::reports
