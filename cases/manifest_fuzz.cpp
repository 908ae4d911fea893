// Manifests of any bytes: cases or an InputError.
#include <cstdint>
#include <filesystem>
#include <fstream>

#include "cases/manifest.hpp"
#include "mesher/core/error.hpp"

namespace {

const std::filesystem::path& folder() {
  static const std::filesystem::path made = [] {
    std::string name = (std::filesystem::temp_directory_path() / "manifest_fuzz_XXXXXX").string();
    return std::filesystem::path(::mkdtemp(name.data()));
  }();
  return made;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  std::ofstream(folder() / "one.json", std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes), static_cast<std::streamsize>(size));
  try {
    cbc3d::cases::load_cases(folder());
  } catch (const cbc3d::InputError&) {
    return 0;
  }
  return 0;
}
