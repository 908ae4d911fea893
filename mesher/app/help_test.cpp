// The help of `cbc3d`: examples, man page and completions, which have every option of the table.
#include <gtest/gtest.h>

#include <algorithm>

#include "mesher/pipeline/option_table.hpp"
#include "mesher/testing/run_command.hpp"

namespace cbc3d {
namespace {

/// As a man page has what is typed.
std::string typed(const std::string& text) {
  std::string out;
  for (const char c : text) {
    out += c == '-' ? "\\-" : std::string(1, c);
  }
  return out;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(Help, ShowsThreeExamples) {
  const testing::Outcome outcome = testing::run_command("--help");
  EXPECT_EQ(outcome.exit_code, 0);
  const std::size_t begin = outcome.text.find("Examples:");
  ASSERT_NE(begin, std::string::npos) << outcome.text;
  EXPECT_EQ(std::count(outcome.text.begin() + static_cast<std::ptrdiff_t>(begin), outcome.text.end(), '\n'),
            7);
}

TEST(Help, EveryOptionIsInThePageAndTheCompletions) {
  const std::string page = testing::run_command("--man").text;
  const std::string bash = testing::run_command("--completion bash").text;
  const std::string zsh = testing::run_command("--completion zsh").text;
  const std::string fish = testing::run_command("--completion fish").text;
  for (const OptionRow& row : option_table()) {
    EXPECT_TRUE(has(page, "\\fB" + typed("--" + row.name) + "\\fR")) << row.name;
    EXPECT_TRUE(has(bash, " --" + row.name + " ")) << row.name;
    EXPECT_TRUE(has(zsh, "*--" + row.name + "[")) << row.name;
    EXPECT_TRUE(has(fish, " -l " + row.name + " ")) << row.name;
    for (const std::string& choice : row.choices) {
      EXPECT_TRUE(has(page, typed(choice))) << choice;
      EXPECT_TRUE(has(bash, choice) && has(fish, choice)) << choice;
    }
  }
}

TEST(Help, RefusesOtherShells) {
  EXPECT_EQ(testing::run_command("--completion csh").exit_code, 2);
}

}  // namespace
}  // namespace cbc3d
