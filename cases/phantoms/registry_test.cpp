#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cases/phantoms/generators.hpp"
#include "cases/phantoms/registry.hpp"
#include "cases/phantoms/shapes.hpp"
#include "mesher/core/error.hpp"
#include "mesher/core/runtime.hpp"

namespace cbc3d::cases {
namespace {

std::vector<double> volumes_mm3(const LabelImage& image) {
  const Vec3& s = image.frame.spacing_mm;
  std::vector<double> volumes;
  for (const std::size_t voxels : image.voxels_per_material()) {
    volumes.push_back(static_cast<double>(voxels) * s.x * s.y * s.z);
  }
  return volumes;
}

double ball(double radius) {
  return 4 * M_PI / 3 * radius * radius * radius;
}

TEST(Phantoms, OrgansHaveTheirVolumes) {
  const PhantomKind& kind = *find_phantom("organs");
  const OrgansShape shape = organs_shape(kind.size, kind.spacing_mm, 5);
  const auto volume = volumes_mm3(organs_phantom(kind.size, kind.spacing_mm, 5));
  const double body = 4 * M_PI / 3 * shape.body_radii.x * shape.body_radii.y * shape.body_radii.z;
  const double ring = 2 * M_PI * M_PI * shape.ring_radius * shape.tube_radius * shape.tube_radius;
  EXPECT_NEAR(volume[1] + volume[2] + volume[3] + volume[4], body, .005 * body);
  EXPECT_NEAR(volume[3], ring, .02 * ring);
  EXPECT_NEAR(volume[4], ball(shape.lesion_radius), .05 * ball(shape.lesion_radius));
  EXPECT_LT(volume[2], ball(shape.organ_radius) - volume[4]);
  EXPECT_GT(volume[2], .7 * ball(shape.organ_radius));
}

TEST(Phantoms, EveryPairOfOrgansThatShouldTouchDoes) {
  const PhantomKind& kind = *find_phantom("organs");
  const LabelImage image = organs_phantom(kind.size, kind.spacing_mm, 0);
  std::array<std::array<int, 5>, 5> contacts{};
  for (int k = 1; k < kind.size[2]; ++k) {
    for (int j = 1; j < kind.size[1]; ++j) {
      for (int i = 1; i < kind.size[0]; ++i) {
        const MaterialId a = image.at(i, j, k);
        for (const MaterialId b : {image.at(i - 1, j, k), image.at(i, j - 1, k), image.at(i, j, k - 1)}) {
          ++contacts[std::min(a, b)][std::max(a, b)];
        }
      }
    }
  }
  EXPECT_GT(contacts[0][1], 0);
  EXPECT_GT(contacts[1][2], 0);
  EXPECT_GT(contacts[1][3], 0);
  EXPECT_GT(contacts[2][3], 0);
  EXPECT_GT(contacts[2][4], 0);
  EXPECT_EQ(contacts[0][2] + contacts[0][3] + contacts[0][4] + contacts[1][4] + contacts[3][4], 0);
}

TEST(Phantoms, ShellsHaveTheirVolumes) {
  const PhantomKind& kind = *find_phantom("shells");
  const ShellsShape shape = shells_shape(kind.size, kind.spacing_mm, 9);
  const auto volume = volumes_mm3(shells_phantom(kind.size, kind.spacing_mm, 9));
  for (std::size_t s = 0; s < 4; ++s) {
    const double inner = s < 3 ? ball(shape.radii[s + 1]) : 0;
    const double expected = ball(shape.radii[s]) - inner;
    EXPECT_NEAR(volume[s + 1], expected, .03 * expected) << s;
  }
}

TEST(Phantoms, RingsHaveTheirVolumesAndAreClearOfEachOther) {
  const PhantomKind& kind = *find_phantom("rings");
  for (const std::uint64_t seed : {1, 2, 3}) {
    const std::array<Ring, 3> rings = rings_shape(kind.size, kind.spacing_mm, seed);
    const auto volume = volumes_mm3(rings_phantom(kind.size, kind.spacing_mm, seed));
    for (std::size_t r = 0; r < 3; ++r) {
      const double expected = 2 * M_PI * M_PI * rings[r].radius * rings[r].tube_radius * rings[r].tube_radius;
      EXPECT_NEAR(volume[r + 1], expected, .03 * expected) << r;
    }
    const SignedDistance distance = rings_distance(kind.size, kind.spacing_mm, seed);
    double nearest = 1e9;  // sum of the distances to two rings: the gap at least
    for (int voxel = 0; voxel < 80 * 80 * 80; ++voxel) {
      std::array<double, 3> d{};
      const int i = voxel % 80, j = voxel / 80 % 80, k = voxel / 6400;
      const Vec3 p{double(i), double(j), double(k)};
      for (int r = 0; r < 3; ++r) d[static_cast<std::size_t>(r)] = distance(p, r + 1);
      std::sort(d.begin(), d.end());
      nearest = std::min(nearest, d[0] + d[1]);
      if (p.min_coeff() == 0 || p.max_coeff() == 79) {
        EXPECT_GT(d[0], 1);
      }
    }
    EXPECT_GT(nearest, 2);
  }
}

TEST(Phantoms, TrueDistanceIsThatOfTheVoxelsAndOfTheFormula) {
  for (const char* name : {"shells", "rings"}) {
    const PhantomKind& kind = *find_phantom(name);
    const Phantom phantom{name, kind.size, kind.spacing_mm, 3, ""};
    const LabelImage image = make_phantom(phantom);
    const SignedDistance distance = phantom_signed_distance(phantom);
    EXPECT_TRUE(std::isnan(distance({0, 0, 0}, 0)));
    EXPECT_TRUE(std::isnan(distance({0, 0, 0}, static_cast<Label>(image.labels.size()))));
    for (std::size_t v = 0; v < image.voxels.size(); v += 7) {
      const Index3 at = image.frame.index_of(v);
      const Vec3 p = image.frame.local_centre(at[0], at[1], at[2]);
      for (std::size_t m = 1; m < image.labels.size(); ++m) {
        const double d = distance(p, image.labels[m]);
        ASSERT_EQ(d <= 0, image.voxels[v] == m) << name << ' ' << v;
        ASSERT_LE(std::abs(distance(p + Vec3{0, 1, 0}, image.labels[m]) - d), 1 + 1e-9);
      }
    }
  }
  const PhantomKind& kind = *find_phantom("shells");
  const ShellsShape shape = shells_shape(kind.size, kind.spacing_mm, 3);
  const SignedDistance distance = shells_distance(kind.size, kind.spacing_mm, 3);
  const auto at = [&](double radius, Label label) {
    return distance(shape.centre + radius * Vec3{.6, 0, -.8}, label);
  };
  EXPECT_NEAR(at(shape.radii[1] + 1, 1), -1, 1e-12);  // just outside the inner of its two spheres
  EXPECT_NEAR(at(shape.radii[1] - 1, 1), 1, 1e-12);
  EXPECT_NEAR(at(shape.radii[0] + 2, 1), 2, 1e-12);
  EXPECT_NEAR(at(0, 4), -shape.radii[3], 1e-12);
}

TEST(Phantoms, VesselsAreThinAndWithinTheImage) {
  const PhantomKind& kind = *find_phantom("vessels");
  const LabelImage image = vessels_phantom(kind.size, kind.spacing_mm, 1);
  const double share =
      static_cast<double>(image.voxels_per_material()[1]) / static_cast<double>(image.voxels.size());
  EXPECT_GT(share, .003);
  EXPECT_LT(share, .1);
  for (int j = 0; j < kind.size[1]; ++j) {
    for (int i = 0; i < kind.size[0]; ++i) {
      EXPECT_EQ(image.at(i, j, 0), kBackground);
    }
  }
}

TEST(Phantoms, NoiseIsAsMuchAsItSays) {
  const PhantomKind& kind = *find_phantom("vessels-noisy");
  const LabelImage clean = vessels_phantom(kind.size, kind.spacing_mm, 1);
  const LabelImage noisy = noisy_vessels_phantom(kind.size, kind.spacing_mm, 1);
  std::size_t specks = 0, holes = 0;
  for (std::size_t v = 0; v < clean.voxels.size(); ++v) {
    specks += noisy.voxels[v] > clean.voxels[v] ? 1 : 0;
    holes += noisy.voxels[v] < clean.voxels[v] ? 1 : 0;
  }
  EXPECT_NEAR(static_cast<double>(specks + holes) / static_cast<double>(clean.voxels.size()), .002, .0002);
  EXPECT_GT(holes, 0U);
}

class EveryPhantom : public testing::TestWithParam<std::string> {};

TEST_P(EveryPhantom, DependsOnItsArgumentsAlone) {
  const Phantom phantom{GetParam(), {40, 36, 30}, {1, 1.25, 1.5}, 77, ""};
  set_thread_count(1);
  const LabelImage one = make_phantom(phantom);
  set_thread_count(2);
  const LabelImage two = make_phantom(phantom);
  set_thread_count(0);
  EXPECT_EQ(one.voxels, two.voxels);
  EXPECT_EQ(one.labels, two.labels);
  if (phantom.name != "assorted") {  // which draws them, see assorted_test.cpp
    EXPECT_EQ(one.frame.size, phantom.size);
    EXPECT_EQ(one.frame.spacing_mm, phantom.spacing_mm);
  }
  for (const std::size_t voxels : one.voxels_per_material()) {
    EXPECT_GT(voxels, 0U);
  }
  Phantom other = phantom;
  other.seed = 78;
  EXPECT_NE(make_phantom(other).voxels, one.voxels);
}

std::vector<std::string> all_names() {
  std::vector<std::string> names;
  for (const PhantomKind& kind : phantom_kinds()) {
    names.emplace_back(kind.name);
  }
  return names;
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryPhantom, testing::ValuesIn(all_names()));

TEST(Phantoms, ImpossibleOnesAreRefused) {
  EXPECT_THROW(make_phantom({"ghost", {40, 36, 30}, {1, 1, 1}, 0, ""}), InputError);
  EXPECT_THROW(make_phantom({"organs", {40, 36, 3}, {1, 1, 1}, 0, ""}), InputError);
  EXPECT_THROW(make_phantom({"organs", {40, 36, 30}, {1, 0, 1}, 0, ""}), InputError);
}

}  // namespace
}  // namespace cbc3d::cases
