#include "cases/adversarial.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "cases/phantoms/random.hpp"
#include "mesher/core/label_image.hpp"

namespace cbc3d::cases {
namespace {

namespace fs = std::filesystem;
using LabelAt = std::function<std::int32_t(int i, int j, int k)>;

static_assert(std::endian::native == std::endian::little, "values are written as they lie in memory");

/// The axes of an image in NRRD's words: one vector an axis, mm.
std::string straight_axes(double spacing_mm) {
  std::ostringstream text;
  text << '(' << spacing_mm << ",0,0) (0," << spacing_mm << ",0) (0,0," << spacing_mm << ')';
  return text.str();
}

std::string nrrd_header(const Index3& size, const std::string& axes) {
  std::ostringstream text;
  text << "NRRD0004\ntype: int\ndimension: 3\nspace: left-posterior-superior\nsizes: " << size[0] << ' '
       << size[1] << ' ' << size[2] << "\nspace directions: " << axes
       << "\nkinds: domain domain domain\nendian: little\nencoding: raw\nspace origin: (0,0,0)\n\n";
  return text.str();
}

std::string voxel_bytes(const Index3& size, const LabelAt& label_at) {
  std::string bytes;
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0]; ++i) {
        const std::int32_t label = label_at(i, j, k);
        bytes.append(reinterpret_cast<const char*>(&label), sizeof label);
      }
    }
  }
  return bytes;
}

