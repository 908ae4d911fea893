#include "reports/tables/input_parameter_table.hpp"

#include <gtest/gtest.h>

#include "reports/tables/testing_tables.hpp"

namespace cbc3d::reports {
namespace {

Json with_iterations(const std::string& case_name, const std::string& iterations) {
  Json line = job_line(case_name, "cbc3d-paper", 1);
  line["parameters"] = {{"iterations", iterations}};
  return line;
}

TEST(InputParameterTable, StandsBesideThePapers) {
  const Table table =
      table_of(input_parameter_table,
               {with_iterations("box", "7"), with_iterations("ball", "7"), with_iterations("tube", "9")});
  EXPECT_FALSE(table.on_screen);
  const std::string text = to_markdown(table);
  EXPECT_NE(text.find("| cbc3d-paper "), std::string::npos);
  EXPECT_NE(text.find("7; 9 (tube)"), std::string::npos) << text;
  EXPECT_NE(text.find("5 (cases 1-3), 7 (case 4)"), std::string::npos);
  EXPECT_NE(text.find("podm (not run)"), std::string::npos);
}

TEST(InputParameterTable, WhatTheMesherReportsIsInForceUnlessItWasGiven) {
  Json line = job_line("box", "mine", 1);
  line["mesher_report"]["parameters"] = {{"size", 2.5}, {"seed", "1"}};
  line["parameters"] = {{"seed", "7"}};
  const Table table = table_of(input_parameter_table, {line});
  EXPECT_EQ(text_in(table, "mine", "size", 0), "2.5");
  EXPECT_EQ(text_in(table, "mine", "seed", 0), "7");
}

}  // namespace
}  // namespace cbc3d::reports
