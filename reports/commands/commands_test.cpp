// The commands as their users run them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <fstream>

#include "mesher/core/image_io.hpp"
#include "mesher/core/mesh_coordinates.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"
#include "mesher/testing/temporary_folder.hpp"
#include "reports/results/result.hpp"
#include "reports/run/child_process.hpp"

namespace cbc3d::reports {
namespace {

using cbc3d::testing::TemporaryFolder;

ChildResult bench(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), BENCH);
  return run_child({arguments, 1, 0, 0});
}

Json read_json(const std::filesystem::path& file) {
  std::ifstream stream(file);
  return Json::parse(stream);
}

TEST(Commands, EvaluateWritesTheSectionsOfAResultLine) {
  const TemporaryFolder folder;
  LabelImage image;
  image.frame.size = {6, 6, 6};
  image.labels = {0, 1, 9};
  image.voxels.assign(image.frame.voxel_count(), 1);
  image.voxels[image.frame.offset(3, 3, 3)] = 2;
  write_label_image(image, folder.path() / "box.nrrd");
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {5, 0, 0}, {0, 5, 0}, {0, 0, 5}};
  mesh.tets.add({0, 1, 2, 3}, 1);
  write_mesh(mesh, folder.path() / "tet.vtu");
  const auto json = folder.path() / "figures.json";
  const ChildResult result =
      bench({"evaluate", folder.path() / "tet.vtu", folder.path() / "box.nrrd", "--json", json});
  ASSERT_EQ(result.exit_code, 0) << result.stderr_tail;
  const Json figures = read_json(json);
  const Json empty = empty_result();
  for (const char* section : {"counts", "quality", "fidelity", "topology"}) {
    for (const auto& [key, value] : empty[section].items()) {
      EXPECT_TRUE(figures[section].contains(key)) << section << "." << key;
    }
  }
  EXPECT_EQ(figures["counts"]["tets"], 1);
  EXPECT_EQ(figures["fidelity"]["missing_labels"], Json::array({9}));
}

/// A cube of n voxels a side of label 1, each of which is six tets around a diagonal.
void write_cube(int n, const std::filesystem::path& image_file, const std::filesystem::path& mesh_file) {
  LabelImage image;
  image.frame.size = {n, n, n};
  image.labels = {0, 1};
  image.voxels.assign(image.frame.voxel_count(), 1);
  write_label_image(image, image_file);
  Mesh mesh;
  const ImageFrame corners{.size = {n + 1, n + 1, n + 1}};
  for (std::size_t v = 0; v < corners.voxel_count(); ++v) {
    const auto [i, j, k] = corners.index_of(v);
    mesh.points.push_back({i - .5, j - .5, k - .5});
  }
  for (std::size_t voxel = 0; voxel < image.voxels.size(); ++voxel) {
    const Index3 low = image.frame.index_of(voxel);
    std::array<std::size_t, 3> axes{0, 1, 2};
    do {
      Index3 at = low;
      std::array<VertexId, 4> tet{};
      for (std::size_t step = 0; step < 4; ++step) {
        tet[step] = static_cast<VertexId>((at[2] * (n + 1) + at[1]) * (n + 1) + at[0]);
        at[axes[std::min<std::size_t>(step, 2)]] += step < 3 ? 1 : 0;
      }
      const bool odd = (axes[0] + 1) % 3 != axes[1];
      if (odd) std::swap(tet[2], tet[3]);
      mesh.tets.add(tet, 1);
    } while (std::next_permutation(axes.begin(), axes.end()));
  }
  write_mesh(mesh, mesh_file);
}

TEST(Commands, EvaluateSolvesOnRequest) {
  const TemporaryFolder folder;
  const auto image = folder.path() / "cube.nrrd", mesh = folder.path() / "cube.vtu",
             json = folder.path() / "figures.json", own = folder.path() / "own.json";
  write_cube(6, image, mesh);
  ASSERT_EQ(bench({"evaluate", mesh, image, "--json", json, "--quiet"}).exit_code, 0);
  EXPECT_FALSE(read_json(json).contains("solver"));
  const ChildResult result = bench({"evaluate", mesh, image, "--json", json, "--solve"});
  ASSERT_EQ(result.exit_code, 0) << result.stderr_tail;
  Json solver = read_json(json)["solver"];
  if (std::string(SOLVE).empty()) {
    EXPECT_TRUE(solver["poisson_p1"].is_null());
    EXPECT_NE(solver["reason"].get<std::string>().find("is not built"), std::string::npos);
    return;
  }
  EXPECT_EQ(solver["reason"], "");
  EXPECT_EQ(solver["poisson_p1"]["unknowns"], 5 * 5 * 5);
  EXPECT_EQ(solver["poisson_p2"]["unknowns"], 11 * 11 * 11);  // vertices and edges inside
  EXPECT_LT(solver["poisson_p2"]["h1_relative"], solver["poisson_p1"]["h1_relative"]);
  ASSERT_EQ(run_child({{SOLVE, mesh, "--image", image, "--quiet", "--json", own}, 1, 120, 0}).exit_code, 0);
  solver.erase("reason");
  EXPECT_EQ(solver, read_json(own)["solver"]);
}