void write_file(const fs::path& file, const std::string& bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

/// An image in which a function gives the labels.
AdversarialImage image(std::string_view name, const Index3& size, const std::string& axes,
                       const LabelAt& label_at) {
  return {name, ".nrrd", true, [=](const fs::path& file) {
            write_file(file, nrrd_header(size, axes) + voxel_bytes(size, label_at));
          }};
}

AdversarialImage refused(AdversarialImage adversarial) {
  adversarial.readable = false;
  return adversarial;
}

/// A ball of radius 6 in an image of side 17, its upper half of another label.
LabelAt ball(std::int32_t lower, std::int32_t upper) {
  return [=](int i, int j, int k) {
    const int x = i - 8, y = j - 8, z = k - 8;
    return x * x + y * y + z * z > 36 ? 0 : z < 0 ? lower : upper;
  };
}

/// Voxel by voxel `labels` at random, each with this share; the rest background.
LabelAt speckle(std::uint64_t seed, double share, int labels) {
  return [=](int i, int j, int k) {
    const int at = (k * 1000 + j) * 1000 + i;
    const double draw = uniform_at(seed, static_cast<std::uint64_t>(at));
    return draw < share * labels ? 1 + static_cast<int>(draw / share) : 0;
  };
}

constexpr Index3 kBall{17, 17, 17};

/// A NIfTI-1 header of four axes, the last of one volume, followed by a ball with one byte per voxel.
void write_four_axes(const fs::path& file) {
  std::array<char, 352> header{};
  const auto put = [&](std::size_t at, auto value) { std::memcpy(header.data() + at, &value, sizeof value); };
  put(0, std::int32_t{348});
  const std::array<std::int16_t, 5> dimensions{4, 17, 17, 17, 1};
  for (std::size_t n = 0; n < dimensions.size(); ++n) {
    put(40 + 2 * n, dimensions[n]);
    put(76 + 4 * n, 1.0F);  // handedness, then the spacings
  }
  put(70, std::int16_t{2});  // unsigned char
  put(72, std::int16_t{8});
  put(108, 352.0F);          // where the voxels begin
  put(123, std::int8_t{2});  // mm
  std::memcpy(header.data() + 344, "n+1", 4);
  std::string bytes(header.data(), header.size());
  const LabelAt label_at = ball(1, 2);
  for (int v = 0; v < 17 * 17 * 17; ++v) {
    bytes += static_cast<char>(label_at(v % 17, v / 17 % 17, v / 289));
  }
  write_file(file, bytes);
}

void write_truncated(const fs::path& file) {
  const std::string whole = nrrd_header(kBall, straight_axes(1)) + voxel_bytes(kBall, ball(1, 2));
  write_file(file, whole.substr(0, whole.size() / 2));
}

/// Gigabytes promised, few bytes there.
void write_empty_promise(const fs::path& file) {
  write_file(file, nrrd_header({1500, 1500, 1500}, straight_axes(1)) + std::string(1000, '\1'));
}

std::vector<AdversarialImage> all_images() {
  const std::string unit = straight_axes(1);
  const auto everywhere = [](int, int, int) { return 1; };
  std::vector<AdversarialImage> images;
  images.push_back(image("one-voxel", {1, 1, 1}, unit, everywhere));
  images.push_back(image("one-slice", {24, 20, 1}, unit, speckle(1, .6, 1)));
  images.push_back(image("one-row", {24, 1, 1}, unit, everywhere));
  images.push_back(image("full-to-border", {12, 11, 10}, unit, everywhere));
  images.push_back(
      image("checkerboard", {16, 16, 16}, unit, [](int i, int j, int k) { return (i + j + k) % 2; }));
  images.push_back(image("checkerboard-two-labels", {14, 14, 14}, unit,
                         [](int i, int j, int k) { return 1 + (i + j + k) % 2; }));
  images.push_back(image("noise", {18, 18, 18}, unit, speckle(2, .15, 4)));
  images.push_back(image("one-voxel-islands", {40, 40, 40}, unit, speckle(3, .002, 2)));
  images.push_back(image("labels-65535", {41, 40, 40}, unit, [](int i, int j, int k) {
    const int voxel = (k * 40 + j) * 41 + i;
    return voxel < 65535 ? voxel + 1 : 0;
  }));
  // With the defaults the mesh and the metrics take over half a minute each (and 1 GB): every voxel is a
  // label of its own.
  images.back().mesh_options = {"--fidelity", "0.2", "--max-distance", "0"};
  images.push_back(refused(image("labels-65537", {41, 41, 41}, unit, [](int i, int j, int k) {
    const int voxel = (k * 41 + j) * 41 + i;
    return voxel < 65537 ? voxel + 1 : 0;
  })));
  images.push_back(image("negative-labels", kBall, unit, ball(-5, -70000)));
  images.push_back(image("label-gaps", kBall, unit, ball(3, 2147483647)));
  images.push_back(image("spacing-thousandth", kBall, straight_axes(1e-3), ball(1, 2)));
  images.push_back(image("spacing-thousand", kBall, straight_axes(1e3), ball(1, 2)));
  images.push_back(image("spacing-uneven", kBall, "(0.001,0,0) (0,1,0) (0,0,1)", ball(1, 2)));
  images.push_back(image("left-handed", kBall, "(-1,0,0) (0,1,0) (0,0,1)", ball(1, 2)));
  images.push_back(refused(image("sheared", kBall, "(1,0,0) (0.5,1,0) (0,0,1)", ball(1, 2))));
  images.push_back(refused(image("flat-axes", kBall, "(1,0,0) (1,0,0) (0,0,1)", ball(1, 2))));
  images.push_back(refused(image("no-foreground", kBall, unit, [](int, int, int) { return 0; })));
  images.push_back({"four-axes", ".nii", true, write_four_axes});
  images.push_back({"truncated", ".nrrd", false, write_truncated});
  images.push_back({"empty-promise", ".nrrd", false, write_empty_promise});
  images.push_back({"not-an-image", ".nrrd", false, [](const fs::path& file) { write_file(file, "hello"); }});
  images.push_back({"empty-file", ".nii.gz", false, [](const fs::path& file) { write_file(file, ""); }});
  return images;
}

}  // namespace

std::span<const AdversarialImage> adversarial_images() {
  static const std::vector<AdversarialImage> images = all_images();
  return images;
}

}  // namespace cbc3d::cases
