// Runs the command `cbc3d` as a user would.
#pragma once

#include <sys/wait.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace cbc3d::testing {

struct Outcome {
  int exit_code;
  std::string text;  ///< both streams
};

/// `folder` becomes its working directory; empty: that of the test.
inline Outcome run_command(const std::string& arguments, const std::filesystem::path& folder = {}) {
  const std::string place = folder.empty() ? "" : "cd '" + folder.string() + "' && ";
  const std::string command = place + CBC3D_COMMAND + " " + arguments + " 2>&1";
  std::FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) return {.exit_code = 127, .text = "the shell could not be started"};
  std::string text;
  std::array<char, 4096> buffer;
  while (std::fgets(buffer.data(), buffer.size(), pipe) != nullptr) {
    text += buffer.data();
  }
  return {WEXITSTATUS(::pclose(pipe)), text};
}

inline std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream all;
  all << in.rdbuf();
  return all.str();
}

}  // namespace cbc3d::testing
