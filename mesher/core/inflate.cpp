#include "mesher/core/inflate.hpp"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <vector>

namespace cbc3d {
namespace {

constexpr unsigned kLongestCode = 15;
constexpr unsigned kFastBits = 10;

enum class Outcome { ended, full, damaged };

/// Bits of a byte stream, the lowest of a byte first. Behind the end come zeros.
class BitReader {
 public:
  explicit BitReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  /// At least 56 bits are there afterwards.
  void refill() {
    if (next_ + 8 <= bytes_.size() && std::endian::native == std::endian::little) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes_.data() + next_, 8);
      bits_ |= word << count_;
      next_ += (63 - count_) / 8;
      count_ |= 56;
      return;
    }
    for (; count_ < 56; count_ += 8, ++next_) {
      bits_ |= (next_ < bytes_.size() ? std::uint64_t{bytes_[next_]} : 0) << count_;
    }
  }
  [[nodiscard]] std::uint64_t peek() const { return bits_; }
  void skip(unsigned count) {
    bits_ >>= count;
    count_ -= count;
  }
  /// So many bits as a number, refill() having been called for them.
  unsigned take(unsigned count) {
    const auto value = static_cast<unsigned>(bits_ & ((std::uint64_t{1} << count) - 1));
    skip(count);
    return value;
  }
  /// The place of the first byte of which no bit is taken yet.
  [[nodiscard]] std::size_t byte_position() const { return next_ - count_ / 8; }
  /// So many whole bytes; what is left of a byte begun is passed over. Fewer where there are no more.
  std::span<const std::uint8_t> take_bytes(std::size_t count) {
    const std::size_t begin = std::min(byte_position(), bytes_.size());
    count = std::min(count, bytes_.size() - begin);
    next_ = begin + count;
    bits_ = 0;
    count_ = 0;
    return bytes_.subspan(begin, count);
  }
  /// More was taken than there is.
  [[nodiscard]] bool overrun() const { return byte_position() > bytes_.size(); }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t next_ = 0;
  std::uint64_t bits_ = 0;
  unsigned count_ = 0;
};

/// A canonical Huffman code: short codes by a table of all their continuations, long ones bit by bit.
class HuffmanCode {
 public:
  /// `lengths`: of every symbol's code, 0 where it has none. False when there is no such code.
  bool build(std::span<const std::uint8_t> lengths) {
    count_.fill(0);
    for (const std::uint8_t length : lengths) {
      ++count_[length];
    }
    if (!is_complete(lengths.size())) {
      return false;
    }
    std::array<std::uint16_t, kLongestCode + 2> first{};  // place in symbols_, by length
    std::array<unsigned, kLongestCode + 2> code{};
    for (unsigned length = 1; length <= kLongestCode; ++length) {
      first[length + 1] = static_cast<std::uint16_t>(first[length] + count_[length]);
      code[length + 1] = (code[length] + count_[length]) << 1U;
    }
    fast_.fill(0);
    for (std::size_t symbol = 0; symbol < lengths.size(); ++symbol) {
      const unsigned length = lengths[symbol];
      if (length != 0) {
        symbols_[first[length]++] = static_cast<std::uint16_t>(symbol);
        tabulate(static_cast<unsigned>(symbol), code[length]++, length);
      }
    }
    return true;
  }

  /// The next symbol; kNone when the bits are no code of it.
  unsigned decode(BitReader& in) const {
    const unsigned entry = fast_[in.peek() & ((1U << kFastBits) - 1)];
    if (entry != 0) {
      in.skip(entry & 15U);
      return entry >> 4U;
    }
    return decode_long(in);
  }

  static constexpr unsigned kNone = 0xFFFF;

 private:
  /// All codes are used, or there is but one code, of one bit, as the format allows for distances, or none.
  [[nodiscard]] bool is_complete(std::size_t symbols) const {
    int left = 1;
    for (unsigned length = 1; length <= kLongestCode; ++length) {
      left = 2 * left - count_[length];
      if (left < 0) {
        return false;
      }
    }
    return left == 0 || count_[0] == symbols || (count_[0] + 1U == symbols && count_[1] == 1);
  }

