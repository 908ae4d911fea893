// What a call says of bad input.
#pragma once

#include <string>

#include "mesher/core/error.hpp"

namespace cbc3d::testing {

/// The message of the InputError that the call ends with; empty without one.
template <typename Call>
std::string error_of(const Call& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace cbc3d::testing
