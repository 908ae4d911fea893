// The executables, run through their adapters on small phantoms in files.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "baselines/registry.hpp"
#include "mesher/core/error.hpp"
#include "mesher/core/image_io.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"

namespace cbc3d::baselines {
namespace {

namespace fs = std::filesystem;
using Parameters = std::map<std::string, std::string>;

std::vector<std::string> built_meshers() {
  std::vector<std::string> names;
  std::istringstream list(CBC3D_BUILT_MESHERS);
  for (std::string name; std::getline(list, name, ',');) names.push_back(name);
  return names;
}

std::string content_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

int exit_code_of(const std::vector<std::string>& argv, const std::string& redirect) {
  std::string line;
  for (const std::string& word : argv) line += "'" + word + "' ";
  const int status = std::system((line + redirect).c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

// Two touching boxes with labels outside one byte, a distance off the border, in an oblique frame.
struct Box {
  Index3 first;
  Index3 last;
  Label label;
};
const Box kLeft{{4, 5, 3}, {13, 24, 15}, -7};
const Box kRight{{14, 5, 3}, {25, 24, 12}, 1000};

Mat3 rotation(double about_z_deg, double about_x_deg) {
  const double a = about_z_deg * M_PI / 180;
  const double b = about_x_deg * M_PI / 180;
  const Mat3 z = Mat3::from_columns({std::cos(a), std::sin(a), 0}, {-std::sin(a), std::cos(a), 0}, {0, 0, 1});
  const Mat3 x = Mat3::from_columns({1, 0, 0}, {0, std::cos(b), std::sin(b)}, {0, -std::sin(b), std::cos(b)});
  return z * x;
}

LabelImage two_boxes(bool left_handed) {
  LabelImage image;
  image.frame.size = {30, 30, 20};
  image.frame.spacing_mm = {1.0, 0.8, 1.5};
  image.frame.origin_mm = {-40, 25, 100};
  image.frame.direction = rotation(20, 35);
  if (left_handed) {
    const Mat3 d = image.frame.direction;
    image.frame.direction = Mat3::from_columns(-d.column(0), d.column(1), d.column(2));
  }
  image.labels = {0, kLeft.label, kRight.label};
  image.voxels.assign(image.frame.voxel_count(), kBackground);
  MaterialId material = 1;
  for (const Box& box : {kLeft, kRight}) {
    for (int k = box.first[2]; k <= box.last[2]; ++k) {
      for (int j = box.first[1]; j <= box.last[1]; ++j) {
        for (int i = box.first[0]; i <= box.last[0]; ++i)
          image.voxels[image.frame.offset(i, j, k)] = material;
      }
    }
    ++material;
  }
  return image;
}

std::array<Vec3, 4> corners_of(const Mesh& mesh, std::size_t tet) {
  std::array<Vec3, 4> p;
  for (std::size_t i = 0; i < 4; ++i) p[i] = mesh.points[mesh.tets.nodes[tet][i]];
  return p;
}

class MesherProgram : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    std::string name = ::testing::UnitTest::GetInstance()->current_test_info()->name();
    std::replace(name.begin(), name.end(), '/', '_');
    folder_ = fs::path(::testing::TempDir()) / ("cbc3d_" + name);
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] const Adapter& adapter() const { return *find_adapter(GetParam()); }
  [[nodiscard]] MeshJob job(const fs::path& image, const std::string& mesh,
                            Parameters parameters = {}) const {
    return {image, folder_ / mesh, folder_ / "report.json", 2, std::move(parameters)};
  }
  [[nodiscard]] const ParameterSpecs& specs() const { return adapter().parameters.in(CBC3D_BIN_DIR); }
  // Those of the parameters that the mesher has.
  [[nodiscard]] Parameters known_of(Parameters parameters) const {
    std::erase_if(parameters, [&](const auto& parameter) {
      return std::none_of(specs().begin(), specs().end(),
                          [&](const ParameterSpec& spec) { return spec.key == parameter.first; });
    });
    return parameters;
  }
  // Delaunay refinement rounds edges off by up to its facet size, and a facet at the curve where two labels
  // meet reaches as far into the other's place; lattice cleaving rounds them off by its blur and its cells.
  // So both get less than half a voxel of it.
  [[nodiscard]] Parameters fine() const {
    return known_of({{"facet-size", "0.7"},
                     {"facet-distance", "0.2"},
                     {"cell-size", "2"},
                     {"blur", "0.4"},
                     {"sampling-rate", "2"},
                     {"delta", "0.6"}});
  }
  [[nodiscard]] int run(const MeshJob& wanted) const {
    return exit_code_of(
        adapter().command(CBC3D_BIN_DIR, wanted),
        "> '" + (folder_ / "stdout").string() + "' 2> '" + (folder_ / "stderr").string() + "'");
  }
  [[nodiscard]] fs::path write(const LabelImage& image) const {
    fs::path path = folder_ / "image.nrrd";
    write_label_image(image, path);
    return path;
  }
  [[nodiscard]] nlohmann::json report() const {
    return nlohmann::json::parse(content_of(folder_ / "report.json"), nullptr, false);
  }
  void expect_two_boxes(const Mesh& mesh, const LabelImage& image) const;

  fs::path folder_;
};

// Labels, orientation, and each box's volume and extent in physical space.
void MesherProgram::expect_two_boxes(const Mesh& mesh, const LabelImage& image) const {
  EXPECT_EQ(labels_of(mesh), (std::vector<Label>{kLeft.label, kRight.label}));
  const Vec3& h = image.frame.spacing_mm;
  // A label image is sure of a boundary within half a voxel; CGAL finds it by bisection to a thousandth of
  // the bounding sphere. A wrong frame is off by several millimetres.
  const Vec3 extent = {h.x * image.frame.size[0], h.y * image.frame.size[1], h.z * image.frame.size[2]};
  const double tolerance_mm = 0.5 * std::max({h.x, h.y, h.z}) + 1e-3 * extent.norm();
  for (const Box& box : {kLeft, kRight}) {
    SCOPED_TRACE(box.label);
    double volume = 0;
    Vec3 low{1e9, 1e9, 1e9};
    Vec3 high{-1e9, -1e9, -1e9};
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      if (mesh.tets.labels[t] != box.label) continue;
      const auto p = corners_of(mesh, t);
      const double six = six_volumes(p[0], p[1], p[2], p[3]);
      ASSERT_GT(six, 0);
      volume += six / 6;
      for (const Vec3& physical : p) {
        const Vec3 local = image.frame.to_local(physical);
        for (int axis = 0; axis < 3; ++axis) {
          low[axis] = std::fmin(low[axis], local[axis]);
          high[axis] = std::fmax(high[axis], local[axis]);
        }
      }
    }
    double truth = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      const double from = (box.first[a] - 0.5) * h[axis];
      const double to = (box.last[a] + 0.5) * h[axis];
      truth *= to - from;
      EXPECT_NEAR(low[axis], from, tolerance_mm);
      EXPECT_NEAR(high[axis], to, tolerance_mm);
    }
    EXPECT_NEAR(volume / truth, 1, 0.04);
  }
}

