#include "baselines/tetgen/child_process.hpp"

#include <gtest/gtest.h>

#include <csignal>
#include <cstring>
#include <new>
#include <numeric>
#include <stdexcept>

namespace cbc3d::baselines {
namespace {

TEST(ChildProcess, SendsBackMoreThanAPipeHolds) {
  std::vector<int> numbers(1 << 20);
  std::iota(numbers.begin(), numbers.end(), 0);
  const ChildResult child =
      run_in_child([&](const Send& send) { send(numbers.data(), numbers.size() * sizeof(int)); });
  EXPECT_EQ(child.exit_code, 0);
  EXPECT_EQ(child.signal, 0);
  ASSERT_EQ(child.output.size(), numbers.size() * sizeof(int));
  EXPECT_EQ(std::memcmp(child.output.data(), numbers.data(), child.output.size()), 0);
}

// Dies, as TetGen's library does, when an exception unwinds it.
struct FatalToUnwind {
  ~FatalToUnwind() { std::raise(SIGSEGV); }
};

TEST(ChildProcess, AnExceptionEndsItWithoutUnwinding) {
  const auto exit_code = [](auto thrown) {
    const ChildResult child = run_in_child([&](const Send&) {
      const FatalToUnwind guard;
      throw thrown;
    });
    EXPECT_EQ(child.signal, 0);
    return child.exit_code;
  };
  EXPECT_EQ(exit_code(3), kChildThrewNumber + 3);
  EXPECT_EQ(exit_code(std::bad_alloc()), kChildOutOfMemory);
  EXPECT_EQ(exit_code(std::runtime_error("other")), kChildThrew);
}

TEST(ChildProcess, ReportsTheSignalThatKilledIt) {
  const ChildResult child = run_in_child([](const Send&) { ::raise(SIGKILL); });
  EXPECT_EQ(child.signal, SIGKILL);
}

TEST(ChildProcess, ReportsAnExit) {
  const ChildResult child = run_in_child([](const Send&) { ::_Exit(7); });
  EXPECT_EQ(child.exit_code, 7);
}

}  // namespace
}  // namespace cbc3d::baselines
