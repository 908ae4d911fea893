#include "reports/run/provenance.hpp"

#include <gtest/gtest.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <ctime>
#include <regex>

namespace cbc3d::reports {
namespace {

TEST(Provenance, HasEveryKeyOfALine) {
  const Json origin = provenance();
  for (const char* key :
       {"cbc3d_version", "git_commit", "git_commit_date", "git_dirty", "compiler", "compiler_flags",
        "build_type", "libraries", "cpu", "cores", "memory_bytes", "system", "load_1min", "utc"}) {
    EXPECT_TRUE(origin.contains(key) && !origin[key].is_null()) << key;
  }
  EXPECT_TRUE(std::regex_match(origin["cbc3d_version"].get<std::string>(), std::regex(R"(\d+\.\d+\.\d+)")));
  for (const char* library : {"itk", "vtk"}) {
    EXPECT_TRUE(
        std::regex_match(origin["libraries"][library].get<std::string>(), std::regex(R"(\d+\.\d+.*)")))
        << library;
  }
}

TEST(Provenance, NamesThisMachine) {
  const Json origin = provenance();
  utsname names{};
  ASSERT_EQ(::uname(&names), 0);
  EXPECT_EQ(origin["system"], std::string(names.sysname) + " " + names.release + " " + names.machine);
  EXPECT_EQ(origin["memory_bytes"].get<std::int64_t>() % ::sysconf(_SC_PAGESIZE), 0);
  EXPECT_GE(origin["cores"].get<int>(), 1);
}

TEST(Provenance, TheTimeIsNowInUtc) {
  const std::time_t before = std::time(nullptr);
  const std::string text = utc_now();
  const std::time_t after = std::time(nullptr);
  std::tm parsed{};
  ASSERT_NE(::strptime(text.c_str(), "%Y-%m-%dT%H:%M:%SZ", &parsed), nullptr) << text;
  const std::time_t told = ::timegm(&parsed);
  EXPECT_GE(told, before);
  EXPECT_LE(told, after);
}

}  // namespace
}  // namespace cbc3d::reports
