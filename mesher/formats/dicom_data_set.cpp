#include "mesher/formats/dicom_data_set.hpp"

#include <algorithm>
#include <array>

#include "mesher/formats/header_text.hpp"

namespace cbc3d::formats {
namespace {

constexpr std::size_t kPreamble = 128, kMagicEnd = 132;
constexpr std::uint32_t kItem = 0xFFFEE000, kItemEnd = 0xFFFEE00D, kSequenceEnd = 0xFFFEE0DD;
constexpr std::uint32_t kTransferSyntax = 0x00020010, kPixelData = 0x7FE00010;
constexpr std::uint32_t kUndefinedLength = 0xFFFFFFFF;
constexpr int kMostDepth = 16;

/// The sequences of a segmentation, which an implicit value representation does not show to be some.
constexpr std::array<std::uint32_t, 7> kSequences = {0x00620002, 0x52009229, 0x52009230, 0x00209113,
                                                     0x00209116, 0x00289110, 0x0062000A};

[[noreturn]] void refuse_cut() {
  throw FormatError("its data elements break off (the file is truncated or damaged); copy it again");
}

/// Bytes that are taken from the front.
class Cursor {
 public:
  explicit Cursor(std::string_view bytes) : left_(bytes) {}
  [[nodiscard]] bool at_end() const { return left_.empty(); }
  std::string_view take(std::size_t count) {
    if (count > left_.size()) {
      refuse_cut();
    }
    const std::string_view taken = left_.substr(0, count);
    left_.remove_prefix(count);
    return taken;
  }
  std::uint32_t take_number(std::size_t bytes) {
    std::uint32_t number = 0;
    const std::string_view taken = take(bytes);
    for (std::size_t n = bytes; n-- > 0;) {
      number = number << 8U | static_cast<std::uint8_t>(taken[n]);
    }
    return number;
  }
  std::uint32_t take_tag() {
    const std::uint32_t group = take_number(2);
    return group << 16U | take_number(2);
  }
  /// The group of the next tag, which stays.
  [[nodiscard]] std::uint32_t next_group() const { return Cursor(left_).take_number(2); }

