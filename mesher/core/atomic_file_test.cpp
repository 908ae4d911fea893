// Files are whole or absent.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
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

/// The limit of the files that this process writes, as long as it lives.
class FileLimit {
 public:
  explicit FileLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit lower{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &lower);
  }
  ~FileLimit() {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FileLimit(const FileLimit&) = delete;
  FileLimit& operator=(const FileLimit&) = delete;

 private:
  rlimit before_{};
  void (*handler_)(int);
};

std::string reason_of_writing(const std::filesystem::path& path, const std::string& text) {
  try {
    write_text_file(path, text);
  } catch (const WriteError& error) {
    return error.reason();
  }
  return "";
}

TEST(AtomicFile, SaysTrulyWhyAFileCannotBeWritten) {
  const testing::TemporaryFolder folder("atomic");
  {
    const FileLimit limit(1000);
    EXPECT_EQ(
        reason_of_writing(folder.file("a.txt"), std::string(2000, 'a')),
        "the file would be larger than the limit of 1000 bytes that this process has for files (ulimit -f); "
        "raise it");
  }
  EXPECT_EQ(files_in(folder), 0U);
  for (const auto& [error, reason] :
       {std::pair{ENOSPC, "the disk is full"}, std::pair{EDQUOT, "the disk quota"},
        std::pair{EIO, "Input/output error"}, std::pair{0, "the disk is full or"}}) {
    try {
      fail_to_write("a.txt", error);
    } catch (const WriteError& thrown) {
      EXPECT_TRUE(thrown.reason().starts_with(reason)) << thrown.what();
      EXPECT_EQ(thrown.what(), "cannot write 'a.txt': " + thrown.reason());
    }
  }
}

TEST(AtomicFile, WhatFillsItIsToldByItsFinalName) {
  const testing::TemporaryFolder folder("atomic");
  AtomicFile file(folder.file("a.txt"));
  try {
    file.fill([](const std::filesystem::path& temporary) { fail_to_write(temporary, ENOSPC); });
    FAIL() << "nothing was thrown";
  } catch (const WriteError& error) {
    EXPECT_TRUE(
        std::string(error.what()).starts_with("cannot write '" + folder.file("a.txt").string() + "': "));
  }
  file.fill([](const std::filesystem::path& temporary) { std::ofstream(temporary) << "whole"; });
  EXPECT_EQ(folder.content("a.txt"), "whole");
}

}  // namespace
}  // namespace cbc3d
