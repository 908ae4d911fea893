// What the header of an image file says, whatever its format.
//
// Notation: LPS mm  physical space: x to the patient's left, y to posterior, z to superior;
//           storage axes  the axes along which voxels follow each other in the file, the fastest first.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace cbc3d::formats {

/// What is wrong with a file, and the remedy: the part of a message that follows "cannot read 'FILE': ".
class FormatError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

enum class Component { uint8, int8, uint16, int16, uint32, int32, uint64, int64, float32, float64 };
enum class Encoding { raw, gzip, bzip2, ascii, hex };

using Triple = std::array<double, 3>;

/// A file, or a part of one, with voxels; several of them follow each other in the image.
struct DataFile {
  std::filesystem::path path;
  std::uint64_t begin = 0;          ///< the first byte that is no longer of the header
  std::uint64_t skipped_lines = 0;  ///< from there on, in the file as it lies on the disk
  std::uint64_t skipped_bytes = 0;  ///< after these lines and, where the voxels are compressed, decompression
  bool at_end = false;              ///< the voxels are the last bytes of the file
  std::uint64_t packed_bytes = 0;   ///< length of the compressed voxels; 0: up to the end of the file
  bool may_continue = false;        ///< other data may follow the voxels
};

/// A structure that a segmentation file names.
struct Segment {
  std::string name;                                   ///< as the file has it; may be empty
  std::int64_t value = 1;                             ///< of its voxels
  std::size_t layer = 0;                              ///< in which they have it
  std::optional<std::array<std::uint8_t, 3>> colour;  ///< red, green, blue
};

/// A 3-D image with one value for each voxel, or several of one frame. All figures are finite, sizes
/// positive, and the product of sizes, volumes and component fits std::size_t.
struct ImageHeader {
  std::string format;                        ///< as its users call it: "NIfTI-1"
  std::array<std::size_t, 3> size{0, 0, 0};  ///< along the storage axes
  std::size_t volumes = 1;  ///< values per voxel: of a 4-D image, or of the layers of a segmentation
  bool volumes_interleaved =
      false;                      ///< the values of a voxel lie side by side; otherwise volume follows volume
  std::vector<Segment> segments;  ///< in the file's order; none where it names none
  Component component = Component::uint8;
  bool big_endian = false;
  Encoding encoding = Encoding::raw;
  std::vector<DataFile> files;  ///< every one holds as many bytes as every other
  Triple spacing_mm{1, 1, 1};
  Triple origin_mm{0, 0, 0};  ///< LPS, centre of the first voxel
  std::array<Triple, 3> axes{
      {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  ///< LPS direction of every storage axis, unit
  double slope = 1, intercept = 0;         ///< value = slope * stored + intercept
  bool non_finite_is_background = false;   ///< the format's library reads NaN as 0
  std::vector<std::string> warnings;
};

std::size_t bytes_of(Component component);
inline bool is_floating(Component component) {
  return component == Component::float32 || component == Component::float64;
}

/// Bytes of all voxels of all volumes. Throws FormatError where they are more than std::size_t or 2^62 can
/// count.
std::size_t voxel_bytes(const ImageHeader& header);

/// Checks what every format promises: sizes from 1 to 2^31 - 1, a product that can be counted, finite
/// figures, spacing of 1e-6 to 1e6 mm, an origin within 1e9 mm. Throws FormatError.
void require_sound(const ImageHeader& header);

/// Spacing and directions of the axes from the steps between voxels along them, LPS mm. Throws FormatError
/// for a step that is zero or not finite; `what` names the field.
void set_steps(ImageHeader& header, const std::array<Triple, 3>& steps, const std::string& what);

}  // namespace cbc3d::formats
