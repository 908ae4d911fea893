// A child that behaves as its first argument says: exit CODE, crash, sleep, allocate, spawn PIDFILE, say
// TEXT, say-and-end CODE TEXT, env NAME, mesh OUT REPORT, tets OUT REPORT SIZE, solve ... OUT, and ill ways
// of meshing.
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "mesher/mesh_formats/mesh_io.hpp"

namespace {

void sleep_long() {
  std::this_thread::sleep_for(std::chrono::seconds(120));
}

/// Touches 640 MiB, 16 at a time, and then waits to be stopped.
int allocate() {
  std::vector<std::vector<char>> blocks;
  for (int n = 0; n < 40; ++n) {
    blocks.emplace_back(std::size_t{16} << 20, 'x');
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  sleep_long();
  return blocks.size() == 40 ? 0 : 1;
}

/// Leaves a grandchild sleeping and notes its id.
int spawn(const std::string& file, bool stay) {
  const pid_t process = ::fork();
  if (process == 0) {
    sleep_long();
    std::_Exit(0);
  }
  std::ofstream(file) << process << '\n' << std::flush;
  if (stay) {
    sleep_long();
  }
  return 0;
}

/// Leaves a process in a session of its own, sleeping.
int spawn_daemon(const std::string& file) {
  const pid_t process = ::fork();
  if (process == 0) {
    ::setsid();
    std::ofstream(file) << ::getpid() << '\n' << std::flush;
    sleep_long();
    std::_Exit(0);
  }
  while (!std::ifstream(file)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return 0;
}

/// Waits for a grandchild that allocates.
int spawn_allocate() {
  if (::fork() == 0) {
    std::_Exit(allocate());
  }
  sleep_long();
  return 0;
}

int write_tet(const std::string& mesh_file, const std::string& report_file, int label = 1) {
  cbc3d::Mesh mesh;
  mesh.points = {{0.5, 0.5, 0.5}, {6.5, 0.5, 0.5}, {0.5, 6.5, 0.5}, {0.5, 0.5, 6.5}};
  mesh.tets.add({0, 1, 2, 3}, label);
  cbc3d::write_mesh(mesh, mesh_file);
  std::ofstream(report_file)
      << R"({"status":"ok","reason":"","seconds":{"total":1.5,"cpu":1.25,"stages":{"all":1.5}},"peak_rss_bytes":99})";
  return 0;
}

/// 1000 / size^3 tets, but at least 20, apart from each other.
int write_tets(const std::string& mesh_file, double size) {
  cbc3d::Mesh mesh;
  const auto count = static_cast<unsigned>(std::max(20.0, std::floor(1000 / (size * size * size))));
  for (unsigned n = 0; n < count; ++n) {
    const double x = 1 + 5.0 * n / count, edge = 2.0 / count;
    for (const cbc3d::Vec3& corner : {cbc3d::Vec3{0, 0, 0}, {edge, 0, 0}, {0, edge, 0}, {0, 0, edge}}) {
      mesh.points.push_back(cbc3d::Vec3{x, 1, 1} + corner);
    }
    mesh.tets.add({4 * n, 4 * n + 1, 4 * n + 2, 4 * n + 3}, 1);
  }
  cbc3d::write_mesh(mesh, mesh_file);
  return 0;
}

/// A mesh file that stops in the middle.
int write_half_a_tet(const std::string& mesh_file, const std::string& report_file) {
  write_tet(mesh_file, report_file);
  std::filesystem::resize_file(mesh_file, std::filesystem::file_size(mesh_file) / 2);
  return 0;
}

int write_garbage(const std::string& mesh_file) {
  std::ofstream out(mesh_file, std::ios::binary);
  for (int n = 0; n < 4096; ++n) {
    out.put(static_cast<char>(n * 37 % 251));
  }
  return 0;
}

int fail(const std::string& report_file) {
  std::ofstream(report_file) << R"({"status":"failed","reason":"no room left on the lattice"})";
  return 3;
}

/// As cbc3d-solve: the figures go to the file that its last argument names.
int write_solver_figures(const std::string& file) {
  std::ofstream(file)
      << R"({"solver":{"poisson_p1":{"h1_relative":0.125},"poisson_p2":{"h1_relative":0.25}}})";
  return 0;
}

int say_and_end(int code, const std::string& text) {
  std::fprintf(stderr, "%s\n", text.c_str());
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string mode = argc > 1 ? argv[1] : "";
  const std::string first = argc > 2 ? argv[2] : "";
  if (mode == "exit") return std::stoi(first);
  if (mode == "sleep") return sleep_long(), 0;
  if (mode == "allocate") return allocate();
  if (mode == "spawn") return spawn(first, false);
  if (mode == "spawn-and-stay") return spawn(first, true);
  if (mode == "spawn-daemon") return spawn_daemon(first);
  if (mode == "spawn-allocate") return spawn_allocate();
  if (mode == "fail" && argc > 3) return fail(argv[3]);
  if (mode == "mesh" && argc > 3) return write_tet(first, argv[3]);
  if (mode == "tets" && argc > 4) return write_tets(first, std::stod(argv[4]));
  if (mode == "mesh-and-daemon" && argc > 3)
    return spawn_daemon(std::string(argv[3]) + ".pid"), write_tet(first, argv[3]);
  if (mode == "wrong-label" && argc > 3) return write_tet(first, argv[3], 99);
  if (mode == "truncated" && argc > 3) return write_half_a_tet(first, argv[3]);
  if (mode == "garbage") return write_garbage(first);
  if (mode == "say") return std::fprintf(stderr, "%s\n", first.c_str()) < 0;
  if (mode == "flood") {
    for (int n = 0; n < 20000; ++n) std::fprintf(stderr, "line %d of the flood\n", n);
    return 0;
  }
  if (mode == "env") {
    const char* value = std::getenv(first.c_str());
    return std::fprintf(stderr, "%s\n", value == nullptr ? "unset" : value) < 0;
  }
  if (mode == "solve") return write_solver_figures(argv[argc - 1]);
  if (mode == "say-and-end" && argc > 3) return say_and_end(std::stoi(first), argv[3]);
  if (mode == "crash") {
    std::fprintf(stderr, "about to crash\n");
    std::signal(SIGSEGV, SIG_DFL);
    std::raise(SIGSEGV);
  }
  return 2;
}
