#include "reports/tables/speed_table.hpp"

#include <gtest/gtest.h>

#include "reports/tables/testing_tables.hpp"

namespace cbc3d::reports {
namespace {

TEST(SpeedTable, RatiosAreOverTheReferencesColumns) {
  Json mixed = timed_line("box", "cbc3d-mixed", 100, 1);
  mixed["counts"]["hexes"] = 20;
  const Table table = table_of(
      speed_table, {timed_line("box", "cbc3d-paper", 1000, 2), timed_line("box", "cbc3d-paper", 1000, 1, 2),
                    timed_line("box", "cgal", 1100, 10), mixed});
  EXPECT_EQ(table.name, "speed");
  EXPECT_EQ(text_in(table, "box", "elements", 3), "120");
  EXPECT_EQ(text_in(table, "box", "elements per second", 0), "500");
  EXPECT_EQ(text_in(table, "box", "time with files (s)", 2), "11.00");
  EXPECT_EQ(text_in(table, "box", "elements over cbc3d-paper (1 thread)'s", 2), "1.10");
  EXPECT_EQ(text_in(table, "box", "time over cbc3d-paper (1 thread)'s", 0), "1.00");
  EXPECT_EQ(text_in(table, "box", "time over cbc3d-paper (1 thread)'s", 2), "5.00 (too few runs to tell)");
  EXPECT_EQ(text_in(table, "box", "time over cbc3d-paper (2 threads)'s", 2), "10.00 (too few runs to tell)");
  EXPECT_EQ(text_in(table, "box", "CPU time over cbc3d-paper (2 threads)'s", 2),
            "5.00 (too few runs to tell)");
  EXPECT_EQ(text_in(table, "box", "time over cgal's", 0), "no row time over cgal's");
  EXPECT_EQ(text_in(table, "box", "core-seconds (time x threads)", 1), "2.00");
  EXPECT_EQ(text_in(table, "box", "the paper's core-seconds over these", 1),
            "no row the paper's core-seconds over these");
}

TEST(SpeedTable, ThePapersCoreSecondsStandBesideOurs) {
  cases::Case subject;
  subject.name = "aneurysm";
  subject.paper = {{"cbc3d", {{"time_s", 68.24}, {"threads", 8}}}, {"cgal", {{"time_s", 12.33}}}};
  const Table table =
      table_of(speed_table,
               {timed_line("aneurysm", "cbc3d-paper", 1000, 2, 2), timed_line("aneurysm", "cgal", 1100, 10)},
               {subject});
  EXPECT_EQ(text_in(table, "aneurysm", "core-seconds (time x threads)", 0), "4.00 (paper: 545.92)");
  EXPECT_EQ(text_in(table, "aneurysm", "the paper's core-seconds over these", 0), "136.5");
  EXPECT_EQ(text_in(table, "aneurysm", "the paper's core-seconds over these", 1), "-");
  EXPECT_EQ(text_in(table, "aneurysm", "time (s)", 1), "10.00 (paper: 12.33)");
}

TEST(SpeedTable, AFailedJobHasNoRatioAndSaysWhy) {
  Json bad = timed_line("box", "cgal", 0, 1);
  bad["status"] = "timeout";
  bad["reason"] = "not done after 5 s";
  const Table table = table_of(speed_table, {timed_line("box", "cbc3d", 1000, 2), bad});
  EXPECT_EQ(text_in(table, "box", "time over cbc3d's", 1), "-");
  EXPECT_EQ(table.rows[0].cells[1].reason, "timeout: not done after 5 s");
}

/// Ten repeats about `seconds`, a per cent apart.
std::vector<Json> repeated(const std::string& mesher, double seconds) {
  std::vector<Json> lines;
  for (int repeat = 0; repeat < 10; ++repeat) {
    lines.push_back(timed_line("box", mesher, 100, seconds * (1 + 0.01 * repeat)));
    lines.back()["repeat"] = repeat;
  }
  return lines;
}

TEST(SpeedTable, SlowerAndFasterStandWhereTheRankTestSaysSo) {
  std::vector<Json> lines = repeated("cbc3d", 1);
  for (const auto& [mesher, seconds] : {std::pair("cgal", 2.0), {"tetgen", 1.001}, {"cleaver", 0.5}}) {
    for (const Json& line : repeated(mesher, seconds)) lines.push_back(line);
  }
  const Table table = table_of(speed_table, lines);
  const auto cell = [&](std::size_t column) { return text_in(table, "box", "time over cbc3d's", column); };
  EXPECT_EQ(cell(0), "1.00");
  EXPECT_EQ(cell(1).substr(0, 9), "2.00 (1.9") << cell(1);
  EXPECT_NE(cell(1).find("; slower, A 1.00)"), std::string::npos) << cell(1);
  EXPECT_NE(cell(2).find("; not told apart, A 0.5"), std::string::npos) << cell(2);
  EXPECT_NE(cell(3).find("; faster, A 0.00)"), std::string::npos) << cell(3);
  EXPECT_EQ(text_in(table, "box", "elements over cbc3d's", 1), "1.00");
  const std::string interval = text_in(table, "box", "time (s): 95 % interval of the median", 1);
  EXPECT_EQ(interval.substr(0, 3), "2.0") << interval;
}

}  // namespace
}  // namespace cbc3d::reports
