#include "mesher/app/tiff_pages.hpp"

#include <tiffio.h>

#include <filesystem>
#include <fstream>
#include <memory>

#include "mesher/app/tiff_directories.hpp"
#include "mesher/core/error.hpp"

namespace cbc3d {
namespace {

struct Closer {
  void operator()(TIFF* file) const { TIFFClose(file); }
};
using File = std::unique_ptr<TIFF, Closer>;

[[noreturn]] void fail(const std::string& file, const std::string& what) {
  throw InputError("cannot read '" + file + "': " + what);
}

/// libtiff would print its faults.
File open(const std::string& file) {
  TIFFSetErrorHandler(nullptr);
  TIFFSetWarningHandler(nullptr);
  File tiff(TIFFOpen(file.c_str(), "r"));
  if (!tiff) {
    fail(file, "a broken TIFF file, or one that may not be read; copy it again");
  }
  return tiff;
}

template <typename T>
T field(TIFF* tiff, std::uint32_t tag, T otherwise) {
  T value{};
  return TIFFGetFieldDefaulted(tiff, tag, &value) == 1 ? value : otherwise;
}

TiffPage::Value value_of(TIFF* tiff, const std::string& file) {
  using Value = TiffPage::Value;
  const auto bits = field<std::uint16_t>(tiff, TIFFTAG_BITSPERSAMPLE, 1);
  const auto format = field<std::uint16_t>(tiff, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_UINT);
  const bool with_sign = format == SAMPLEFORMAT_INT;
  if (format == SAMPLEFORMAT_IEEEFP && bits == 32) {
    return Value::float32;
  }
  if (format == SAMPLEFORMAT_UINT || format == SAMPLEFORMAT_VOID || with_sign) {
    switch (bits) {
      case 8:
        return with_sign ? Value::int8 : Value::uint8;
      case 16:
        return with_sign ? Value::int16 : Value::uint16;
      case 32:
        return with_sign ? Value::int32 : Value::uint32;
      default:
        break;
    }
  }
  fail(file, "its values have " + std::to_string(bits) + " bits (sample format " + std::to_string(format) +
                 "); convert it to integers of 8, 16 or 32 bits");
}

void require_grey(TIFF* tiff, const std::string& file) {
  switch (field<std::uint16_t>(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK)) {
    case PHOTOMETRIC_MINISBLACK:
    case PHOTOMETRIC_RGB:
      break;
    case PHOTOMETRIC_PALETTE:
      fail(file, "it is a palette image, whose values stand for colours; convert it to grey values");
    case PHOTOMETRIC_MINISWHITE:
      fail(file, "its grey values are inverted (white is zero); save it with black as zero");
    default:
      fail(file, "its colours are neither grey nor RGB; convert it to grey values");
  }
  if (TIFFIsTiled(tiff) != 0 ||
      field<std::uint16_t>(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG) != PLANARCONFIG_CONTIG) {
    fail(file, "its pixels are stored in tiles or colour planes; save it in strips");
  }
  if (field<std::uint16_t>(tiff, TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT) != ORIENTATION_TOPLEFT) {
    fail(file, "its rows do not run from the top left (orientation tag); save it upright");
  }
}

TiffPage empty_page(TIFF* tiff, const std::string& file) {
  constexpr std::uint64_t kHarmless = 1U << 26U, kMostPacked = 1100;
  TiffPage page;
  page.width = field<std::uint32_t>(tiff, TIFFTAG_IMAGEWIDTH, 0);
  page.height = field<std::uint32_t>(tiff, TIFFTAG_IMAGELENGTH, 0);
  page.channels = field<std::uint16_t>(tiff, TIFFTAG_SAMPLESPERPIXEL, 1);
  page.value = value_of(tiff, file);
  const auto row = static_cast<std::uint64_t>(TIFFScanlineSize(tiff));
  if (page.width < 1 || page.height < 1 || row < page.width || page.channels < 1 || page.channels > 4 ||
      row > (kHarmless + kMostPacked * std::filesystem::file_size(file)) / page.height) {
    fail(file, "its header promises more pixels than it can hold, or none; copy it again");
  }
  page.bytes.resize(row * page.height);
  return page;
}

}  // namespace

bool is_tiff(const std::string& file) {
  char magic[4] = {};
  std::ifstream(file, std::ios::binary).read(magic, sizeof magic);
  const std::string text(magic, sizeof magic);
  return text == std::string("II*\0", 4) || text == std::string("MM\0*", 4) ||
         text == std::string("II+\0", 4) || text == std::string("MM\0+", 4);
}

std::size_t count_tiff_pages(const std::string& file) {
  const std::size_t count = require_whole_tiff(file);
  if (count == 0 || TIFFNumberOfDirectories(open(file).get()) != count) {
    fail(file, "a broken TIFF file: its pages cannot be counted; copy it again");
  }
  return count;
}

TiffPage read_tiff_page(const std::string& file, std::size_t number) {
  const File tiff = open(file);
  if (TIFFSetDirectory(tiff.get(), static_cast<tdir_t>(number)) != 1) {
    fail(file, "its page " + std::to_string(number + 1) + " is broken; copy it again");
  }
  require_grey(tiff.get(), file);
  TiffPage page = empty_page(tiff.get(), file);
  const std::size_t row = page.bytes.size() / page.height;
  for (std::size_t y = 0; y < page.height; ++y) {
    if (TIFFReadScanline(tiff.get(), page.bytes.data() + y * row, static_cast<std::uint32_t>(y)) != 1) {
      fail(file, "a broken or truncated image; copy it again");
    }
  }
  return page;
}

}  // namespace cbc3d
