#include "mesher/core/nrrd_header.hpp"

#include <algorithm>
#include <bit>
#include <fstream>
#include <string>

namespace cbc3d {

std::size_t nrrd_voxel_offset(const std::filesystem::path& path, std::size_t component_bytes,
                              std::initializer_list<std::string_view> encodings) {
  constexpr std::string_view kEncoding = "encoding: ";
  std::ifstream in(path, std::ios::binary);
  std::string line;
  bool encoded = false, ordered = component_bytes == 1;
  if (!std::getline(in, line) || !line.starts_with("NRRD")) {
    return 0;
  }
  while (std::getline(in, line) && !line.empty()) {
    encoded = encoded || (line.starts_with(kEncoding) &&
                          std::find(encodings.begin(), encodings.end(),
                                    std::string_view(line).substr(kEncoding.size())) != encodings.end());
    ordered =
        ordered || line == (std::endian::native == std::endian::little ? "endian: little" : "endian: big");
    if (line.starts_with("data file:") || line.starts_with("datafile:") || line.starts_with("line skip:") ||
        line.starts_with("byte skip:")) {
      return 0;
    }
  }
  return in && encoded && ordered ? static_cast<std::size_t>(in.tellg()) : 0;
}

}  // namespace cbc3d
