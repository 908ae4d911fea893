// What zlib compressed comes back, what is damaged does not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "mesher/formats/inflate.hpp"
#include "mesher/formats/testing_gzip.hpp"

namespace cbc3d {
namespace {

using testing::Bytes;
using testing::compressed;

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
  Bytes shorter(bytes.size() - 1), longer(bytes.size() + 1);
  EXPECT_FALSE(inflate_gzip(file, shorter));
  EXPECT_FALSE(inflate_gzip(file, longer));
}

TEST(Inflate, RefusesEveryTruncation) {
  const Bytes bytes = runs(3000, 40, 30, 2, 9);
  const Bytes file = compressed(bytes, 6);
  Bytes out(bytes.size());
  for (std::size_t length = 0; length < file.size(); ++length) {
    EXPECT_FALSE(inflate_gzip({file.data(), length}, out)) << length << " of " << file.size();
  }
}

/// Damage is never taken for data: the checksum shows it, or the code itself. (A distance may change to
/// another one in a run of equal bytes, which is no damage.) Under a sanitizer this also shows that nothing
/// outside the ranges is touched.
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

}  // namespace
}  // namespace cbc3d
