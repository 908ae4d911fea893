// Slices in files, for tests.
#pragma once

#include <itkImageIOBase.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace cbc3d::testing {

inline constexpr std::size_t kWidth = 7, kHeight = 5;

/// By ITK, a row of kWidth pixels after the other.
template <class Format, class Value>
void write_slice(const std::filesystem::path& path, const std::vector<Value>& values,
                 itk::ImageIOBase::IOComponentType type, unsigned channels = 1) {
  auto io = Format::New();
  io->SetNumberOfDimensions(2);
  io->SetDimensions(0, kWidth);
  io->SetDimensions(1, values.size() / kWidth / channels);
  io->SetComponentType(type);
  io->SetPixelType(channels == 1 ? itk::CommonEnums::IOPixel::SCALAR : itk::CommonEnums::IOPixel::RGB);
  io->SetNumberOfComponents(channels);
  io->SetFileName(path.string());
  itk::ImageIORegion region(2);
  region.SetSize(0, kWidth);
  region.SetSize(1, values.size() / kWidth / channels);
  io->SetIORegion(region);
  io->Write(values.data());
}

/// Values that differ from pixel to pixel and from slice to slice.
template <class Value>
std::vector<Value> slice(int k) {
  std::vector<Value> values(kWidth * kHeight);
  for (std::size_t n = 0; n < values.size(); ++n) {
    values[n] = static_cast<Value>(1 + n + 40 * static_cast<std::size_t>(k));
  }
  return values;
}

inline constexpr int kPalette = 3;  // of TIFF's photometric interpretations

/// A TIFF file of pages of 3 x 2 values, each value its number in the file plus one.
inline std::string tiff(int pages, int bits, int photometric, int format) {
  std::string bytes("II*\0\0\0\0\0", 8);
  const auto put = [&](std::size_t at, std::uint32_t value, std::size_t length) {
    for (std::size_t n = 0; n < length; ++n) {
      bytes[at + n] = static_cast<char>(value >> 8 * n);
    }
  };
  std::size_t link = 4;
  for (int page = 0; page < pages; ++page) {
    const auto strip = static_cast<std::uint32_t>(bytes.size());
    const auto each = static_cast<std::size_t>(bits) / 8;
    bytes.resize(bytes.size() + 6 * each + (6 * each) % 2, '\0');
    for (std::size_t v = 0; v < 6; ++v) {
      put(strip + v * each, static_cast<std::uint32_t>(6 * static_cast<std::size_t>(page) + v + 1), each);
    }
    put(link, static_cast<std::uint32_t>(bytes.size()), 4);
    const auto map = static_cast<std::uint32_t>(bytes.size());
    bytes.resize(bytes.size() + (photometric == kPalette ? 3 * 2 * 256 : 0), '\1');
    if (photometric == kPalette) {
      put(link, static_cast<std::uint32_t>(bytes.size()), 4);
    }
    std::vector<std::array<std::uint32_t, 4>> entries = {{256, 4, 1, 3},
                                                         {257, 4, 1, 2},
                                                         {258, 4, 1, static_cast<std::uint32_t>(bits)},
                                                         {259, 4, 1, 1},
                                                         {262, 4, 1, static_cast<std::uint32_t>(photometric)},
                                                         {273, 4, 1, strip},
                                                         {277, 4, 1, 1},
                                                         {278, 4, 1, 2},
                                                         {279, 4, 1, static_cast<std::uint32_t>(6 * each)},
                                                         {339, 4, 1, static_cast<std::uint32_t>(format)}};
    if (photometric == kPalette) {
      entries.insert(entries.end() - 1, {320, 3, 3 * 256, map});
    }
    std::size_t at = bytes.size();
    bytes.resize(at + 2 + 12 * entries.size() + 4, '\0');
    put(at, static_cast<std::uint32_t>(entries.size()), 2);
    at += 2;
    for (const auto& [tag, type, count, value] : entries) {
      put(at, tag, 2);
      put(at + 2, type, 2);  // 3 and 4: integers of 16 and 32 bits
      put(at + 4, count, 4);
      put(at + 8, value, 4);
      at += 12;
    }
    link = at;
  }
  return bytes;
}

}  // namespace cbc3d::testing
