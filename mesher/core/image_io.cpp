#include "mesher/core/image_io.hpp"

#include <fcntl.h>
#include <itkImageIOFactory.h>
#include <unistd.h>

#include <algorithm>

#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"
#include "mesher/core/itk_formats.hpp"
#include "mesher/formats/read_header.hpp"
#include "mesher/formats/voxel_data.hpp"

namespace cbc3d {
namespace fs = std::filesystem;
namespace {

using Component = itk::ImageIOBase::IOComponentType;

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

/// ITK's writers print their own lines beside the one that we give; they go nowhere as long as this lives.
class QuietStandardError {
 public:
  QuietStandardError() : kept_(::dup(STDERR_FILENO)) {
    const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nowhere >= 0) {
      ::dup2(nowhere, STDERR_FILENO);
      ::close(nowhere);
    }
  }
  ~QuietStandardError() {
    if (kept_ >= 0) {
      ::dup2(kept_, STDERR_FILENO);
      ::close(kept_);
    }
  }
  QuietStandardError(const QuietStandardError&) = delete;
  QuietStandardError& operator=(const QuietStandardError&) = delete;

 private:
  int kept_;
};

/// ITK's writers do not say when a disk is full: what they wrote is read again. Throws JobError.
void require_whole(const fs::path& written, const fs::path& path) {
  const int error = errno;
  try {
    formats::ImageHeader header = formats::read_image_header(written);
    formats::require_plausible_length(header);
    std::vector<std::uint8_t> buffer(formats::lead_bytes(header) + formats::voxel_bytes(header));
    formats::read_voxels(header, buffer);
  } catch (const formats::FormatError&) {
    fail_to_write(path, error);
  }
}

void write_values(itk::ImageIOBase& io, Component component, const void* values, const fs::path& path) {
  io.SetComponentType(component);
  const QuietStandardError quiet;
  errno = 0;
  try {
    io.Write(values);
  } catch (const itk::ExceptionObject&) {
    fail_to_write(path);
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

void require_writable_image_path(const fs::path& path) {
  const std::string extension = image_extension(path);
  if (extension != ".nii" && extension != ".nii.gz" && extension != ".nrrd" && extension != ".mha") {
    throw InputError("cannot write '" + path.string() +
                     "': unknown image format; use .nii, .nii.gz, .nrrd or .mha");
  }
  require_writable(path);
}

void write_label_image(const LabelImage& image, const fs::path& path) {
  register_itk_formats();
  require_writable_image_path(path);
  const std::string extension = image_extension(path);
  AtomicFile file(path);
  fs::path temporary = file.temporary();
  temporary += extension;
  auto io = itk::ImageIOFactory::CreateImageIO(temporary.c_str(), itk::CommonEnums::IOFileMode::WriteMode);
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
    require_whole(temporary, path);
  } catch (...) {
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw;
  }
  fs::rename(temporary, file.temporary());
  file.commit();
}

}  // namespace cbc3d
