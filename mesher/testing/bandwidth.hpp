// This machine's memory bandwidth, measured as STREAM does (McCalpin, "Memory Bandwidth and Machine Balance
// in Current High Performance Computers", 1995): copy and triad over arrays far beyond the cache, all
// threads.
#pragma once

#include <benchmark/benchmark.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace cbc3d::bench {

/// Three arrays of doubles, each four times as large as the largest cache and 64 MiB at least.
class StreamArrays {
 public:
  StreamArrays() : count_(array_bytes() / sizeof(double)) {
    for (Array* array : {&a_, &b_, &c_}) {
      *array = std::make_unique_for_overwrite<double[]>(count_);
    }
    double* const a = a_.get();
    double* const b = b_.get();
    double* const c = c_.get();
#pragma omp parallel for schedule(static)  // every page where its thread is
    for (std::size_t i = 0; i < count_; ++i) {
      a[i] = 1;
      b[i] = 2;
      c[i] = 0;
    }
  }

  /// c = a; returns the bytes read and written.
  std::size_t copy() {
    const double* const a = a_.get();
    double* const c = c_.get();
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < count_; ++i) {
      c[i] = a[i];
    }
    benchmark::DoNotOptimize(c);
    benchmark::ClobberMemory();
    return 2 * sizeof(double) * count_;
  }

  /// c = a + s b; returns the bytes read and written.
  std::size_t triad() {
    const double* const a = a_.get();
    const double* const b = b_.get();
    double* const c = c_.get();
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < count_; ++i) {
      c[i] = a[i] + 3.0 * b[i];
    }
    benchmark::DoNotOptimize(c);
    benchmark::ClobberMemory();
    return 3 * sizeof(double) * count_;
  }

 private:
  using Array = std::unique_ptr<double[]>;
  static std::size_t array_bytes() {
    const long cache = std::max(::sysconf(_SC_LEVEL3_CACHE_SIZE), ::sysconf(_SC_LEVEL2_CACHE_SIZE));
    return std::max<std::size_t>(std::size_t{64} << 20U, cache > 0 ? 4 * static_cast<std::size_t>(cache) : 0);
  }
  std::size_t count_;
  Array a_, b_, c_;
};

/// Bytes per second: the best of five copies and triads, as STREAM takes it. Measured at the first call.
inline double bandwidth() {
  static const double best = [] {
    StreamArrays arrays;
    double most = 0;
    const auto measure = [&](auto work) {
      const auto begin = std::chrono::steady_clock::now();
      const auto bytes = static_cast<double>(work());
      const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
      most = std::max(most, bytes / seconds.count());
    };
    for (int repeat = 0; repeat < 5; ++repeat) {
      measure([&] { return arrays.copy(); });
      measure([&] { return arrays.triad(); });
    }
    return most;
  }();
  return best;
}

/// What one iteration handles and the bytes it must at least move; adds items and bytes per second and the
/// counter of_bandwidth, the share of this machine's bandwidth that the kernel reaches. Above 1 where the
/// data stay in the cache.
inline void count_work(benchmark::State& state, double items, double bytes) {
  const auto iterations = static_cast<double>(state.iterations());
  state.SetItemsProcessed(static_cast<std::int64_t>(iterations * items));
  state.SetBytesProcessed(static_cast<std::int64_t>(iterations * bytes));
  state.counters["of_bandwidth"] =
      benchmark::Counter(iterations * bytes / bandwidth(), benchmark::Counter::kIsRate);
}

inline void stream_copy(benchmark::State& state) {
  StreamArrays arrays;
  std::size_t bytes = 0;
  for ([[maybe_unused]] const auto _ : state) bytes = arrays.copy();
  count_work(state, static_cast<double>(bytes) / (2 * sizeof(double)), static_cast<double>(bytes));
}

inline void stream_triad(benchmark::State& state) {
  StreamArrays arrays;
  std::size_t bytes = 0;
  for ([[maybe_unused]] const auto _ : state) bytes = arrays.triad();
  count_work(state, static_cast<double>(bytes) / (3 * sizeof(double)), static_cast<double>(bytes));
}

}  // namespace cbc3d::bench
