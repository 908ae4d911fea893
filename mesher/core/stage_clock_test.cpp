#include "mesher/core/stage_clock.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <thread>

namespace cbc3d {
namespace {

void sleep_a_little() {
  std::this_thread::sleep_for(std::chrono::milliseconds(2));
}

std::vector<std::string> names_of(const StageClock& clock) {
  std::vector<std::string> names;
  for (const auto& [name, seconds] : clock.seconds()) {
    names.push_back(name);
  }
  return names;
}

TEST(StageClock, StagesStandInTheOrderInWhichTheyBegan) {
  StageClock clock;
  clock.time("b", [&] { clock.time("c", sleep_a_little); });
  clock.time("a", sleep_a_little);
  clock.time("b", sleep_a_little);
  EXPECT_EQ(names_of(clock), (std::vector<std::string>{"b", "c", "a"}));
}

TEST(StageClock, AStageThatRunsAgainCountsOnUnderItsName) {
  StageClock clock;
  clock.time("a", sleep_a_little);
  const double once = clock.seconds()[0].second;
  clock.time("a", sleep_a_little);
  ASSERT_EQ(clock.seconds().size(), 1U);
  EXPECT_GE(once, 0.002);
  EXPECT_GE(clock.seconds()[0].second, once + 0.002);
  EXPECT_DOUBLE_EQ(clock.total_seconds(), clock.seconds()[0].second);
}

TEST(StageClock, AStageReturnsItsValueAndCountsWhenItThrows) {
  StageClock clock;
  EXPECT_EQ(clock.time("value", [] { return 7; }), 7);
  EXPECT_THROW(clock.time("throws",
                          [] {
                            sleep_a_little();
                            throw std::runtime_error("");
                          }),
               std::runtime_error);
  EXPECT_GE(clock.seconds()[1].second, 0.002);
}

TEST(StageClock, StartEndsTheStageBefore) {
  StageClock clock;
  clock.stop();
  clock.start("a");
  sleep_a_little();
  clock.start("b");
  clock.start("a");
  sleep_a_little();
  clock.stop();
  const double total = clock.total_seconds();
  sleep_a_little();
  clock.stop();
  EXPECT_EQ(names_of(clock), (std::vector<std::string>{"a", "b"}));
  EXPECT_GE(clock.seconds()[0].second, 0.004);
  EXPECT_EQ(clock.total_seconds(), total);
}

TEST(StageClock, CpuSecondsAreThoseOfTheStages) {
  StageClock clock;
  const double before = process_cpu_seconds();
  clock.time("work", [&] {
    while (process_cpu_seconds() < before + 0.005) {
    }
  });
  EXPECT_GT(clock.cpu_seconds(), 0);
  EXPECT_LE(clock.cpu_seconds(), process_cpu_seconds() - before);
  EXPECT_GE(clock.system_cpu_seconds(), 0);
  EXPECT_LE(clock.system_cpu_seconds(), process_system_cpu_seconds());
}

}  // namespace
}  // namespace cbc3d
