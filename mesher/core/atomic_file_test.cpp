// Files are whole or absent.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"
#include "mesher/testing/temporary_folder.hpp"

namespace cbc3d {
namespace {

std::size_t files_in(const testing::TemporaryFolder& folder) {
  std::size_t count = 0;
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(folder.path())) ++count;
  return count;
}

TEST(AtomicFile, AppearsWithTheCommitAndLeavesNoOther) {
  const testing::TemporaryFolder folder("atomic");
  {
    AtomicFile file(folder.file("a.txt"));
    std::ofstream(file.temporary()) << "whole";
    EXPECT_FALSE(std::filesystem::exists(folder.file("a.txt")));
    file.commit();
  }
  EXPECT_EQ(folder.content("a.txt"), "whole");
  EXPECT_EQ(files_in(folder), 1U);
}

TEST(AtomicFile, WithoutACommitWhatWasThereStays) {
  const testing::TemporaryFolder folder("atomic");
  folder.write("a.txt", "before");
  {
    const AtomicFile file(folder.file("a.txt"));
    std::ofstream(file.temporary()) << "half";
  }
  EXPECT_EQ(folder.content("a.txt"), "before");
  EXPECT_EQ(files_in(folder), 1U);
}

TEST(AtomicFile, RefusesAbsentFoldersAndFoldersThemselves) {
  const testing::TemporaryFolder folder("atomic");
  EXPECT_THROW(AtomicFile(folder.path() / "absent" / "a.txt"), InputError);
  EXPECT_THROW(require_writable(folder.path()), InputError);
  EXPECT_NO_THROW(require_writable(folder.file("a.txt")));
  EXPECT_EQ(files_in(folder), 0U);  // the trial leaves nothing
}

TEST(AtomicFile, TextIsWrittenAsItIsOverWhatWasThere) {
  const testing::TemporaryFolder folder("atomic");
  folder.write("a.txt", "something longer than what follows");
  const std::string text("two\nlines\0and a zero", 20);
  write_text_file(folder.file("a.txt"), text);
  EXPECT_EQ(folder.content("a.txt"), text);
  EXPECT_THROW(write_text_file(folder.path() / "absent" / "a.txt", text), InputError);
}

}  // namespace
}  // namespace cbc3d
