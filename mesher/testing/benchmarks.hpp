// What the benchmarks work on: one three-material phantom at 1, 8 and 64 times the voxels (the argument is
// the size along an axis), and how its items are counted.
#pragma once

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <map>

#include "mesher/testing/test_images.hpp"

namespace cbc3d::bench {

inline constexpr int kSizes[] = {48, 96, 192};

/// Body, organ and a vessel through both, in the same proportions at every size; spacing 1 mm.
inline LabelImage phantom(int size) {
  const double s = size;
  return testing::make_image({size, size, size}, {1, 1, 1}, 3, [s](const Vec3& p) {
    const Vec3 q = p / s - Vec3{0.5, 0.5, 0.5};
    const bool vessel = std::hypot(q.y - 0.1, q.z) < 0.05 && std::abs(q.x) < 0.4;
    return vessel ? 3 : (q - Vec3{0.05, 0.1, 0}).norm() < 0.2 ? 2 : q.norm() < 0.42 ? 1 : 0;
  });
}

/// The phantom, made once.
inline const LabelImage& image_of(int size) {
  static std::map<int, LabelImage> cache;
  const auto [found, added] = cache.try_emplace(size);
  if (added) {
    found->second = phantom(size);
  }
  return found->second;
}

inline const LabelImage& image_of(const benchmark::State& state) {
  return image_of(static_cast<int>(state.range(0)));
}

inline void all_sizes(benchmark::internal::Benchmark* benchmark) {
  for (const int size : kSizes) {
    benchmark->Arg(size);
  }
  benchmark->Unit(benchmark::kMillisecond)->UseRealTime();
}

inline double voxel_bytes(const LabelImage& image) {
  return static_cast<double>(image.voxels.bytes());
}

inline double voxel_count(const LabelImage& image) {
  return static_cast<double>(image.voxels.size());
}

inline void count_voxels(benchmark::State& state, const LabelImage& image) {
  const auto voxels = static_cast<std::int64_t>(image.voxels.size());
  state.SetItemsProcessed(state.iterations() * voxels);
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(image.voxels.bytes()));
}

inline void count_tets(benchmark::State& state, std::size_t tets) {
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(tets));
}

}  // namespace cbc3d::bench
