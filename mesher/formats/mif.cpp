#include "mesher/formats/mif.hpp"

#include <cmath>
#include <map>

#include "mesher/formats/byte_stream.hpp"
#include "mesher/formats/file_list.hpp"
#include "mesher/formats/header_text.hpp"

namespace cbc3d::formats {
namespace {

namespace fs = std::filesystem;

/// The values of every key, one for each of its lines.
using Fields = std::map<std::string, std::vector<std::string>>;

Fields parse(std::string_view head) {
  Fields fields;
  Lines lines(head);
  lines.next();  // the signature
  while (const auto line = lines.next()) {
    if (trimmed(*line) == "END") {
      return fields;
    }
    const std::size_t colon = line->find(':');
    if (colon != std::string_view::npos) {
      fields[lower_case(trimmed(line->substr(0, colon)))].emplace_back(trimmed(line->substr(colon + 1)));
    }
  }
  throw FormatError("its header does not end with END; the file is truncated, copy it again");
}

const std::string& required(const Fields& fields, const std::string& key) {
  const auto found = fields.find(key);
  if (found == fields.end() || found->second.size() != 1) {
    throw FormatError("its header has no field '" + key + "', or several; repair its header");
  }
  return found->second[0];
}

std::string blanks_for_commas(std::string text) {
  for (char& c : text) {
    c = c == ',' ? ' ' : c;
  }
  return text;
}

/// Which image axis is stored as the n-th fastest, and whether backwards.
struct Layout {
  std::array<std::size_t, 3> axis{};
  std::array<bool, 3> backwards{};
};

Layout layout_of(const Fields& fields, std::size_t dimensions, const std::vector<std::int64_t>& sizes) {
  const auto words = words_of(required(fields, "layout"), ", ");
  std::vector<int> rank_to_axis(dimensions, -1);
  std::vector<bool> backwards(dimensions, false);
  for (std::size_t axis = 0; axis < words.size(); ++axis) {
    const auto rank = to_integer(words[axis].substr(1));
    const bool good = (words[axis][0] == '+' || words[axis][0] == '-') && rank && *rank >= 0 &&
                      static_cast<std::size_t>(*rank) < dimensions && words.size() == dimensions;
    if (!good || rank_to_axis[static_cast<std::size_t>(*rank)] != -1) {
      throw FormatError("its layout is " + in_quotes(required(fields, "layout")) + "; repair its header");
    }
    rank_to_axis[static_cast<std::size_t>(*rank)] = static_cast<int>(axis);
    backwards[axis] = words[axis][0] == '-';
  }
  Layout layout;
  std::size_t n = 0;
  for (const int axis : rank_to_axis) {
    if (axis >= 0 && axis < 3 && n < 3) {
      layout.axis[n] = static_cast<std::size_t>(axis);
      layout.backwards[n++] = backwards[static_cast<std::size_t>(axis)];
    } else if (axis < 0 || sizes[static_cast<std::size_t>(axis)] > 1) {
      throw FormatError("its layout is " + in_quotes(required(fields, "layout")) + "; repair its header");
    }
  }
  return layout;
}

void take_type(const std::string& text, ImageHeader& image) {
  static const std::map<std::string, Component> kTypes = {
      {"uint8", Component::uint8},    {"int8", Component::int8},     {"uint16", Component::uint16},
      {"int16", Component::int16},    {"uint32", Component::uint32}, {"int32", Component::int32},
      {"uint64", Component::uint64},  {"int64", Component::int64},   {"float32", Component::float32},
      {"float64", Component::float64}};
  std::string name = lower_case(text);
  if (name.ends_with("be") || name.ends_with("le")) {
    image.big_endian = name.ends_with("be");
    name.resize(name.size() - 2);
  }
  const auto found = kTypes.find(name);
  if (found == kTypes.end()) {
    throw FormatError("its datatype is " + in_quotes(text) +
                      ", which holds no labels; convert it to an integer type");
  }
  image.component = found->second;
}

/// Steps and origin of the image axes, right-anterior-superior: the transform has unit columns.
struct Affine {
  std::array<Triple, 3> axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  Triple origin{};
};

Affine affine_of(const Fields& fields, ImageHeader& image) {
  Affine affine;
  const auto found = fields.find("transform");
  if (found == fields.end()) {
    image.warnings.emplace_back(
        "its header has no transform: its axes are taken towards right, anterior, superior");
    return affine;
  }
  std::string all;
  for (const std::string& line : found->second) {
    all += blanks_for_commas(line) + " ";
  }
  const auto entries = numbers_of("transform", all, 0);
  if (entries.size() != 12 && entries.size() != 16) {
    throw FormatError("its transform has " + std::to_string(entries.size()) +
                      " numbers, not 12; repair its header");
  }
  for (std::size_t row = 0; row < 3; ++row) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      affine.axes[axis][row] = entries[4 * row + axis];
    }
    affine.origin[row] = entries[4 * row + 3];
  }
  return affine;
}

