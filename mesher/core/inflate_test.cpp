// What zlib compressed comes back, what is damaged does not.
#include "mesher/core/inflate.hpp"

#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "mesher/core/image_io.hpp"
#include "mesher/core/packed_voxels.hpp"

namespace cbc3d {
namespace {
namespace fs = std::filesystem;

using Bytes = std::vector<std::uint8_t>;

/// A gzip member as zlib writes it.
Bytes compressed(const Bytes& bytes, int level, int strategy = Z_DEFAULT_STRATEGY) {
  z_stream stream{};
  EXPECT_EQ(deflateInit2(&stream, level, Z_DEFLATED, 15 + 16, 8, strategy), Z_OK);
  Bytes out(deflateBound(&stream, bytes.size()) + 32);
  stream.next_in = const_cast<Bytef*>(bytes.data());
  stream.avail_in = static_cast<uInt>(bytes.size());
  stream.next_out = out.data();
  stream.avail_out = static_cast<uInt>(out.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  out.resize(stream.total_out);
  deflateEnd(&stream);
  return out;
}

/// Runs of `symbols` values that are short or long, as in the rows of a label image, in `wide` bytes a value.
Bytes runs(std::size_t count, unsigned symbols, unsigned longest, std::size_t wide, unsigned seed) {
  std::mt19937 random(seed);
  Bytes bytes;
  while (bytes.size() < count) {
    const auto value = static_cast<std::uint8_t>(random() % symbols);
    for (unsigned n = 1 + random() % longest; n > 0; --n) {
      for (std::size_t b = 0; b < wide; ++b) {
        bytes.push_back(b + 1 == wide ? value : std::uint8_t{0});
      }
    }
  }
  bytes.resize(count);
  return bytes;
}

std::vector<Bytes> samples() {
  return {{},
          {7},
          Bytes(3000000, 0),
          runs(700000, 2, 1, 1, 1),
          runs(700000, 256, 1, 1, 2),  // cannot be compressed
          runs(700000, 200, 9, 4, 3),
          runs(700000, 3, 2000, 2, 4),
          runs(300000, 60, 30, 8, 5),
          runs(65536, 5, 3, 3, 6)};
}

TEST(Inflate, GivesBackWhatZlibCompressed) {
  for (const Bytes& bytes : samples()) {
    for (const int level : {0, 1, 6, 9}) {
      for (const int strategy : {Z_DEFAULT_STRATEGY, Z_HUFFMAN_ONLY, Z_RLE, Z_FIXED}) {
        Bytes out(bytes.size(), 0xAA);
        EXPECT_TRUE(inflate_gzip(compressed(bytes, level, strategy), out))
            << bytes.size() << " bytes, level " << level << ", strategy " << strategy;
        EXPECT_EQ(out, bytes);
      }
    }
  }
}

TEST(Inflate, JoinsMembers) {
  Bytes file, all;
  for (const Bytes& bytes : samples()) {
    const Bytes member = compressed(bytes, 6);
    file.insert(file.end(), member.begin(), member.end());
    all.insert(all.end(), bytes.begin(), bytes.end());
  }
  Bytes out(all.size());
  EXPECT_TRUE(inflate_gzip(file, out));
  EXPECT_EQ(out, all);
}

TEST(Inflate, PassesOverNameAndCommentOfTheHeader) {
  const Bytes bytes = runs(1000, 5, 20, 1, 8);
  Bytes file = compressed(bytes, 6);
  const std::string name("image.raw\0a comment\0", 20);
  file[3] = 8 | 16;
  file.insert(file.begin() + 10, name.begin(), name.end());
  Bytes out(bytes.size());
  EXPECT_TRUE(inflate_gzip(file, out));
  EXPECT_EQ(out, bytes);
}

TEST(Inflate, WantsTheSizeThatIsAskedFor) {
  const Bytes bytes = runs(5000, 5, 20, 1, 8);
  const Bytes file = compressed(bytes, 6);
  Bytes shorter(bytes.size() - 1), longer(bytes.size() + 1), begin(352);
  EXPECT_FALSE(inflate_gzip(file, shorter));
  EXPECT_FALSE(inflate_gzip(file, longer));
  EXPECT_TRUE(inflate_gzip_begin(file, begin));
  EXPECT_TRUE(std::equal(begin.begin(), begin.end(), bytes.begin()));
  EXPECT_FALSE(inflate_gzip_begin(file, longer));
}

TEST(Inflate, RefusesEveryTruncation) {
  const Bytes bytes = runs(3000, 40, 30, 2, 9);
  const Bytes file = compressed(bytes, 6);
  Bytes out(bytes.size());
  for (std::size_t length = 0; length < file.size(); ++length) {
    EXPECT_FALSE(inflate_gzip({file.data(), length}, out)) << length << " of " << file.size();
  }
}

/// No damage is taken for data: the checksum tells, or the code itself. (A distance may change to another
/// one in a run of equal bytes, which is no damage.) Under a sanitizer this also shows that nothing outside
/// the ranges is touched.
TEST(Inflate, TakesNoDamageForData) {
  const Bytes bytes = runs(20000, 40, 30, 2, 9);
  for (const int level : {0, 1, 9}) {
    const Bytes file = compressed(bytes, level);
    std::mt19937 random(11);
    int refused = 0;
    for (int i = 0; i < 3000; ++i) {
      Bytes damaged = file;
      const std::size_t at = 10 + random() % (file.size() - 10);
      damaged[at] ^= static_cast<std::uint8_t>(1U << random() % 8);
      Bytes out(bytes.size());
      const bool taken = inflate_gzip(damaged, out);
      refused += taken ? 0 : 1;
      EXPECT_TRUE(!taken || out == bytes) << "level " << level << ", byte " << at;
    }
    EXPECT_GT(refused, 2500) << "level " << level;
  }
}

TEST(Inflate, RefusesNoise) {
  std::mt19937 random(5);
  for (int i = 0; i < 3000; ++i) {
    Bytes file = {0x1F, 0x8B, 8, 0, 0, 0, 0, 0, 0, 3};
    for (int n = 0; n < 200; ++n) {
      file.push_back(static_cast<std::uint8_t>(random()));
    }
    Bytes out(1000);
    EXPECT_FALSE(inflate_gzip(file, out));
  }
}

class Packed : public ::testing::Test {
 protected:
  void TearDown() override { fs::remove(file_); }
  void name(const std::string& extension) {
    file_ = fs::temp_directory_path() / ("cbc3d-packed-" + std::to_string(::getpid()) + extension);
  }
  void write(const std::string& head, const Bytes& packed) const {
    std::ofstream out(file_, std::ios::binary);
    out << head;
    out.write(reinterpret_cast<const char*>(packed.data()), static_cast<std::streamsize>(packed.size()));
  }
  fs::path file_;
};

/// A NIfTI header of 4 x 3 x 2 floats and these after it.
Bytes nifti(const std::vector<float>& values, float slope) {
  Bytes bytes(352 + 4 * values.size(), 0);
  const auto put = [&](std::size_t at, auto value) { std::memcpy(bytes.data() + at, &value, sizeof(value)); };
  put(0, std::int32_t{348});
  const std::int16_t sizes[] = {3, 4, 3, 2, 1, 1, 1, 1};
  std::memcpy(bytes.data() + 40, sizes, sizeof(sizes));
  put(70, std::int16_t{16});
  put(72, std::int16_t{32});
  for (std::size_t i = 0; i < 4; ++i) {
    put(76 + 4 * i, 1.0F);
  }
  put(108, 352.0F);
  put(112, slope);
  std::memcpy(bytes.data() + 344, "n+1", 4);
  std::memcpy(bytes.data() + 352, values.data(), 4 * values.size());
  return bytes;
}

std::vector<float> counting() {
  std::vector<float> values(24);
  for (std::size_t v = 0; v < values.size(); ++v) {
    values[v] = static_cast<float>(v % 5);
  }
  return values;
}

TEST_F(Packed, NiftiIsUnpackedAndWhatIsNoNumberIsZero) {
  std::vector<float> values = counting();
  values[7] = std::numeric_limits<float>::quiet_NaN();
  values[8] = std::numeric_limits<float>::infinity();
  name(".nii.gz");
  write("", compressed(nifti(values, 1), 6));
  EXPECT_TRUE(unpack_voxels(file_, 96, 4, true).has_value());
  EXPECT_FALSE(unpack_voxels(file_, 92, 4, true).has_value());
  EXPECT_FALSE(unpack_voxels(file_, 96, 2, false).has_value());
  const LabelImage image = read_label_image(file_);
  for (std::size_t v = 0; v < values.size(); ++v) {
    EXPECT_EQ(static_cast<float>(image.labels[image.voxels[v]]), std::isfinite(values[v]) ? values[v] : 0.0F);
  }
}

TEST_F(Packed, RescaledNiftiIsReadTheOrdinaryWay) {
  name(".nii.gz");
  write("", compressed(nifti(counting(), 2), 6));
  EXPECT_FALSE(unpack_voxels(file_, 96, 4, true).has_value());
  const LabelImage image = read_label_image(file_);
  EXPECT_EQ(image.labels, (std::vector<Label>{0, 2, 4, 6, 8}));
}

TEST_F(Packed, NrrdIsUnpacked) {
  const std::string head =
      "NRRD0004\ntype: short\ndimension: 3\nsizes: 4 3 2\nencoding: gzip\nendian: little\n\n";
  Bytes values(48, 0);
  for (std::size_t v = 0; v < 24; ++v) {
    values[2 * v] = static_cast<std::uint8_t>(v % 7);
  }
  name(".nrrd");
  write(head, compressed(values, 6));
  EXPECT_TRUE(unpack_voxels(file_, 48, 2, false).has_value());
  const LabelImage image = read_label_image(file_);
  for (std::size_t v = 0; v < 24; ++v) {
    EXPECT_EQ(image.labels[image.voxels[v]], static_cast<Label>(v % 7));
  }
}

}  // namespace
}  // namespace cbc3d
