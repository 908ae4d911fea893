// Ranges of the numbers that options take, checked before any work.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <limits>

namespace cbc3d {

/// Check of an option: a finite number from `lowest` to `highest`. The message is short whatever was given:
/// "--timeout: nan: give a number from 0.001 to 1e+07".
CLI::Validator number_between(double lowest, double highest);

/// The same of whole numbers: "--repeat: 0: give a whole number from 1 to 10000".
CLI::Validator whole_number_between(std::int64_t lowest, std::int64_t highest);

/// Threads of all pools; 0: all cores.
inline CLI::Validator thread_count() {
  return whole_number_between(0, 1024);
}

/// Seeds of random choices.
inline CLI::Validator seed_value() {
  return whole_number_between(0, std::numeric_limits<std::int64_t>::max());
}

/// Labels of images are integers of 32 bits.
inline CLI::Validator label_value() {
  return whole_number_between(std::numeric_limits<std::int32_t>::min(),
                              std::numeric_limits<std::int32_t>::max());
}

}  // namespace cbc3d
