#include "mesher/formats/metaimage.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "mesher/formats/byte_stream.hpp"
#include "mesher/formats/file_list.hpp"
#include "mesher/formats/header_text.hpp"
#include "mesher/formats/units.hpp"

namespace cbc3d::formats {
namespace {

namespace fs = std::filesystem;

/// The fields by their names; ElementDataFile is the last.
struct Header {
  std::map<std::string, std::string> fields;
  std::vector<std::string> listed_files;
  std::size_t end = 0;

  [[nodiscard]] const std::string* find(const std::string& key) const {
    const auto found = fields.find(key);
    return found == fields.end() ? nullptr : &found->second;
  }
  /// The first of several names of one field that is there.
  [[nodiscard]] const std::string* first(std::initializer_list<const char*> keys) const {
    for (const char* key : keys) {
      if (const std::string* const value = find(key)) {
        return value;
      }
    }
    return nullptr;
  }
};

Header parse(std::string_view head) {
  Header header;
  Lines lines(head);
  while (header.find("ElementDataFile") == nullptr) {
    const auto line = lines.next();
    if (!line) {
      throw FormatError("its header does not end with ElementDataFile; the file is truncated, copy it again");
    }
    const std::size_t equals = line->find('=');
    if (equals == std::string_view::npos) {
      if (!trimmed(*line).empty()) {
        throw FormatError("its header has the line " + in_quotes(*line) +
                          ", which is no field; repair its header");
      }
      continue;
    }
    const std::string key(trimmed(line->substr(0, equals)));
    if (!header.fields.emplace(key, trimmed(line->substr(equals + 1))).second) {
      throw FormatError("its header has the field " + in_quotes(key) + " twice; repair its header");
    }
  }
  header.end = std::min(lines.position(), head.size());
  while (const auto line = lines.next()) {  // names of files, where ElementDataFile is LIST
    if (header.fields["ElementDataFile"].starts_with("LIST") && !trimmed(*line).empty()) {
      header.listed_files.emplace_back(trimmed(*line));
    } else if (!header.fields["ElementDataFile"].starts_with("LIST")) {
      break;
    }
  }
  return header;
}

bool is_true(const Header& header, std::initializer_list<const char*> keys, bool otherwise) {
  const std::string* const value = header.first(keys);
  if (value == nullptr || value->empty()) {
    return otherwise;
  }
  const char first = (*value)[0];
  return first == 'T' || first == 't' || first == '1' || first == 'Y' || first == 'y';
}

std::size_t dimensions_of(const Header& header) {
  const std::string* const text = header.find("NDims");
  const std::int64_t count = text == nullptr ? 0 : integers_of("NDims", *text, 1)[0];
  if (count < 1 || count > 10) {
    throw FormatError("its header has NDims " + (text == nullptr ? std::string("missing") : *text) +
                      "; repair its header");
  }
  if (count < 3) {
    throw FormatError("it is " + std::to_string(count) +
                      "-dimensional; give a 3-D image (`cbc3d tile` stacks slices)");
  }
  return static_cast<std::size_t>(count);
}

void take_size(const Header& header, std::size_t dimensions, ImageHeader& image) {
  const std::string* const text = header.find("DimSize");
  if (text == nullptr) {
    throw FormatError("its header has no DimSize; repair its header");
  }
  const auto sizes = integers_of("DimSize", *text, dimensions);
  for (std::size_t axis = 0; axis < dimensions; ++axis) {
    const std::size_t size = size_of("DimSize", sizes[axis]);
    if (axis < 3) {
      image.size[axis] = size;
    } else if (axis == 3) {
      image.volumes = size;
    } else if (size > 1) {
      throw FormatError("it is " + std::to_string(dimensions) + "-dimensional with " + std::to_string(size) +
                        " volumes; give one 3-D volume of it");
    }
  }
  const std::string* const channels = header.find("ElementNumberOfChannels");
  if (channels != nullptr && integers_of("ElementNumberOfChannels", *channels, 1)[0] != 1) {
    throw FormatError(
        "it has " + *channels +
        " components per voxel (a colour or vector image); give a label image with one value per voxel");
  }
}

Component component_of(const Header& header) {
  static const std::map<std::string, Component> kTypes = {
      {"MET_UCHAR", Component::uint8},       {"MET_CHAR", Component::int8},
      {"MET_USHORT", Component::uint16},     {"MET_SHORT", Component::int16},
      {"MET_UINT", Component::uint32},       {"MET_INT", Component::int32},
      {"MET_ULONG", Component::uint32},      {"MET_LONG", Component::int32},
      {"MET_ULONG_LONG", Component::uint64}, {"MET_LONG_LONG", Component::int64},
      {"MET_FLOAT", Component::float32},     {"MET_DOUBLE", Component::float64}};
  const std::string* const type = header.find("ElementType");
  const auto found = type == nullptr ? kTypes.end() : kTypes.find(*type);
  if (found == kTypes.end()) {
    throw FormatError("its ElementType is " + in_quotes(type == nullptr ? "missing" : *type) +
                      ", which holds no labels; convert it to an integer type");
  }
  return found->second;
}

double unit_mm(const Header& header, ImageHeader& image) {
  const std::string* const unit = header.find("DistanceUnits");
  const auto mm = unit == nullptr ? std::optional<double>(1) : millimetres_of(*unit);
  if (!mm && *unit != "?" && !unit->empty()) {
    image.warnings.push_back("its DistanceUnits " + in_quotes(*unit) +
                             " are no length that is known; mm are taken");
  }
  return mm.value_or(1);
}

/// Letters say where an axis comes from: R from the right, towards the left, and so on.
std::optional<std::array<Triple, 3>> axes_of_letters(const std::string& letters) {
  static const std::map<char, Triple> kTowards = {{'R', {1, 0, 0}},  {'L', {-1, 0, 0}}, {'A', {0, 1, 0}},
                                                  {'P', {0, -1, 0}}, {'I', {0, 0, 1}},  {'S', {0, 0, -1}}};
  std::array<Triple, 3> axes{};
  Triple used{};
  for (std::size_t axis = 0; axis < 3 && axis < letters.size(); ++axis) {
    const auto found = kTowards.find(letters[axis]);
    if (found == kTowards.end()) {
      return std::nullopt;
    }
    axes[axis] = found->second;
    for (std::size_t row = 0; row < 3; ++row) {
      used[row] += std::fabs(axes[axis][row]);
    }
  }
  return letters.size() >= 3 && used == Triple{1, 1, 1} ? std::optional(axes) : std::nullopt;
}

/// TransformMatrix rules, as for ITK; the letters are in place of one that is missing, and checked otherwise.
void take_directions(const Header& header, std::size_t dimensions, ImageHeader& image) {
  const std::string* const letters = header.find("AnatomicalOrientation");
  const auto lettered = letters == nullptr ? std::nullopt : axes_of_letters(*letters);
  const std::string* const matrix = header.first({"TransformMatrix", "Orientation", "Rotation"});
  if (matrix == nullptr) {
    if (lettered) {
      image.axes = *lettered;
    } else if (letters != nullptr && letters->find('?') == std::string::npos) {
      throw FormatError("its AnatomicalOrientation " + in_quotes(*letters) +
                        " is none; give three of RL, AP and IS, or a TransformMatrix");
    }
    return;
  }
  const auto entries = numbers_of("TransformMatrix", *matrix, dimensions * dimensions);
  std::array<Triple, 3> steps{};
  double agreement = 3;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t row = 0; row < 3; ++row) {
      steps[axis][row] = entries[axis * dimensions + row];
      agreement = lettered ? std::fmin(agreement, (*lettered)[axis][row] == 0
                                                      ? agreement
                                                      : (*lettered)[axis][row] * steps[axis][row])
                           : agreement;
    }
  }
  const Triple spacing = image.spacing_mm;
  set_steps(image, steps, "TransformMatrix");
  for (std::size_t axis = 0; axis < 3;
       ++axis) {  // the matrix may carry the spacing, too, which must not count
    const double length = image.spacing_mm[axis];
    if (std::fabs(length - 1) > 1e-3) {
      throw FormatError("its TransformMatrix has a row of length " + number_text(length) +
                        ", not 1; repair its header");
    }
    for (std::size_t row = 0; row < 3; ++row) {
      image.axes[axis][row] = steps[axis][row];
    }
  }
  image.spacing_mm = spacing;
  if (lettered && agreement < 0.5) {
    image.warnings.push_back("its AnatomicalOrientation " + *letters +
                             " does not go with its TransformMatrix, by which it is placed");
  }
}