  void tabulate(unsigned symbol, unsigned code, unsigned length) {
    if (length > kFastBits) {
      return;
    }
    unsigned reversed = 0;
    for (unsigned bit = 0; bit < length; ++bit) {
      reversed |= (code >> bit & 1U) << (length - 1 - bit);
    }
    for (unsigned at = reversed; at < 1U << kFastBits; at += 1U << length) {
      fast_[at] = static_cast<std::uint16_t>(symbol << 4U | length);
    }
  }

  unsigned decode_long(BitReader& in) const {
    int code = 0, first = 0, index = 0;
    for (unsigned length = 1; length <= kLongestCode; ++length) {
      code |= static_cast<int>(in.take(1));
      const int count = count_[length];
      if (code - count < first) {
        return symbols_[static_cast<std::size_t>(index + code - first)];
      }
      index += count;
      first = (first + count) << 1;
      code <<= 1;
    }
    return kNone;
  }

  std::array<std::uint16_t, 1U << kFastBits> fast_{};  // symbol and length, 0: the code is longer
  std::array<std::uint16_t, kLongestCode + 1> count_{};
  std::array<std::uint16_t, 288> symbols_{};  // by code
};

/// What a length or distance symbol stands for: a base and further bits.
struct Span {
  std::uint16_t base;
  std::uint8_t bits;
};

constexpr std::array<Span, 29> kLengths = {
    {{3, 0},  {4, 0},  {5, 0},  {6, 0},   {7, 0},   {8, 0},   {9, 0},   {10, 0},  {11, 1}, {13, 1},
     {15, 1}, {17, 1}, {19, 2}, {23, 2},  {27, 2},  {31, 2},  {35, 3},  {43, 3},  {51, 3}, {59, 3},
     {67, 4}, {83, 4}, {99, 4}, {115, 4}, {131, 5}, {163, 5}, {195, 5}, {227, 5}, {258, 0}}};
constexpr std::array<Span, 30> kDistances = {
    {{1, 0},     {2, 0},     {3, 0},     {4, 0},      {5, 1},      {7, 1},     {9, 2},     {13, 2},
     {17, 3},    {25, 3},    {33, 4},    {49, 4},     {65, 5},     {97, 5},    {129, 6},   {193, 6},
     {257, 7},   {385, 7},   {513, 8},   {769, 8},    {1025, 9},   {1537, 9},  {2049, 10}, {3073, 10},
     {4097, 11}, {6145, 11}, {8193, 12}, {12289, 12}, {16385, 13}, {24577, 13}}};

/// Copies bytes from `distance` before `to`, which may overlap: what is copied repeats.
void repeat(std::uint8_t* to, std::size_t distance, std::size_t length) {
  if (distance == 1) {
    std::memset(to, to[-1], length);
    return;
  }
  const std::uint8_t* const from = to - distance;
  for (std::size_t done = 0; done < length;) {  // twice as much is known after each piece
    const std::size_t piece = std::min(length - done, distance + done);
    std::memcpy(to + done, from, piece);
    done += piece;
  }
}

/// One deflate stream (RFC 1951) into a range of memory that is its own window.
class Inflater {
 public:
  Inflater(BitReader& in, std::span<std::uint8_t> out) : in_(in), out_(out) {}

  /// Up to the stream's end, or until the range is full and more comes.
  Outcome run() {
    for (bool last = false; !last;) {
      in_.refill();
      last = in_.take(1) != 0;
      const unsigned kind = in_.take(2);
      Outcome outcome = Outcome::damaged;
      if (kind == 0) {
        outcome = stored();
      } else if (kind == 1 ? build_fixed() : kind == 2 && build_dynamic()) {
        outcome = compressed();
      }
      if (outcome != Outcome::ended) {
        return outcome;
      }
    }
    return Outcome::ended;
  }

  [[nodiscard]] std::size_t size() const { return size_; }

 private:
  Outcome stored() {
    const auto head = in_.take_bytes(4);
    if (head.size() < 4 || (head[0] ^ head[2]) != 0xFF || (head[1] ^ head[3]) != 0xFF) {
      return Outcome::damaged;
    }
    const std::size_t length = head[0] + std::size_t{256} * head[1];
    const auto bytes = in_.take_bytes(length);
    if (bytes.size() < length) {
      return Outcome::damaged;
    }
    const std::size_t fits = std::min(length, out_.size() - size_);
    std::copy_n(bytes.begin(), fits, out_.begin() + static_cast<std::ptrdiff_t>(size_));
    size_ += fits;
    return fits < length ? Outcome::full : Outcome::ended;
  }

