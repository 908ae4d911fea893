// Descriptions of meshers from outside of any bytes: an adapter or an InputError.
#include <cstdint>

#include "baselines/external.hpp"
#include "mesher/core/error.hpp"
#include "mesher/testing/fuzz_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  const cbc3d::testing::FuzzFile file(bytes, size);
  try {
    static_cast<void>(cbc3d::baselines::load_external_mesher(file.path()));
  } catch (const cbc3d::InputError&) {
    return 0;
  }
  return 0;
}
