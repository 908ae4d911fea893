#include "mesher/formats/gipl.hpp"

#include "mesher/formats/testing_headers.hpp"

namespace cbc3d::formats {
namespace {

class Gipl : public testing::Headers {};
using testing::packed;
using testing::put;

std::string gipl() {
  std::string bytes(256, '\0');
  for (std::size_t axis = 0; axis < 3; ++axis) {
    put(bytes, 2 * axis, static_cast<std::uint16_t>(2), true);
    put(bytes, 10 + 4 * axis, 0.5F * static_cast<float>(axis + 1), true);
    put(bytes, 204 + 8 * axis, 10.0 * static_cast<double>(axis), true);
  }
  put(bytes, 6, static_cast<std::uint16_t>(1), true);
  put(bytes, 8, static_cast<std::uint16_t>(15), true);
  put(bytes, 252, std::uint32_t{0xEFFFE9B0U}, true);
  for (char v = 0; v < 8; ++v) {
    bytes += '\0';
    bytes += v;
  }
  return bytes;
}

TEST_F(Gipl, IsReadPlainAndCompressed) {
  const ImageHeader header = header_of("a.gipl", gipl());
  EXPECT_EQ(header.spacing_mm, (Triple{0.5, 1, 1.5}));
  EXPECT_EQ(header.origin_mm, (Triple{0, 10, 20}));
  EXPECT_EQ(voxels_of("a.gipl.gz", packed(gipl()))[6], 3);
}

TEST_F(Gipl, DamageIsNamed) {
  expect_refusal("cut.gipl", gipl().substr(0, 270), "truncated");
  std::string bytes = gipl();
  put(bytes, 8, static_cast<std::uint16_t>(1), true);
  expect_refusal("bits.gipl", bytes, "pixel type");
  bytes = gipl();
  put(bytes, 10, -1.0F, true);
  expect_refusal("spacing.gipl", bytes, "spacing");
  put(bytes, 6, static_cast<std::uint16_t>(5), true);
  expect_refusal("volumes.gipl", bytes, "5 volumes");
}

}  // namespace
}  // namespace cbc3d::formats
