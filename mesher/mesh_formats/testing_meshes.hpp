// Labelled meshes, what they measure, and what programs that are not ours say of their files.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "mesher/core/mesh.hpp"
#include "mesher/testing/kuhn_box.hpp"

namespace cbc3d::testing {

/// n cubes along each axis, of half a unit; label 7 below x = n / 4, label 3 above it.
inline Mesh two_label_box(int n) {
  const KuhnBox box(n);
  Mesh mesh;
  mesh.points = box.points;
  for (Vec3& p : mesh.points) p *= 0.5;
  for (std::size_t t = 0; t < box.tets.size(); ++t) {
    mesh.tets.add(box.tets[t], box.centroid(t).x < 0.5 * n ? 7 : 3);
  }
  return mesh;
}

/// The tets' volume by label.
inline std::map<Label, double> tet_volumes(const Mesh& mesh) {
  std::map<Label, double> volumes;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto& n = mesh.tets.nodes[t];
    volumes[mesh.tets.labels[t]] +=
        six_volumes(mesh.points[n[0]], mesh.points[n[1]], mesh.points[n[2]], mesh.points[n[3]]) / 6;
  }
  return volumes;
}

struct ProgramOutcome {
  int exit_code;
  std::string text;  ///< both streams
};

inline ProgramOutcome run_program(const std::string& command) {
  std::FILE* const pipe = ::popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return {.exit_code = 127, .text = "the shell could not be started"};
  std::string text;
  std::array<char, 4096> buffer;
  while (std::fgets(buffer.data(), buffer.size(), pipe) != nullptr) text += buffer.data();
  return {WEXITSTATUS(::pclose(pipe)), text};
}

inline bool has_program(const std::string& name) {
  return run_program("command -v " + name).exit_code == 0;
}

inline bool has_meshio() {
  return run_program("/usr/bin/python3 -c 'import meshio'").exit_code == 0;
}

/// What meshio reads of a file (reopen.py).
inline nlohmann::json reopened(const std::string& file) {
  const ProgramOutcome outcome = run_program("/usr/bin/python3 " CBC3D_REOPEN " '" + file + "'");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.text;
  const std::size_t begin = outcome.text.find("{\"points\"");
  return begin == std::string::npos ? nlohmann::json() : nlohmann::json::parse(outcome.text.substr(begin));
}

/// Expects the labels' volumes of a file as meshio has them.
inline void expect_volumes(const nlohmann::json& found, const Mesh& mesh) {
  const auto expected = tet_volumes(mesh);
  ASSERT_EQ(found["volumes"].size(), expected.size()) << found;
  for (const auto& [label, volume] : expected) {
    EXPECT_NEAR(found["volumes"].value(std::to_string(label), 0.0), volume, 1e-9 * volume) << found;
  }
}

}  // namespace cbc3d::testing
