#include "mesher/core/child_process.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <csignal>
#include <cstring>
#include <stdexcept>
#include <vector>

namespace cbc3d {
namespace {

constexpr ChildLimits kLimits{.memory_bytes = std::uint64_t{1} << 28U, .cpu_seconds = 2};

TEST(ChildProcess, SendsWhatItFinds) {
  ChildProcess child(kLimits, [](const ChildOutput& out) {
    const std::vector<int> numbers(100000, 7);
    out.write(std::as_bytes(std::span(numbers)));
  });
  std::vector<int> got(100000);
  ASSERT_TRUE(child.read(std::as_writable_bytes(std::span(got))));
  EXPECT_EQ(got, std::vector<int>(100000, 7));
  int more = 0;
  EXPECT_FALSE(child.read(std::as_writable_bytes(std::span(&more, 1))));
  EXPECT_EQ(child.wait(), "");
}

TEST(ChildProcess, ItsEndIsToldAndNothingElseEnds) {
  ChildProcess crash(kLimits, [](const ChildOutput&) { ::raise(SIGSEGV); });
  EXPECT_EQ(crash.wait(), "signal " + std::to_string(SIGSEGV));
  ChildProcess exception(kLimits, [](const ChildOutput&) { throw std::runtime_error("no"); });
  EXPECT_EQ(exception.wait(), "an exception");
  ChildProcess endless({.memory_bytes = kLimits.memory_bytes, .cpu_seconds = 1}, [](const ChildOutput&) {
    for (std::atomic<unsigned> n = 0;; ++n) {
    }
  });
  EXPECT_EQ(endless.wait(), "it takes too long");
}

#ifndef __SANITIZE_ADDRESS__
TEST(ChildProcess, HasNoMoreMemoryThanItMay) {
  ChildProcess child(kLimits, [](const ChildOutput&) {
    std::vector<char> much(std::size_t{1} << 30U);
    std::memset(much.data(), 1, much.size());
  });
  EXPECT_EQ(child.wait(), "an exception");
}
#endif

}  // namespace
}  // namespace cbc3d
