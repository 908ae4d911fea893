#include "reports/results/job_result.hpp"

#include <gtest/gtest.h>

#include "mesher/core/error.hpp"
#include "mesher/testing/temporary_folder.hpp"

namespace cbc3d::reports {
namespace {

using cbc3d::testing::TemporaryFolder;
using metrics::metric_id;

TEST(JobResult, IsDecodedFromItsLine) {
  Json line = empty_result();
  line["case"] = "liver";
  line["mesher"] = "cgal";
  line["threads"] = 2;
  line["repeat"] = 3;
  line["parameters"] = {{"size", "2"}};
  line["status"] = "ok";
  line["mesh_sha256"] = "aa";
  line["counts"]["tets"] = 7;
  line["topology"]["conforming"] = true;
  line["fidelity"]["missing_labels"] = {4, 5};
  line["fidelity"]["per_label"] = {{{"volume_error_percent", 1.0}}, {{"volume_error_percent", -3.25}}};
  line["summary"]["min_dihedral_label"] = 4;
  line["summary"]["inverted_labels"] = {3, 5};
  line["time_s"] = {
      {"mesh", 2.0}, {"cpu", 3.0}, {"reference_cpu", 0.5}, {"stages", {{"b", 0.5}, {"a", 1.5}}}};
  line["image"] = {{"size", {8, 9, 10}}, {"spacing_mm", {1, 1, 2.5}}, {"labels", {1, 4}}};
  line["shape"] = {{"voxel_surface", {{"normal_deviation_deg", 45.0}}}, {"per_label", {1, 2}}};
  line["provenance"] = {{"cpu", "fast"}, {"mesher_deterministic", false}};
  line["new_section"] = {{"new_key", 1}};
  const JobResult result = decode(line);
  EXPECT_EQ(result.id, "liver-cgal-t2-r3");
  EXPECT_EQ(result.threads, 2);
  EXPECT_EQ(result.parameters, (Parameters{{"size", "2"}}));
  EXPECT_TRUE(result.is_ok());
  EXPECT_EQ(result.mesh_sha256, "aa");
  EXPECT_EQ(result.figures[metric_id("counts.tets")], 7);
  EXPECT_EQ(result.figures[metric_id("elements")], 7);
  EXPECT_EQ(result.figures[metric_id("threads")], 2);
  EXPECT_EQ(result.figures[metric_id("topology.conforming")], 1);
  EXPECT_EQ(result.figures[metric_id("fidelity.missing_labels")], 2);
  EXPECT_EQ(result.figures[metric_id("volume_error_percent")], 3.25);
  EXPECT_EQ(result.figures[metric_id("elements_per_second")], 3.5);
  EXPECT_EQ(result.figures[metric_id("time_ratio")], 6);
  EXPECT_FALSE(result.figures[metric_id("fidelity.hausdorff_mm")].has_value());
  EXPECT_EQ(result.worst_labels.at(metric_id("summary.min_dihedral_deg")), std::vector<long>{4});
  EXPECT_EQ(result.worst_labels.at(metric_id("summary.inverted")), (std::vector<long>{3, 5}));
  EXPECT_EQ(result.missing_labels, (std::vector<long>{4, 5}));
  EXPECT_EQ(result.stage_seconds.front().first, "b");
  EXPECT_EQ(result.stage("a"), 1.5);
  EXPECT_FALSE(result.stage("c").has_value());
  EXPECT_EQ(result.image.value().size, (std::vector<std::int64_t>{8, 9, 10}));
  EXPECT_EQ(result.voxel_surface[metric_id("shape.normal_deviation_deg")], 45);
  EXPECT_EQ(result.labels_with_shape, 2U);
  EXPECT_FALSE(result.mesher_is_deterministic);
  EXPECT_EQ(result.provenance("cpu"), "fast");
  EXPECT_TRUE(result.provenance("load").is_null());
  EXPECT_EQ(result.line, line);  // with what nobody here reads
}

TEST(JobResult, WhatIsAbsentOrOfAnotherTypeIsNotKnown) {
  for (const Json& line : {empty_result(), Json{{"case", "box"}, {"mesher", "cgal"}},
                           Json{{"status", 3}, {"counts", "many"}, {"time_s", nullptr}, {"image", {1, 2}}}}) {
    const JobResult result = decode(line);
    EXPECT_FALSE(result.is_ok());
    EXPECT_EQ(result.threads, 1);
    EXPECT_FALSE(result.image.has_value());
    EXPECT_TRUE(result.stage_seconds.empty());
    for (const metrics::MetricId id : metrics::all_metrics()) {
      EXPECT_FALSE(result.figures[id].has_value()) << metrics::metric(id).key;
    }
  }
}

TEST(JobResult, ResultsOfAFolderWithoutAnyAreAnError) {
  const TemporaryFolder folder;
  EXPECT_THROW(results_of(folder.path()), InputError);
  append_result(folder.path() / "results.jsonl", {{"case", "box"}, {"mesher", "cgal"}, {"status", "ok"}});
  EXPECT_EQ(results_of(folder.path()).size(), 1U);
}

TEST(JobResult, FailuresAndSummaryAreSaid) {
  const std::vector<JobResult> results =
      decode_lines({{{"status", "ok"}}, {{"status", "crashed"}, {"reason", "SIGSEGV"}}, {{"status", "ok"}}});
  EXPECT_EQ(failure_of(results[1]), "crashed: SIGSEGV");
  EXPECT_EQ(failure_of(decode(Json{{"status", "skipped"}})), "skipped");
  EXPECT_EQ(summary_line(results), "3 jobs: 2 ok, 1 crashed");
}

}  // namespace
}  // namespace cbc3d::reports
