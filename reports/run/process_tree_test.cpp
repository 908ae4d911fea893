#include "reports/run/process_tree.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <vector>

namespace cbc3d::reports {
namespace {

constexpr std::int64_t kTouchedBytes = std::int64_t{64} << 20;

/// A child that touches memory, in a child of its own when told, and holds it until it is killed.
class Holder {
 public:
  explicit Holder(bool in_grandchild) {
    std::array<int, 2> ready{};
    EXPECT_EQ(::pipe(ready.data()), 0);
    process_ = ::fork();
    if (process_ == 0) {
      ::setpgid(0, 0);  // so that both can be ended
      if (in_grandchild && ::fork() != 0) {
        ::wait(nullptr);
        ::_exit(0);
      }
      const std::vector<char> touched(kTouchedBytes, 'x');
      [[maybe_unused]] const ssize_t written = ::write(ready[1], touched.data(), 1);
      ::pause();
      ::_exit(touched.back());
    }
    char byte = 0;
    EXPECT_EQ(::read(ready[0], &byte, 1), 1);
    ::close(ready[0]);
    ::close(ready[1]);
  }
  ~Holder() { end(); }
  Holder(const Holder&) = delete;
  Holder& operator=(const Holder&) = delete;

  [[nodiscard]] pid_t process() const { return process_; }
  void end() {
    if (process_ > 0) {
      ::kill(-process_, SIGKILL);
      ::waitpid(process_, nullptr, 0);
      process_ = -1;
    }
  }

 private:
  pid_t process_ = -1;
};

TEST(TreeMemory, CountsAChildAndNotTheRoot) {
  Holder child(false);
  TreeMemory above(::getpid());
  EXPECT_GE(above.sample(), kTouchedBytes);
  EXPECT_EQ(TreeMemory(child.process()).sample(), 0);
  child.end();
  EXPECT_LT(above.sample(), kTouchedBytes);
}

TEST(TreeMemory, FindsANewChildAtTheFifthFurtherCall) {
  TreeMemory tree(::getpid());
  EXPECT_EQ(tree.sample(), 0);
  const Holder child(false);
  for (int call = 0; call < 4; ++call) {
    EXPECT_EQ(tree.sample(), 0);
  }
  EXPECT_GE(tree.sample(), kTouchedBytes);
}

TEST(TreeMemory, CountsGrandchildren) {
  Holder child(true);
  EXPECT_GE(TreeMemory(::getpid()).sample(), kTouchedBytes);
  EXPECT_GE(TreeMemory(child.process()).sample(), kTouchedBytes);
}

}  // namespace
}  // namespace cbc3d::reports
