#include "reports/tables/parallel_table.hpp"

#include <gtest/gtest.h>

#include "reports/tables/testing_tables.hpp"

namespace cbc3d::reports {
namespace {

std::vector<SweepPoint> points(std::vector<Json> lines) {
  return sweep_points(decode_lines(std::move(lines)));
}

/// A job of three stages at a thread count: one that is halved by two threads, one with a serial half, a
/// small serial one.
Json staged(const std::string& mesher, int threads) {
  Json result = timed_line("box", mesher, 100, 0, threads);
  const double parallel = 6.0 / threads, half = 2 + 2.0 / threads, serial = 0.5;
  result["time_s"]["mesh"] = parallel + half + serial;
  result["time_s"]["process_wall"] = parallel + half + serial + 1.5;
  result["time_s"]["stages"] = {{"improvement", parallel}, {"half", half}, {"cleaning", serial}};
  return result;
}

TEST(ParallelTable, SerialSharesAreAmdahls) {
  EXPECT_DOUBLE_EQ(serial_share(2, 2), 0);
  EXPECT_DOUBLE_EQ(serial_share(1, 2), 1);
  EXPECT_NEAR(serial_share(1 / (0.25 + 0.75 / 4), 4), 0.25, 1e-12);
  EXPECT_DOUBLE_EQ(serial_share(2.2, 2), 0);  // more than two threads can do: noise, or twice the cache
  EXPECT_DOUBLE_EQ(serial_share(0.8, 2), 1);  // slower with two: no share of it is more than all
}

TEST(ParallelTable, StagesAndTheWholeJobAreComparedWithOneThread) {
  const Table table =
      parallel_table(points({staged("cbc3d", 4), staged("cbc3d", 1), staged("cbc3d", 2), staged("cgal", 2)}));
  EXPECT_EQ(table.columns,
            (std::vector<std::string>{"1 thread (s)", "2 threads (s)", "4 threads (s)",
                                      "share of one thread's time (%)", "speed-up, 2 threads",
                                      "serial share, 2 threads (%)", "speed-up, 4 threads",
                                      "serial share, 4 threads (%)", "speed-up asked at 2 threads"}));
  const auto row = [&](const std::string& stage) {
    std::vector<std::string> texts(table.columns.size());
    for (std::size_t column = 0; column < texts.size(); ++column) {
      texts[column] = text_in(table, "box, cbc3d", stage, column);
    }
    return texts;
  };
  using Texts = std::vector<std::string>;
  EXPECT_EQ(row("improvement"),
            (Texts{"6.000", "3.000", "1.500", "57.1", "2.00", "0.0", "4.00", "0.0", "1.5"}));
  EXPECT_EQ(row("half"),
            (Texts{"4.000", "3.000", "2.500", "38.1", "1.33 missed", "50.0", "1.60", "50.0", "1.5"}));
  EXPECT_EQ(row("cleaning"),
            (Texts{"0.500", "0.500", "0.500", "4.8", "1.00", "100.0", "1.00", "100.0", "not asked"}));
  EXPECT_EQ(row("whole job"),  // 2.5 of 10.5 s are serial
            (Texts{"10.500", "6.500", "4.500", "100.0", "1.62 missed", "23.8", "2.33", "23.8", "1.7"}));
  EXPECT_EQ(row("whole job, files included"),  // 4 of 12
            (Texts{"12.000", "8.000", "6.000", "114.3", "1.50 missed", "33.3", "2.00", "33.3", "1.7"}));
  EXPECT_EQ(table.rows.size(), 5U);  // nothing of the mesher that one thread was not measured of
}

TEST(ParallelTable, WhatFailedAtAThreadCountIsADash) {
  Json bad = staged("cbc3d", 4);
  bad["status"] = "timeout";
  const Table table = parallel_table(points({staged("cbc3d", 1), staged("cbc3d", 2), bad}));
  EXPECT_EQ(table.columns.size(), 6U);  // nothing is known of four threads
  EXPECT_TRUE(parallel_table(points({staged("cbc3d", 1), bad})).rows.empty());
}

TEST(ParallelTable, ARunThatIsNoSweepHasNone) {
  EXPECT_TRUE(table_of(sweep_parallel_table, {staged("cbc3d", 1), staged("cbc3d", 2)}).rows.empty());
}

}  // namespace
}  // namespace cbc3d::reports
