// Files that are cut short or changed: a mesh or one line, never a crash.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <string>

#include "mesher/core/error.hpp"
#include "mesher/core/mesh.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"

namespace cbc3d::testing {

/// Reads the text cut at many places, each of which must be refused in one line that names the file, and with
/// changed bytes, which must end in a mesh or such a line. Returns what is wrong, empty where nothing is. A
/// cut that takes no more than the last two bytes away may be read.
inline std::string damage_taken(const std::string& text, const std::filesystem::path& file,
                                Mesh (*read)(const std::filesystem::path&, const ReadMeshOptions&,
                                             MeshFileOptions&)) {
  const auto refusal_of = [&](const std::string& bytes) -> std::string {
    std::ofstream(file, std::ios::binary) << bytes;
    try {
      MeshFileOptions stated;
      read(file, ReadMeshOptions{}, stated);
      return "";
    } catch (const InputError& error) {
      const std::string line = error.what();
      EXPECT_EQ(line.find('\n'), std::string::npos) << line;
      EXPECT_NE(line.find(file.filename().string()), std::string::npos) << line;
      return line;
    }
  };
  const std::size_t step = std::max<std::size_t>(1, text.size() / 300);
  for (std::size_t length = 0; length + 2 < text.size(); length += step) {
    if (refusal_of(text.substr(0, length)).empty()) return "taken when cut at byte " + std::to_string(length);
  }
  std::mt19937 random(7);
  for (int n = 0; n < 300; ++n) {
    std::string damaged = text;
    damaged[random() % text.size()] = static_cast<char>(random() % 256);
    static_cast<void>(refusal_of(damaged));
  }
  return "";
}

}  // namespace cbc3d::testing
