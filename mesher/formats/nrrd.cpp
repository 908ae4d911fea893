#include "mesher/formats/nrrd.hpp"

#include <algorithm>
#include <map>

#include "mesher/formats/file_list.hpp"
#include "mesher/formats/header_text.hpp"
#include "mesher/formats/nrrd_frame.hpp"
#include "mesher/formats/nrrd_segments.hpp"

namespace cbc3d::formats {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostAxes = 16;  // NRRD_DIM_MAX

/// Names that mean the same, without blanks.
std::string canonical(std::string_view key) {
  std::string name = lower_case(key);
  name.erase(std::remove(name.begin(), name.end(), ' '), name.end());
  return name == "centers" ? "centerings" : name;
}

/// The fields, and where the header ends.
struct Header {
  NrrdFields fields;
  NrrdFields notes;                       ///< "key:=value", keys as they are written
  std::vector<std::string> listed_files;  ///< of "data file: LIST"
  std::size_t end = 0;
  bool ended = false;  ///< by an empty line
};

void take_field(std::string_view line, Header& header) {
  const std::size_t colon = line.find(": ");
  const std::size_t bare = line.ends_with(':') ? line.size() - 1 : std::string_view::npos;
  const std::size_t at = std::min(colon, bare);
  if (at == std::string_view::npos) {
    throw FormatError("its header has the line " + in_quotes(line) +
                      ", which is no field; repair its header");
  }
  const std::string key = canonical(line.substr(0, at));
  const std::string value(trimmed(line.substr(std::min(at + 2, line.size()))));
  if (!header.fields.emplace(key, value).second) {
    throw FormatError("its header has the field " + in_quotes(key) + " twice; repair its header");
  }
}

bool lists_files(const Header& header) {
  const auto found = header.fields.find("datafile");
  return found != header.fields.end() && lower_case(found->second).starts_with("list");
}

/// "key:=value" is for whoever wrote it; "field: value" is the standard's.
bool is_key_and_value(std::string_view line) {
  if (line.starts_with('#')) {
    return false;
  }
  const std::size_t colon = line.find(':');
  return colon != std::string_view::npos && line.substr(colon).starts_with(":=");
}

Header parse(std::string_view head) {
  Header header;
  Lines lines(head);
  lines.next();  // the signature
  while (const auto line = lines.next()) {
    if (lists_files(header)) {  // all that follows are names
      if (!trimmed(*line).empty()) {
        header.listed_files.emplace_back(trimmed(*line));
      }
    } else if (line->empty()) {
      header.ended = true;
      break;
    } else if (is_key_and_value(*line)) {
      const std::size_t colon = line->find(':');
      header.notes.insert_or_assign(std::string(line->substr(0, colon)),
                                    std::string(line->substr(colon + 2)));
    } else if (!line->starts_with('#')) {
      take_field(*line, header);
    }
  }
  header.end = std::min(lines.position(), head.size());
  return header;
}

const std::string& required(const NrrdFields& fields, const std::string& key) {
  const auto found = fields.find(key);
  if (found == fields.end()) {
    throw FormatError("its header has no field '" + key + "'; repair its header");
  }
  return found->second;
}

Component component_of(const std::string& type) {
  static const std::map<std::string, Component> kTypes = {{"signed char", Component::int8},
                                                          {"int8", Component::int8},
                                                          {"int8_t", Component::int8},
                                                          {"char", Component::int8},
                                                          {"uchar", Component::uint8},
                                                          {"unsigned char", Component::uint8},
                                                          {"uint8", Component::uint8},
                                                          {"uint8_t", Component::uint8},
                                                          {"short", Component::int16},
                                                          {"short int", Component::int16},
                                                          {"signed short", Component::int16},
                                                          {"signed short int", Component::int16},
                                                          {"int16", Component::int16},
                                                          {"int16_t", Component::int16},
                                                          {"ushort", Component::uint16},
                                                          {"unsigned short", Component::uint16},
                                                          {"unsigned short int", Component::uint16},
                                                          {"uint16", Component::uint16},
                                                          {"uint16_t", Component::uint16},
                                                          {"int", Component::int32},
                                                          {"signed int", Component::int32},
                                                          {"int32", Component::int32},
                                                          {"int32_t", Component::int32},
                                                          {"uint", Component::uint32},
                                                          {"unsigned int", Component::uint32},
                                                          {"uint32", Component::uint32},
                                                          {"uint32_t", Component::uint32},
                                                          {"longlong", Component::int64},
                                                          {"long long", Component::int64},
                                                          {"long long int", Component::int64},
                                                          {"signed long long", Component::int64},
                                                          {"signed long long int", Component::int64},
                                                          {"int64", Component::int64},
                                                          {"int64_t", Component::int64},
                                                          {"ulonglong", Component::uint64},
                                                          {"unsigned long long", Component::uint64},
                                                          {"unsigned long long int", Component::uint64},
                                                          {"uint64", Component::uint64},
                                                          {"uint64_t", Component::uint64},
                                                          {"float", Component::float32},
                                                          {"double", Component::float64}};
  const auto found = kTypes.find(lower_case(type));
  if (found == kTypes.end()) {
    throw FormatError("its type is " + in_quotes(type) +
                      ", which holds no labels; convert it to an integer type");
  }
  return found->second;
}

Encoding encoding_of(const std::string& text) {
  const std::string name = lower_case(text);
  if (name == "raw") return Encoding::raw;
  if (name == "gzip" || name == "gz") return Encoding::gzip;
  if (name == "bzip2" || name == "bz2") return Encoding::bzip2;
  if (name == "ascii" || name == "text" || name == "txt") return Encoding::ascii;
  if (name == "hex") return Encoding::hex;
  throw FormatError("its encoding is " + in_quotes(text) + "; known are raw, gzip, bzip2, text and hex");
}

bool is_big_endian(const Header& header, const ImageHeader& image) {
  const auto found = header.fields.find("endian");
  if (found == header.fields.end()) {
    if (bytes_of(image.component) > 1 && image.encoding != Encoding::ascii) {
      throw FormatError(
          "its header has no field 'endian', so that its byte order is not known; repair its header");
    }
    return false;
  }
  const std::string order = lower_case(found->second);
  if (order != "big" && order != "little") {
    throw FormatError("its byte order is " + in_quotes(found->second) + "; it has to be little or big");
  }
  return order == "big";
}

std::vector<std::int64_t> sizes_of(const NrrdFields& fields) {
  const auto dimension = static_cast<std::size_t>(
      std::clamp<std::int64_t>(integers_of("dimension", required(fields, "dimension"), 1)[0], 0, 1000));
  if (dimension < 1 || dimension > kMostAxes) {
    throw FormatError("its dimension is " + required(fields, "dimension") + "; repair its header");
  }
  const auto sizes = integers_of("sizes", required(fields, "sizes"), dimension);
  for (const std::int64_t size : sizes) {
    size_of("sizes", size);
  }
  if (dimension < 3) {
    throw FormatError("it is " + std::to_string(dimension) +
                      "-dimensional; give a 3-D image (`cbc3d tile` stacks slices)");
  }
  return sizes;
}

std::uint64_t skip_of(const NrrdFields& fields, const std::string& key) {
  const auto found = fields.find(key);
  const std::int64_t skip = found == fields.end() ? 0 : integers_of(key, found->second, 1)[0];
  if (skip < (key == "byteskip" ? -1 : 0) || skip > (std::int64_t{1} << 48U)) {
    throw FormatError("its header has " + key + " " + std::to_string(skip) + "; repair its header");
  }
  return static_cast<std::uint64_t>(skip);
}

std::vector<std::string> names_of_files(const Header& header, const std::string& value) {
  if (lists_files(header)) {
    return header.listed_files;
  }
  const auto words = words_of(value);
  return is_file_pattern(words) ? names_of_pattern(words) : std::vector<std::string>{value};
}

std::vector<DataFile> data_files(const Header& header, const fs::path& path, Encoding encoding) {
  std::vector<DataFile> files;
  const auto named = header.fields.find("datafile");
  if (named == header.fields.end()) {
    if (!header.ended) {
      throw FormatError("its header does not end, or within 1 MB; the file is truncated, copy it again");
    }
    files.push_back({.path = path, .skipped_bytes = 0});
  } else {
    files = files_beside(path, names_of_files(header, named->second));
  }
  const std::uint64_t bytes = skip_of(header.fields, "byteskip");
  const bool at_end = bytes == static_cast<std::uint64_t>(-1);
  if (at_end && encoding != Encoding::raw) {
    throw FormatError("its header has byte skip -1, which compressed voxels cannot have; repair its header");
  }
  for (DataFile& file : files) {
    file.skipped_lines = skip_of(header.fields, "lineskip");
    file.skipped_bytes = at_end ? 0 : bytes;
    file.at_end = at_end;
    file.begin = named == header.fields.end() ? header.end : 0;
  }
  return files;
}

/// Fields that say how the voxels lie; a word near them would be a slip.
bool is_known(const std::string& key) {
  static constexpr std::string_view kKnown[] = {
      "dimension",        "type",       "blocksize",   "encoding",
      "endian",           "content",    "min",         "max",
      "oldmin",           "oldmax",     "datafile",    "lineskip",
      "byteskip",         "number",     "sampleunits", "sizes",
      "spacings",         "axismins",   "axismaxs",    "centerings",
      "labels",           "units",      "kinds",       "space",
      "spacedimension",   "spaceunits", "spaceorigin", "spacedirections",
      "measurementframe", "thicknesses"};
  return std::find(std::begin(kKnown), std::end(kKnown), key) != std::end(kKnown);
}

}  // namespace

bool is_nrrd(std::string_view head) {
  return head.starts_with("NRRD");
}

ImageHeader read_nrrd_header(std::string_view head, const fs::path& path) {
  const Header header = parse(head);
  ImageHeader image;
  image.format = "NRRD";
  image.component = component_of(required(header.fields, "type"));
  image.encoding = encoding_of(required(header.fields, "encoding"));
  image.big_endian = is_big_endian(header, image);
  take_nrrd_frame(header.fields, sizes_of(header.fields), image);
  image.segments = nrrd_segments(header.notes, image.volumes);
  image.files = data_files(header, path, image.encoding);
  for (const auto& [key, value] : header.fields) {
    if (!is_known(key)) {
      image.warnings.push_back("its header has the field " + in_quotes(key) + ", which NRRD does not know");
    }
  }
  return image;
}

}  // namespace cbc3d::formats
