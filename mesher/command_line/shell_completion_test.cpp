#include "mesher/command_line/shell_completion.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "mesher/command_line/testing_program.hpp"
#include "mesher/testing/temporary_folder.hpp"

namespace cbc3d {
namespace {

class ShellCompletion : public ::testing::TestWithParam<std::string> {
 protected:
  /// A file with the completion for a shell.
  std::string script(const std::string& shell) {
    const std::string path = (folder_.path() / shell).string();
    std::ofstream(path) << shell_completion(command_tree(*testing::knife(), "bread-knife"), shell);
    return path;
  }

  testing::TemporaryFolder folder_{"completion"};
};

/// What bash offers for the words, the last of which is being typed.
std::string offered(const std::string& script, const std::string& words, int last) {
  const std::string command = "bash -c 'source " + script + "; COMP_WORDS=(" + words +
                              "); COMP_CWORD=" + std::to_string(last) +
                              "; _bread_knife; echo ${COMPREPLY[@]}'";
  std::FILE* pipe = ::popen(command.c_str(), "r");
  char text[1024] = "";
  const std::size_t length = std::fread(text, 1, sizeof text - 1, pipe);
  ::pclose(pipe);
  return {text, length};
}

TEST_F(ShellCompletion, BashOffersCommandsOptionsAndChoices) {
  const std::string path = script("bash");
  EXPECT_EQ(offered(path, "bread-knife s", 1), "sharpen\n");
  EXPECT_EQ(offered(path, "bread-knife \"\"", 1), "cut sharpen -h --help\n");
  EXPECT_EQ(offered(path, "bread-knife cut --cr", 2), "--crust --crumbs\n");
  EXPECT_EQ(offered(path, "bread-knife cut --crust \"\"", 3), "keep leave\n");
  EXPECT_EQ(offered(path, "bread-knife cut --board o", 3), "oak\n");
  EXPECT_EQ(offered(path, "bread-knife cut " + path.substr(0, path.size() - 1), 2), path + "\n");
}

TEST_P(ShellCompletion, NamesEveryFlagAndIsUnderstood) {
  const std::string& shell = GetParam();
  const std::string text = shell_completion(command_tree(*testing::knife(), "bread-knife"), shell);
  for (const char* name : {"cut", "sharpen", "thickness", "crust", "board", "crumbs", "keep", "beech"}) {
    EXPECT_NE(text.find(name), std::string::npos) << name;
  }
  EXPECT_EQ(text.find("secret"), std::string::npos);
  if (std::system(("command -v " + shell + " >/dev/null 2>&1").c_str()) != 0) {
    GTEST_SKIP() << shell << " is not installed; its script is not read by it";
  }
  EXPECT_EQ(std::system((shell + " -n " + script(shell)).c_str()), 0);
}

INSTANTIATE_TEST_SUITE_P(All, ShellCompletion, ::testing::ValuesIn(completed_shells()),
                         [](const auto& shell) { return shell.param; });

}  // namespace
}  // namespace cbc3d
