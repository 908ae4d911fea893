#include "reports/gate/parameter_change.hpp"

#include <gtest/gtest.h>

#include "reports/gate/testing_gate.hpp"

namespace cbc3d::reports {
namespace {

TEST(ParameterChange, NamesEachParameterWithBothValues) {
  EXPECT_EQ(
      changes_of({{"size", "2"}, {"seed", "1"}, {"old", "x"}},
                 {{"size", "1.5"}, {"seed", "1"}, {"mixed", "true"}}),
      "parameter mixed was not given, is true; parameter old was x, is not given; parameter size was 2, "
      "is 1.5");
  EXPECT_EQ(changes_of({{"size", "2"}}, {{"size", "2"}}), "");
}

TEST(ParameterChange, TheGateSaysWhichAndWhatItCost) {
  std::vector<Json> run = good_run();
  for (Json& line : run) {
    line["parameters"] = {{"size", "2"}};
    line["time_s"]["cpu"] = 1.5;
    line["quality"]["min_dihedral_deg"] = 15.0;
    line["fidelity"]["hausdorff_mm"] = 2.01;  // within its tolerance
  }
  const Verdict verdict = compare_lines(run, baseline());
  ASSERT_EQ(verdict.fallen(), 1U);
  const std::string& text = verdict.checks[0].text;
  EXPECT_EQ(
      text,
      "parameter size was not given, is 2; run as the baseline was, or --update. It cost: CPU time over "
      "the reference work's was 50, is 75 (+25, +50.0 %; allowed 20); it gained: smallest dihedral angle "
      "was 12 deg, is 15 deg (+3 deg, +25.0 %; allowed 0.5000 deg)");
}

TEST(ParameterChange, AMeshersOtherDefaultIsNoted) {
  std::vector<Json> run = good_run();
  for (Json& line : run) line["mesher_report"]["parameters"] = {{"deviation", "0.35"}};
  const Json former = make_baseline(decode_lines(run), Json(), "why");
  for (Json& line : run) line["mesher_report"]["parameters"] = {{"deviation", "0.3"}};
  const Verdict verdict = compare_lines(run, former);
  EXPECT_TRUE(verdict.holds()) << to_text(verdict);
  ASSERT_EQ(verdict.notes.size(), 1U);
  EXPECT_NE(verdict.notes[0].find(
                "by the mesher's defaults parameter deviation was 0.35, is 0.3. It cost: CPU time"),
            std::string::npos)
      << verdict.notes[0];
}

}  // namespace
}  // namespace cbc3d::reports