TEST_P(MesherProgram, IsAvailable) {
  const Availability availability = adapter().availability(CBC3D_BIN_DIR);
  EXPECT_TRUE(availability.available) << availability.reason;
}

TEST_P(MesherProgram, MeshesAnObliqueImageInPhysicalSpace) {
  const LabelImage image = two_boxes(false);
  ASSERT_EQ(run(job(write(image), "mesh.vtu", fine())), kExitSuccess) << content_of(folder_ / "stderr");
  expect_two_boxes(read_mesh(folder_ / "mesh.vtu"), image);
  EXPECT_EQ(content_of(folder_ / "stdout"), "");
}

TEST_P(MesherProgram, MeshesALeftHandedImageInPhysicalSpace) {
  const LabelImage image = two_boxes(true);
  ASSERT_EQ(run(job(write(image), "mesh.vtu", fine())), kExitSuccess) << content_of(folder_ / "stderr");
  expect_two_boxes(read_mesh(folder_ / "mesh.vtu"), image);
}

TEST_P(MesherProgram, ReportsTimesMemoryParametersAndVersions) {
  const LabelImage image = two_boxes(false);
  const std::string key = specs().front().key;
  const std::string value = specs().front().default_value;
  ASSERT_EQ(run(job(write(image), "mesh.vtu", {{key, value}})), kExitSuccess);
  const nlohmann::json found = report();
  EXPECT_EQ(found["status"], "ok");
  EXPECT_EQ(found["reason"], "");
  EXPECT_EQ(found["counts"]["tets"], read_mesh(folder_ / "mesh.vtu").tets.size());
  double stages = 0;
  for (const auto& [name, seconds] : found["seconds"]["stages"].items()) stages += seconds.get<double>();
  EXPECT_GT(found["seconds"]["cpu"], 0);
  // The stages are all that takes time, yet a busy machine may pause the program between two of them.
  EXPECT_GT(stages, 0);
  EXPECT_LE(stages, found["seconds"]["total"].get<double>());
  EXPECT_GT(found["peak_rss_bytes"], 1 << 20);
  EXPECT_EQ(found["parameters"][key].get<double>(), std::stod(value));
  EXPECT_EQ(found["parameters"]["threads"], 2);
  EXPECT_FALSE(found["versions"].empty());
}

