#include "reports/history/commit.hpp"

#include <gtest/gtest.h>

#include "mesher/core/error.hpp"
#include "mesher/testing/temporary_folder.hpp"
#include "reports/history/testing_history.hpp"
#include "reports/run/child_process.hpp"

namespace cbc3d::reports {
namespace {

using cbc3d::testing::TemporaryFolder;
using test::history_line;

constexpr const char* kHash = "0123456789abcdef0123456789abcdef01234567";

std::vector<JobResult> results_of_build(const std::string& hash, bool dirty = false,
                                        const std::string& mesher = "cbc3d") {
  Json line = history_line(1, 0, mesher);
  line["provenance"]["git_commit"] = hash;
  line["provenance"]["git_commit_date"] = "2026-02-03T05:00:00+01:00";
  line["provenance"]["git_dirty"] = dirty;
  return decode_lines({line});
}

std::string refusal(const std::vector<JobResult>& results, const GivenCommit& given,
                    const std::filesystem::path& folder) {
  try {
    return "found " + find_commit(results, given, folder).commit.name;
  } catch (const InputError& error) {
    return error.what();
  }
}

class CommitTest : public ::testing::Test {
 protected:
  bool git(std::vector<std::string> arguments) const {
    arguments.insert(arguments.begin(),
                     {"env", "GIT_COMMITTER_DATE=2026-01-02T03:04:05Z", "git", "-C", folder_.path(), "-c",
                      "user.name=T", "-c", "user.email=t@example.org"});
    const ChildResult child = run_child({arguments, 0, 0, 0});
    return child.end == ChildEnd::exited && child.exit_code == 0;
  }
  bool make_work_tree() const {
    folder_.write("file", "one");
    return git({"init", "-q"}) && git({"add", "file"}) && git({"commit", "-q", "-m", "one"}) &&
           git({"tag", "v1.0"});
  }
  TemporaryFolder folder_;
};

TEST_F(CommitTest, IsThatOfTheBuildInTheResults) {
  const FoundCommit found = find_commit(results_of_build(kHash), {}, folder_.path());
  EXPECT_EQ(found.commit.name, kHash);
  EXPECT_EQ(found.commit.date, "2026-02-03T04:00:00Z");
  EXPECT_EQ(found.from, "the results' provenance");
}

TEST_F(CommitTest, GivenByNameAndDateGoesFirst) {
  const FoundCommit found =
      find_commit(results_of_build(kHash, true), {"r1234", "2026-05-06"}, folder_.path());
  EXPECT_EQ(found.commit.name, "r1234");
  EXPECT_EQ(found.commit.date, "2026-05-06T00:00:00Z");
}

TEST_F(CommitTest, WithoutADateHasThatOfTheFirstRun) {
  const FoundCommit found = find_commit(results_of_build(kHash), {"r1234", ""}, folder_.path());
  EXPECT_EQ(found.commit.date, "2026-01-01T00:00:00Z");
  EXPECT_NE(found.date_from.find("the first run"), std::string::npos);
}

TEST_F(CommitTest, OfAMesherFromOutsideIsThatOfTheFolder) {
  if (!make_work_tree()) {
    GTEST_SKIP() << "git is not installed";
  }
  const auto outside = results_of_build(kHash, false, "external:mytool");
  const FoundCommit found = find_commit(outside, {}, folder_.path());
  EXPECT_EQ(found.commit.name.size(), 40U);
  EXPECT_NE(found.commit.name, kHash);
  EXPECT_EQ(found.commit.date, "2026-01-02T03:04:05Z");
  const FoundCommit tagged = find_commit(outside, {"v1.0", ""}, folder_.path());
  EXPECT_EQ(tagged.commit.name, found.commit.name) << "git knows the tag";
  EXPECT_EQ(find_commit(outside, {found.commit.name.substr(0, 8), ""}, folder_.path()).commit.name,
            found.commit.name);
  folder_.write("file", "two");
  EXPECT_NE(refusal(outside, {}, folder_.path()).find("differ from commit"), std::string::npos);
}

TEST_F(CommitTest, RefusesWhatIsNoStateOfTheSources) {
  EXPECT_NE(refusal(results_of_build(kHash, true), {}, folder_.path()).find("differ from commit 0123"),
            std::string::npos);
  EXPECT_NE(refusal(results_of_build("unknown"), {}, folder_.path()).find("give --commit NAME"),
            std::string::npos);
  EXPECT_NE(refusal(results_of_build("../../etc/x"), {}, folder_.path()).find("which is no commit"),
            std::string::npos);
  std::vector<JobResult> two = results_of_build(kHash);
  two.push_back(results_of_build("abcdef").front());
  EXPECT_NE(refusal(two, {}, folder_.path()).find("builds of several commits"), std::string::npos);
}

TEST_F(CommitTest, RefusesNamesThatAreNoneAndDatesThatAreNone) {
  for (const char* name : {"../x", "a/b", "-x", ".x", "a b", "a;b"}) {
    EXPECT_NE(refusal(results_of_build(kHash), {name, ""}, folder_.path()).find("--commit '"),
              std::string::npos)
        << name;
  }
  EXPECT_NE(refusal(results_of_build(kHash), {"a", "soon"}, folder_.path()).find("--date 'soon'"),
            std::string::npos);
}

}  // namespace
}  // namespace cbc3d::reports
