// What the registry says of cbc3d's parameters is what the program takes.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>

#include "baselines/registry.hpp"

namespace cbc3d::baselines {
namespace {

std::string output_of(const std::string& command) {
  std::FILE* pipe = ::popen(command.c_str(), "r");
  std::string text;
  std::array<char, 4096> buffer;
  while (std::fgets(buffer.data(), buffer.size(), pipe) != nullptr) text += buffer.data();
  EXPECT_EQ(::pclose(pipe), 0) << command;
  return text;
}

TEST(Cbc3dAdapter, TheProgramHasEveryParameterAndPreset) {
  const std::string help = output_of("'" CBC3D_BIN_DIR "/cbc3d' mesh --help");
  for (const char* name : {"cbc3d", "cbc3d-paper"}) {
    const Adapter& adapter = *find_adapter(name);
    EXPECT_TRUE(adapter.availability(CBC3D_BIN_DIR).available);
    for (const ParameterSpec& spec : adapter.parameters) {
      EXPECT_NE(help.find("--" + spec.key + " "), std::string::npos) << spec.key;
    }
  }
  EXPECT_NE(help.find("paper"), std::string::npos);
}

}  // namespace
}  // namespace cbc3d::baselines