  bool build_fixed() {
    std::array<std::uint8_t, 288> lengths{};
    std::fill(lengths.begin(), lengths.begin() + 144, 8);
    std::fill(lengths.begin() + 144, lengths.begin() + 256, 9);
    std::fill(lengths.begin() + 256, lengths.begin() + 280, 7);
    std::fill(lengths.begin() + 280, lengths.end(), 8);
    std::array<std::uint8_t, 32> distances{};
    distances.fill(5);
    return literals_.build(lengths) && distances_.build(distances);
  }

  bool build_dynamic() {
    constexpr std::array<std::uint8_t, 19> kOrder = {16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                     11, 4,  12, 3, 13, 2, 14, 1, 15};
    const std::size_t literals = in_.take(5) + 257;
    const std::size_t distances = in_.take(5) + 1;
    const std::size_t codes = in_.take(4) + 4;
    std::array<std::uint8_t, 19> code_lengths{};
    for (std::size_t i = 0; i < codes; ++i) {
      in_.refill();
      code_lengths[kOrder[i]] = static_cast<std::uint8_t>(in_.take(3));
    }
    std::array<std::uint8_t, 288 + 32> lengths{};
    if (literals > 286 || distances > 30 || !literals_.build(code_lengths) ||
        !read_lengths({lengths.data(), literals + distances}) || lengths[256] == 0) {
      return false;
    }
    return literals_.build({lengths.data(), literals}) &&
           distances_.build({lengths.data() + literals, distances});
  }

  /// Code lengths, themselves in the code that stands in literals_.
  bool read_lengths(std::span<std::uint8_t> lengths) {
    for (std::size_t i = 0; i < lengths.size();) {
      in_.refill();
      const unsigned symbol = literals_.decode(in_);
      if (symbol < 16) {
        lengths[i++] = static_cast<std::uint8_t>(symbol);
        continue;
      }
      if (symbol > 18 || (symbol == 16 && i == 0)) {
        return false;
      }
      const std::size_t times = symbol == 16   ? 3 + in_.take(2)
                                : symbol == 17 ? 3 + in_.take(3)
                                               : 11 + in_.take(7);
      const std::uint8_t length = symbol == 16 ? lengths[i - 1] : std::uint8_t{0};
      if (i + times > lengths.size()) {
        return false;
      }
      std::fill_n(lengths.begin() + static_cast<std::ptrdiff_t>(i), times, length);
      i += times;
    }
    return true;
  }

  /// The state is in local variables meanwhile: what is written could else be a part of it.
  Outcome compressed() {
    BitReader in = in_;
    std::uint8_t* to = out_.data() + size_;
    std::uint8_t* const end = out_.data() + out_.size();
    Outcome outcome = Outcome::damaged;
    while (!in.overrun()) {
      in.refill();  // enough for a length and a distance
      const unsigned symbol = literals_.decode(in);
      if (symbol < 256 && to != end) {
        *to++ = static_cast<std::uint8_t>(symbol);
        continue;
      }
      outcome = symbol < 256    ? Outcome::full
                : symbol == 256 ? Outcome::ended
                                : copy(symbol - 257, in, to, end);
      if (symbol <= 256 || outcome != Outcome::ended) {
        break;
      }
      outcome = Outcome::damaged;  // if there is no more
    }
    in_ = in;
    size_ = static_cast<std::size_t>(to - out_.data());
    return in.overrun() ? Outcome::damaged : outcome;
  }

