// Abaqus's format: read back by us and by meshio; CalculiX bends and pulls a bar of it.
#include "mesher/mesh_formats/abaqus_writing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "mesher/core/testing_mesh.hpp"
#include "mesher/mesh_formats/abaqus_reading.hpp"
#include "mesher/mesh_formats/testing_meshes.hpp"
#include "mesher/testing/temporary_folder.hpp"

namespace cbc3d {
namespace {

class AbaqusWriting : public ::testing::Test {
 protected:
  [[nodiscard]] std::string file(const std::string& name) const { return folder_.file(name).string(); }
  testing::TemporaryFolder folder_{"abaqus"};
};

TEST_F(AbaqusWriting, IsReadBackWithNodesOrderAndLabels) {
  const Mesh mesh = testing::one_of_each();
  MeshFileOptions options;
  options.names.set({.label = 4, .name = "left lung 9", .colour = {}});
  write_abaqus(FileMesh(mesh, {}), file("m.inp"), options);
  const Mesh back = read_abaqus(file("m.inp"));
  EXPECT_EQ(back.tets.nodes, mesh.tets.nodes);
  EXPECT_EQ(back.pyramids.nodes, mesh.pyramids.nodes);
  EXPECT_EQ(back.wedges.nodes, mesh.wedges.nodes);
  EXPECT_EQ(back.hexes.nodes, mesh.hexes.nodes);
  EXPECT_EQ(labels_of(back), labels_of(mesh));
  const std::string text = folder_.content("m.inp");
  EXPECT_NE(text.find("ELSET=left_lung_9"), std::string::npos);
  EXPECT_NE(text.find("*SURFACE, NAME=label_5__label_6, TYPE=ELEMENT\n3, S2\n"), std::string::npos) << text;
}

TEST_F(AbaqusWriting, MeshioReadsTheSameCells) {
  if (!testing::has_meshio()) GTEST_SKIP() << "python3-meshio is not installed";
  const Mesh mesh = testing::two_label_box(2);
  write_abaqus(FileMesh(mesh, {}), file("m.inp"), {});
  const nlohmann::json found = testing::reopened(file("m.inp"));
  EXPECT_EQ(found["cells"]["tetra"], 48);
  EXPECT_EQ(found["sets"]["label_7"], 24) << found;
  double volume = 0;
  for (const auto& part : found["volumes"]) volume += part.get<double>();
  EXPECT_NEAR(volume, 1, 1e-9);
}

/// A bar along x of two labels, fixed at x = 0 in its own direction and along its axes of symmetry, so that
/// it may shrink across.
struct Bar {
  static constexpr double kLength = 10, kSide = 1, kYoung = 1000, kPoisson = 0.3;
  Mesh mesh;

  Bar() {
    mesh = testing::two_label_box(4);  // 2 x 2 x 2
    for (Vec3& p : mesh.points) {
      p = {p.x / 2 * kLength, p.y / 2 * kSide, p.z / 2 * kSide};
    }
  }
};

/// Mean displacement along x of the end of a bar that is pulled by the pressure -1 on the faces of the
/// surface.
double stretch_of(const Bar& bar, std::span<const Vec3> points, const std::string& mesh_text,
                  const testing::TemporaryFolder& folder) {
  std::ostringstream deck;
  deck << mesh_text << "*NSET, NSET=LEFT\n";
  const auto list = [&](const auto& is_in) {
    for (std::size_t v = 0; v < points.size(); ++v) {
      if (is_in(points[v])) deck << v + 1 << ",\n";
    }
  };
  list([](const Vec3& p) { return p.x < 1e-9; });
  deck << "*NSET, NSET=FRONT\n";
  list([](const Vec3& p) { return p.y < 1e-9; });
  deck << "*NSET, NSET=BOTTOM\n";
  list([](const Vec3& p) { return p.z < 1e-9; });
  deck << "*NSET, NSET=RIGHT\n";
  list([](const Vec3& p) { return p.x > Bar::kLength - 1e-9; });
  deck << "*BOUNDARY\nLEFT, 1, 1\nFRONT, 2, 2\nBOTTOM, 3, 3\n*MATERIAL, NAME=M\n*ELASTIC\n"
       << Bar::kYoung << ", " << Bar::kPoisson << "\n*SOLID SECTION, ELSET=label_3, MATERIAL=M\n"
       << "*SOLID SECTION, ELSET=label_7, MATERIAL=M\n*STEP\n*STATIC\n*DLOAD\n";
  // The faces of the surface on the right end.
  std::istringstream lines(mesh_text.substr(mesh_text.find("NAME=label_3__exterior")));
  std::string line;
  std::getline(lines, line);
  const FileMesh view(bar.mesh, {});
  while (std::getline(lines, line) && line[0] != '*') {
    std::istringstream words(line);
    std::size_t element = 0, face = 0;
    std::string comma;
    words >> element >> comma;
    words.ignore(2);  // " S"
    if (!(words >> face)) ADD_FAILURE() << line;
    std::array<VertexId, 6> nodes;
    view.nodes_of({static_cast<std::uint32_t>(element - 1), static_cast<std::uint8_t>(face - 1)}, nodes);
    const bool at_end = std::all_of(nodes.begin(), nodes.begin() + 3,
                                    [&](VertexId v) { return bar.mesh.points[v].x > Bar::kLength - 1e-9; });
    if (at_end) deck << element << ", P" << face << ", -1.\n";
  }
  deck << "*NODE PRINT, NSET=RIGHT\nU\n*END STEP\n";
  folder.write("bar.inp", deck.str());
  const auto outcome =
      testing::run_program("cd '" + folder.path().string() + "' && OMP_NUM_THREADS=1 ccx bar");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  std::istringstream results(folder.content("bar.dat"));
  double sum = 0;
  int count = 0;
  while (std::getline(results, line)) {
    double node = 0, u = 0, v = 0, w = 0;
    if (std::istringstream(line) >> node >> u >> v >> w) {
      sum += u;
      ++count;
    }
  }
  EXPECT_GT(count, 0) << outcome.text;
  return sum / count;
}

/// u = sigma L / E: within 1 %, by linear and by quadratic elements, through the element sets and faces of
/// the file.
TEST_F(AbaqusWriting, CalculixStretchesABarByTheFormula) {
  if (!testing::has_program("ccx")) GTEST_SKIP() << "calculix-ccx is not installed";
  const Bar bar;
  const double expected = Bar::kLength / Bar::kYoung;
  write_abaqus(FileMesh(bar.mesh, {}), file("linear.inp"), {});
  EXPECT_NEAR(stretch_of(bar, bar.mesh.points, folder_.content("linear.inp"), folder_) / expected, 1, 0.01);
  const QuadraticMesh quadratic = straight_quadratic_mesh(bar.mesh);
  write_abaqus(FileMesh(quadratic, {}), file("quadratic.inp"), {});
  EXPECT_NEAR(stretch_of(bar, quadratic.points, folder_.content("quadratic.inp"), folder_) / expected, 1,
              0.01);
}

}  // namespace
}  // namespace cbc3d
