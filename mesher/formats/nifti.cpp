#include "mesher/formats/nifti.hpp"

#include <cmath>
#include <cstdio>
#include <optional>

#include "mesher/formats/binary_header.hpp"
#include "mesher/formats/byte_stream.hpp"
#include "mesher/formats/header_text.hpp"

namespace cbc3d::formats {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kBytes1 = 348, kBytes2 = 540;
constexpr int kAnalyze = 0;  // in place of a version

/// The fields that matter, whatever the version.
struct Fields {
  int version = 1;  ///< kAnalyze, 1 or 2
  bool big_endian = false;
  bool pair = false;  ///< voxels in a file of their own
  std::array<std::int64_t, 8> dim{};
  std::array<double, 8> pixdim{};
  int datatype = 0, bitpix = 0, units = 0, qform_code = 0, sform_code = 0;
  double vox_offset = 0, slope = 0, intercept = 0;
  std::array<double, 6> quaternion{};  ///< b, c, d and the offsets
  std::array<std::array<double, 4>, 3> srow{};
};

/// Voxel steps and origin in the header's own space and unit, right-anterior-superior.
struct Affine {
  std::array<Triple, 3> steps;
  Triple origin;
};

std::optional<bool> byte_order(std::string_view head) {
  for (const bool big : {false, true}) {
    const auto size = BinaryHeader(head, big).get<std::int32_t>(0);
    if ((size == 348 && head.size() >= kBytes1) || (size == 540 && head.size() >= kBytes2)) {
      return big;
    }
  }
  return std::nullopt;
}

Fields version_1_fields(std::string_view head, bool big) {
  const BinaryHeader at(head, big);
  Fields f;
  const std::string_view magic = head.substr(344, 4);
  f.big_endian = big;
  f.pair = magic != std::string_view("n+1\0", 4);
  f.version = f.pair && magic != std::string_view("ni1\0", 4) ? kAnalyze : 1;
  for (std::size_t i = 0; i < 8; ++i) {
    f.dim[i] = at.get<std::int16_t>(40 + 2 * i);
    f.pixdim[i] = at.get<float>(76 + 4 * i);
  }
  f.datatype = at.get<std::int16_t>(70);
  f.bitpix = at.get<std::int16_t>(72);
  f.vox_offset = at.get<float>(108);
  if (f.version == kAnalyze) {
    return f;
  }
  f.slope = at.get<float>(112);
  f.intercept = at.get<float>(116);
  f.units = static_cast<unsigned char>(head[123]);
  f.qform_code = at.get<std::int16_t>(252);
  f.sform_code = at.get<std::int16_t>(254);
  for (std::size_t i = 0; i < 6; ++i) {
    f.quaternion[i] = at.get<float>(256 + 4 * i);
  }
  for (std::size_t i = 0; i < 12; ++i) {
    f.srow[i / 4][i % 4] = at.get<float>(280 + 4 * i);
  }
  return f;
}

Fields version_2_fields(std::string_view head, bool big) {
  const BinaryHeader at(head, big);
  Fields f;
  f.version = 2;
  f.big_endian = big;
  const std::string_view magic = head.substr(4, 8);
  f.pair = magic.starts_with("ni2");
  if (magic != std::string_view("n+2\0\r\n\032\n", 8) && magic != std::string_view("ni2\0\r\n\032\n", 8)) {
    throw FormatError("it begins like NIfTI-2, but its signature is damaged; copy it again in binary mode");
  }
  for (std::size_t i = 0; i < 8; ++i) {
    f.dim[i] = at.get<std::int64_t>(16 + 8 * i);
    f.pixdim[i] = at.get<double>(104 + 8 * i);
  }
  f.datatype = at.get<std::int16_t>(12);
  f.bitpix = at.get<std::int16_t>(14);
  f.vox_offset = static_cast<double>(at.get<std::int64_t>(168));
  f.slope = at.get<double>(176);
  f.intercept = at.get<double>(184);
  f.qform_code = at.get<std::int32_t>(344);
  f.sform_code = at.get<std::int32_t>(348);
  for (std::size_t i = 0; i < 6; ++i) {
    f.quaternion[i] = at.get<double>(352 + 8 * i);
  }
  for (std::size_t i = 0; i < 12; ++i) {
    f.srow[i / 4][i % 4] = at.get<double>(400 + 8 * i);
  }
  f.units = at.get<std::int32_t>(500);
  return f;
}

void take_size(const Fields& f, ImageHeader& header) {
  if (f.dim[0] < 1 || f.dim[0] > 7) {
    throw FormatError("its header has " + std::to_string(f.dim[0]) + " dimensions; repair its header");
  }
  if (f.dim[0] < 3) {
    throw FormatError("it is " + std::to_string(f.dim[0]) +
                      "-dimensional; give a 3-D image (`cbc3d tile` stacks slices)");
  }
  for (std::size_t i = 0; i < 3; ++i) {
    header.size[i] = size_of("dim[" + std::to_string(i + 1) + "]", f.dim[i + 1]);
  }
  const auto rank = static_cast<std::size_t>(f.dim[0]);
  if (rank >= 5 && f.dim[5] > 1) {
    throw FormatError("it has " + std::to_string(f.dim[5]) +
                      " components per voxel (a vector image); give a label image with one value per voxel");
  }
  header.volumes = rank >= 4 && f.dim[4] > 1 ? size_of("dim[4]", f.dim[4]) : 1;
  for (std::size_t i = 5; i <= rank; ++i) {
    if (f.dim[i] > 1) {
      throw FormatError("it is " + std::to_string(rank) + "-dimensional with " + std::to_string(f.dim[i]) +
                        " volumes; give one 3-D volume of it");
    }
  }
}

Component component_of(int datatype) {
  switch (datatype) {
    case 2:
      return Component::uint8;
    case 4:
      return Component::int16;
    case 8:
      return Component::int32;
    case 16:
      return Component::float32;
    case 64:
      return Component::float64;
    case 256:
      return Component::int8;
    case 512:
      return Component::uint16;
    case 768:
      return Component::uint32;
    case 1024:
      return Component::int64;
    case 1280:
      return Component::uint64;
    case 128:
      throw FormatError(
          "it has 3 components per voxel (RGB colours); give a label image with one value per voxel");
    case 2304:
      throw FormatError(
          "it has 4 components per voxel (RGBA colours); give a label image with one value per voxel");
    case 1:
      throw FormatError("its voxels are single bits (datatype 1); convert it to 8-bit integers");
    default:
      throw FormatError("its pixel type is datatype " + std::to_string(datatype) +
                        ", which holds no labels; convert it to an integer type");
  }
}

void take_values(const Fields& f, ImageHeader& header) {
  header.component = component_of(f.datatype);
  const auto bits = static_cast<int>(8 * bytes_of(header.component));
  if (f.bitpix != bits) {
    throw FormatError("its header is at odds with itself: datatype " + std::to_string(f.datatype) + " has " +
                      std::to_string(bits) + " bits, bitpix says " + std::to_string(f.bitpix) +
                      "; repair its header");
  }
  if (f.slope != 0 && std::isfinite(f.slope) && std::isfinite(f.intercept)) {  // by the standard 0 is unset
    header.slope = f.slope;
    header.intercept = f.intercept;
  } else if (!std::isfinite(f.slope) || (f.slope != 0 && !std::isfinite(f.intercept))) {
    header.warnings.emplace_back("scl_slope or scl_inter is no finite number; the values are not scaled");
  }
  header.non_finite_is_background = true;
}

/// Millimetres of the header's unit.
double unit_mm(const Fields& f, ImageHeader& header) {
  const int unit = f.version == kAnalyze ? 2 : f.units % 8;
  if (unit > 3) {
    header.warnings.push_back("xyzt_units has the unit " + std::to_string(unit) +
                              ", which is none; mm are taken");
  }
  return unit == 1 ? 1000 : unit == 3 ? 0.001 : 1;
}

void require_finite(const Affine& affine, const std::string& what) {
  for (std::size_t row = 0; row < 3; ++row) {
    for (const Triple& v : {affine.steps[0], affine.steps[1], affine.steps[2], affine.origin}) {
      if (!std::isfinite(v[row])) {
        throw FormatError("its " + what + " has an entry that is no finite number; repair its header");
      }
    }
  }
}

Affine sform_of(const Fields& f) {
  Affine affine{};
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      affine.steps[axis][row] = f.srow[row][axis];
    }
    affine.origin[row] = f.srow[row][3];
  }
  require_finite(affine, "sform");
  return affine;
}

