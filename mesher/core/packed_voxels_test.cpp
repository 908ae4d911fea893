// Voxels of gzip-compressed files, unpacked or left to the ordinary way.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <vector>

#include "mesher/core/image_io.hpp"
#include "mesher/core/packed_voxels.hpp"
#include "mesher/core/testing_gzip.hpp"

namespace cbc3d {
namespace {

using testing::Bytes;
using testing::compressed;

namespace fs = std::filesystem;

class PackedVoxels : public ::testing::Test {
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

TEST_F(PackedVoxels, NiftiIsUnpackedAndWhatIsNoNumberIsZero) {
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

TEST_F(PackedVoxels, RescaledNiftiIsReadTheOrdinaryWay) {
  name(".nii.gz");
  write("", compressed(nifti(counting(), 2), 6));
  EXPECT_FALSE(unpack_voxels(file_, 96, 4, true).has_value());
  const LabelImage image = read_label_image(file_);
  EXPECT_EQ(image.labels, (std::vector<Label>{0, 2, 4, 6, 8}));
}

TEST_F(PackedVoxels, NrrdIsUnpacked) {
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