void take_frame(const Header& header, std::size_t dimensions, ImageHeader& image) {
  const double mm = unit_mm(header, image);
  if (const std::string* const text = header.first({"ElementSpacing", "ElementSize"})) {
    const auto spacing = numbers_of("ElementSpacing", *text, dimensions);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      image.spacing_mm[axis] = std::fabs(spacing[axis]) * mm;
      if (spacing[axis] < 0) {
        image.warnings.emplace_back("a spacing of it is negative; its size is taken");
      }
    }
  } else {
    image.warnings.emplace_back("its header has no ElementSpacing: 1 mm is taken");
  }
  take_directions(header, dimensions, image);
  if (const std::string* const text = header.first({"Offset", "Origin", "Position"})) {
    const auto origin = numbers_of("Offset", *text, dimensions);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      image.origin_mm[axis] = origin[axis] * mm;
    }
  }
}

void take_scaling(const Header& header, ImageHeader& image) {
  if (const std::string* const slope = header.find("ElementToIntensityFunctionSlope")) {
    image.slope = numbers_of("ElementToIntensityFunctionSlope", *slope, 1)[0];
  }
  if (const std::string* const offset = header.find("ElementToIntensityFunctionOffset")) {
    image.intercept = numbers_of("ElementToIntensityFunctionOffset", *offset, 1)[0];
  }
}

