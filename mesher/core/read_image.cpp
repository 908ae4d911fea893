#include "mesher/core/read_image.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>
#include <set>
#include <type_traits>

#include "mesher/core/error.hpp"
#include "mesher/core/frame_check.hpp"
#include "mesher/core/image_volumes.hpp"
#include "mesher/core/label_classifier.hpp"
#include "mesher/core/mapped_voxels.hpp"
#include "mesher/core/voxel_bytes.hpp"
#include "mesher/formats/byte_stream.hpp"
#include "mesher/formats/component_type.hpp"
#include "mesher/formats/dicom_data_set.hpp"
#include "mesher/formats/dicom_segmentation.hpp"
#include "mesher/formats/read_header.hpp"
#include "mesher/formats/voxel_data.hpp"

namespace cbc3d {
namespace fs = std::filesystem;
namespace {

using formats::Component;
using formats::ImageHeader;
using formats::with_type;

/// The beginning of every message about a file.
std::string subject_of(const fs::path& path) {
  return "cannot read '" + path.string() + "'";
}

[[noreturn]] void fail(const fs::path& path, const std::string& what) {
  throw InputError(subject_of(path) + ": " + what);
}

void require_file(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) {
    fail(path, error ? error.message() + "; check its name and permissions"
                     : "the file does not exist; check its name");
  }
  if (fs::is_directory(path, error)) {
    fail(path, "it is a folder; name an image file");
  }
  // A pipe would be waited for without an end, and a device be read without one.
  if (!fs::is_regular_file(path, error)) {
    fail(path, "it is a device or a pipe, which cannot be read twice; save the image to a file first");
  }
}

ImageFrame frame_of(const ImageHeader& header) {
  ImageFrame frame;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    frame.size[a] = static_cast<int>(header.size[a]);
    frame.spacing_mm[axis] = header.spacing_mm[a];
    frame.origin_mm[axis] = header.origin_mm[a];
    for (int row = 0; row < 3; ++row) {
      frame.direction(row, axis) = header.axes[a][static_cast<std::size_t>(row)];
    }
  }
  return frame;
}

VoxelBytes voxels_in_memory(ImageHeader& header) {
  const std::size_t lead = formats::lead_bytes(header), bytes = formats::voxel_bytes(header);
  VoxelBytes voxels(lead, bytes);
  formats::read_voxels(header, {voxels.data() - lead, lead + bytes});
  return voxels;
}

FileVoxels voxels_of_file(ImageHeader& header) {
  formats::require_plausible_length(header);
  if (const auto offset = formats::offset_in_place(header)) {
    if (auto mapped = map_voxels(header.files[0].path, *offset, formats::voxel_bytes(header))) {
      return std::move(*mapped);
    }
  }
  return voxels_in_memory(header);
}

/// What is no number becomes background, as the NIfTI library has it; returns how many voxels did.
template <typename T>
std::size_t zero_what_is_no_number(T* values, std::size_t count) {
  std::size_t zeroed = 0;
#pragma omp parallel for schedule(static) reduction(+ : zeroed)
  for (std::size_t v = 0; v < count; ++v) {
    if (!std::isfinite(values[v])) {
      values[v] = T{0};
      ++zeroed;
    }
  }
  return zeroed;
}

/// Values within the tolerance of an integer become that integer.
template <typename T>
void round_values(T* values, std::size_t count) {
#pragma omp parallel for schedule(static)
  for (std::size_t v = 0; v < count; ++v) {
    const T whole = std::nearbyint(values[v]);
    if (std::fabs(values[v] - whole) <= static_cast<T>(kRoundingTolerance)) {
      values[v] = whole;
    }
  }
}

void treat_floats(ImageHeader& header, const FileVoxels& voxels, const ReadImageOptions& options) {
  with_type(header.component, [&](const auto* type) {
    using T = std::remove_const_t<std::remove_pointer_t<decltype(type)>>;
    if constexpr (std::is_floating_point_v<T>) {
      auto* const values = static_cast<T*>(data_of(voxels));
      const std::size_t count = formats::voxel_bytes(header) / sizeof(T);
      const std::size_t zeroed = header.non_finite_is_background ? zero_what_is_no_number(values, count) : 0;
      if (zeroed > 0) {
        header.warnings.push_back(std::to_string(zeroed) +
                                  " voxels are no finite number; they are background");
      }
      if (options.round_values) {
        round_values(values, count);
      }
    }
  });
}

/// Values as the header scales them, in double precision.
FileVoxels scaled(ImageHeader& header, FileVoxels voxels) {
  if (header.slope == 1 && header.intercept == 0) {
    return voxels;
  }
  const std::size_t count = formats::voxel_bytes(header) / formats::bytes_of(header.component);
  VoxelBytes wide(0, count * sizeof(double));
  auto* const to = reinterpret_cast<double*>(wide.data());
  with_type(header.component, [&](const auto* type) {
    const auto* const from = static_cast<decltype(type)>(data_of(voxels));
#pragma omp parallel for schedule(static)
    for (std::size_t v = 0; v < count; ++v) {
      to[v] = header.slope * static_cast<double>(from[v]) + header.intercept;
    }
  });
  header.component = Component::float64;
  return wide;
}

/// Voxels of one byte are not copied: those in memory are overwritten by their materials, and those of a
/// mapped file stay there when they are materials already.
template <typename T>
void classify(FileVoxels voxels, LabelImage& image, const fs::path& path) {
  const std::size_t count = image.frame.voxel_count();
  Classifier<T> classifier(static_cast<const T*>(data_of(voxels)), count, subject_of(path));
  classifier.find_labels(image);
  if constexpr (sizeof(T) == 1) {
    const bool in_memory = std::holds_alternative<VoxelBytes>(voxels);
    if (in_memory && !classifier.values_are_materials()) {
      classifier.look_up(static_cast<std::uint8_t*>(data_of(voxels)));
    }
    if (in_memory || classifier.values_are_materials()) {
      image.voxels = LabelVoxels(std::move(voxels), count);
      return;
    }
  }
  image.voxels = classifier.voxels();
}

