#include "mesher/formats/inrimage.hpp"

#include <map>

#include "mesher/formats/header_text.hpp"

namespace cbc3d::formats {
namespace {

constexpr std::size_t kBlock = 256;

using Fields = std::map<std::string, std::string>;

Fields parse(std::string_view text) {
  Fields fields;
  Lines lines(text);
  while (const auto line = lines.next()) {
    const std::size_t equals = line->find('=');
    if (equals != std::string_view::npos && !line->starts_with('#')) {
      fields[std::string(trimmed(line->substr(0, equals)))] = std::string(trimmed(line->substr(equals + 1)));
    }
  }
  return fields;
}

double number(const Fields& fields, const std::string& key, double otherwise) {
  const auto found = fields.find(key);
  return found == fields.end() ? otherwise : numbers_of(key, found->second, 1)[0];
}

std::int64_t integer(const Fields& fields, const std::string& key, std::int64_t otherwise) {
  const auto found = fields.find(key);
  return found == fields.end() ? otherwise : integers_of(key, found->second, 1)[0];
}

Component component_of(const Fields& fields) {
  const auto type_field = fields.find("TYPE"), bits_field = fields.find("PIXSIZE");
  const std::string type = type_field == fields.end() ? "" : type_field->second;
  const auto words = words_of(bits_field == fields.end() ? "8 bits" : bits_field->second);
  const std::int64_t bits = words.empty() ? 0 : integers_of("PIXSIZE", words[0], 1)[0];
  const bool floating = type.starts_with("float"), with_sign = type.starts_with("signed");
  if (floating && (bits == 32 || bits == 64)) {
    return bits == 64 ? Component::float64 : Component::float32;
  }
  switch (floating ? 0 : bits) {
    case 8:
      return with_sign ? Component::int8 : Component::uint8;
    case 16:
      return with_sign ? Component::int16 : Component::uint16;
    case 32:
      return with_sign ? Component::int32 : Component::uint32;
    default:
      throw FormatError("its pixel type is TYPE=" + type + " PIXSIZE=" + std::to_string(bits) +
                        "; known are 8, 16 and 32-bit integers and 32 and 64-bit floats");
  }
}

void take_frame(const Fields& fields, ImageHeader& image) {
  const char* const sizes[] = {"XDIM", "YDIM", "ZDIM"};
  const char* const spacings[] = {"VX", "VY", "VZ"};
  const char* const translations[] = {"TX", "TY", "TZ"};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    image.size[axis] = size_of(sizes[axis], integer(fields, sizes[axis], 1));
    image.spacing_mm[axis] = number(fields, spacings[axis], 1);
    image.origin_mm[axis] = number(fields, translations[axis], 0);
  }
  if (const std::int64_t values = integer(fields, "VDIM", 1); values != 1) {
    throw FormatError("it has VDIM=" + std::to_string(values) +
                      " values per voxel; give an image with one label per voxel");
  }
  if (number(fields, "RX", 0) != 0 || number(fields, "RY", 0) != 0 || number(fields, "RZ", 0) != 0) {
    image.warnings.emplace_back("its header turns the image by RX, RY, RZ, which is not followed");
  }
}

}  // namespace

bool is_inrimage(std::string_view head) {
  return head.starts_with("#INRIMAGE");
}

ImageHeader read_inrimage_header(std::string_view head, const std::filesystem::path& path,
                                 Encoding encoding) {
  const std::size_t end = head.substr(0, 64 * kBlock).find("##}");
  if (end == std::string_view::npos) {
    throw FormatError("not an INRIMAGE-4 file (its header does not end); convert it to NIfTI or NRRD");
  }
  const std::size_t length = (end + 3 + kBlock - 1) / kBlock * kBlock;  // whole blocks
  const Fields fields = parse(head.substr(0, end));
  ImageHeader image;
  image.format = "INRIMAGE-4";
  take_frame(fields, image);
  image.component = component_of(fields);
  const auto cpu = fields.find("CPU");
  image.big_endian = cpu != fields.end() && (cpu->second == "sun" || cpu->second == "sgi");
  image.encoding = encoding;
  image.files = {{.path = path, .skipped_bytes = length}};
  return image;
}

}  // namespace cbc3d::formats
