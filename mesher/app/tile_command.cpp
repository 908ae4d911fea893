#include "mesher/app/tile_command.hpp"

#include <itkBMPImageIO.h>
#include <itkPNGImageIO.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <memory>
#include <span>
#include <sstream>

#include "mesher/app/bmp_header.hpp"
#include "mesher/app/natural_order.hpp"
#include "mesher/app/subcommand.hpp"
#include "mesher/app/tiff_pages.hpp"
#include "mesher/command_line/number_range.hpp"
#include "mesher/core/atomic_file.hpp"
#include "mesher/core/child_process.hpp"
#include "mesher/core/error.hpp"
#include "mesher/core/terminal_progress.hpp"

namespace cbc3d {
namespace {

namespace fs = std::filesystem;
using Component = itk::ImageIOBase::IOComponentType;

struct TileCommand {
  std::vector<std::string> slices;
  std::string out;
  std::vector<double> spacing_mm, origin_mm{0, 0, 0};
  bool natural_order = false;  ///< slices are sorted by the numbers in their names
  bool luminance = false;      ///< colours become grey
  CommonOptions common;
};

/// One slice: grey values in the file's own type.
struct Slice {
  std::size_t width = 0, height = 0;
  Component component = Component::UCHAR;
  std::size_t bytes_per_value = 1;
  std::vector<char> values;
};

[[noreturn]] void fail(const std::string& file, const std::string& what) {
  throw InputError("cannot read '" + file + "': " + what);
}

itk::ImageIOBase::Pointer reader_of(const std::string& file) {
  const std::vector<itk::ImageIOBase::Pointer> formats{itk::PNGImageIO::New().GetPointer(),
                                                       itk::BMPImageIO::New().GetPointer()};
  for (const auto& io : formats) {
    if (io->CanReadFile(file.c_str())) {
      return io;
    }
  }
  fail(file, "not a PNG, BMP or TIFF image; convert it to one");
}

/// The luminance of a pixel by ITU-R BT.601, as most programs take it, in the place of its first channel.
template <typename T>
void put_luminance(char* pixel) {
  T rgb[3];
  std::memcpy(rgb, pixel, sizeof rgb);
  const auto grey = static_cast<T>(std::lround(0.299 * rgb[0] + 0.587 * rgb[1] + 0.114 * rgb[2]));
  std::memcpy(pixel, &grey, sizeof grey);
}

/// Takes a colour slice whose channels are all the same as a grey one; others are refused, or become their
/// luminance where that is asked for.
void keep_one_channel(Slice& slice, std::size_t channels, const std::string& file, bool luminance) {
  const std::size_t count = slice.width * slice.height, bytes = slice.bytes_per_value;
  const bool is_whole = slice.component == Component::UCHAR || slice.component == Component::USHORT;
  for (std::size_t pixel = 0; channels > 1 && pixel < count; ++pixel) {
    char* const from = slice.values.data() + pixel * channels * bytes;
    const bool coloured = channels >= 3 && (std::memcmp(from, from + bytes, bytes) != 0 ||
                                            std::memcmp(from, from + 2 * bytes, bytes) != 0);
    if (coloured && !(luminance && is_whole)) {
      fail(file, is_whole
                     ? "it is a colour image; convert it to grey values first, or take their luminance with "
                       "--luminance (for grey images, not for labels drawn in colours)"
                     : "it is a colour image; convert it to grey values first");
    }
    if (coloured) {
      bytes == 1 ? put_luminance<std::uint8_t>(from) : put_luminance<std::uint16_t>(from);
    }
    std::memmove(slice.values.data() + pixel * bytes, from, bytes);
  }
  slice.values.resize(count * bytes);
}

Slice read_tiff_slice(const std::string& file, std::size_t page, bool luminance) {
  constexpr Component kComponents[] = {Component::UCHAR, Component::CHAR, Component::USHORT, Component::SHORT,
                                       Component::UINT,  Component::INT,  Component::FLOAT};
  constexpr std::size_t kBytes[] = {1, 1, 2, 2, 4, 4, 4};
  TiffPage from = read_tiff_page(file, page);
  const auto type = static_cast<std::size_t>(from.value);
  Slice slice{from.width, from.height, kComponents[type], kBytes[type], std::move(from.bytes)};
  keep_one_channel(slice, from.channels, file, luminance);
  return slice;
}

/// A palette's values stand for colours, which ITK puts in their place.
void require_no_palette(const std::string& file) {
  constexpr std::size_t kColourType = 25;
  constexpr char kPalette = 3;
  char head[kColourType + 1] = {};
  std::ifstream(file, std::ios::binary).read(head, sizeof head);
  if (std::string(head + 1, 3) == "PNG" && head[kColourType] == kPalette) {
    fail(file, "it is a palette image, whose values stand for colours; convert it to grey values");
  }
}

/// What the child sends before the values.
struct SliceHead {
  std::size_t width = 0, height = 0, bytes_per_value = 0, channels = 0, bytes = 0;
  Component component = Component::UCHAR;
};

/// Memory for a picture of the most pixels that a file of its length may have.
ChildLimits limits_of(const std::string& file) {
  constexpr std::uint64_t kLeastMemory = std::uint64_t{1} << 29U, kMostPacked = 2200;
  const std::uint64_t bytes = fs::file_size(file);
  return {.memory_bytes = kLeastMemory + kMostPacked * bytes,
          .cpu_seconds = static_cast<unsigned>(5 + bytes / 1000000)};
}

/// The libraries for PNG and BMP end the process on some damaged files, so a child reads them.
void read_and_send(itk::ImageIOBase& io, const std::string& file, const ChildOutput& out) {
  io.SetFileName(file);
  io.ReadImageInformation();
  itk::ImageIORegion region(2);
  region.SetSize(0, io.GetDimensions(0));
  region.SetSize(1, io.GetDimensions(1));
  io.SetIORegion(region);
  const SliceHead head{.width = io.GetDimensions(0),
                       .height = io.GetDimensions(1),
                       .bytes_per_value = io.GetComponentSize(),
                       .channels = io.GetNumberOfComponents(),
                       .bytes = static_cast<std::size_t>(io.GetImageSizeInBytes()),
                       .component = io.GetComponentType()};
  std::vector<char> values(head.bytes);
  io.Read(values.data());
  out.write(std::as_bytes(std::span(&head, 1)));
  out.write(std::as_bytes(std::span(values)));
}

Slice read_slice(const std::string& file, std::size_t page, bool luminance) {
  if (is_tiff(file)) {
    return read_tiff_slice(file, page, luminance);
  }
  require_no_palette(file);
  if (is_bmp(file)) {
    require_whole_bmp(file);
  }
  const auto io = reader_of(file);
  Slice slice;
  ChildProcess child(limits_of(file), [&](const ChildOutput& out) { read_and_send(*io, file, out); });
  SliceHead head;
  const bool is_there = child.read(std::as_writable_bytes(std::span(&head, 1)));
  slice.values.resize(is_there ? head.bytes : 0);
  if (!is_there || !child.read(std::as_writable_bytes(std::span(slice.values)))) {
    fail(file, "a broken or truncated image; copy it again");
  }
  slice.width = head.width;
  slice.height = head.height;
  slice.component = head.component;
  slice.bytes_per_value = head.bytes_per_value;
  keep_one_channel(slice, head.channels, file, luminance);
  return slice;
}

struct TypeNames {
  Component component;
  const char *nrrd, *meta;
};

const TypeNames& names_of(Component component, const std::string& file) {
  static const std::vector<TypeNames> names{{Component::UCHAR, "unsigned char", "MET_UCHAR"},
                                            {Component::CHAR, "signed char", "MET_CHAR"},
                                            {Component::USHORT, "unsigned short", "MET_USHORT"},
                                            {Component::SHORT, "short", "MET_SHORT"},
                                            {Component::UINT, "unsigned int", "MET_UINT"},
                                            {Component::INT, "int", "MET_INT"},
                                            {Component::FLOAT, "float", "MET_FLOAT"}};
  const auto found = std::find_if(names.begin(), names.end(),
                                  [&](const TypeNames& name) { return name.component == component; });
  if (found == names.end()) {
    fail(file, "its values are of a type that is not known; convert it to 8 or 16 bits");
  }
  return *found;
}

std::string triple(const std::vector<double>& v, const char* separator) {
  std::ostringstream text;
  text.precision(17);
  text << v[0] << separator << v[1] << separator << v[2];
  return text.str();
}

/// In both formats uncompressed values follow, first axis fastest, lowest byte first.
std::string header(const TileCommand& command, const Slice& first, std::size_t slices) {
  const TypeNames& names = names_of(first.component, command.slices.front());
  const std::vector<double>& s = command.spacing_mm;
  std::ostringstream text;
  text.precision(17);
  const std::string sizes =
      std::to_string(first.width) + " " + std::to_string(first.height) + " " + std::to_string(slices);
  if (fs::path(command.out).extension() == ".nrrd") {
    text << "NRRD0004\ntype: " << names.nrrd
         << "\ndimension: 3\nspace: left-posterior-superior\nsizes: " << sizes << "\nspace directions: ("
         << s[0] << ",0,0) (0," << s[1] << ",0) (0,0," << s[2]
         << ")\nkinds: domain domain domain\nendian: little\nencoding: raw\nspace origin: ("
         << triple(command.origin_mm, ",") << ")\n\n";
  } else {
    text << "ObjectType = Image\nNDims = 3\nBinaryData = True\nBinaryDataByteOrderMSB = False\n"
         << "CompressedData = False\nTransformMatrix = 1 0 0 0 1 0 0 0 1\nOffset = "
         << triple(command.origin_mm, " ") << "\nElementSpacing = " << triple(s, " ")
         << "\nDimSize = " << sizes << "\nElementType = " << names.meta << "\nElementDataFile = LOCAL\n";
  }
  return text.str();
}

void require_alike(const Slice& slice, const Slice& first, const std::string& file,
                   const std::string& first_file) {
  if (slice.width != first.width || slice.height != first.height || slice.component != first.component) {
    fail(file, "it has " + std::to_string(slice.width) + " x " + std::to_string(slice.height) +
                   " pixels of " + std::to_string(8 * slice.bytes_per_value) + " bits, but '" + first_file +
                   "' has " + std::to_string(first.width) + " x " + std::to_string(first.height) + " of " +
                   std::to_string(8 * first.bytes_per_value) + "; make them alike");
  }
}

void require_good(const TileCommand& command) {
  const fs::path extension = fs::path(command.out).extension();
  if (extension != ".nrrd" && extension != ".mha") {
    throw InputError("--out '" + command.out + "' has an unknown extension; give .nrrd or .mha");
  }
  require_writable(command.out);
}

/// A slice of the volume: a file, or a page of one.
struct Page {
  const std::string& file;
  std::size_t number;
};

std::vector<Page> pages_of(const std::vector<std::string>& files) {
  std::vector<Page> pages;
  for (const std::string& file : files) {
    if (!fs::is_regular_file(file)) {
      fail(file,
           fs::exists(file) ? "it is a folder, device or pipe; name a file" : "no such file; check its name");
    }
    const std::size_t count = is_tiff(file) ? count_tiff_pages(file) : 1;
    for (std::size_t number = 0; number < count; ++number) {
      pages.push_back({file, number});
    }
  }
  return pages;
}

/// The warning that names do not count upwards; empty where they do. A shell sorts s10 before s2.
std::string order_warning(const std::vector<std::string>& slices) {
  const auto wrong = std::is_sorted_until(slices.begin(), slices.end(), comes_before);
  if (wrong == slices.end()) {
    return "";
  }
  return "'" + *wrong + "' comes after '" + *(wrong - 1) +
         "' in the order given, but before it in the natural order of names (s2 before s10); --natural-order "
         "sorts "
         "the slices";
}

/// Holds one slice in memory at a time.
void run(TileCommand& command) {
  require_good(command);
  TerminalProgress progress(command.common.quiet);
  if (command.natural_order) {
    std::stable_sort(command.slices.begin(), command.slices.end(), comes_before);
  } else if (const std::string warning = order_warning(command.slices); !warning.empty()) {
    progress.line("warning: " + warning, true);
  }
  const std::vector<Page> pages = pages_of(command.slices);
  Slice first;
  AtomicFile file(command.out);
  errno = 0;
  std::ofstream out(file.temporary(), std::ios::binary);
  for (std::size_t n = 0; n < pages.size() && out; ++n) {
    progress.step("slice " + pages[n].file, static_cast<double>(n) / static_cast<double>(pages.size()));
    Slice slice = read_slice(pages[n].file, pages[n].number, command.luminance);
    if (n == 0) {
      out << header(command, slice, pages.size());
      first = slice;
      first.values.clear();
    }
    require_alike(slice, first, pages[n].file, pages[0].file);
    out.write(slice.values.data(), static_cast<std::streamsize>(slice.values.size()));
  }
  out.close();
  if (!out) {
    fail_to_write(command.out);
  }
  file.commit();
  progress.done();
  progress.line("wrote " + command.out + ": " + std::to_string(first.width) + " x " +
                std::to_string(first.height) + " x " + std::to_string(pages.size()) + " voxels");
}

}  // namespace

void add_tile_command(CLI::App& app, int& exit_code) {
  auto command = std::make_shared<TileCommand>();
  CLI::App* tile = app.add_subcommand("tile", "stacks 2-D slices, in the order given, to one volume");
  tile->add_option("slices", command->slices,
                   "grey slices of one size: PNG, BMP or TIFF, of one page or several")
      ->required();
  tile->add_option("-o,--out", command->out, "volume, uncompressed: .nrrd or .mha")->required();
  tile->add_option("--spacing", command->spacing_mm, "X,Y,Z: distance of pixels and of slices, mm")
      ->required()
      ->delimiter(',')
      ->expected(3)
      ->check(number_between(1e-6, 1e6));
  tile->add_option("--origin", command->origin_mm, "X,Y,Z: centre of the first voxel, LPS mm [0,0,0]")
      ->delimiter(',')
      ->expected(3)
      ->check(number_between(-1e9, 1e9));
  tile->add_flag("--natural-order", command->natural_order,
                 "sort the slices by the numbers in their names, s2 before s10 [the order given]");
  tile->add_flag("--luminance", command->luminance,
                 "take the luminance of colour slices [colours are refused]");
  complete_command(*tile, command->common, exit_code, [command] { run(*command); });
}

}  // namespace cbc3d