TEST(Commands, EvaluateNamesLabelsByTheTableBesideTheImageOrTheMesh) {
  const TemporaryFolder folder;
  const auto image = folder.path() / "cube.nrrd", mesh = folder.path() / "cube.vtu",
             json = folder.path() / "figures.json";
  write_cube(3, image, mesh);
  MeshFileOptions named;
  named.names.set({.label = 1, .name = "heart", .colour = {}});
  write_mesh(read_mesh(mesh), mesh, named);
  ASSERT_EQ(bench({"evaluate", mesh, image, "--json", json, "--quiet"}).exit_code, 0);
  EXPECT_EQ(read_json(json)["label_names"]["1"], "heart") << "of the mesh";
  folder.write("cube.tsv", "index\tname\n1\tright lung\n");
  ASSERT_EQ(bench({"evaluate", mesh, image, "--json", json, "--quiet"}).exit_code, 0);
  const Json figures = read_json(json);
  for (const char* section : {"quality", "fidelity", "topology", "surface"}) {
    EXPECT_EQ(figures[section]["per_label"][0]["name"], "right lung") << section;
  }
  EXPECT_EQ(figures["image"]["label_names"]["1"], "right lung");
}

TEST(Commands, EvaluateTakesLabelsAndStatedCoordinates) {
  const TemporaryFolder folder;
  const auto image = folder.path() / "cube.nrrd", mesh = folder.path() / "cube.vtu",
             json = folder.path() / "a.json", other = folder.path() / "b.json";
  write_cube(4, image, mesh);
  ASSERT_EQ(bench({"evaluate", mesh, image, "--json", json, "--quiet"}).exit_code, 0);
  for (const char* const coordinates : {"RAS", "voxel"}) {
    const LabelImage read = read_label_image(image);
    Mesh moved = read_mesh(mesh);
    from_lps(moved, coordinates, &read.frame);
    write_mesh(moved, folder.path() / "moved.vtu", {.names = {}, .coordinates = coordinates});
    ASSERT_EQ(bench({"evaluate", folder.path() / "moved.vtu", image, "--json", other, "--quiet"}).exit_code,
              0);
    EXPECT_EQ(read_json(other)["fidelity"], read_json(json)["fidelity"]) << coordinates;
  }
  EXPECT_EQ(bench({"evaluate", mesh, image, "--labels", "7"}).exit_code, 2);
  EXPECT_EQ(bench({"evaluate", mesh, image, "--labels", "1", "--solve"}).exit_code, 2);
  EXPECT_EQ(bench({"evaluate", mesh, image, "--labels", "1", "--quiet"}).exit_code, 0);
}

TEST(Commands, AMeshThatTheSolverRefusesIsEvaluatedAllTheSame) {
  const TemporaryFolder folder;
  const auto image = folder.path() / "cube.nrrd", mesh = folder.path() / "cube.vtu",
             json = folder.path() / "figures.json";
  write_cube(3, image, mesh);
  Mesh folded = read_mesh(mesh);
  std::swap(folded.tets.nodes[0][0], folded.tets.nodes[0][1]);
  write_mesh(folded, mesh);
  ASSERT_EQ(bench({"evaluate", mesh, image, "--json", json, "--solve"}).exit_code, 0);
  const Json figures = read_json(json);
  EXPECT_EQ(figures["quality"]["inverted"], 1);
  EXPECT_TRUE(figures["solver"]["poisson_p1"].is_null());
  EXPECT_TRUE(figures["solver"]["poisson_p2"].is_null());
  if (!std::string(SOLVE).empty()) {
    EXPECT_EQ(figures["solver"]["reason"].get<std::string>().rfind("the mesh is refused: ", 0), 0U)
        << figures["solver"];
  }
}

