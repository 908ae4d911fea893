// Image files of any bytes: a header or a FormatError, and no more voxels than the header promises.
#include <cstdint>
#include <vector>

#include "mesher/formats/read_header.hpp"
#include "mesher/formats/voxel_data.hpp"
#include "mesher/testing/fuzz_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  namespace formats = cbc3d::formats;
  constexpr std::size_t kMostBytes = 1 << 22;
  const cbc3d::testing::FuzzFile file(bytes, size);
  try {
    formats::ImageHeader header = formats::read_image_header(file.path());
    formats::require_plausible_length(header);
    const std::size_t wanted = formats::voxel_bytes(header);
    if (wanted <= kMostBytes) {
      std::vector<std::uint8_t> buffer(formats::lead_bytes(header) + wanted);
      formats::read_voxels(header, buffer);
    }
  } catch (const formats::FormatError&) {
    return 0;  // the answer to nearly all bytes
  }
  return 0;
}
