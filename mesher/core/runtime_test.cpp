// Threads, clocks and memory of the process.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <omp.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mesher/core/runtime.hpp"

namespace cbc3d {
namespace {

TEST(Runtime, ThreadCountIsWhatIsAskedForOrAllCores) {
  EXPECT_EQ(set_thread_count(3), 3);
  EXPECT_EQ(omp_get_max_threads(), 3);
  EXPECT_EQ(set_thread_count(0), omp_get_num_procs());
  EXPECT_EQ(omp_get_max_threads(), omp_get_num_procs());
}

/// An environment variable, put back in the end.
class Variable {
 public:
  explicit Variable(const char* name) : name_(name) {
    if (const char* value = std::getenv(name)) before_ = value;
    ::unsetenv(name);
  }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;
  ~Variable() {
    if (before_) {
      ::setenv(name_, before_->c_str(), 1);
    } else {
      ::unsetenv(name_);
    }
  }
  [[nodiscard]] std::string value() const {
    const char* value = std::getenv(name_);
    return value != nullptr ? value : "";
  }

 private:
  const char* name_;
  std::optional<std::string> before_;
};

TEST(Runtime, WaitsAreChosenOnlyWhereTheEnvironmentSaysNothing) {
  const Variable policy("OMP_WAIT_POLICY");
  const Variable spins("GOMP_SPINCOUNT");
  ::setenv("OMP_WAIT_POLICY", "active", 1);
  EXPECT_FALSE(choose_sleeping_waits());
  EXPECT_EQ(policy.value(), "active");
  ::unsetenv("OMP_WAIT_POLICY");
  EXPECT_TRUE(choose_sleeping_waits());
  EXPECT_EQ(policy.value(), "passive");
  EXPECT_NE(spins.value(), "");
  EXPECT_FALSE(choose_sleeping_waits());  // so that a program starts itself once more, and no oftener
}

// In a child, for GoogleTest needs the streams.
TEST(Runtime, ClosedStandardStreamsAreOpenedToNothing) {
  const pid_t child = ::fork();
  if (child == 0) {
    for (int stream = 0; stream < 3; ++stream) ::close(stream);
    open_standard_streams();
    bool open = ::open("/dev/null", O_RDONLY) >= 3;
    for (int stream = 0; stream < 3; ++stream) open &= ::fcntl(stream, F_GETFD) == 0;
    ::_exit(open ? 0 : 1);
  }
  int status = -1;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
}

TEST(Runtime, ClocksRunForwardsAndMemoryIsCounted) {
  const Stopwatch watch;
  const double cpu = process_cpu_seconds();
  keep_freed_memory();
  const std::size_t bytes = std::size_t{64} << 20U;
  const std::vector<char> touched(bytes, 1);
  EXPECT_EQ(touched[bytes / 2], 1);
  EXPECT_GT(watch.seconds(), 0);
  EXPECT_GE(process_cpu_seconds(), cpu);
  EXPECT_GE(process_peak_rss_bytes(), static_cast<std::int64_t>(bytes));
}

}  // namespace
}  // namespace cbc3d
