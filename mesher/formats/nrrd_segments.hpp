// What 3D Slicer's .seg.nrrd says of its segments in the notes of its header.
#pragma once

#include <cstddef>
#include <vector>

#include "mesher/formats/image_header.hpp"
#include "mesher/formats/nrrd_frame.hpp"

namespace cbc3d::formats {

/// The segments of "SegmentN_Name:=...", by ascending N: Name, LabelValue, Layer and Color (red, green and
/// blue from 0 to 1). Files before Slicer 4.11 have one layer for each segment and give no LabelValue: the
/// value is 1, the layer N where the file has several `layers`. A colour that is none is left out. Throws
/// FormatError where a value or layer is no number or the file has no such layer.
std::vector<Segment> nrrd_segments(const NrrdFields& notes, std::size_t layers);

}  // namespace cbc3d::formats
