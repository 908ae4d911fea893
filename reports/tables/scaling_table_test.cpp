#include "reports/tables/scaling_table.hpp"

#include <gtest/gtest.h>

#include "reports/tables/testing_tables.hpp"

namespace cbc3d::reports {
namespace {

cases::Case phantom_case(const std::string& name, int size, std::uint64_t seed = 1) {
  cases::Case subject;
  subject.name = name;
  subject.phantom = cases::Phantom{"ball", {size, size, size}, {1, 1, 1}, seed, ""};
  return subject;
}

TEST(ScalingTable, CostsArePerVoxelAndElementWithTheirSpread) {
  const std::vector<cases::Case> cases{phantom_case("large", 200), phantom_case("small", 100),
                                       phantom_case("other", 400, 2)};
  // 1 and 8 million voxels: 1,000 and 1,500 ns a voxel; 100 and 150 us an element.
  const Table table =
      table_of(scaling_table,
               {timed_line("small", "cbc3d", 10'000, 1), timed_line("large", "cbc3d", 80'000, 12),
                timed_line("other", "cbc3d", 10'000, 1), timed_line("small", "cgal", 10'000, 1)},
               cases);
  EXPECT_EQ(table.columns, (std::vector<std::string>{"1x", "8x", "spread (%), at most 20"}));
  EXPECT_EQ(text_in(table, "ball, cbc3d", "elements", 1), "80,000");
  EXPECT_EQ(text_in(table, "ball, cbc3d", "wall time (ns per voxel)", 0), "1,000.00");
  EXPECT_EQ(text_in(table, "ball, cbc3d", "wall time (ns per voxel)", 1), "1,500.00");
  EXPECT_EQ(text_in(table, "ball, cbc3d", "wall time (us per element)", 1), "150.00");
  EXPECT_EQ(text_in(table, "ball, cbc3d", "wall time (ns per voxel)", 2),
            "20.0");  // 250 from the median 1,250
  EXPECT_EQ(text_in(table, "ball, cbc3d", "lattice (us per element)", 0), "75.00");
  EXPECT_EQ(text_in(table, "ball, cbc3d", "rest (us per element)", 0), "no row rest (us per element)");
  for (const Row& row : table.rows) {
    EXPECT_EQ(row.case_name, "ball, cbc3d");  // neither the other seed nor the mesher with one size
  }
}

TEST(ScalingTable, WhatIsNotFlatIsMarkedAndAMissingSizeIsADash) {
  const std::vector<cases::Case> cases{phantom_case("a", 10), phantom_case("b", 20), phantom_case("c", 40)};
  const Table table = table_of(scaling_table,
                               {timed_line("a", "cbc3d", 100, 1), timed_line("b", "cbc3d", 800, 8),
                                timed_line("c", "cbc3d", 6400, 128), timed_line("a", "cgal", 100, 1),
                                timed_line("c", "cgal", 6400, 64)},
                               cases);
  EXPECT_EQ(table.columns.size(), 4U);
  EXPECT_EQ(text_in(table, "ball, cbc3d", "wall time (us per element)", 3), "100.0 missed");
  EXPECT_EQ(text_in(table, "ball, cgal", "wall time (us per element)", 3), "0.0");
  EXPECT_EQ(text_in(table, "ball, cgal", "wall time (us per element)", 1), "-");
  EXPECT_EQ(text_in(table, "ball, cbc3d", "lattice (us per element)", 3), "100.0");  // a stage has no limit
  EXPECT_TRUE(table_of(scaling_table, {timed_line("a", "cbc3d", 100, 1)}, cases).rows.empty());
}

TEST(ScalingTable, CopiesSideBySideAreASeriesOfTheirOwn) {
  std::vector<cases::Case> cases{phantom_case("one", 100), phantom_case("eight", 100),
                                 phantom_case("fine", 200)};
  cases[1].derive.repeat = {2, 2, 2};
  const Table table = table_of(scaling_table,
                               {timed_line("one", "cbc3d", 100, 1), timed_line("eight", "cbc3d", 800, 16),
                                timed_line("fine", "cbc3d", 800, 8)},
                               cases);
  EXPECT_EQ(table.columns, (std::vector<std::string>{"1x", "8x", "spread (%), at most 20"}));
  EXPECT_EQ(text_in(table, "ball side by side, cbc3d", "wall time (ns per voxel)", 0), "1,000.00");
  EXPECT_EQ(text_in(table, "ball side by side, cbc3d", "wall time (ns per voxel)", 1), "2,000.00");
  EXPECT_EQ(text_in(table, "ball, cbc3d", "wall time (ns per voxel)", 0), "1,000.00");
  EXPECT_EQ(text_in(table, "ball, cbc3d", "wall time (ns per voxel)", 1), "1,000.00");
  cases.pop_back();  // copies alone have no other resolution
  EXPECT_EQ(
      text_in(table_of(scaling_table,
                       {timed_line("one", "cbc3d", 100, 1), timed_line("eight", "cbc3d", 800, 16)}, cases),
              "ball, cbc3d", "elements", 0),
      "no row elements");
}

}  // namespace
}  // namespace cbc3d::reports
