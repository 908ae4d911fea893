#include "reports/history/history_page.hpp"

#include <gtest/gtest.h>

#include "mesher/testing/count_of.hpp"
#include "mesher/testing/temporary_folder.hpp"
#include "reports/history/testing_history.hpp"

namespace cbc3d::reports {
namespace {

using cbc3d::testing::count_of;
using cbc3d::testing::TemporaryFolder;

constexpr const char* kHostile = "<script>alert(\"x\")</script>";

/// Slower by a third from the tenth commit on, with hostile names wherever a name can come from outside.
std::string page() {
  const TemporaryFolder folder;
  const std::vector<double> times = test::noisy_times(4, 20, 10, 1.3);
  for (std::size_t n = 0; n < times.size(); ++n) {
    Json line = test::history_line(times[n]);
    line["mesher"] = std::string("external:") + kHostile;
    line["provenance"]["mesher_version"] = (n < 10 ? "1.0 " : "1.1 ") + std::string(kHostile);
    add_to_store(folder.path(), decode_lines({line}), test::commit_at(static_cast<int>(n)),
                 std::string("machine ") + kHostile);
  }
  const History history = make_history(read_store(folder.path()));
  return history_page(std::string("A history ") + kHostile, history, find_changes(history, {}),
                      default_metrics());
}

TEST(HistoryPage, PlotsWhatVariesAndMarksTheChange) {
  const std::string html = page();
  EXPECT_EQ(count_of(html, "<svg"), 1U) << "all but the time ratio is constant";
  EXPECT_EQ(count_of(html, "stroke-dasharray"), 1U) << "one change";
  EXPECT_NE(html.find(", after c009, in c010, version 1.0"), std::string::npos);
  EXPECT_NE(html.find("The same at every commit: "), std::string::npos);
  EXPECT_NE(html.find("20 commits, 1 jobs, 1 changes for the worse."), std::string::npos);
  EXPECT_NE(html.find("2026-01-20T00:00:00Z"), std::string::npos) << "the commits are listed";
}

TEST(HistoryPage, EscapesNamesAndAsksForNothing) {
  const std::string html = page();
  EXPECT_EQ(count_of(html, "<script"), 2U) << "those of the page alone";
  EXPECT_GE(count_of(html, "&lt;script&gt;alert(&quot;x&quot;)"), 5U);
  EXPECT_EQ(count_of(html, "http://"), count_of(html, "xmlns=\"http://"));
  EXPECT_EQ(count_of(html, "https://") + count_of(html, "src=") + count_of(html, "<link"), 0U);
  for (const char* tag : {"table", "section", "figure", "svg", "div", "g", "h2", "h3", "p"}) {
    const std::string name = tag;
    EXPECT_EQ(count_of(html, "<" + name + " ") + count_of(html, "<" + name + ">"),
              count_of(html, "</" + name + ">"))
        << tag;
  }
}

}  // namespace
}  // namespace cbc3d::reports
