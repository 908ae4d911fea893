#include "mesher/formats/byte_stream.hpp"

#include <bzlib.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <limits>
#include <vector>

namespace cbc3d::formats {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kPiece = std::size_t{1} << 18U;

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

/// The bytes of a file as they lie there.
class FileStream : public ByteStream {
 public:
  FileStream(const fs::path& path, std::uint64_t begin, std::uint64_t length)
      : file_(std::fopen(path.c_str(), "rb")),
        left_(length == 0 ? std::numeric_limits<std::uint64_t>::max() : length) {
    if (!file_) {
      throw FormatError("the file cannot be opened (" + std::string(std::strerror(errno)) +
                        "); check its name and permissions");
    }
    if (begin > static_cast<std::uint64_t>(std::numeric_limits<off_t>::max()) ||
        ::fseeko(file_.get(), static_cast<off_t>(begin), SEEK_SET) != 0) {
      throw FormatError("its voxels cannot be reached at byte " + std::to_string(begin));
    }
  }

  std::size_t read(std::span<std::uint8_t> out) override {
    const auto wanted = static_cast<std::size_t>(std::min<std::uint64_t>(out.size(), left_));
    const std::size_t got = wanted == 0 ? 0 : std::fread(out.data(), 1, wanted, file_.get());
    if (got < wanted && std::ferror(file_.get()) != 0) {
      throw FormatError("the file cannot be read (" + std::string(std::strerror(errno)) + ")");
    }
    left_ -= got;
    return got;
  }

 private:
  std::unique_ptr<std::FILE, FileCloser> file_;
  std::uint64_t left_;
};

/// What decompressors share: the compressed bytes, piece by piece, and streams that follow each other.
class PackedStream : public ByteStream {
 public:
  std::size_t read(std::span<std::uint8_t> out) final {
    std::size_t done = 0;
    while (done < out.size() && has_more()) {
      done += unpack_into(out.subspan(done));
    }
    return done;
  }

 protected:
  explicit PackedStream(std::unique_ptr<FileStream> from) : from_(std::move(from)), piece_(kPiece) {}

  /// Decompresses some bytes and calls end_stream() where the stream has ended; returns the bytes written.
  virtual std::size_t unpack_into(std::span<std::uint8_t> out) = 0;
  /// Prepares for a stream that begins with this byte; false when what follows is none.
  virtual bool begin_next(std::uint8_t first) = 0;
  void end_stream() { ended_ = true; }

  /// The compressed bytes that are at hand, more of them where there are none; empty at the end.
  std::span<std::uint8_t> available() {
    if (begin_ == end_) {
      begin_ = 0;
      end_ = from_->read(piece_);
    }
    return std::span(piece_).subspan(begin_, end_ - begin_);
  }
  void consume(std::size_t bytes) { begin_ += bytes; }

  /// True when only zeros follow, as tapes and block devices pad files.
  bool only_zeros_follow() {
    for (auto bytes = available(); !bytes.empty(); bytes = available()) {
      if (std::any_of(bytes.begin(), bytes.end(), [](std::uint8_t b) { return b != 0; })) {
        return false;
      }
      consume(bytes.size());
    }
    return true;
  }

 private:
  /// True when there is something to decompress.
  bool has_more() {
    if (ended_) {
      const auto bytes = available();
      ended_ = bytes.empty() || !begin_next(bytes[0]);
    }
    return !ended_;
  }

  std::unique_ptr<FileStream> from_;
  std::vector<std::uint8_t> piece_;
  std::size_t begin_ = 0, end_ = 0;
  bool ended_ = false;
};

class ZlibStream : public PackedStream {
 public:
  explicit ZlibStream(std::unique_ptr<FileStream> from) : PackedStream(std::move(from)) {
    constexpr int kGzipOrZlib = 32;  // zlib finds out which of the two when this is added
    if (inflateInit2(&stream_, MAX_WBITS + kGzipOrZlib) != Z_OK) {
      throw std::bad_alloc();
    }
  }
  ~ZlibStream() override { inflateEnd(&stream_); }
  ZlibStream(const ZlibStream&) = delete;
  ZlibStream& operator=(const ZlibStream&) = delete;

