// The bytes are read again here as the format says; view/decode_mesh_test.js reads the same example.
#include "reports/viewer/mesh_payload.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "mesher/core/testing_mesh.hpp"

namespace cbc3d::reports {
namespace {

std::string inflated(const std::string& packed, std::size_t bytes) {
  std::string text(bytes, '\0');
  uLongf size = bytes;
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(text.data()), &size,
                       reinterpret_cast<const Bytef*>(packed.data()), packed.size()),
            Z_OK);
  EXPECT_EQ(size, bytes) << "the size follows from the counts";
  return text;
}

/// Reads numbers in planes, as view/decode_mesh.js does.
class Reader {
 public:
  explicit Reader(std::string bytes) : bytes_(std::move(bytes)) {}
  std::vector<std::uint32_t> read(std::size_t count, unsigned planes) {
    std::vector<std::uint32_t> numbers(count, 0);
    for (unsigned plane = 0; plane < planes; ++plane) {
      for (std::uint32_t& number : numbers) {
        number |= std::uint32_t{static_cast<std::uint8_t>(bytes_[at_++])} << 8 * plane;
      }
    }
    return numbers;
  }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

TEST(MeshPayload, HoldsEveryTetWithItsPlacesLabelAndQuality) {
  const ShownMesh mesh = shown_mesh(cbc3d::testing::one_of_each(), 1000, 2);
  const MeshPayload payload = mesh_payload(mesh);
  const std::size_t n = payload.header["vertices"], m = payload.header["tets"];
  EXPECT_EQ(n, 13U);
  EXPECT_EQ(m, 12U);
  EXPECT_EQ(payload.header["worst"].size(), 2U);
  Reader reader(inflated(payload.bytes, 6 * n + 17 * m));
  std::vector<Vec3> points(n);
  for (int axis = 0; axis < 3; ++axis) {
    std::uint32_t place = 0;
    const auto steps = reader.read(n, 2);
    for (std::size_t v = 0; v < n; ++v) {
      place = (place + steps[v]) & 0xFFFFU;
      points[v][axis] = payload.header["origin"][static_cast<std::size_t>(axis)].get<double>() +
                        place * payload.header["step"][static_cast<std::size_t>(axis)].get<double>();
    }
  }
  std::array<std::vector<std::uint32_t>, 4> codes;
  for (auto& one : codes) {
    one = reader.read(m, 3);
  }
  const auto labels = reader.read(m, 2), angles = reader.read(m, 1), ratios = reader.read(m, 1);
  std::uint32_t used = 0, label = 0;
  std::multiset<std::string> found, expected;
  const auto text = [](std::array<Vec3, 4> p, std::uint32_t of, double angle, double ratio) {
    std::sort(p.begin(), p.end(), [](const Vec3& a, const Vec3& b) {
      return std::array{std::round(a.x * 100), std::round(a.y * 100), std::round(a.z * 100)} <
             std::array{std::round(b.x * 100), std::round(b.y * 100), std::round(b.z * 100)};
    });
    std::string line = std::to_string(of) + " " + std::to_string(std::lround(angle * 3.5)) + " " +
                       std::to_string(std::lround(ratio * 250));
    for (const Vec3& one : p) {
      for (int axis = 0; axis < 3; ++axis) {
        line += " " + std::to_string(std::lround(one[axis] * 100));
      }
    }
    return line;
  };
  for (std::size_t t = 0; t < m; ++t) {
    std::array<std::uint32_t, 4> tet{used + 3 - codes[0][t]};
    for (std::size_t k = 1; k < 4; ++k) {
      tet[k] = tet[k - 1] - codes[k][t];
    }
    used = std::max(used, tet[0] + 1);
    label = (label + labels[t]) & 0xFFFFU;
    for (const std::uint32_t corner : tet) {
      ASSERT_LT(corner, n);
    }
    found.insert(text({points[tet[0]], points[tet[1]], points[tet[2]], points[tet[3]]}, label,
                      angles[t] / 3.5, ratios[t] / 250.0));
    const auto& own = mesh.tets[t];
    expected.insert(text({mesh.points[own[0]], mesh.points[own[1]], mesh.points[own[2]], mesh.points[own[3]]},
                         mesh.label_index[t], static_cast<double>(mesh.min_dihedral_deg[t]),
                         std::max(0.0, static_cast<double>(mesh.mean_ratio[t]))));
  }
  EXPECT_EQ(found, expected);
}

TEST(MeshPayload, AMeshInAPlaneHasPlacesToo) {
  ShownMesh mesh;
  mesh.points = {{0, 0, 5}, {1, 0, 5}, {0, 1, 5}, {1, 1, 5}};
  mesh.tets = {{0, 1, 2, 3}};
  mesh.label_index = {0};
  mesh.min_dihedral_deg = {0};
  mesh.mean_ratio = {0};
  mesh.boundary = {15};
  mesh.labels = {1};
  EXPECT_EQ(mesh_payload(mesh).header["step"][2], 1.0);
}

}  // namespace
}  // namespace cbc3d::reports
