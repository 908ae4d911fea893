// Values that no option takes: one short line at once, before any file is read.
#include <gtest/gtest.h>

#include "mesher/pipeline/option_table.hpp"
#include "mesher/testing/option_walk.hpp"
#include "mesher/testing/run_command.hpp"

namespace cbc3d {
namespace {

testing::Outcome run(const std::string& command, const std::string& flag, const std::string& value) {
  return testing::run_command(command + " " + flag + " '" + value + "'");
}

TEST(OptionRanges, NoOptionTakesWhatIsNoNumberOrFarTooLarge) {
  const auto options = testing::options_with_values(testing::run_command("--completion fish").text);
  int of_table = 0;
  for (const OptionRow& row : option_table()) of_table += row.kind == OptionKind::on_off ? 0 : 1;
  EXPECT_GT(testing::expect_bad_values_refused(options, run), of_table + 20);
}

TEST(OptionRanges, TheLineHasTheRange) {
  EXPECT_EQ(run("tile", "--threads", "99999999").text,
            "cbc3d: --threads: 99999999: give a whole number from 0 to 1024 (see --help)\n");
  EXPECT_EQ(run("tile", "--spacing", "1,0,1").text,
            "cbc3d: --spacing: 0: give a number from 1e-06 to 1000000 (see --help)\n");
  EXPECT_EQ(run("segment", "--label", "3000000000").text,
            "cbc3d: --label: 3000000000: give a whole number from -2147483648 to 2147483647 (see --help)\n");
  const std::string table = run("mesh", "--lattice-spacing", std::string(300, '9')).text;
  EXPECT_EQ(table, "cbc3d: --lattice-spacing " + std::string(37, '9') + "...: give a number in (0, 1e+09]\n");
}

}  // namespace
}  // namespace cbc3d
