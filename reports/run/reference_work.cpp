#include "reports/run/reference_work.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <thread>
#include <vector>

namespace cbc3d::reports {
namespace {

double thread_cpu_seconds() {
  std::timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Steps through the table in an order that no prefetcher foresees and adds up lengths.
double work(const std::vector<float>& table) {
  constexpr int kSteps = 12'000'000;
  std::uint64_t state = 1;
  double sum = 0;
  for (int step = 0; step < kSteps; ++step) {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    const std::size_t at = static_cast<std::size_t>(state >> 40U) % (table.size() - 3);
    sum += std::sqrt(1.0 + table[at] * table[at] + table[at + 1] * table[at + 2]);
  }
  return sum;
}

/// The least CPU time of this thread's goes.
double best_go(const std::vector<float>& table) {
  constexpr int kGoes = 4;
  double best = INFINITY;
  volatile double keep = 0;  // or the compiler would see that nobody needs the sum
  for (int go = 0; go < kGoes; ++go) {
    const double begin = thread_cpu_seconds();
    keep = keep + work(table);
    best = std::min(best, thread_cpu_seconds() - begin);
  }
  return best;
}

std::vector<float> table_of_numbers() {
  // 512 KiB. A table larger than the near caches would time the size of this process's memory pages (here by
  // a factor of 1.5 between runs), not the machine.
  constexpr std::size_t kFloats = std::size_t{128} << 10;
  std::vector<float> table(kFloats);
  for (std::size_t n = 0; n < kFloats; ++n) {
    table[n] = static_cast<float>(n % 1009);
  }
  return table;
}

}  // namespace

double reference_cpu_seconds(int threads) {
  const std::vector<float> table = table_of_numbers();
  std::vector<double> seconds(static_cast<std::size_t>(threads));
  std::vector<std::jthread> others;
  for (std::size_t n = 1; n < seconds.size(); ++n) {
    others.emplace_back([&, n] { seconds[n] = best_go(table); });
  }
  seconds[0] = best_go(table);
  others.clear();  // joins
  double sum = 0;
  for (const double s : seconds) {
    sum += s;
  }
  return sum / threads;
}

}  // namespace cbc3d::reports
