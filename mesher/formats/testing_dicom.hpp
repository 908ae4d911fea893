// DICOM segmentations of a test, byte by byte.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace cbc3d::formats::testing {

/// Writes elements with explicit or implicit value representations, sequences with lengths or delimiters.
class DicomWriter {
 public:
  explicit DicomWriter(bool is_explicit = true, bool has_delimiters = false)
      : is_explicit_(is_explicit), has_delimiters_(has_delimiters) {}

  [[nodiscard]] std::string element(std::uint32_t tag, const std::string& representation,
                                    std::string value) const {
    value += value.size() % 2 == 1
                 ? (representation == "UI" || representation == "OB" ? std::string(1, '\0') : " ")
                 : "";
    return head(tag, representation, static_cast<std::uint32_t>(value.size())) + value;
  }
  [[nodiscard]] std::string number(std::uint32_t tag, int value) const {
    return element(tag, "US", little(static_cast<std::uint32_t>(value), 2));
  }
  [[nodiscard]] std::string sequence(std::uint32_t tag, const std::vector<std::string>& items) const {
    std::string all;
    for (const std::string& item : items) {
      all += tag_bytes(0xFFFEE000) + length(item) + item + (has_delimiters_ ? end_of(0xFFFEE00D) : "");
    }
    const std::uint32_t bytes = has_delimiters_ ? kOpen : static_cast<std::uint32_t>(all.size());
    return head(tag, "SQ", bytes) + all + (has_delimiters_ ? end_of(0xFFFEE0DD) : "");
  }
  /// Preamble and group 2 before the elements.
  [[nodiscard]] std::string file(const std::string& elements, const std::string& syntax = "") const {
    const std::string uid = !syntax.empty() ? syntax
                            : is_explicit_  ? "1.2.840.10008.1.2.1"
                                            : "1.2.840.10008.1.2";
    const std::string meta = DicomWriter().element(0x00020010, "UI", uid);
    return std::string(128, '\0') + "DICM" +
           DicomWriter().element(0x00020000, "UL", little(static_cast<std::uint32_t>(meta.size()), 4)) +
           meta + elements;
  }

  static std::string little(std::uint32_t value, int bytes) {
    std::string text;
    for (int n = 0; n < bytes; ++n) {
      text += static_cast<char>(value >> 8 * n & 0xFFU);
    }
    return text;
  }
  static std::string tag_bytes(std::uint32_t tag) { return little(tag >> 16U, 2) + little(tag & 0xFFFFU, 2); }

 private:
  static constexpr std::uint32_t kOpen = 0xFFFFFFFF;
  static std::string end_of(std::uint32_t tag) { return tag_bytes(tag) + little(0, 4); }
  [[nodiscard]] std::string length(const std::string& item) const {
    return little(has_delimiters_ ? kOpen : static_cast<std::uint32_t>(item.size()), 4);
  }
  [[nodiscard]] std::string head(std::uint32_t tag, const std::string& representation,
                                 std::uint32_t bytes) const {
    if (!is_explicit_) {
      return tag_bytes(tag) + little(bytes, 4);
    }
    const bool is_long = representation == "SQ" || representation == "OB" || representation == "UN";
    return tag_bytes(tag) + representation +
           (is_long ? std::string(2, '\0') + little(bytes, 4) : little(bytes, 2));
  }

  bool is_explicit_, has_delimiters_;
};

/// A plane of one segment; its pixels row by row.
struct SegmentFrame {
  int segment = 1;
  std::string position;  ///< "x\y\z"
  std::vector<bool> pixels;
};

struct DicomSegmentationFile {
  std::string sop_class = "1.2.840.10008.5.1.4.1.1.66.4", modality = "SEG", type = "BINARY", syntax;
  std::string orientation = "1\\0\\0\\0\\1\\0", spacing = "0.5\\0.25", between = "2";
  int rows = 2, columns = 3, bits = 1, segments = 2;
  std::string frame_count;  ///< empty: as many as there are
  std::vector<SegmentFrame> frames;

  [[nodiscard]] std::string bytes(const DicomWriter& w = DicomWriter()) const {
    std::vector<std::string> numbers, own;
    for (int s = 1; s <= segments; ++s) {
      numbers.push_back(w.number(0x00620004, s) + w.element(0x00620005, "LO", "segment"));
    }
    std::string pixels((frames.size() * frames.at(0).pixels.size() + 7) / 8, '\0');
    std::size_t bit = 0;
    for (const SegmentFrame& frame : frames) {
      own.push_back(w.sequence(0x00209113, {w.element(0x00200032, "DS", frame.position)}) +
                    w.sequence(0x0062000A, {w.number(0x0062000B, frame.segment)}));
      for (const bool pixel : frame.pixels) {
        pixels[bit / 8] = static_cast<char>(pixels[bit / 8] | (pixel ? 1 : 0) << bit % 8);
        ++bit;
      }
    }
    const std::string measures = w.element(0x00180050, "DS", "7") +
                                 (between.empty() ? "" : w.element(0x00180088, "DS", between)) +
                                 w.element(0x00280030, "DS", spacing);
    const std::string shared = w.sequence(0x00209116, {w.element(0x00200037, "DS", orientation)}) +
                               w.sequence(0x00289110, {measures});
    return w.file(
        w.element(0x00080016, "UI", sop_class) + w.element(0x00080060, "CS", modality) +
            w.element(0x00280008, "IS", frame_count.empty() ? std::to_string(frames.size()) : frame_count) +
            w.number(0x00280010, rows) + w.number(0x00280011, columns) + w.number(0x00280100, bits) +
            w.element(0x00620001, "CS", type) + w.sequence(0x00620002, numbers) +
            w.sequence(0x52009229, {shared}) + w.sequence(0x52009230, own) +
            w.element(0x7FE00010, "OB", pixels),
        syntax);
  }
};

/// Two segments in three of four slices of 3 x 2 voxels; they share one voxel.
inline DicomSegmentationFile segmentation() {
  DicomSegmentationFile file;
  file.frames = {{1, "10\\20\\30", {true, false, false, true, true, false}},
                 {1, "10\\20\\32", {true, true, false, false, false, false}},
                 {2, "10\\20\\32", {false, true, true, false, false, false}},
                 {2, "10\\20\\36", {false, false, false, false, false, true}}};
  return file;
}

}  // namespace cbc3d::formats::testing
