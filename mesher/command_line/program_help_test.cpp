#include "mesher/command_line/program_help.hpp"

#include <gtest/gtest.h>

#include "mesher/command_line/testing_program.hpp"

namespace cbc3d {
namespace {

/// What is printed by the program.
std::string printed(std::vector<std::string> arguments) {
  const auto app = testing::knife();
  add_program_help(*app, testing::knife_help());
  ::testing::internal::CaptureStdout();
  EXPECT_THROW(app->parse(arguments), CLI::Success);
  return ::testing::internal::GetCapturedStdout();
}

TEST(ProgramHelp, PrintsAManPageAndCompletions) {
  EXPECT_EQ(printed({"--man"}).rfind(".TH", 0), 0U);
  EXPECT_NE(printed({"bash", "--completion"}).find("complete -o filenames -F _bread_knife bread-knife"),
            std::string::npos);
  EXPECT_EQ(printed({"zsh", "--completion"}).rfind("#compdef bread-knife", 0), 0U);
  EXPECT_NE(printed({"fish", "--completion"}).find("complete -c bread-knife"), std::string::npos);
}

TEST(ProgramHelp, ShowsItsExamples) {
  const auto app = testing::knife();
  add_program_help(*app, testing::knife_help());
  EXPECT_NE(app->help().find("Examples:\n  bread-knife cut rye.loaf --thickness 9\n      Thick slices."),
            std::string::npos);
}

}  // namespace
}  // namespace cbc3d
