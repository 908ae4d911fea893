#include "reports/tables/paper_figure.hpp"

#include <gtest/gtest.h>

#include "reports/tables/catalog_table.hpp"
#include "reports/tables/testing_tables.hpp"

namespace cbc3d::reports {
namespace {

std::vector<cases::Case> cases_with_paper(const nlohmann::json& paper) {
  cases::Case subject;
  subject.name = "nidus";
  subject.paper = paper;
  return {subject};
}

TEST(PaperFigure, StandsBesideOurs) {
  const auto cases = cases_with_paper({{"cbc3d", {{"hausdorff_mm", 4.51}, {"tets", 272000}}}});
  const std::vector<Json> lines{job_line("nidus", "cbc3d-paper", 300000), job_line("nidus", "cbc3d-mixed", 1),
                                job_line("nidus", "cgal", 1)};
  const Row count = table_of(catalog_table("element_count", ""), lines, cases).rows[0];
  EXPECT_EQ(cell_text(count.cells[0], 0), "300,000 (paper: 272,000)");
  EXPECT_FALSE(count.cells[1].paper.has_value());
  EXPECT_FALSE(count.cells[2].paper.has_value());
  const Table fidelity = table_of(catalog_table("fidelity", ""), lines, cases);
  EXPECT_EQ(row_of(fidelity, "HD (mm)").cells[0].paper, 4.51);
  EXPECT_NE(to_csv(fidelity).find("cbc3d-paper (paper)"), std::string::npos);
}

TEST(PaperFigure, OfADeformationNeedsTheSameIterationsAndPattern) {
  const auto cases = cases_with_paper(
      {{"deformation", {{"iterations", 10}, {"patterns", {{"face", {{"hausdorff_mm", 0.88}}}}}}}});
  const auto figure_of = [&](const char* iterations, const char* pattern) {
    Json line = job_line("nidus", "cbc3d-paper", 1);
    line["parameters"] = {{"connectivity", pattern}, {"iterations", iterations}};
    const JobResult result = decode(line);
    return paper_figure(cases, {&result}, "hausdorff_mm");
  };
  EXPECT_EQ(figure_of("10", "face"), 0.88);
  EXPECT_FALSE(figure_of("5", "face").has_value());
  EXPECT_FALSE(figure_of("10", "edge").has_value());
}

TEST(PaperFigure, NeedsRunsAndAKey) {
  const auto cases = cases_with_paper({{"cbc3d", {{"hausdorff_mm", 4.51}}}});
  const JobResult result = decode(job_line("nidus", "cbc3d", 1));
  EXPECT_EQ(paper_figure(cases, {&result}, "hausdorff_mm"), 4.51);
  EXPECT_FALSE(paper_figure(cases, {}, "hausdorff_mm").has_value());
  EXPECT_FALSE(paper_figure(cases, {&result}, "").has_value());
}

}  // namespace
}  // namespace cbc3d::reports
