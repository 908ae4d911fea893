// Stores of known figures, for tests.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "reports/history/date.hpp"
#include "reports/history/store.hpp"
#include "reports/results/result.hpp"

namespace cbc3d::reports::test {

/// Normal draws that are the same on every platform (Box and Muller).
class Noise {
 public:
  explicit Noise(std::uint64_t seed) : random_(seed) {}
  /// Of mean 0 and standard deviation 1.
  double draw() {
    const double radius = std::sqrt(-2 * std::log(uniform()));
    return radius * std::cos(2 * std::numbers::pi * uniform());
  }
  /// Of mean 1 and that standard deviation.
  double factor(double spread) { return 1 + spread * draw(); }

 private:
  double uniform() { return (static_cast<double>(random_() >> 11U) + 0.5) / 9007199254740992.0; }
  std::mt19937_64 random_;
};

/// A good line of a job on the machine "TestCPU, 2 cores".
inline Json history_line(double cpu_s, int repeat = 0, const std::string& mesher = "cbc3d") {
  Json line = empty_result();
  line["case"] = "box";
  line["mesher"] = mesher;
  line["threads"] = 1;
  line["repeat"] = repeat;
  line["status"] = "ok";
  line["counts"]["tets"] = 1000;
  line["quality"]["min_dihedral_deg"] = 12.5;
  line["time_s"]["cpu"] = cpu_s;
  line["time_s"]["reference_cpu"] = 0.1;
  line["peak_rss_bytes"] = 5e7;
  line["provenance"] = {{"cpu", "TestCPU"},      {"cores", 2},       {"mesher_version", "1.0"},
                        {"git_dirty", false},    {"git_commit", ""}, {"utc", "2026-01-01T00:00:00Z"},
                        {"image_sha256", "abcd"}};
  return line;
}

/// The nth commit of a store, a day apart.
inline Commit commit_at(int n) {
  char name[16] = {};
  std::snprintf(name, sizeof name, "c%03d", n);
  return {name, utc_text(1767225600 + 86400L * n)};
}

/// A store with a commit for every value of the CPU time.
inline void write_times(const std::filesystem::path& folder, const std::vector<double>& cpu_s) {
  for (std::size_t n = 0; n < cpu_s.size(); ++n) {
    add_to_store(folder, decode_lines({history_line(cpu_s[n])}), commit_at(static_cast<int>(n)), "");
  }
}

/// Noise of 2 % about 10 s, and from `first_changed` on about 10 `factor` s.
inline std::vector<double> noisy_times(std::uint64_t seed, std::size_t count,
                                       std::size_t first_changed = 1000, double factor = 1) {
  Noise noise(seed);
  std::vector<double> times;
  times.reserve(count);
  for (std::size_t n = 0; n < count; ++n) {
    times.push_back(10 * noise.factor(0.02) * (n >= first_changed ? factor : 1));
  }
  return times;
}

}  // namespace cbc3d::reports::test
