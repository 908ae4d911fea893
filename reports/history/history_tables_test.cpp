#include "reports/history/history_tables.hpp"

#include <gtest/gtest.h>

#include "mesher/testing/temporary_folder.hpp"
#include "reports/history/testing_history.hpp"

namespace cbc3d::reports {
namespace {

using cbc3d::testing::TemporaryFolder;
using metrics::metric_id;

History slower_store() {
  const TemporaryFolder folder;
  test::write_times(folder.path(), test::noisy_times(4, 20, 10, 1.3));
  return make_history(read_store(folder.path()));
}

TEST(HistoryTables, MarkTheFigureFromWhichOnItIsAnother) {
  const History history = slower_store();
  const Table table = job_table(history, 0, {metric_id("time_ratio")}, find_changes(history, {}), 15);
  ASSERT_EQ(table.rows.size(), 15U);
  EXPECT_EQ(table.rows[0].case_name, "c005");
  EXPECT_EQ(table.rows[0].figure, "2026-01-06");
  const std::string text = to_markdown(table);
  const std::size_t mark = text.find("worse");
  ASSERT_NE(mark, std::string::npos) << text;
  EXPECT_EQ(text.substr(text.rfind('\n', mark) + 1, 8).find("c010"), 2U) << text;
  EXPECT_EQ(text.find("worse", mark + 1), std::string::npos);
}

TEST(HistoryTables, SayWhatAChangeIs) {
  const History history = slower_store();
  const std::vector<Change> changes = find_changes(history, {});
  const std::string text = to_markdown(change_table(history, changes, "changes", "Changes"));
  for (const char* words : {"box, cbc3d, 1 thread", "CPU time over the reference work's", "worse",
                            "c009 (2026-01-10)", "c010 (2026-01-11)", "10, 10", "TestCPU, 2 cores"}) {
    EXPECT_NE(text.find(words), std::string::npos) << words << '\n' << text;
  }
}

TEST(HistoryTables, AChangeFromNothingHasNoPerCent) {
  Change change;
  change.metric = metric_id("topology.self_intersections");
  change.after = 3;
  EXPECT_EQ(change_text(change), "+3");
  change.metric = metric_id("time_ratio");
  change.before = 10;
  change.after = 10.8;
  EXPECT_EQ(change_text(change), "+8.0 %");
}

TEST(HistoryTables, AFailedJobHasItsReason) {
  const TemporaryFolder folder;
  Json line = test::history_line(1);
  add_to_store(folder.path(), decode_lines({line}), test::commit_at(0), "");
  line["status"] = "crashed";
  line["reason"] = "SIGSEGV";
  add_to_store(folder.path(), decode_lines({line}), test::commit_at(1), "");
  const History history = make_history(read_store(folder.path()));
  const std::vector<Change> changes = find_changes(history, {});
  EXPECT_NE(to_markdown(job_table(history, 0, shown_metrics(), changes, 9)).find("crashed: SIGSEGV"),
            std::string::npos);
  EXPECT_NE(to_markdown(change_table(history, changes, "c", "C")).find("not ok"), std::string::npos);
}

}  // namespace
}  // namespace cbc3d::reports
