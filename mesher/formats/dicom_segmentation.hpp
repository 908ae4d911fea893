// DICOM segmentation objects (PS3.3, A.51): frames of one bit per voxel, each of one segment in one plane.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "mesher/formats/image_header.hpp"

namespace cbc3d::formats {

/// A segmentation as a volume of segment numbers.
struct DicomSegmentation {
  ImageHeader header;                 ///< of 16 bits without sign; it names no files
  std::vector<std::uint16_t> labels;  ///< of the voxels, 0 where no segment is
};

/// Reads a binary segmentation. The frame is that of the functional groups: axes from the image orientation,
/// slices at the frames' positions along their normal, those that were left out empty. A voxel in several
/// segments has the highest number of them, and a warning counts such voxels. Throws FormatError for other
/// objects of DICOM, naming what they are, for fractional and compressed segmentations, and where planes are
/// not parallel and evenly spaced.
DicomSegmentation read_dicom_segmentation(const std::filesystem::path& path);

}  // namespace cbc3d::formats
