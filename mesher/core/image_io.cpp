#include "mesher/core/image_io.hpp"

#include <itkImageIOFactory.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>

#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"
#include "mesher/core/frame_check.hpp"
#include "mesher/core/inrimage.hpp"
#include "mesher/core/itk_formats.hpp"
#include "mesher/core/label_classifier.hpp"
#include "mesher/core/mapped_voxels.hpp"
#include "mesher/core/packed_voxels.hpp"

namespace cbc3d {
namespace fs = std::filesystem;
namespace {

using Component = itk::ImageIOBase::IOComponentType;

/// The beginning of every message about a file.
std::string subject_of(const fs::path& path) {
  return "cannot read '" + path.string() + "'";
}

[[noreturn]] void fail(const fs::path& path, const std::string& what) {
  throw InputError(subject_of(path) + ": " + what);
}

/// The part of an ITK exception's message that describes the fault, in one line.
std::string brief(const itk::ExceptionObject& error) {
  std::string text = error.GetDescription();
  std::replace(text.begin(), text.end(), '\n', ' ');
  const auto colon = text.rfind("): ");
  if (colon != std::string::npos) {
    text.erase(0, colon + 3);
  }
  return text.empty() ? "unknown fault" : text;
}

itk::ImageIOBase::Pointer open_header(const fs::path& path) {
  auto io = itk::ImageIOFactory::CreateImageIO(path.c_str(), itk::CommonEnums::IOFileMode::ReadMode);
  if (!io) {
    fail(path, "not an image format that is known; give NIfTI, NRRD, MHA/MHD or INRIMAGE (.inr, .inr.gz)");
  }
  try {
    io->SetFileName(path.string());
    io->ReadImageInformation();
  } catch (const itk::ExceptionObject& error) {
    fail(path, brief(error) + "; repair its header, or resample it to an orthogonal grid");
  }
  return io;
}

void require_scalar_volume(const itk::ImageIOBase& io, const fs::path& path) {
  if (io.GetNumberOfComponents() != 1) {
    fail(path,
         "it has " + std::to_string(io.GetNumberOfComponents()) +
             " components per voxel (a colour or vector image); give a label image with one value per voxel");
  }
  const unsigned dimension = io.GetNumberOfDimensions();
  if (dimension < 3) {
    fail(path, "it is " + std::to_string(dimension) +
                   "-dimensional; give a 3-D image (`cbc3d tile` stacks slices)");
  }
  for (unsigned axis = 3; axis < dimension; ++axis) {
    if (io.GetDimensions(axis) != 1) {
      fail(path, "it is " + std::to_string(dimension) + "-dimensional with " +
                     std::to_string(io.GetDimensions(axis)) + " volumes; give one 3-D volume of it");
    }
  }
}

/// True when an NRRD header says that the voxels lie in another file.
bool names_other_file(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  for (std::string line; std::getline(in, line) && !line.empty();) {
    if (line.starts_with("data file:") || line.starts_with("datafile:")) {
      return true;
    }
  }
  return false;
}

/// Refuses a small file whose header promises gigabytes before any memory is allocated. Deflate packs at most
/// 1032 to 1; files whose voxels lie elsewhere (detached headers) are not judged.
void require_plausible_size(const itk::ImageIOBase& io, const fs::path& path) {
  constexpr std::uintmax_t kMostPacked = 1100, kHarmlessBytes = 64U << 20U;
  const std::string extension = path.extension().string();
  const bool attached = extension == ".nii" || extension == ".gz" || extension == ".mha" ||
                        (extension == ".nrrd" && !names_other_file(path));
  const std::uintmax_t promised = io.GetImageSizeInBytes();
  if (attached && promised > kHarmlessBytes && promised / kMostPacked > fs::file_size(path)) {
    fail(path, "its header promises " + std::to_string(promised) + " bytes of voxels, but the file has " +
                   std::to_string(fs::file_size(path)) + "; it is truncated, copy it again");
  }
}

ImageFrame frame_of(const itk::ImageIOBase& io, const fs::path& path) {
  ImageFrame frame;
  for (unsigned axis = 0; axis < 3; ++axis) {
    const auto size = io.GetDimensions(axis);
    if (size < 1 || size > static_cast<std::size_t>(std::numeric_limits<int>::max())) {
      fail(path, "its size along axis " + std::to_string(axis) + " is " + std::to_string(size));
    }
    frame.size[axis] = static_cast<int>(size);
    frame.spacing_mm[axis] = io.GetSpacing(axis);
    frame.origin_mm[axis] = io.GetOrigin(axis);
    for (unsigned row = 0; row < 3; ++row) {
      frame.direction(row, axis) = io.GetDirection(axis)[row];
    }
  }
  require_usable_frame(frame, subject_of(path));
  return frame;
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

void classify_component(Component component, FileVoxels voxels, LabelImage& image, const fs::path& path) {
  switch (component) {
    case Component::UCHAR:
      return classify<unsigned char>(std::move(voxels), image, path);
    case Component::CHAR:
      return classify<signed char>(std::move(voxels), image, path);
    case Component::USHORT:
      return classify<unsigned short>(std::move(voxels), image, path);
    case Component::SHORT:
      return classify<short>(std::move(voxels), image, path);
    case Component::UINT:
      return classify<unsigned int>(std::move(voxels), image, path);
    case Component::INT:
      return classify<int>(std::move(voxels), image, path);
    case Component::ULONG:
      return classify<unsigned long>(std::move(voxels), image, path);
    case Component::LONG:
      return classify<long>(std::move(voxels), image, path);
    case Component::ULONGLONG:
      return classify<unsigned long long>(std::move(voxels), image, path);
    case Component::LONGLONG:
      return classify<long long>(std::move(voxels), image, path);
    case Component::FLOAT:
      return classify<float>(std::move(voxels), image, path);
    case Component::DOUBLE:
      return classify<double>(std::move(voxels), image, path);
    default:
      fail(path, "its pixel type is not known; convert it to an integer type");
  }
}

/// Reads the voxels with ITK, which works for every format.
VoxelBytes read_voxels(itk::ImageIOBase& io, const fs::path& path) {
  itk::ImageIORegion region(io.GetNumberOfDimensions());
  for (unsigned axis = 0; axis < io.GetNumberOfDimensions(); ++axis) {
    region.SetSize(axis, io.GetDimensions(axis));
    region.SetIndex(axis, 0);
  }
  io.SetIORegion(region);
  VoxelBytes voxels(0, io.GetImageSizeInBytes());
  try {
    io.Read(voxels.data());
  } catch (const itk::ExceptionObject& error) {
    fail(path, brief(error) + "; the file may be truncated, copy it again");
  }
  return voxels;
}

FileVoxels voxels_of_file(itk::ImageIOBase& io, const fs::path& path) {
  const auto bytes = static_cast<std::size_t>(io.GetImageSizeInBytes());
  const std::size_t component_bytes = io.GetComponentSize();
  if (auto mapped = map_raw_nrrd(path, bytes, component_bytes)) {
    return std::move(*mapped);
  }
  const bool floating =
      io.GetComponentType() == Component::FLOAT || io.GetComponentType() == Component::DOUBLE;
  if (auto unpacked = unpack_voxels(path, bytes, component_bytes, floating)) {
    return std::move(*unpacked);
  }
  return read_voxels(io, path);
}

LabelImage read_with_itk(const fs::path& path) {
  const auto io = open_header(path);
  require_scalar_volume(*io, path);
  require_plausible_size(*io, path);
  LabelImage image;
  image.frame = frame_of(*io, path);
  classify_component(io->GetComponentType(), voxels_of_file(*io, path), image, path);
  return image;
}

LabelImage read_from_inrimage(const fs::path& path) {
  constexpr std::array<Component, 8> kComponents = {// in the order of InrimageVolume::Voxel
                                                    Component::UCHAR, Component::CHAR,  Component::USHORT,
                                                    Component::SHORT, Component::UINT,  Component::INT,
                                                    Component::FLOAT, Component::DOUBLE};
  InrimageVolume volume = read_inrimage(path);
  LabelImage image;
  image.frame = volume.frame;
  classify_component(kComponents[static_cast<std::size_t>(volume.type)], std::move(volume.bytes), image,
                     path);
  return image;
}

template <typename T>
std::vector<T> label_values(const LabelImage& image) {
  std::vector<T> values(image.voxels.size());
  image.voxels.visit([&](const auto* voxels) {
#pragma omp parallel for
    for (std::size_t v = 0; v < values.size(); ++v) {
      values[v] = static_cast<T>(image.labels[voxels[v]]);
    }
  });
  return values;
}

void write_values(itk::ImageIOBase& io, Component component, const void* values, const fs::path& path) {
  io.SetComponentType(component);
  try {
    io.Write(values);
  } catch (const itk::ExceptionObject& error) {
    throw JobError("cannot write '" + path.string() + "': " + brief(error));
  }
}

void describe(itk::ImageIOBase& io, const ImageFrame& frame) {
  io.SetNumberOfDimensions(3);
  io.SetPixelType(itk::CommonEnums::IOPixel::SCALAR);
  io.SetNumberOfComponents(1);
  io.SetUseCompression(true);
  itk::ImageIORegion region(3);
  for (unsigned axis = 0; axis < 3; ++axis) {
    io.SetDimensions(axis, static_cast<itk::SizeValueType>(frame.size[axis]));
    io.SetSpacing(axis, frame.spacing_mm[axis]);
    io.SetOrigin(axis, frame.origin_mm[axis]);
    io.SetDirection(axis, {frame.direction(0, axis), frame.direction(1, axis), frame.direction(2, axis)});
    region.SetSize(axis, static_cast<itk::SizeValueType>(frame.size[axis]));
  }
  io.SetIORegion(region);
}

/// ITK chooses the format by the extension, so the temporary file keeps it: ".name.part7" + extension.
std::string image_extension(const fs::path& path) {
  const std::string name = path.filename().string();
  return name.ends_with(".nii.gz") ? ".nii.gz" : path.extension().string();
}

}  // namespace

LabelImage read_label_image(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) {
    fail(path, "the file does not exist; check its name");
  }
  if (fs::is_directory(path, error)) {
    fail(path, "it is a folder; name an image file");
  }
  register_itk_formats();
  LabelImage image = has_inrimage_extension(path) ? read_from_inrimage(path) : read_with_itk(path);
  if (image.labels.size() < 2) {
    fail(path, "every voxel is background (0); there is nothing to mesh");
  }
  return image;
}

void write_label_image(const LabelImage& image, const fs::path& path) {
  register_itk_formats();
  const std::string extension = image_extension(path);
  AtomicFile file(path);
  fs::path temporary = file.temporary();
  temporary += extension;
  auto io = itk::ImageIOFactory::CreateImageIO(temporary.c_str(), itk::CommonEnums::IOFileMode::WriteMode);
  if (!io || extension == ".mhd") {
    throw InputError("cannot write '" + path.string() +
                     "': unknown image format; use .nii, .nii.gz, .nrrd or .mha");
  }
  io->SetFileName(temporary.string());
  describe(*io, image.frame);
  const auto [lowest, highest] = std::minmax_element(image.labels.begin(), image.labels.end());
  try {
    if (*lowest >= 0 && *highest <= 255) {
      write_values(*io, Component::UCHAR, label_values<unsigned char>(image).data(), path);
    } else if (*lowest >= -32768 && *highest <= 32767) {
      write_values(*io, Component::SHORT, label_values<short>(image).data(), path);
    } else {
      write_values(*io, Component::INT, label_values<int>(image).data(), path);
    }
  } catch (...) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw;
  }
  fs::rename(temporary, file.temporary());
  file.commit();
}

}  // namespace cbc3d
