#include "mesher/formats/gipl.hpp"

#include "mesher/formats/binary_header.hpp"
#include "mesher/formats/header_text.hpp"

namespace cbc3d::formats {
namespace {

constexpr std::size_t kBytes = 256;

Component component_of(int type) {
  switch (type) {
    case 7:
      return Component::int8;
    case 8:
      return Component::uint8;
    case 15:
      return Component::int16;
    case 16:
      return Component::uint16;
    case 31:
      return Component::uint32;
    case 32:
      return Component::int32;
    case 64:
      return Component::float32;
    case 65:
      return Component::float64;
    default:
      throw FormatError("its pixel type is GIPL's " + std::to_string(type) +
                        ", which holds no labels that can be read; convert it to 8 or 16-bit integers");
  }
}

}  // namespace

bool is_gipl(std::string_view head) {
  if (head.size() < kBytes) {
    return false;
  }
  const auto magic = BinaryHeader(head, true).get<std::uint32_t>(252);
  return magic == 0xEFFFE9B0U || magic == 0x2AE389B8U;
}

ImageHeader read_gipl_header(std::string_view head, const std::filesystem::path& path, Encoding encoding) {
  const BinaryHeader at(head, true);
  ImageHeader image;
  image.format = "GIPL";
  image.big_endian = true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    image.size[axis] = size_of("dimension", at.get<std::uint16_t>(2 * axis));
    image.spacing_mm[axis] = at.get<float>(10 + 4 * axis);
    image.origin_mm[axis] = at.get<double>(204 + 8 * axis);
  }
  if (const auto volumes = at.get<std::uint16_t>(6); volumes > 1) {
    throw FormatError("it is 4-dimensional with " + std::to_string(volumes) +
                      " volumes; give one 3-D volume of it");
  }
  image.component = component_of(at.get<std::uint16_t>(8));
  image.warnings.emplace_back(
      "GIPL says nothing of directions: its axes are taken towards left, posterior, superior");
  image.encoding = encoding;
  image.files = {{.path = path, .skipped_bytes = kBytes}};
  return image;
}

}  // namespace cbc3d::formats