/// Header and voxels of a file, its frame checked. Throws InputError with the file's name.
struct FileImage {
  ImageHeader header;
  ImageFrame frame;
  FileVoxels voxels;
};

bool is_dicom_file(const fs::path& path) {
  constexpr std::size_t kHead = 132;
  return formats::is_dicom(formats::head_of_file(path, formats::Encoding::raw, kHead));
}

FileImage read_dicom(const fs::path& path, const ReadImageOptions& options) {
  if (options.volume || options.layer) {
    throw formats::FormatError("a DICOM segmentation has neither volumes nor layers; leave the choice out");
  }
  formats::DicomSegmentation segmentation = formats::read_dicom_segmentation(path);
  ImageFrame frame = frame_of(segmentation.header);
  require_usable_frame(frame, subject_of(path), options.accept_shear, &segmentation.header.warnings);
  const std::size_t bytes = formats::voxel_bytes(segmentation.header);
  VoxelBytes voxels(0, bytes);
  std::memcpy(voxels.data(), segmentation.labels.data(), bytes);
  return {std::move(segmentation.header), frame, std::move(voxels)};
}

FileImage read_file(const fs::path& path, const ReadImageOptions& options) {
  require_file(path);
  try {
    if (is_dicom_file(path)) {
      return read_dicom(path, options);
    }
    ImageHeader header = formats::read_image_header(path);
    ImageFrame frame = frame_of(header);
    require_usable_frame(frame, subject_of(path), options.accept_shear, &header.warnings);
    FileVoxels voxels = one_value_per_voxel(header, voxels_of_file(header), options);
    treat_floats(header, voxels, options);
    voxels = scaled(header, std::move(voxels));
    return {std::move(header), frame, std::move(voxels)};
  } catch (const formats::FormatError& error) {
    fail(path, error.what());
  } catch (const fs::filesystem_error& error) {
    fail(path, error.code().message());
  }
}

/// Names that the image has voxels of, and a warning for segments without any.
void take_notes(const fs::path& path, ImageHeader& header, const LabelImage& image, ImageNotes& notes) {
  const LabelNames all = names_of_segments(header);
  notes.names = all.of(image.labels);
  std::string empty;
  for (const NamedLabel& named : all.entries()) {
    if (notes.names.find(named.label) == nullptr) {
      empty += (empty.empty() ? "" : ", ") + all.text(named.label);
    }
  }
  if (!empty.empty()) {
    header.warnings.push_back("it names segments without voxels: " + empty);
  }
  for (const std::string& warning : header.warnings) {
    notes.warnings.push_back("'" + path.string() + "': " + warning);
  }
}

}  // namespace

LabelImage read_label_image(const fs::path& path, const ReadImageOptions& options,
                            std::vector<std::string>* warnings) {
  ImageNotes notes;
  LabelImage image = read_label_image(path, options, notes);
  if (warnings != nullptr) {
    warnings->insert(warnings->end(), notes.warnings.begin(), notes.warnings.end());
  }
  return image;
}

LabelImage read_label_image(const fs::path& path, const ReadImageOptions& options, ImageNotes& notes) {
  FileImage file = read_file(path, options);
  if (const std::string fraction = probability_in(file.header, file.voxels); !fraction.empty()) {
    fail(path, "it has fractions from 0 to 1 alone (" + fraction +
                   "), a probability map; threshold it first (FSL: fslmaths IN -thr 0.5 -bin OUT), or of one "
                   "map for each label take the most likely label");
  }
  LabelImage image;
  image.frame = file.frame;
  with_type(file.header.component, [&](const auto* type) {
    using T = std::remove_const_t<std::remove_pointer_t<decltype(type)>>;
    classify<T>(std::move(file.voxels), image, path);
  });
  if (image.labels.size() < 2) {
    fail(path, "every voxel is background (0); there is nothing to mesh");
  }
  take_notes(path, file.header, image, notes);
  return image;
}

GreyImage read_grey_image(const fs::path& path, const ReadImageOptions& options) {
  const FileImage file = read_file(path, options);
  GreyImage image{file.frame, std::vector<float>(file.frame.voxel_count())};
  with_type(file.header.component, [&](const auto* type) {
    const auto* const from = static_cast<decltype(type)>(data_of(file.voxels));
    std::transform(from, from + image.values.size(), image.values.begin(),
                   [](auto value) { return static_cast<float>(value); });
  });
  return image;
}

std::string format_of_image(const fs::path& path) {
  require_file(path);
  try {
    return is_dicom_file(path) ? "DICOM SEG" : formats::read_image_header(path).format;
  } catch (const formats::FormatError& error) {
    fail(path, error.what());
  }
}

std::uintmax_t file_bytes_of_image(const fs::path& path) {
  require_file(path);
  std::set<fs::path> files{path};
  try {
    if (!is_dicom_file(path)) {
      for (const formats::DataFile& file : formats::read_image_header(path).files) files.insert(file.path);
    }
  } catch (const formats::FormatError& error) {
    fail(path, error.what());
  }
  std::uintmax_t bytes = 0;
  std::error_code error;
  for (const fs::path& file : files) {
    const std::uintmax_t size = fs::file_size(file, error);
    bytes += error ? 0 : size;
  }
  return bytes;
}

}  // namespace cbc3d