/// The rotation of a unit quaternion whose real part is not stored, entries rounded to floats as the
/// format's own library has them.
std::array<Triple, 3> rotation_of(double b, double c, double d) {
  double a = 1.0 - (b * b + c * c + d * d);
  if (a < 1e-7) {  // a half turn: the vector alone, of length one
    const double scale = 1.0 / std::sqrt(b * b + c * c + d * d);
    b *= scale;
    c *= scale;
    d *= scale;
    a = 0;
  } else {
    a = std::sqrt(a);
  }
  return {{{a * a + b * b - c * c - d * d, 2 * (b * c + a * d), 2 * (b * d - a * c)},
           {2 * (b * c - a * d), a * a + c * c - b * b - d * d, 2 * (c * d + a * b)},
           {2 * (b * d + a * c), 2 * (c * d - a * b), a * a + d * d - c * c - b * b}}};
}

Affine qform_of(const Fields& f) {
  const auto& q = f.quaternion;
  constexpr double kRounding = 1e-3;
  if (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] > 1 + kRounding) {
    throw FormatError("its qform has a quaternion longer than one; repair its header");
  }
  const auto rotation = rotation_of(q[0], q[1], q[2]);
  Affine affine{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double step = axis == 2 && f.pixdim[0] < 0 ? -f.pixdim[3] : f.pixdim[axis + 1];
    for (std::size_t row = 0; row < 3; ++row) {
      affine.steps[axis][row] = static_cast<float>(rotation[axis][row] * step);
    }
    affine.origin[axis] = q[3 + axis];
  }
  require_finite(affine, "qform");
  return affine;
}

