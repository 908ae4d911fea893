#include "mesher/command_line/man_page.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "mesher/command_line/testing_program.hpp"
#include "mesher/testing/temporary_folder.hpp"

namespace cbc3d {
namespace {

std::string page() {
  return man_page(command_tree(*testing::knife(), "bread-knife"), testing::knife_help());
}

TEST(ManPage, HasItsSectionsAndOptions) {
  const std::string text = page();
  for (const char* part :
       {".TH \"BREAD\\-KNIFE\" 1 \"\" \"bread-knife 1.2\"", ".SH NAME\nbread\\-knife \\- cuts bread\n",
        ".SH SYNOPSIS\n", ".SS bread\\-knife cut\n", "Slices:\n",
        "\\fB\\-t\\fR, \\fB\\-\\-thickness\\fR \\fIMM\\fR\nof a slice [5]\n",
        "\\fIoak|beech\\fR\n (required)", "keep them: \\e and [those]", ".SH EXIT STATUS\n", "no bread",
        ".SH EXAMPLES\n.TP\n\\fBbread\\-knife cut rye.loaf \\-\\-thickness 9\\fR\nThick slices.\n"}) {
    EXPECT_NE(text.find(part), std::string::npos) << part << " is not in\n" << text;
  }
  EXPECT_EQ(text.find("secret"), std::string::npos);
}

TEST(ManPage, GroffHasNothingToSay) {
  if (std::system("command -v groff >/dev/null 2>&1") != 0) {
    GTEST_SKIP() << "groff is not installed";
  }
  const testing::TemporaryFolder folder("man");
  const std::string path = (folder.path() / "page.1").string(), log = (folder.path() / "log").string();
  std::ofstream(path) << page();
  EXPECT_EQ(std::system(("groff -man -Tutf8 -ww " + path + " >/dev/null 2>" + log).c_str()), 0);
  std::ifstream said(log);
  const std::string text{std::istreambuf_iterator<char>(said), {}};
  EXPECT_TRUE(text.empty()) << text;
}

}  // namespace
}  // namespace cbc3d
