#include "mesher/mesh_formats/file_text.hpp"

#include <gtest/gtest.h>

#include "mesher/core/error.hpp"
#include "mesher/testing/temporary_folder.hpp"

namespace cbc3d {
namespace {

class FileTextTest : public ::testing::Test {
 protected:
  FileText text(const std::string& bytes) {
    folder_.write("f", bytes);
    return FileText(folder_.file("f"));
  }
  testing::TemporaryFolder folder_{"text"};
};

TEST_F(FileTextTest, ReadsWordsNumbersAndLines) {
  FileText file = text("a  12\r\n +1.5D+1 rest of it\nlast");
  EXPECT_EQ(file.word(), "a");
  EXPECT_EQ(file.integer("n"), 12);
  EXPECT_EQ(file.real("n"), 15);
  EXPECT_EQ(file.line(), " rest of it");
  EXPECT_EQ(file.peek_word(), "last");
  EXPECT_EQ(file.word(), "last");
  EXPECT_EQ(file.word(), "");
  EXPECT_TRUE(file.at_end());
}

TEST_F(FileTextTest, NamesTheLineOfAFault) {
  FileText file = text("1\n2\nx\n");
  EXPECT_EQ(file.integer("ids") + file.integer("ids"), 3);
  try {
    file.integer("ids");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("line 3: 'x' stands for an integer of its ids"),
              std::string::npos)
        << error.what();
  }
}

TEST_F(FileTextTest, RefusesWhatIsNoFiniteNumberAndCountsBeyondTheFile) {
  for (const char* word : {"nan", "inf", "1e999", "1.2.3", "--1", ""}) {
    FileText file = text(word);
    EXPECT_THROW(file.real("points"), InputError) << word;
  }
  FileText file = text("1e-999 1000000000 -1");
  EXPECT_EQ(file.real("points"), 0) << "what is too small is nothing";
  EXPECT_THROW(file.count("points", 8), InputError);
  EXPECT_THROW(file.count("points", 8), InputError);
  EXPECT_THROW(file.bytes<double>("points"), InputError);
}

TEST_F(FileTextTest, FindsTheEndOfASection) {
  FileText file = text("$A\nx $EndA\n$EndA more\nnext");
  EXPECT_TRUE(file.skip_past_line("$EndA"));
  EXPECT_EQ(file.line(), "next");
  EXPECT_FALSE(file.skip_past_line("$EndA"));
}

}  // namespace
}  // namespace cbc3d