/// Spacing alone. NIfTI's method 1 has x towards the patient's right and the first voxel at 0; Analyze has x
/// towards the left, and its readers put the centre of the image at 0.
Affine spacing_alone(const Fields& f) {
  const bool analyze = f.version == kAnalyze;
  Affine affine{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double step = (analyze && axis == 0 ? -1 : 1) * f.pixdim[axis + 1];
    affine.steps[axis][axis] = step;
    affine.origin[axis] = analyze ? -step * static_cast<double>(f.dim[axis + 1] - 1) / 2 : 0;
  }
  return affine;
}

void require_pixdim(Fields& f, ImageHeader& header) {
  for (std::size_t axis = 1; axis <= 3; ++axis) {
    if (f.pixdim[axis] < 0) {
      f.pixdim[axis] = -f.pixdim[axis];
      header.warnings.push_back("pixdim[" + std::to_string(axis) + "] is negative; its size is taken");
    }
    if (!(f.pixdim[axis] > 0) || !std::isfinite(f.pixdim[axis])) {
      throw FormatError("its header has pixdim[" + std::to_string(axis) +
                        "] = " + number_text(f.pixdim[axis]) + ", which is no spacing; repair its header");
    }
  }
}

Affine frame_of(Fields& f, ImageHeader& header) {
  if (f.sform_code > 0) {
    return sform_of(f);
  }
  require_pixdim(f, header);
  if (f.qform_code > 0) {
    return qform_of(f);
  }
  header.warnings.emplace_back(f.version == kAnalyze ? "Analyze files say nothing of where the image lies: "
                                                       "its centre is taken at 0, its axes towards left, "
                                                       "anterior, superior"
                                                     : "neither qform nor sform is set: its first voxel is "
                                                       "taken at 0, its axes towards right, anterior, "
                                                       "superior");
  return spacing_alone(f);
}

/// Steps are lengths of columns; where they are the spacings to a float's last digits, these are taken as
/// they are written.
void take_frame(const Affine& affine, const Fields& f, double mm, ImageHeader& header) {
  constexpr double kRounding = 1e-6;
  std::array<Triple, 3> steps = affine.steps;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    steps[axis][0] = -steps[axis][0];
    steps[axis][1] = -steps[axis][1];
    header.origin_mm[axis] = (axis < 2 ? -affine.origin[axis] : affine.origin[axis]) * mm;
  }
  set_steps(header, steps, f.sform_code > 0 ? "sform" : "qform");
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double length = header.spacing_mm[axis], written = f.pixdim[axis + 1];
    if (std::fabs(length - written) <= kRounding * written) {
      header.spacing_mm[axis] = written;
    }
    header.spacing_mm[axis] *= mm;
    for (std::size_t row = 0; row < 3; ++row) {
      header.axes[axis][row] = steps[axis][row] / length;
    }
  }
}

