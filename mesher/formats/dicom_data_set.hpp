// DICOM files as data sets of elements (PS3.5 and PS3.10), uncompressed and little-endian.
//
// Notation: tag  group and element as one number: (0062,0002) is 0x00620002.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "mesher/formats/image_header.hpp"

namespace cbc3d::formats {

struct DicomElement;

/// What a file, or an item of a sequence, holds. Values are views of the file's bytes.
struct DicomDataSet {
  std::vector<DicomElement> elements;

  /// The element of the tag; null where there is none.
  [[nodiscard]] const DicomElement* find(std::uint32_t tag) const;
  /// Its value as text without padding, values separated by blanks; empty where there is none.
  [[nodiscard]] std::string text(std::uint32_t tag) const;
  /// Its first value, of 16 bits without sign; `missing` where there is none.
  [[nodiscard]] int number(std::uint32_t tag, int missing) const;
  /// The items of a sequence; none where there is no such sequence.
  [[nodiscard]] const std::vector<DicomDataSet>& items(std::uint32_t tag) const;
};

struct DicomElement {
  std::uint32_t tag = 0;
  std::string_view value;           ///< empty for a sequence
  std::vector<DicomDataSet> items;  ///< of a sequence
  bool is_compressed = false;       ///< pixels in fragments
};

/// True when a file begins like one of DICOM.
bool is_dicom(std::string_view head);

/// The data set of a file. Throws FormatError where it is cut off, nests deeper than any known object, or has
/// another transfer syntax than the two that are read.
DicomDataSet parse_dicom(std::string_view file);

}  // namespace cbc3d::formats
