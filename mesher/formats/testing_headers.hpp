// Files of a test, what their headers say and why they are refused.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <string>
#include <vector>

#include "mesher/formats/read_header.hpp"
#include "mesher/formats/testing_gzip.hpp"
#include "mesher/formats/voxel_data.hpp"
#include "mesher/testing/temporary_folder.hpp"

namespace cbc3d::formats::testing {

inline std::string packed(const std::string& bytes) {
  const cbc3d::testing::Bytes all = cbc3d::testing::compressed({bytes.begin(), bytes.end()}, 6);
  return {all.begin(), all.end()};
}

/// Writes a number at a place of a binary header.
template <typename T>
void put(std::string& bytes, std::size_t at, T value, bool big_endian = false) {
  char raw[sizeof(T)];
  std::memcpy(raw, &value, sizeof(T));
  for (std::size_t n = 0; n < sizeof(T); ++n) {
    bytes[at + n] = raw[big_endian ? sizeof(T) - 1 - n : n];
  }
}

class Headers : public ::testing::Test {
 protected:
  [[nodiscard]] ImageHeader header_of(const std::string& name, const std::string& bytes) const {
    folder_.write(name, bytes);
    return read_image_header(folder_.file(name));
  }
  /// The voxels as bytes.
  [[nodiscard]] std::vector<std::uint8_t> voxels_of(const std::string& name, const std::string& bytes) const {
    ImageHeader header = header_of(name, bytes);
    require_plausible_length(header);
    std::vector<std::uint8_t> buffer(lead_bytes(header) + voxel_bytes(header));
    read_voxels(header, buffer);
    buffer.erase(buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(lead_bytes(header)));
    return buffer;
  }
  /// The refusal of header or voxels; empty when both are taken.
  [[nodiscard]] std::string refusal_of(const std::string& name, const std::string& bytes) const {
    try {
      static_cast<void>(voxels_of(name, bytes));
    } catch (const FormatError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
      return error.what();
    }
    return "";
  }
  void expect_refusal(const std::string& name, const std::string& bytes, const std::string& words) const {
    EXPECT_NE(refusal_of(name, bytes).find(words), std::string::npos) << refusal_of(name, bytes);
  }
  cbc3d::testing::TemporaryFolder folder_{"formats"};
};

/// A NIfTI-1 header of 2 x 3 x 4 bytes in front of these.
inline std::string nifti(bool big_endian = false) {
  std::string bytes(352 + 24, '\0');
  const auto put16 = [&](std::size_t at, int value) {
    put(bytes, at, static_cast<std::int16_t>(value), big_endian);
  };
  put(bytes, 0, std::int32_t{348}, big_endian);
  put16(40, 3);
  for (int axis = 0; axis < 3; ++axis) {
    put16(42 + 2 * static_cast<std::size_t>(axis), 2 + axis);
    put(bytes, 80 + 4 * static_cast<std::size_t>(axis), 0.5F * static_cast<float>(axis + 1), big_endian);
  }
  put16(48, 1);
  put16(70, 2);
  put16(72, 8);
  put(bytes, 76, 1.0F, big_endian);
  put(bytes, 108, 352.0F, big_endian);
  bytes[123] = 2;
  put16(254, 1);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    put(bytes, 280 + 16 * axis + 4 * axis, 0.5F * static_cast<float>(axis + 1), big_endian);
    put(bytes, 292 + 16 * axis, 10.0F * static_cast<float>(axis + 1), big_endian);
  }
  bytes.replace(344, 4, std::string("n+1\0", 4));
  for (int v = 0; v < 24; ++v) {
    bytes[352 + static_cast<std::size_t>(v)] = static_cast<char>(v % 5);
  }
  return bytes;
}

/// An NRRD header of 2 x 3 x 4 bytes with these lines in place of the frame's, in front of its voxels.
inline std::string nrrd(const std::string& lines) {
  std::string voxels;
  for (int v = 0; v < 24; ++v) {
    voxels += static_cast<char>(v % 5);
  }
  return "NRRD0005\ntype: uchar\ndimension: 3\nsizes: 2 3 4\nencoding: raw\n" + lines + "\n" + voxels;
}

/// A MetaImage header of 2 x 3 x 4 bytes with these lines among the others, in front of its voxels.
inline std::string metaimage(const std::string& lines) {
  return "ObjectType = Image\nNDims = 3\nDimSize = 2 3 4\nElementType = MET_UCHAR\n" + lines +
         "ElementDataFile = LOCAL\n" + nrrd("").substr(nrrd("").size() - 24);
}

}  // namespace cbc3d::formats::testing
