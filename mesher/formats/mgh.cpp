#include "mesher/formats/mgh.hpp"

#include "mesher/formats/binary_header.hpp"
#include "mesher/formats/header_text.hpp"

namespace cbc3d::formats {
namespace {

constexpr std::size_t kBytes = 284;

Component component_of(int type) {
  switch (type) {
    case 0:
      return Component::uint8;
    case 1:
      return Component::int32;
    case 3:
      return Component::float32;
    case 4:
      return Component::int16;
    case 10:
      return Component::uint16;
    default:
      throw FormatError("its pixel type is MGH's " + std::to_string(type) +
                        ", which holds no labels that can be read; convert it to integers");
  }
}

/// Spacing, directions and the centre of the volume, right-anterior-superior; the centre is the voxel of half
/// the size, as FreeSurfer has it.
void take_frame(const BinaryHeader& at, ImageHeader& image) {
  const bool good = at.get<std::int16_t>(28) > 0;
  std::array<Triple, 3> axes{{{-1, 0, 0}, {0, 0, -1}, {0, 1, 0}}};
  Triple centre{};
  if (!good) {
    image.warnings.emplace_back(
        "its header says nothing of its place: coronal slices of 1 mm around 0 are taken");
  }
  for (std::size_t axis = 0; good && axis < 3; ++axis) {
    image.spacing_mm[axis] = at.get<float>(30 + 4 * axis);
    centre[axis] = at.get<float>(78 + 4 * axis);
    for (std::size_t row = 0; row < 3; ++row) {
      axes[axis][row] = at.get<float>(42 + 4 * (3 * axis + row));
    }
  }
  for (std::size_t row = 0; row < 3; ++row) {
    const double sign = row < 2 ? -1 : 1;
    double origin = centre[row];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      origin -= axes[axis][row] * image.spacing_mm[axis] * static_cast<double>(image.size[axis]) / 2;
      image.axes[axis][row] = sign * axes[axis][row];
    }
    image.origin_mm[row] = sign * origin;
  }
}

}  // namespace

bool is_mgh(std::string_view head, const std::filesystem::path& path) {
  const std::string extension = lower_case(path.extension().string());
  const bool named =
      extension == ".mgh" || extension == ".mgz" || lower_case(path.string()).ends_with(".mgh.gz");
  return named && head.size() >= kBytes && BinaryHeader(head, true).get<std::int32_t>(0) == 1;
}

ImageHeader read_mgh_header(std::string_view head, const std::filesystem::path& path, Encoding encoding) {
  const BinaryHeader at(head, true);
  ImageHeader image;
  image.format = "MGH";
  image.big_endian = true;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    image.size[axis] = size_of("dimension", at.get<std::int32_t>(4 + 4 * axis));
  }
  if (const auto frames = at.get<std::int32_t>(16); frames > 1) {
    image.volumes = size_of("nframes", frames);
  }
  image.component = component_of(at.get<std::int32_t>(20));
  take_frame(at, image);
  image.encoding = encoding;
  image.files = {{.path = path, .skipped_bytes = kBytes, .may_continue = true}};  // scan parameters and tags
  return image;
}

}  // namespace cbc3d::formats
