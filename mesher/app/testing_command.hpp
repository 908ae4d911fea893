// A folder of its own for each test, in which it runs the command.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "mesher/testing/run_command.hpp"
#include "mesher/testing/temporary_folder.hpp"

namespace cbc3d::testing {

class CommandTest : public ::testing::Test {
 protected:
  [[nodiscard]] std::string at(const std::string& name) const { return (folder_ / name).string(); }

  /// Expects exit 2, one line with the text on the fault and no file of the name given.
  void expect_refusal(const std::string& arguments, const std::string& text,
                      const std::string& output) const {
    const Outcome outcome = run_command(arguments + " --quiet");
    EXPECT_EQ(outcome.exit_code, 2) << outcome.text;
    EXPECT_NE(outcome.text.find(text), std::string::npos) << outcome.text;
    EXPECT_EQ(std::count(outcome.text.begin(), outcome.text.end(), '\n'), 1) << outcome.text;
    EXPECT_FALSE(std::filesystem::exists(folder_ / output));
  }

  TemporaryFolder temporary_{"command"};
  std::filesystem::path folder_ = temporary_.path();
};

}  // namespace cbc3d::testing
