// Every option of a program that takes a value, from what the program itself says, and values that none
// takes.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

namespace cbc3d::testing {

struct ValuedOption {
  std::string command, flag;
};

/// From the completion for fish, which has a line for each option, with -r or -x where it takes a value.
inline std::vector<ValuedOption> options_with_values(const std::string& fish_script) {
  const std::string command_mark = "__fish_seen_subcommand_from ";
  std::vector<ValuedOption> options;
  std::istringstream lines(fish_script);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t command = line.find(command_mark), flag = line.find(" -l "), text = line.find(" -d ");
    const bool takes_value = std::min(line.find(" -r"), line.find(" -x")) < std::min(text, line.size());
    if (command == std::string::npos || flag == std::string::npos || !takes_value) continue;
    const std::size_t from = command + command_mark.size();
    options.push_back({line.substr(from, line.find_first_of("' ", from) - from),
                       "--" + line.substr(flag + 4, line.find(' ', flag + 4) - flag - 4)});
  }
  return options;
}

/// Gives every option values that no number is, and expects exit 2 and one short line; of options that check
/// their value the line names the option. Returns how many those are. `run` takes a command, a flag and a
/// value and returns an outcome with `exit_code` and `text`.
template <typename Run>
int expect_bad_values_refused(const std::vector<ValuedOption>& options, const Run& run) {
  int checked = 0;
  for (const auto& [command, flag] : options) {
    const bool is_checked = run(command, flag, "x").text.find(flag) != std::string::npos;
    checked += is_checked ? 1 : 0;
    for (const std::string& value : {std::string("nan"), std::string("1e300"), std::string(300, '9')}) {
      const auto outcome = run(command, flag, value);
      SCOPED_TRACE(command + " " + flag + " " + value.substr(0, 10) + "\n" + outcome.text);
      EXPECT_EQ(outcome.exit_code, 2);
      EXPECT_EQ(std::count(outcome.text.begin(), outcome.text.end(), '\n'), 1);
      EXPECT_LT(outcome.text.size(), 250U);
      EXPECT_TRUE(!is_checked || outcome.text.find(flag) != std::string::npos);
    }
  }
  return checked;
}

}  // namespace cbc3d::testing