void take_encoding(const Header& header, ImageHeader& image) {
  image.big_endian = is_true(header, {"BinaryDataByteOrderMSB", "ElementByteOrderMSB"}, false);
  image.encoding = !is_true(header, {"BinaryData"}, true)       ? Encoding::ascii
                   : is_true(header, {"CompressedData"}, false) ? Encoding::gzip
                                                                : Encoding::raw;
}

std::vector<std::string> names_of_files(const Header& header) {
  const std::string& value = *header.find("ElementDataFile");
  const auto words = words_of(value);
  if (words.empty()) {
    throw FormatError("its ElementDataFile names no file; repair its header");
  }
  if (words[0] == "LIST") {
    return header.listed_files;
  }
  if (is_file_pattern(words)) {
    return names_of_pattern(words);
  }
  if (value.find('%') != std::string::npos && words.size() > 1) {
    return names_of_pattern({words[0], words[1], words.size() > 2 ? words[2] : words[1], "1"});
  }
  return {value};
}

void take_files(const Header& header, const fs::path& path, ImageHeader& image) {
  const std::string& value = *header.find("ElementDataFile");
  const bool local = value == "LOCAL" || value == "Local" || value == "local";
  image.files = local ? std::vector<DataFile>{{.path = path, .begin = header.end}}
                      : files_beside(path, names_of_files(header));
  const std::string* const skipped = header.find("HeaderSize");
  const std::int64_t skip = skipped == nullptr ? 0 : integers_of("HeaderSize", *skipped, 1)[0];
  if (skip < -1 || skip > (std::int64_t{1} << 48U)) {
    throw FormatError("its HeaderSize is " + *skipped + "; repair its header");
  }
  const std::string* const packed = header.find("CompressedDataSize");
  for (DataFile& file : image.files) {
    file.at_end = skip == -1 && image.encoding == Encoding::raw;
    file.begin = skip > 0 ? static_cast<std::uint64_t>(skip) : file.begin;
    if (packed != nullptr && image.encoding == Encoding::gzip && image.files.size() == 1) {
      const std::int64_t bytes = integers_of("CompressedDataSize", *packed, 1)[0];
      file.packed_bytes = bytes > 0 ? static_cast<std::uint64_t>(bytes) : 0;
    }
  }
}

}  // namespace

bool is_metaimage(std::string_view head) {
  const std::string_view begin = trimmed(head.substr(0, 200));
  return begin.starts_with("ObjectType") || begin.starts_with("NDims") || begin.starts_with("Comment") ||
         begin.starts_with("TransformType") || begin.starts_with("DimSize");
}

ImageHeader read_metaimage_header(std::string_view head, const fs::path& path) {
  const Header header = parse(head);
  ImageHeader image;
  image.format = "MetaImage";
  const std::string* const object = header.find("ObjectType");
  if (object != nullptr && lower_case(*object) != "image") {
    throw FormatError("it is a MetaIO object of type " + in_quotes(*object) + ", not an image");
  }
  const std::size_t dimensions = dimensions_of(header);
  take_size(header, dimensions, image);
  image.component = component_of(header);
  take_encoding(header, image);
  take_frame(header, dimensions, image);
  take_scaling(header, image);
  take_files(header, path, image);
  return image;
}

}  // namespace cbc3d::formats
