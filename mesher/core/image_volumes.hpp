// Files that hold several images of one frame: volumes of a 4-D image, layers of a segmentation.
#pragma once

#include <string>
#include <vector>

#include "mesher/core/image_io.hpp"
#include "mesher/core/label_voxels.hpp"
#include "mesher/formats/image_header.hpp"

namespace cbc3d {

/// One value per voxel of a file that may have several: the volume or layer that the options choose, or all
/// layers of a segmentation combined. `header` becomes that of the result and gains warnings, its segments
/// stay those whose voxels are in the result, with its values. Throws FormatError where the choice is
/// missing, does not exist or is of the other kind, and for 4-D probability maps.
FileVoxels one_value_per_voxel(formats::ImageHeader& header, FileVoxels voxels,
                               const ReadImageOptions& options);

/// One volume, or layer, of a file; it exists.
VoxelBytes volume_of(const formats::ImageHeader& header, const FileVoxels& voxels, std::size_t volume);

/// Lays the layers of a segmentation over each other. Where segments overlap the voxel belongs to the one
/// that comes last in the file; a warning counts such voxels and names the pairs. A segment's label is its
/// value; where two layers have one value for different segments, the segments are numbered from 1 on in the
/// order of the file instead, as 3D Slicer's export does, and a warning says so. Values of no segment come
/// first in that order and are numbered last. Throws FormatError for floating-point values and for more than
/// 65536 values.
FileVoxels combine_layers(formats::ImageHeader& header, const FileVoxels& voxels);

/// The names of a file's segments by their values. Of two with one value the first is taken, and a warning of
/// the header says so.
LabelNames names_of_segments(formats::ImageHeader& header);

/// Fractions from 0 to 1 and nothing else: one of them as text; empty for all other values.
std::string probability_in(const formats::ImageHeader& header, const FileVoxels& voxels);

}  // namespace cbc3d