 private:
  std::string_view left_;
};

/// Value representation and length of an element.
struct Shape {
  std::string_view representation;  // empty where it is implicit
  std::uint32_t length = 0;
};

Shape take_shape(Cursor& cursor, bool is_explicit) {
  if (!is_explicit) {
    return {"", cursor.take_number(4)};
  }
  constexpr std::array<std::string_view, 13> kLong = {"OB", "OD", "OF", "OL", "OV", "OW", "SQ",
                                                      "SV", "UC", "UN", "UR", "UT", "UV"};
  const std::string_view representation = cursor.take(2);
  if (std::find(kLong.begin(), kLong.end(), representation) == kLong.end()) {
    return {representation, cursor.take_number(2)};
  }
  cursor.take(2);
  return {representation, cursor.take_number(4)};
}

DicomDataSet take_data_set(Cursor& cursor, bool is_explicit, int depth, bool ends_by_delimiter);

std::vector<DicomDataSet> take_items(Cursor& cursor, bool is_explicit, int depth, bool ends_by_delimiter) {
  std::vector<DicomDataSet> items;
  while (ends_by_delimiter || !cursor.at_end()) {
    const std::uint32_t tag = cursor.take_tag();
    const std::uint32_t length = cursor.take_number(4);
    if (tag == kSequenceEnd && ends_by_delimiter) {
      return items;
    }
    if (tag != kItem) {
      throw FormatError("a sequence of it has something else than items; it is damaged, export it again");
    }
    if (length == kUndefinedLength) {
      items.push_back(take_data_set(cursor, is_explicit, depth + 1, true));
    } else {
      Cursor item(cursor.take(length));
      items.push_back(take_data_set(item, is_explicit, depth + 1, false));
    }
  }
  return items;
}

void skip_fragments(Cursor& cursor) {
  for (std::uint32_t tag = 0; tag != kSequenceEnd;) {
    tag = cursor.take_tag();
    cursor.take(cursor.take_number(4));
  }
}

void take_value(Cursor& cursor, const Shape& shape, bool is_explicit, int depth, DicomElement& element) {
  const bool is_open = shape.length == kUndefinedLength;
  if (is_open && element.tag == kPixelData) {
    element.is_compressed = true;
    return skip_fragments(cursor);
  }
  // A sequence whose representation was not known to the writer is implicit inside (PS3.5, 6.2.2).
  const bool items_are_explicit = is_explicit && shape.representation != "UN";
  const bool is_known = std::find(kSequences.begin(), kSequences.end(), element.tag) != kSequences.end();
  if (is_open) {
    element.items = take_items(cursor, items_are_explicit, depth, true);
  } else if (shape.representation == "SQ" || is_known) {
    Cursor inside(cursor.take(shape.length));
    element.items = take_items(inside, items_are_explicit, depth, false);
  } else {
    element.value = cursor.take(shape.length);
  }
}

DicomDataSet take_data_set(Cursor& cursor, bool is_explicit, int depth, bool ends_by_delimiter) {
  if (depth > kMostDepth) {
    throw FormatError("its sequences nest deeper than those of any known object; export it again");
  }
  DicomDataSet set;
  while (ends_by_delimiter || !cursor.at_end()) {
    DicomElement element{.tag = cursor.take_tag()};
    if (element.tag == kItemEnd && ends_by_delimiter) {
      cursor.take(4);
      return set;
    }
    const Shape shape = take_shape(cursor, is_explicit);
    take_value(cursor, shape, is_explicit, depth, element);
    set.elements.push_back(std::move(element));
  }
  return set;
}

/// The elements of group 2, which are explicit whatever the others are.
std::string take_transfer_syntax(Cursor& cursor) {
  DicomDataSet meta;
  while (!cursor.at_end() && cursor.next_group() == 2) {
    DicomElement element{.tag = cursor.take_tag()};
    take_value(cursor, take_shape(cursor, true), true, 0, element);
    meta.elements.push_back(std::move(element));
  }
  return meta.text(kTransferSyntax);
}

/// True for explicit value representations. What is compressed has them too, and is refused where its pixels
/// are.
bool is_explicit_syntax(const std::string& uid) {
  const bool is_deflated = uid == "1.2.840.10008.1.2.1.99";
  if (is_deflated || uid == "1.2.840.10008.1.2.2" || uid.empty()) {
    throw FormatError("its transfer syntax is " +
                      (uid.empty()   ? std::string("missing")
                       : is_deflated ? "deflated"
                                     : "big-endian") +
                      "; convert it to explicit little-endian (dcmconv +te)");
  }
  return uid != "1.2.840.10008.1.2";
}

}  // namespace

const DicomElement* DicomDataSet::find(std::uint32_t tag) const {
  const auto found =
      std::find_if(elements.begin(), elements.end(), [tag](const DicomElement& e) { return e.tag == tag; });
  return found == elements.end() ? nullptr : &*found;
}

std::string DicomDataSet::text(std::uint32_t tag) const {
  const DicomElement* const element = find(tag);
  std::string text(element == nullptr ? "" : element->value);
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\\' || c == '\0'; }, ' ');
  return std::string(trimmed(text));
}

int DicomDataSet::number(std::uint32_t tag, int missing) const {
  const DicomElement* const element = find(tag);
  return element == nullptr || element->value.size() < 2
             ? missing
             : static_cast<int>(Cursor(element->value).take_number(2));
}

const std::vector<DicomDataSet>& DicomDataSet::items(std::uint32_t tag) const {
  static const std::vector<DicomDataSet> kNone;
  const DicomElement* const element = find(tag);
  return element == nullptr ? kNone : element->items;
}

bool is_dicom(std::string_view head) {
  return head.size() >= kMagicEnd && head.substr(kPreamble, 4) == "DICM";
}

DicomDataSet parse_dicom(std::string_view file) {
  if (file.size() < kMagicEnd) {
    throw FormatError("it ends within the preamble of DICOM (truncated); copy it again");
  }
  Cursor cursor(file.substr(kMagicEnd));
  const bool is_explicit = is_explicit_syntax(take_transfer_syntax(cursor));
  return take_data_set(cursor, is_explicit, 0, false);
}

}  // namespace cbc3d::formats