void take_frame(const Fields& fields, const Layout& layout, const std::vector<std::int64_t>& sizes,
                ImageHeader& image) {
  const Affine affine = affine_of(fields, image);
  const auto spacing = numbers_of("vox", blanks_for_commas(required(fields, "vox")), sizes.size());
  image.origin_mm = affine.origin;
  for (std::size_t n = 0; n < 3; ++n) {
    const std::size_t axis = layout.axis[n];
    image.size[n] = size_of("dim", sizes[axis]);
    image.spacing_mm[n] = spacing[axis];
    for (std::size_t row = 0; row < 3; ++row) {
      const double entry = affine.axes[axis][row];
      image.axes[n][row] = (layout.backwards[n] ? -entry : entry) * (row < 2 ? -1 : 1);
      image.origin_mm[row] +=
          layout.backwards[n] ? entry * spacing[axis] * static_cast<double>(image.size[n] - 1) : 0;
    }
  }
  image.origin_mm[0] = -image.origin_mm[0];
  image.origin_mm[1] = -image.origin_mm[1];
}

void take_files(const Fields& fields, const fs::path& path, Encoding encoding, ImageHeader& image) {
  const auto words = words_of(required(fields, "file"));
  if (words.empty() || words.size() > 2) {
    throw FormatError("its header names no file with its voxels; repair its header");
  }
  const auto offset = words.size() == 2 ? to_integer(words[1]) : std::optional<std::int64_t>(0);
  if (!offset || *offset < 0) {
    throw FormatError("its voxels begin at byte " + in_quotes(words[1]) + "; repair its header");
  }
  image.files = words[0] == "." ? std::vector<DataFile>{{.path = path}} : files_beside(path, {words[0]});
  image.files[0].skipped_bytes = static_cast<std::uint64_t>(*offset);
  image.encoding = encoding;
  if (std::error_code error; words[0] != "." && fs::is_regular_file(image.files[0].path, error)) {
    image.encoding = encoding_of_file(image.files[0].path);
  }
}

}  // namespace

bool is_mif(std::string_view head) {
  return head.starts_with("mrtrix image");
}

ImageHeader read_mif_header(std::string_view head, const fs::path& path, Encoding encoding) {
  const Fields fields = parse(head);
  ImageHeader image;
  image.format = "MRtrix";
  const auto sizes = integers_of("dim", blanks_for_commas(required(fields, "dim")), 0);
  if (sizes.size() < 3 || sizes.size() > 16) {
    throw FormatError("it is " + std::to_string(sizes.size()) + "-dimensional; give a 3-D image");
  }
  for (std::size_t axis = 3; axis < sizes.size(); ++axis) {
    if (size_of("dim", sizes[axis]) > 1) {
      throw FormatError("it is " + std::to_string(sizes.size()) + "-dimensional with " +
                        std::to_string(sizes[axis]) + " volumes; give one 3-D volume of it");
    }
  }
  take_type(required(fields, "datatype"), image);
  take_frame(fields, layout_of(fields, sizes.size(), sizes), sizes, image);
  if (const auto scaling = fields.find("scaling"); scaling != fields.end()) {
    const auto numbers = numbers_of("scaling", blanks_for_commas(scaling->second[0]), 2);
    image.intercept = numbers[0];
    image.slope = numbers[1];
  }
  take_files(fields, path, encoding, image);
  return image;
}

}  // namespace cbc3d::formats