  Outcome copy(unsigned length_symbol, BitReader& in, std::uint8_t*& to, const std::uint8_t* end) const {
    if (length_symbol >= kLengths.size()) {
      return Outcome::damaged;
    }
    const std::size_t length = kLengths[length_symbol].base + in.take(kLengths[length_symbol].bits);
    const unsigned symbol = distances_.decode(in);
    if (symbol >= kDistances.size()) {
      return Outcome::damaged;
    }
    const std::size_t distance = kDistances[symbol].base + in.take(kDistances[symbol].bits);
    if (distance > static_cast<std::size_t>(to - out_.data())) {
      return Outcome::damaged;
    }
    const std::size_t fits = std::min(length, static_cast<std::size_t>(end - to));
    repeat(to, distance, fits);
    to += fits;
    return fits < length ? Outcome::full : Outcome::ended;
  }

  BitReader& in_;
  std::span<std::uint8_t> out_;
  std::size_t size_ = 0;
  HuffmanCode literals_, distances_;
};

/// Bytes of a gzip member's header at the begin of `file`; 0 when there is none.
std::size_t header_size(std::span<const std::uint8_t> file) {
  constexpr unsigned kHeaderCrc = 2, kExtra = 4, kName = 8, kComment = 16;
  if (file.size() < 18 || file[0] != 0x1F || file[1] != 0x8B || file[2] != 8 || (file[3] & 0xE0U) != 0) {
    return 0;
  }
  const unsigned flags = file[3];
  std::size_t at = 10;
  if ((flags & kExtra) != 0) {
    at += 2U + file[at] + 256U * file[at + 1];
  }
  for (const unsigned text : {kName, kComment}) {
    while ((flags & text) != 0 && at < file.size() && file[at++] != 0) {
    }
  }
  at += (flags & kHeaderCrc) != 0 ? 2 : 0;
  return at < file.size() ? at : 0;
}

/// The checksum that ends a gzip member, in pieces side by side.
std::uint32_t checksum(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kPiece = std::size_t{1} << 20U;
  const std::size_t pieces = (bytes.size() + kPiece - 1) / kPiece;
  std::vector<uLong> sums(pieces);
#pragma omp parallel for schedule(static)
  for (std::size_t p = 0; p < pieces; ++p) {
    const auto piece = bytes.subspan(p * kPiece, std::min(kPiece, bytes.size() - p * kPiece));
    sums[p] = crc32_z(0, piece.data(), piece.size());
  }
  uLong sum = 0;
  for (std::size_t p = 0; p < pieces; ++p) {
    sum = crc32_combine(sum, sums[p], static_cast<z_off_t>(std::min(kPiece, bytes.size() - p * kPiece)));
  }
  return static_cast<std::uint32_t>(sum);
}

std::uint32_t number_at(std::span<const std::uint8_t> file, std::size_t at) {
  return file[at] | static_cast<std::uint32_t>(file[at + 1]) << 8U |
         static_cast<std::uint32_t>(file[at + 2]) << 16U | static_cast<std::uint32_t>(file[at + 3]) << 24U;
}

/// One member; how much of the file and of the range it took, zero of the file when it is damaged.
struct Member {
  std::size_t file_bytes = 0, bytes = 0;
};

Member inflate_member(std::span<const std::uint8_t> file, std::span<std::uint8_t> out) {
  const std::size_t header = header_size(file);
  if (header == 0) {
    return {};
  }
  BitReader in(file.subspan(header));
  Inflater inflater(in, out);
  if (inflater.run() != Outcome::ended) {
    return {};
  }
  const std::size_t end = header + in.byte_position();
  const std::size_t size = inflater.size();
  if (end + 8 > file.size() || number_at(file, end) != checksum(out.first(size)) ||
      number_at(file, end + 4) != static_cast<std::uint32_t>(size)) {
    return {};
  }
  return {end + 8, size};
}

}  // namespace

bool inflate_gzip(std::span<const std::uint8_t> file, std::span<std::uint8_t> out) {
  do {
    const Member member = inflate_member(file, out);
    if (member.file_bytes == 0) {
      return false;
    }
    file = file.subspan(member.file_bytes);
    out = out.subspan(member.bytes);
  } while (!file.empty());
  return out.empty();
}

bool inflate_gzip_begin(std::span<const std::uint8_t> file, std::span<std::uint8_t> out) {
  const std::size_t header = header_size(file);
  if (header == 0) {
    return false;
  }
  BitReader in(file.subspan(header));
  return Inflater(in, out).run() == Outcome::full;
}

}  // namespace cbc3d
