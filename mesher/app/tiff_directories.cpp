#include "mesher/app/tiff_directories.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <set>
#include <vector>

#include "mesher/core/error.hpp"

namespace cbc3d {
namespace {

constexpr std::uint64_t kStripOffsets = 273, kStripBytes = 279;

/// Bytes of a value by its type's number; 0 where the number stands for none.
constexpr std::array<std::uint64_t, 19> kTypeBytes = {0, 1, 1, 2, 4, 8, 1, 1, 2, 4,
                                                      8, 4, 8, 4, 0, 0, 8, 8, 8};

class DirectoryReader {
 public:
  explicit DirectoryReader(const std::string& file)
      : file_(file), in_(file, std::ios::binary), length_(std::filesystem::file_size(file)) {
    const std::uint64_t order = number_at(0, 2);
    big_endian_ = order == 0x4D4D;
    constexpr std::uint64_t kBigTiff = 43;
    big_tiff_ = number_at(2, 2) == kBigTiff;
  }

  std::size_t count_pages() {
    std::set<std::uint64_t> seen;
    for (std::uint64_t at = number_at(big_tiff_ ? 8 : 4, word()); at != 0; at = read_directory(at)) {
      if (!seen.insert(at).second) {
        fail("a TIFF file whose pages follow each other in a circle");
      }
    }
    return seen.size();
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw InputError("cannot read '" + file_ + "': " + what + "; copy it again");
  }
  [[nodiscard]] std::uint64_t word() const { return big_tiff_ ? 8 : 4; }

  void require_within(std::uint64_t at, std::uint64_t bytes) const {
    if (at > length_ || bytes > length_ - at) {
      fail("a truncated TIFF file: it should have " + std::to_string(bytes) + " bytes from byte " +
           std::to_string(at) + ", but ends at byte " + std::to_string(length_));
    }
  }

  std::uint64_t number_at(std::uint64_t at, std::uint64_t bytes) {
    require_within(at, bytes);
    std::array<char, 8> raw{};
    in_.seekg(static_cast<std::streamoff>(at));
    in_.read(raw.data(), static_cast<std::streamsize>(bytes));
    std::uint64_t value = 0;
    for (std::uint64_t n = 0; n < bytes; ++n) {
      const std::uint64_t byte = std::bit_cast<unsigned char>(raw[n]);
      value |= byte << 8 * (big_endian_ ? bytes - 1 - n : n);
    }
    return value;
  }

  /// Checks the directory and its strips; returns the place of the next, 0 behind the last.
  std::uint64_t read_directory(std::uint64_t at) {
    const std::uint64_t count_bytes = big_tiff_ ? 8 : 2, entry_bytes = big_tiff_ ? 20 : 12;
    const std::uint64_t count = number_at(at, count_bytes);
    require_within(at + count_bytes, count > length_ / entry_bytes ? length_ : count * entry_bytes + word());
    std::vector<std::uint64_t> offsets, bytes;
    for (std::uint64_t e = 0; e < count; ++e) {
      const std::uint64_t entry = at + count_bytes + e * entry_bytes, tag = number_at(entry, 2);
      const std::vector<std::uint64_t> values = read_entry(entry, tag == kStripOffsets || tag == kStripBytes);
      if (tag == kStripOffsets) offsets = values;
      if (tag == kStripBytes) bytes = values;
    }
    require_strips(offsets, bytes);
    return number_at(at + count_bytes + count * entry_bytes, word());
  }

  /// Checks that the entry's values lie within the file, and returns them where they are wanted.
  std::vector<std::uint64_t> read_entry(std::uint64_t entry, bool wanted) {
    const std::uint64_t type = number_at(entry + 2, 2), count = number_at(entry + 4, word());
    const std::uint64_t each = type < kTypeBytes.size() ? kTypeBytes[type] : 0;
    if (each != 0 && count > length_ / each) {
      require_within(0, length_ + 1);
    }
    const std::uint64_t field = entry + 4 + word();
    const std::uint64_t at = each * count <= word() ? field : number_at(field, word());
    require_within(at, each * count);
    std::vector<std::uint64_t> values;
    for (std::uint64_t n = 0; wanted && each != 0 && n < count; ++n) {
      values.push_back(number_at(at + n * each, each));
    }
    return values;
  }

  void require_strips(const std::vector<std::uint64_t>& offsets,
                      const std::vector<std::uint64_t>& bytes) const {
    if (offsets.size() != bytes.size()) {
      fail("a TIFF file with " + std::to_string(offsets.size()) + " strips and the lengths of " +
           std::to_string(bytes.size()));
    }
    for (std::size_t s = 0; s < offsets.size(); ++s) {
      require_within(offsets[s], bytes[s]);
    }
  }

  std::string file_;
  std::ifstream in_;
  std::uint64_t length_;
  bool big_endian_ = false, big_tiff_ = false;
};

}  // namespace

std::size_t require_whole_tiff(const std::string& file) {
  return DirectoryReader(file).count_pages();
}

}  // namespace cbc3d
