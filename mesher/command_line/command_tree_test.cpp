#include "mesher/command_line/command_tree.hpp"

#include <gtest/gtest.h>

#include "mesher/command_line/testing_program.hpp"

namespace cbc3d {
namespace {

TEST(CommandTree, HasWhatTheParserHas) {
  const CommandTree tree = command_tree(*testing::knife(), "bread-knife");
  EXPECT_EQ(tree.name, "bread-knife");
  ASSERT_EQ(tree.commands.size(), 2U);
  const CommandTree& cut = tree.commands[0];
  EXPECT_EQ(cut.name, "cut");
  ASSERT_EQ(cut.options.size(), 6U);  // with --help, without the hidden one
  EXPECT_EQ(cut.options[0].flags, (std::vector<std::string>{"-h", "--help"}));
  EXPECT_TRUE(cut.options[0].value.empty());
  EXPECT_TRUE(cut.options[1].flags.empty());
  EXPECT_EQ(cut.options[1].value, "loaf");
  EXPECT_TRUE(cut.options[1].required);
  EXPECT_EQ(cut.options[2].flags, (std::vector<std::string>{"-t", "--thickness"}));
  EXPECT_EQ(cut.options[2].value, "MM");
  EXPECT_EQ(cut.options[2].group, "Slices");
  EXPECT_EQ(cut.options[3].choices, (std::vector<std::string>{"keep", "leave"}));
  EXPECT_EQ(cut.options[4].choices, (std::vector<std::string>{"oak", "beech"}));
  EXPECT_EQ(cut.options[4].value, "oak|beech");
  EXPECT_TRUE(cut.options[5].value.empty());
}

TEST(CommandTree, ClausesAreShort) {
  EXPECT_EQ(first_clause("of a slice [5]", 40), "of a slice");
  EXPECT_EQ(first_clause("cuts a loaf; it's sharp", 40), "cuts a loaf");
  EXPECT_EQ(first_clause("one two, three four", 10), "one two");
  EXPECT_EQ(first_clause("unbreakable", 5), "unbre");
  EXPECT_EQ(first_clause("", 5), "");
}

}  // namespace
}  // namespace cbc3d
