// The tables of what meshes cost: known answers.
#include <gtest/gtest.h>

#include "reports/sweep/parallel_table.hpp"
#include "reports/tables/scaling_table.hpp"
#include "reports/tables/speed_table.hpp"

namespace cbc3d::reports {
namespace {

Json line(const std::string& case_name, const std::string& mesher, int tets, double seconds,
          int threads = 1) {
  Json result = empty_result();
  result["case"] = case_name;
  result["mesher"] = mesher;
  result["threads"] = threads;
  result["repeat"] = 0;
  result["status"] = "ok";
  result["counts"]["tets"] = tets;
  result["fidelity"]["hausdorff_mm"] = 1.5;
  result["time_s"] = {{"mesh", seconds},
                      {"cpu", seconds * threads},
                      {"process_wall", seconds + 1},
                      {"stages", {{"lattice", seconds * 0.75}, {"rest", seconds * 0.01}}}};
  result["peak_rss_bytes"] = 250'000'000;
  return result;
}

std::string text(const Table& table, const std::string& case_name, const std::string& figure,
                 std::size_t column) {
  for (const Row& row : table.rows) {
    if (row.case_name == case_name && row.figure == figure) {
      return cell_text(row.cells.at(column), row.decimals);
    }
  }
  return "no row " + figure;
}

cases::Case phantom_case(const std::string& name, int size, std::uint64_t seed = 1) {
  cases::Case subject;
  subject.name = name;
  subject.phantom = cases::Phantom{"ball", {size, size, size}, {1, 1, 1}, seed, ""};
  return subject;
}

TEST(SpeedTable, RatiosAreOverTheReferencesColumns) {
  Json mixed = line("box", "cbc3d-mixed", 100, 1);
  mixed["counts"]["hexes"] = 20;
  const Table table =
      speed_table({line("box", "cbc3d-paper", 1000, 2), line("box", "cbc3d-paper", 1000, 1, 2),
                   line("box", "cgal", 1100, 10), mixed},
                  {});
  EXPECT_EQ(table.name, "speed");
  EXPECT_EQ(text(table, "box", "elements", 3), "120");
  EXPECT_EQ(text(table, "box", "elements per second", 0), "500");
  EXPECT_EQ(text(table, "box", "time with files (s)", 2), "11.00");
  EXPECT_EQ(text(table, "box", "elements over cbc3d-paper (1 thread)'s", 2), "1.10");
  EXPECT_EQ(text(table, "box", "time over cbc3d-paper (1 thread)'s", 0), "1.00");
  EXPECT_EQ(text(table, "box", "time over cbc3d-paper (1 thread)'s", 2), "5.00");
  EXPECT_EQ(text(table, "box", "time over cbc3d-paper (2 threads)'s", 2), "10.00");
  EXPECT_EQ(text(table, "box", "CPU time over cbc3d-paper (2 threads)'s", 2), "5.00");
  EXPECT_EQ(text(table, "box", "time over cgal's", 0), "no row time over cgal's");
  EXPECT_EQ(text(table, "box", "core-seconds (time x threads)", 1), "2.00");
  EXPECT_EQ(text(table, "box", "the paper's core-seconds over these", 1),
            "no row the paper's core-seconds over these");
}

TEST(SpeedTable, ThePapersCoreSecondsStandBesideOurs) {
  cases::Case subject;
  subject.name = "aneurysm";
  subject.paper = {{"cbc3d", {{"time_s", 68.24}, {"threads", 8}}}, {"cgal", {{"time_s", 12.33}}}};
  const Table table = speed_table(
      {line("aneurysm", "cbc3d-paper", 1000, 2, 2), line("aneurysm", "cgal", 1100, 10)}, {subject});
  EXPECT_EQ(text(table, "aneurysm", "core-seconds (time x threads)", 0), "4.00 (paper: 545.92)");
  EXPECT_EQ(text(table, "aneurysm", "the paper's core-seconds over these", 0), "136.5");
  EXPECT_EQ(text(table, "aneurysm", "the paper's core-seconds over these", 1), "-");
  EXPECT_EQ(text(table, "aneurysm", "time (s)", 1), "10.00 (paper: 12.33)");
}

TEST(SpeedTable, AFailedJobHasNoRatioAndSaysWhy) {
  Json bad = line("box", "cgal", 0, 1);
  bad["status"] = "timeout";
  bad["reason"] = "not done after 5 s";
  const Table table = speed_table({line("box", "cbc3d", 1000, 2), bad}, {});
  EXPECT_EQ(text(table, "box", "time over cbc3d's", 1), "-");
  EXPECT_EQ(table.rows[0].cells[1].reason, "timeout: not done after 5 s");
}

TEST(ScalingTable, CostsArePerVoxelAndElementWithTheirSpread) {
  const std::vector<cases::Case> cases{phantom_case("large", 200), phantom_case("small", 100),
                                       phantom_case("other", 400, 2)};
  // 1 and 8 million voxels: 1,000 and 1,500 ns a voxel; 100 and 150 us an element.
  const Table table = scaling_table({line("small", "cbc3d", 10'000, 1), line("large", "cbc3d", 80'000, 12),
                                     line("other", "cbc3d", 10'000, 1), line("small", "cgal", 10'000, 1)},
                                    cases);
  EXPECT_EQ(table.columns, (std::vector<std::string>{"1x", "8x", "spread (%), at most 20"}));
  EXPECT_EQ(text(table, "ball, cbc3d", "elements", 1), "80,000");
  EXPECT_EQ(text(table, "ball, cbc3d", "wall time (ns per voxel)", 0), "1,000.00");
  EXPECT_EQ(text(table, "ball, cbc3d", "wall time (ns per voxel)", 1), "1,500.00");
  EXPECT_EQ(text(table, "ball, cbc3d", "wall time (us per element)", 1), "150.00");
  EXPECT_EQ(text(table, "ball, cbc3d", "wall time (ns per voxel)", 2), "20.0");  // 250 from the median 1,250
  EXPECT_EQ(text(table, "ball, cbc3d", "lattice (us per element)", 0), "75.00");
  EXPECT_EQ(text(table, "ball, cbc3d", "rest (us per element)", 0), "no row rest (us per element)");
  for (const Row& row : table.rows) {
    EXPECT_EQ(row.case_name, "ball, cbc3d");  // neither the other seed nor the mesher with one size
  }
}

TEST(ScalingTable, WhatIsNotFlatIsMarkedAndAMissingSizeIsADash) {
  const std::vector<cases::Case> cases{phantom_case("a", 10), phantom_case("b", 20), phantom_case("c", 40)};
  const Table table =
      scaling_table({line("a", "cbc3d", 100, 1), line("b", "cbc3d", 800, 8), line("c", "cbc3d", 6400, 128),
                     line("a", "cgal", 100, 1), line("c", "cgal", 6400, 64)},
                    cases);
  EXPECT_EQ(table.columns.size(), 4U);
  EXPECT_EQ(text(table, "ball, cbc3d", "wall time (us per element)", 3), "100.0 missed");
  EXPECT_EQ(text(table, "ball, cgal", "wall time (us per element)", 3), "0.0");
  EXPECT_EQ(text(table, "ball, cgal", "wall time (us per element)", 1), "-");
  EXPECT_EQ(text(table, "ball, cbc3d", "lattice (us per element)", 3), "100.0");  // a stage has no limit
  EXPECT_TRUE(scaling_table({line("a", "cbc3d", 100, 1)}, cases).rows.empty());
}

TEST(ScalingTable, CopiesSideBySideAreASeriesOfTheirOwn) {
  std::vector<cases::Case> cases{phantom_case("one", 100), phantom_case("eight", 100),
                                 phantom_case("fine", 200)};
  cases[1].derive.repeat = {2, 2, 2};
  const Table table = scaling_table(
      {line("one", "cbc3d", 100, 1), line("eight", "cbc3d", 800, 16), line("fine", "cbc3d", 800, 8)}, cases);
  EXPECT_EQ(table.columns, (std::vector<std::string>{"1x", "8x", "spread (%), at most 20"}));
  EXPECT_EQ(text(table, "ball side by side, cbc3d", "wall time (ns per voxel)", 0), "1,000.00");
  EXPECT_EQ(text(table, "ball side by side, cbc3d", "wall time (ns per voxel)", 1), "2,000.00");
  EXPECT_EQ(text(table, "ball, cbc3d", "wall time (ns per voxel)", 0), "1,000.00");
  EXPECT_EQ(text(table, "ball, cbc3d", "wall time (ns per voxel)", 1), "1,000.00");
  cases.pop_back();  // copies alone have no other resolution
  EXPECT_EQ(text(scaling_table({line("one", "cbc3d", 100, 1), line("eight", "cbc3d", 800, 16)}, cases),
                 "ball, cbc3d", "elements", 0),
            "no row elements");
}

/// A job of three stages at a thread count: one that is halved by two threads, one with a serial half, a
/// small serial one.
Json staged(const std::string& mesher, int threads) {
  Json result = line("box", mesher, 100, 0, threads);
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
}

TEST(ParallelTable, StagesAndTheWholeJobAreComparedWithOneThread) {
  const Table table = parallel_table(
      sweep_points({staged("cbc3d", 4), staged("cbc3d", 1), staged("cbc3d", 2), staged("cgal", 2)}));
  EXPECT_EQ(table.columns,
            (std::vector<std::string>{"1 thread (s)", "2 threads (s)", "4 threads (s)",
                                      "share of one thread's time (%)", "speed-up, 2 threads",
                                      "serial share, 2 threads (%)", "speed-up, 4 threads",
                                      "serial share, 4 threads (%)", "speed-up asked at 2 threads"}));
  const auto row = [&](const std::string& stage) {
    std::vector<std::string> texts;
    for (std::size_t column = 0; column < table.columns.size(); ++column) {
      texts.push_back(text(table, "box, cbc3d", stage, column));
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
  const Table table = parallel_table(sweep_points({staged("cbc3d", 1), staged("cbc3d", 2), bad}));
  EXPECT_EQ(table.columns.size(), 6U);  // nothing is known of four threads
  EXPECT_TRUE(parallel_table(sweep_points({staged("cbc3d", 1), bad})).rows.empty());
}

}  // namespace
}  // namespace cbc3d::reports