/// The largest distance that two affines put any voxel centre apart: at a corner, for it is a linear
/// function.
double largest_distance(const Affine& a, const Affine& b, const ImageHeader& header) {
  double largest = 0;
  for (std::size_t corner = 0; corner < 8; ++corner) {
    double squared = 0;
    for (std::size_t row = 0; row < 3; ++row) {
      double apart = a.origin[row] - b.origin[row];
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto last = static_cast<double>(header.size[axis] - 1);
        apart += ((corner >> axis) & 1U) * last * (a.steps[axis][row] - b.steps[axis][row]);
      }
      squared += apart * apart;
    }
    largest = std::fmax(largest, std::sqrt(squared));
  }
  return largest;
}

void warn_of_two_frames(const Fields& f, const Affine& affine, double mm, ImageHeader& header) {
  constexpr double kVoxels = 0.1;
  if (f.sform_code <= 0 || f.qform_code <= 0) {
    return;
  }
  double distance_mm = HUGE_VAL;
  try {
    distance_mm = mm * largest_distance(affine, qform_of(f), header);
  } catch (const FormatError&) {  // a broken qform that is not used
    header.warnings.emplace_back("its qform is damaged; the sform is used");
    return;
  }
  const Triple& s = header.spacing_mm;
  if (distance_mm > kVoxels * std::fmin(s[0], std::fmin(s[1], s[2]))) {
    char text[200];
    std::snprintf(
        text, sizeof text,
        "its sform (code %d) and qform (code %d) place voxels up to %.4g mm apart; the sform is used, and "
        "other programs may take the other",
        f.sform_code, f.qform_code, distance_mm);
    header.warnings.emplace_back(text);
  }
}

/// The file beside a header: NAME.img or NAME.img.gz of NAME.hdr, by the letter case of the header's own.
fs::path voxel_file(const fs::path& path) {
  fs::path base = path;
  if (lower_case(base.extension().string()) == ".gz" || lower_case(base.extension().string()) == ".bz2") {
    base.replace_extension();
  }
  for (const char* extension : {".img", ".IMG", ".img.gz", ".img.bz2"}) {
    fs::path other = base;
    other.replace_extension(extension);
    std::error_code error;
    if (fs::is_regular_file(other, error)) {
      return other;
    }
  }
  return base.replace_extension(".img");
}

}  // namespace

bool is_nifti(std::string_view head) {
  return byte_order(head).has_value();
}

ImageHeader read_nifti_header(std::string_view head, const fs::path& path, Encoding encoding) {
  const bool big = byte_order(head).value_or(false);
  const bool second = BinaryHeader(head, big).get<std::int32_t>(0) == 540;
  Fields f = second ? version_2_fields(head, big) : version_1_fields(head, big);
  ImageHeader header;
  header.format = f.version == kAnalyze ? "Analyze 7.5" : "NIfTI-" + std::to_string(f.version);
  header.big_endian = f.big_endian;
  take_size(f, header);
  take_values(f, header);
  const double mm = unit_mm(f, header);
  const Affine affine = frame_of(f, header);
  take_frame(affine, f, mm, header);
  warn_of_two_frames(f, affine, mm, header);

  const double least = f.pair ? 0 : f.version == 2 ? 544 : 352;
  if (!std::isfinite(f.vox_offset) || f.vox_offset != std::floor(f.vox_offset) || f.vox_offset > 1e15 ||
      (f.vox_offset < least && f.vox_offset != 0)) {
    throw FormatError("its header puts the voxels at byte " + number_text(f.vox_offset) +
                      " (vox_offset), where they cannot be; repair its header");
  }
  DataFile file{.path = f.pair ? voxel_file(path) : path};
  file.skipped_bytes = static_cast<std::uint64_t>(std::fmax(f.vox_offset, least));
  header.encoding = encoding;
  if (f.pair) {
    std::error_code error;
    header.encoding = fs::is_regular_file(file.path, error) ? encoding_of_file(file.path) : Encoding::raw;
  }
  header.files = {file};
  return header;
}

}  // namespace cbc3d::formats
