#include "mesher/formats/mgh.hpp"

#include "mesher/formats/testing_headers.hpp"

namespace cbc3d::formats {
namespace {

class Mgh : public testing::Headers {};
using testing::packed;
using testing::put;

/// 2 x 4 x 6 bytes, axes to the left, inferior and anterior, the centre at (1, 2, 3) RAS.
std::string mgh() {
  std::string bytes(284 + 48, '\0');
  const std::int32_t fields[] = {1, 2, 4, 6, 1, 0, 0};
  for (std::size_t n = 0; n < 7; ++n) {
    put(bytes, 4 * n, fields[n], true);
  }
  put(bytes, 28, std::int16_t{1}, true);
  const float floats[] = {1, 2, 3, -1, 0, 0, 0, 0, -1, 0, 1, 0, 1, 2, 3};
  for (std::size_t n = 0; n < 15; ++n) {
    put(bytes, 30 + 4 * n, floats[n], true);
  }
  bytes[284 + 7] = 9;
  return bytes;
}

TEST_F(Mgh, ItsCentreIsTheVoxelOfHalfTheSize) {
  const ImageHeader header = header_of("a.mgh", mgh());
  EXPECT_EQ(header.spacing_mm, (Triple{1, 2, 3}));
  EXPECT_EQ(header.axes[0], (Triple{1, 0, 0}));
  EXPECT_EQ(header.axes[1], (Triple{0, 0, -1}));
  EXPECT_EQ(header.axes[2], (Triple{0, -1, 0}));
  // RAS: (1, 2, 3) - 1 (-1, 0, 0) - 4 (0, 0, -1) - 9 (0, 1, 0) = (2, -7, 7)
  EXPECT_EQ(header.origin_mm, (Triple{-2, 7, 7}));
  EXPECT_EQ(voxels_of("a.mgz", packed(mgh() + "scan parameters"))[7], 9);
}

TEST_F(Mgh, DamageIsNamed) {
  expect_refusal("cut.mgh", mgh().substr(0, 300), "truncated");
  std::string bytes = mgh();
  put(bytes, 28, std::int16_t{0}, true);
  EXPECT_EQ(header_of("nowhere.mgh", bytes).warnings.size(), 1U);
  put(bytes, 16, std::int32_t{3}, true);
  EXPECT_EQ(header_of("volumes.mgh", bytes).volumes, 3U);
  bytes = mgh();
  put(bytes, 8, std::int32_t{-4}, true);
  expect_refusal("size.mgh", bytes, "'-4'");
}

}  // namespace
}  // namespace cbc3d::formats
