// Label images from arrays in memory.
#pragma once

#include <cstdint>
#include <span>
#include <variant>

#include "mesher/core/label_image.hpp"

namespace cbc3d {

/// The label values of an image's voxels, i fastest, then j, then k; 0 is background. A contiguous container
/// of one of these types converts to it: a std::vector<std::uint8_t>, say.
using LabelArray = std::variant<std::span<const std::int8_t>, std::span<const std::uint8_t>,
                                std::span<const std::int16_t>, std::span<const std::uint16_t>,
                                std::span<const std::int32_t>, std::span<const std::uint32_t>,
                                std::span<const std::int64_t>, std::span<const std::uint64_t>>;

/// Copies an array into a label image, in parallel; `frame` gives the size of the array and its place in
/// physical space. Throws InputError when the array has not size[0] * size[1] * size[2] values, none of them
/// is a label, one does not fit 32 bits or more than 65536 differ, and for a frame that require_usable_frame
/// refuses.
LabelImage to_label_image(const LabelArray& labels, const ImageFrame& frame);

}  // namespace cbc3d
