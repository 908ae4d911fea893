// cbc3d-solve as a program: its figures against those of another solver, its messages, its bytes.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "mesher/mesh_formats/mesh_io.hpp"
#include "metrics/solver/testing.hpp"

namespace cbc3d::solver {
namespace {

struct Outcome {
  int exit_code;
  std::string output;
};

Outcome run(const std::string& command) {
  std::FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return {-1, "the shell could not be started"};
  std::string output;
  std::array<char, 4096> buffer{};
  while (const std::size_t count = std::fread(buffer.data(), 1, buffer.size(), pipe)) {
    output.append(buffer.data(), count);
  }
  const int status = ::pclose(pipe);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, output};
}

class Program : public ::testing::Test {
 protected:
  Program()
      : folder_(std::filesystem::path(::testing::TempDir()) /
                (std::string("solve-") + ::testing::UnitTest::GetInstance()->current_test_info()->name())) {
    std::filesystem::create_directories(folder_);
  }
  ~Program() override { std::filesystem::remove_all(folder_); }

  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  std::string written(const Mesh& mesh) const {
    write_mesh(mesh, file("mesh.vtu"));
    return file("mesh.vtu");
  }
  static Outcome solve(const std::string& arguments) {
    return run(std::string(CBC3D_SOLVE) + " --quiet " + arguments + " 2>&1");
  }

 private:
  std::filesystem::path folder_;
};

/// The mesh as the script reads it, and the box of the exact field.
std::string write_for_sfepy(const Mesh& mesh, const std::string& path) {
  std::ofstream out(path);
  out.precision(17);
  out << mesh.points.size() << ' ' << mesh.tets.size() << '\n';
  for (const Vec3& p : mesh.points) {
    out << p.x << ' ' << p.y << ' ' << p.z << '\n';
  }
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    for (const VertexId v : mesh.tets.nodes[t]) {
      out << v << ' ';
    }
    out << mesh.tets.labels[t] << '\n';
  }
  return path;
}

struct Compared {
  const char* name;
  Mesh mesh;
  Vec3 lower;
  double side;
};

std::vector<Compared> compared_meshes() {
  std::vector<double> radii{0};
  std::vector<Label> labels;
  test::append_radii(radii, labels, 30, 3, 1);
  test::append_radii(radii, labels, 40, 1, 2);
  test::append_radii(radii, labels, 50, 1, 3);
  Mesh flat = test::cube_of_tets(4, .2);
  for (Vec3& p : flat.points) {
    p.z *= .1;
  }
  return {{"distorted cube", test::cube_of_tets(6, .2), {0, 0, 0}, 1},
          {"layered ball", test::layered_ball(2, radii, labels), {-50, -50, -50}, 100},
          {"flat cube", flat, {0, 0, 0}, 1}};
}

TEST_F(Program, AgreesWithSfepyToThreeDigits) {
  constexpr const char* kPython = "/usr/bin/python3";
  if (run(std::string(kPython) + " -c 'import sfepy' 2>/dev/null").exit_code != 0) {
    GTEST_SKIP() << "python3-sfepy is not installed";
  }
  for (const Compared& compared : compared_meshes()) {
    std::ostringstream box, frame;
    const Vec3 upper = compared.lower + compared.side * Vec3{1, 1, 1};
    box << compared.lower.x << ',' << compared.lower.y << ',' << compared.lower.z << ',' << upper.x << ','
        << upper.y << ',' << upper.z;
    frame << compared.lower.x << ' ' << compared.lower.y << ' ' << compared.lower.z << ' ' << compared.side;
    const Outcome ours = solve(written(compared.mesh) + " --box=" + box.str());
    ASSERT_EQ(ours.exit_code, 0) << ours.output;
    const auto figures = nlohmann::json::parse(ours.output)["solver"];
    for (const int order : {1, 2}) {
      const Outcome theirs = run(std::string(kPython) + " " + CBC3D_SFEPY_SCRIPT + " " +
                                 write_for_sfepy(compared.mesh, file("mesh.txt")) + " " +
                                 std::to_string(order) + " " + frame.str());
      double h1 = 0, l2 = 0;
      std::size_t unknowns = 0;
      ASSERT_TRUE(std::istringstream(theirs.output) >> h1 >> l2 >> unknowns) << theirs.output;
      const auto& own = figures["poisson_p" + std::to_string(order)];
      EXPECT_NEAR(own["h1_relative"].get<double>() / h1, 1, 5e-4) << compared.name << ", order " << order;
      EXPECT_NEAR(own["l2_relative"].get<double>() / l2, 1, 5e-4) << compared.name << ", order " << order;
      EXPECT_EQ(own["unknowns"].get<std::size_t>(), unknowns) << compared.name << ", order " << order;
    }
  }
}

TEST_F(Program, WritesTheSameFiguresAtAnyThreadCount) {
  const std::string mesh = written(test::cube_of_all_kinds(6, .1));
  const std::string problems = " --problem poisson elasticity --json ";
  ASSERT_EQ(solve(mesh + " --threads 1" + problems + file("1.json")).exit_code, 0);
  ASSERT_EQ(solve(mesh + " --threads 3" + problems + file("3.json")).exit_code, 0);
  const auto read = [&](const char* name) {
    std::ifstream in(file(name));
    return nlohmann::json::parse(in);
  };
  const auto report = read("1.json");
  EXPECT_EQ(report["solver"].dump(), read("3.json")["solver"].dump());
  for (const char* problem : {"poisson_p1", "poisson_p2", "elasticity_p1", "elasticity_p2"}) {
    for (const char* key : {"h1_relative", "l2_relative", "unknowns", "cg_iterations", "lambda_max"}) {
      EXPECT_GT(report["solver"][problem][key].get<double>(), 0) << problem << key;
    }
  }
  EXPECT_EQ(report["solver"]["box_from"], "mesh");
}

TEST_F(Program, SaysInOneLineWhatIsWrong) {
  const std::string mesh = written(test::cube_of_tets(2));
  const std::vector<std::pair<std::string, std::string>> wrong{
      {file("absent.vtu"), "absent.vtu"},
      {mesh + " --conductivity 1:3", "--conductivity 1:3: not of the form LABEL=NUMBER"},
      {mesh + " --conductivity 1=-3", "is not positive"},
      {mesh + " --box=0,0,0,0,0,0", "no extent"},
      {mesh + " --problem dipole-sphere", "--layer LABEL=RADIUS_MM"},
      {mesh + " --problem dipole-sphere --layer 1=1 2=2 --conductivity 1=1", "label 2"},
      {mesh + " --problem pressurised-sphere --layer 1=1 2=2", "--cavity-radius"},
      {mesh + " --problem elasticity --poisson-ratio 1=.5", "must be positive, the second in (-1, .5)"},
      {mesh + " --json " + file("no/folder.json"), "folder"}};
  for (const auto& [arguments, message] : wrong) {
    const Outcome outcome = solve(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << arguments;
    EXPECT_NE(outcome.output.find(message), std::string::npos) << arguments << "\n" << outcome.output;
    EXPECT_EQ(std::count(outcome.output.begin(), outcome.output.end(), '\n'), 1) << outcome.output;
  }
  EXPECT_EQ(solve("--order 3 " + mesh).exit_code, 2);
  EXPECT_EQ(solve("--help").exit_code, 0);
}

}  // namespace
}  // namespace cbc3d::solver
