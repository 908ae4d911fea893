#include "reports/tables/catalog_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "reports/tables/testing_tables.hpp"

namespace cbc3d::reports {
namespace {

const TableBuilder kElementCount = catalog_table("element_count", "Element count");
const TableBuilder kFidelity = catalog_table("fidelity", "Fidelity");

TEST(CatalogTable, RowsAreTheMetricsThatNameTheTable) {
  const Table table = table_of(catalog_table("element_quality", "Quality"), {job_line("nidus", "cgal", 1)});
  std::vector<std::string> figures, titles;
  for (const Row& row : table.rows) {
    figures.push_back(row.figure);
  }
  for (const metrics::Metric& metric : metrics::kCatalog) {
    if (is_shown_in(metric, "element_quality")) {
      titles.push_back(title(metric));
    }
  }
  EXPECT_EQ(figures, titles);
  for (const char* figure : {"min dihedral angle (deg)", "max dihedral angle (deg)", "min scaled Jacobian",
                             "inverted elements", "self-intersections"}) {
    EXPECT_EQ(std::count(figures.begin(), figures.end(), figure), 1) << figure;
  }
}

TEST(CatalogTable, FiguresMadeOfSeveral) {
  const Json line = job_line("nidus", "cgal", 1);
  const Table fidelity = table_of(kFidelity, {line});
  EXPECT_EQ(row_of(fidelity, "largest volume error of a label (%)").cells[0].value, 3.25);
  EXPECT_EQ(row_of(fidelity, "labels missing").cells[0].value, 2);
  EXPECT_EQ(row_of(table_of(catalog_table("time", ""), {line}), "peak memory (MB)").cells[0].value, 250);
}

TEST(CatalogTable, SolverIsThereWhereItWasAsked) {
  const TableBuilder solver = for_solved_meshes(catalog_table("solver", "Solver"));
  Json solved = job_line("nidus", "cgal", 1), refused = job_line("nidus", "tetgen", 1);
  EXPECT_TRUE(table_of(solver, {solved, crashed_line("nidus", "ld", "oops")}).rows.empty());
  solved["solver"]["poisson_p1"]["h1_relative"] = 0.125;
  refused["solver"] = {{"poisson_p1", nullptr}, {"reason", "the mesh is refused: flat cells"}};
  const Table table = table_of(solver, {solved, refused, crashed_line("nidus", "ld", "oops")});
  const Row& row = row_of(table, "P1 H1 error");
  EXPECT_EQ(row.cells[0].value, 0.125);
  EXPECT_FALSE(row.cells[1].value.has_value());
  EXPECT_EQ(row.cells[1].reason, "the mesh is refused: flat cells");
  EXPECT_EQ(row.cells[2].reason, "crashed: oops");
}

TEST(CatalogTable, AMesherHasAColumnForEveryThreadCount) {
  const Table table = table_of(
      kElementCount,
      {job_line("nidus", "cbc3d", 1), job_line("nidus", "cbc3d", 1, 0, 2), job_line("nidus", "cgal", 1)});
  EXPECT_EQ(table.columns, (std::vector<std::string>{"cbc3d (1 thread)", "cbc3d (2 threads)", "cgal"}));
}

TEST(CatalogTable, AMesherThatDidNotRunACaseIsADash) {
  const Table table = table_of(kElementCount, {job_line("nidus", "cbc3d", 1), job_line("liver", "cgal", 1)});
  EXPECT_EQ(table.rows[1].cells[0].reason, "not run");
}

TEST(CatalogTable, VerticesAreShownForMixedMeshes) {
  const TableBuilder vertices = for_mixed_meshes(catalog_table("vertices", ""));
  Json mixed = job_line("nidus", "cbc3d-mixed", 1);
  EXPECT_TRUE(table_of(vertices, {mixed}).rows.empty());
  mixed["counts"]["hexes"] = 12;
  EXPECT_EQ(row_of(table_of(vertices, {mixed}), "hexahedra").cells[0].value, 12);
}

}  // namespace
}  // namespace cbc3d::reports