 private:
  bool begin_next(std::uint8_t first) override {
    if (first != 0x1F) {
      if (only_zeros_follow()) {
        return false;
      }
      throw FormatError(
          "its compressed data are followed by bytes that are none; it is damaged, copy it again");
    }
    inflateReset(&stream_);
    return true;
  }

  std::size_t unpack_into(std::span<std::uint8_t> out) override {
    const auto bytes = available();
    stream_.next_in = bytes.data();
    stream_.avail_in = static_cast<uInt>(bytes.size());
    stream_.next_out = out.data();
    const auto room = static_cast<uInt>(std::min<std::size_t>(out.size(), 1U << 30U));
    stream_.avail_out = room;
    const int result = inflate(&stream_, Z_NO_FLUSH);
    consume(bytes.size() - stream_.avail_in);
    if (result == Z_STREAM_END) {
      end_stream();
    } else if (result == Z_BUF_ERROR && bytes.empty()) {
      throw FormatError("its compressed data break off (the file is truncated); copy it again");
    } else if (result != Z_OK && result != Z_BUF_ERROR) {
      throw FormatError("its compressed data are damaged (" +
                        std::string(stream_.msg != nullptr ? stream_.msg : "zlib fails") +
                        "); copy it again");
    }
    return room - stream_.avail_out;
  }

  z_stream stream_{};
};

class BzipStream : public PackedStream {
 public:
  explicit BzipStream(std::unique_ptr<FileStream> from) : PackedStream(std::move(from)) { begin(); }
  ~BzipStream() override { BZ2_bzDecompressEnd(&stream_); }
  BzipStream(const BzipStream&) = delete;
  BzipStream& operator=(const BzipStream&) = delete;

 private:
  void begin() {
    stream_ = {};
    if (BZ2_bzDecompressInit(&stream_, 0, 0) != BZ_OK) {
      throw std::bad_alloc();
    }
  }

  bool begin_next(std::uint8_t first) override {
    if (first == 0 && only_zeros_follow()) {
      return false;
    }
    BZ2_bzDecompressEnd(&stream_);
    begin();
    return true;
  }

  std::size_t unpack_into(std::span<std::uint8_t> out) override {
    const auto bytes = available();
    if (bytes.empty()) {
      throw FormatError("its compressed data break off (the file is truncated); copy it again");
    }
    stream_.next_in = reinterpret_cast<char*>(bytes.data());
    stream_.avail_in = static_cast<unsigned>(bytes.size());
    stream_.next_out = reinterpret_cast<char*>(out.data());
    const auto room = static_cast<unsigned>(std::min<std::size_t>(out.size(), 1U << 30U));
    stream_.avail_out = room;
    const int result = BZ2_bzDecompress(&stream_);
    consume(bytes.size() - stream_.avail_in);
    if (result == BZ_STREAM_END) {
      end_stream();
    } else if (result != BZ_OK) {
      throw FormatError("its compressed data are damaged (bzip2 fails); copy it again");
    }
    return room - stream_.avail_out;
  }

  bz_stream stream_{};
};

}  // namespace

std::unique_ptr<ByteStream> open_stream(const fs::path& path, std::uint64_t begin, std::uint64_t length,
                                        Encoding encoding) {
  auto file = std::make_unique<FileStream>(path, begin, length);
  switch (encoding) {
    case Encoding::gzip:
      return std::make_unique<ZlibStream>(std::move(file));
    case Encoding::bzip2:
      return std::make_unique<BzipStream>(std::move(file));
    default:
      return file;
  }
}

Encoding encoding_of_file(const fs::path& path) {
  std::array<std::uint8_t, 4> magic{};
  const std::size_t got = FileStream(path, 0, 0).read(magic);
  if (got >= 2 && magic[0] == 0x1F && magic[1] == 0x8B) {
    return Encoding::gzip;
  }
  const bool bzip2 =
      got == 4 && std::memcmp(magic.data(), "BZh", 3) == 0 && magic[3] >= '1' && magic[3] <= '9';
  return bzip2 ? Encoding::bzip2 : Encoding::raw;
}

std::string head_of_file(const fs::path& path, Encoding encoding, std::size_t most) {
  std::string head(most, '\0');
  auto* const bytes = reinterpret_cast<std::uint8_t*>(head.data());
  head.resize(open_stream(path, 0, 0, encoding)->read({bytes, head.size()}));
  return head;
}

}  // namespace cbc3d::formats