TEST(Commands, BadInputIsOneLineAndExitCodeTwo) {
  const TemporaryFolder folder;
  const std::vector<std::vector<std::string>> calls{
      {},
      {"run", "--out", folder.path()},
      {"run", "--suite", "nonsense", "--out", folder.path() / "out"},
      {"run", "--case", "nonsense", "--out", folder.path() / "out"},
      {"run", "--suite", "demo", "--mesher", "nonsense", "--out", folder.path() / "out"},
      {"run", "--suite", "demo", "--set", "cgal", "--out", folder.path() / "out"},
      {"run", "--suite", "demo", "--mesher", "cgal", "--set", "cgal.nonsense=1", "--out",
       folder.path() / "out"},
      {"run", "--suite", "demo", "--data", "/nowhere", "--out", folder.path() / "out"},
      {"tables", folder.path()},
      {"report", folder.path(), "--out", folder.path() / "r.html"},
      {"report", folder.path(), "--out", "/nowhere/r.html"},
      {"merge", folder.path(), "--out", folder.path() / "joint"},
      {"sweep", "--case", "nonsense", "--out", folder.path() / "out"},
      {"gate", folder.path(), "--baseline", folder.path() / "b.json"},
      {"run", "--suite", "demo", "--shard", "3/2", "--out", folder.path() / "out"},
      {"run", "--suite", "demo", "--shard", "x", "--out", folder.path() / "out"},
      {"history"},
      {"history", "add", folder.path(), "--store", folder.path() / "store"},
      {"history", "show", "--store", folder.path() / "store"},
      {"history", "regressions", "--store", folder.path() / "store", "--level", "2"},
      {"evaluate", folder.path() / "none.vtu", folder.path() / "none.nrrd"},
      {"phantom", "nonsense", "--out", folder.path() / "p.nrrd"}};
  for (const auto& call : calls) {
    const ChildResult result = bench(call);
    EXPECT_EQ(result.end, ChildEnd::exited);
    EXPECT_EQ(result.exit_code, 2) << ::testing::PrintToString(call);
    EXPECT_FALSE(last_line(result.stderr_tail).empty());
  }
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out" / "results.jsonl"));
}

TEST(Commands, PhantomHonoursSizeAndSpacing) {
  const TemporaryFolder folder;
  const auto file = folder.path() / "p.nrrd";
  const ChildResult result =
      bench({"phantom", "shells", "--size", "20,24,28", "--spacing", "1,1.5,2", "--out", file, "--quiet"});
  ASSERT_EQ(result.exit_code, 0) << result.stderr_tail;
  const LabelImage image = read_label_image(file);
  EXPECT_EQ(image.frame.size, (Index3{20, 24, 28}));
  EXPECT_EQ(image.frame.spacing_mm, (Vec3{1, 1.5, 2}));
}

TEST(Commands, JobsOfAClusterKeepTheLimitsThatWereGiven) {
  const TemporaryFolder folder;
  ASSERT_EQ(bench({"cluster", "slurm", "--case", "gate-shells", "--mesher", "cbc3d-paper", "--timeout", "60",
                   "--evaluation-timeout", "180", "--file-limit", "2", "--memory-limit", "3", "--quiet",
                   "--out", folder.path() / "jobs"})
                .exit_code,
            0);
  const std::string job = folder.content("jobs/job.sh"), array = folder.content("jobs/array.sbatch");
  EXPECT_NE(
      job.find("'--timeout' '60.0' '--evaluation-timeout' '180.0' '--file-limit' '2.0' '--memory-limit' "
               "'3.0'"),
      std::string::npos)
      << job;
  EXPECT_NE(array.find("#SBATCH --time=9\n"), std::string::npos) << array;  // 1 + 3 minutes, and 5 to begin
}

TEST(Commands, EveryCommandHasHelp) {
  for (const char* command : {"list", "run", "sweep", "gate", "report", "merge", "evaluate", "tables",
                              "phantom", "history", "cluster"}) {
    EXPECT_EQ(bench({command, "--help"}).exit_code, 0) << command;
  }
  for (const char* what : {"meshers", "cases", "suites"}) {
    EXPECT_EQ(bench({"list", what}).exit_code, 0) << what;
  }
  EXPECT_EQ(bench({"--man"}).exit_code, 0);
  EXPECT_EQ(bench({"--completion", "zsh"}).exit_code, 0);
  EXPECT_EQ(bench({"--completion", "csh"}).exit_code, 2);
}

}  // namespace
}  // namespace cbc3d::reports