TEST_P(MesherProgram, RepeatsItselfWhereItSaysSo) {
  if (!adapter().deterministic) GTEST_SKIP() << "says that it does not";
  const fs::path image = write(two_boxes(false));
  ASSERT_EQ(run(job(image, "first.vtu")), kExitSuccess);
  MeshJob again = job(image, "second.vtu");
  again.threads = 1;
  ASSERT_EQ(run(again), kExitSuccess);
  EXPECT_EQ(content_of(folder_ / "first.vtu"), content_of(folder_ / "second.vtu"));
}

// More materials than a byte can number; the outer ones touch the image's border.
TEST_P(MesherProgram, KeepsMoreThan255Labels) {
  LabelImage image;
  image.frame.size = {36, 36, 24};
  image.voxels.assign(image.frame.voxel_count(), kBackground);
  const int blocks = 9 * 9 * 4;
  for (int block = 0; block < blocks; ++block) image.labels.push_back(100 + 3 * block);
  for (int k = 0; k < 24; ++k) {
    for (int j = 0; j < 36; ++j) {
      for (int i = 0; i < 36; ++i) {
        image.voxels[image.frame.offset(i, j, k)] =
            static_cast<MaterialId>(1 + i / 4 + 9 * (j / 4) + 81 * (k / 6));
      }
    }
  }
  const Parameters quick = known_of({{"perturb", "false"}, {"exude", "false"}});
  ASSERT_EQ(run(job(write(image), "mesh.vtu", quick)), kExitSuccess) << content_of(folder_ / "stderr");
  const std::vector<Label> labels = labels_of(read_mesh(folder_ / "mesh.vtu"));
  EXPECT_TRUE(std::equal(labels.begin(), labels.end(), image.labels.begin() + 1, image.labels.end()))
      << labels.size() << " of " << blocks << " labels";
}

TEST_P(MesherProgram, BadInputEndsWithTwoAReasonAndNoMesh) {
  const fs::path image = write(two_boxes(false));
  const std::string key = specs().front().key;
  const std::vector<MeshJob> bad{job(folder_ / "absent.nrrd", "mesh.vtu"), job(image, "mesh.stl"),
                                 job(image, "mesh.vtu", {{key, "much"}}),
                                 job(image, "mesh.vtu", {{key, "-1"}})};
  for (const MeshJob& wanted : bad) {
    fs::remove(wanted.report);
    EXPECT_EQ(run(wanted), kExitBadInput) << content_of(folder_ / "stderr");
    EXPECT_FALSE(fs::exists(wanted.mesh));
    EXPECT_EQ(report()["status"], "failed");
    EXPECT_NE(content_of(folder_ / "stderr").find(report()["reason"].get<std::string>()), std::string::npos);
  }
  auto argv = adapter().command(CBC3D_BIN_DIR, job(image, "mesh.vtu"));
  argv.emplace_back("--no-such-option");
  EXPECT_EQ(exit_code_of(argv, "2> /dev/null"), kExitBadInput);
}

TEST_P(MesherProgram, HelpNamesUnitAndDefaultOfEveryParameter) {
  const fs::path program = adapter().command(CBC3D_BIN_DIR, job("x", "y")).front();
  ASSERT_EQ(exit_code_of({program.string(), "--help"}, "> '" + (folder_ / "help").string() + "'"),
            kExitSuccess);
  const std::string help = content_of(folder_ / "help");
  for (const ParameterSpec& spec : specs()) {
    const std::size_t at = help.find("--" + spec.key + " ");
    ASSERT_NE(at, std::string::npos) << spec.key;
    EXPECT_NE(help.find("=" + spec.default_value, at), std::string::npos) << spec.key;
    EXPECT_NE(help.find(spec.unit, at), std::string::npos) << spec.key;
  }
}

INSTANTIATE_TEST_SUITE_P(Built, MesherProgram, ::testing::ValuesIn(built_meshers()), [](const auto& mesher) {
  std::string name = mesher.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

}  // namespace
}  // namespace cbc3d::baselines
