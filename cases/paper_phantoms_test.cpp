// The phantoms of the paper's cases: the same voxels everywhere, what touches what, and the true shape
// against the voxels.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "cases/manifest.hpp"
#include "cases/phantoms/random.hpp"
#include "cases/phantoms/registry.hpp"
#include "mesher/core/error.hpp"
#include "mesher/core/image_io.hpp"
#include "mesher/core/runtime.hpp"
#include "mesher/testing/temporary_folder.hpp"

namespace cbc3d::cases {
namespace {

using cbc3d::testing::TemporaryFolder;

Phantom quarter(const std::string& name) {
  for (const Case& one : load_cases(CBC3D_MANIFESTS)) {
    if (one.name == name + "-quarter") {
      return one.phantom.value();
    }
  }
  throw InputError("no case " + name + "-quarter");
}

class PaperPhantom : public ::testing::TestWithParam<std::string> {};

TEST_P(PaperPhantom, HasItsManifestsVoxelsAtAnyThreadCountAndInSlabs) {
  const TemporaryFolder folder("paper");
  const Phantom phantom = quarter(GetParam());
  ASSERT_EQ(phantom.sha256.size(), 64U);
  set_thread_count(1);
  EXPECT_EQ(write_phantom(phantom, folder.path() / "streamed.nrrd", 1000), phantom.sha256);
  set_thread_count(2);
  EXPECT_EQ(write_phantom(phantom, folder.path() / "whole.nrrd"), phantom.sha256);
  set_thread_count(0);
  const LabelImage streamed = read_label_image(folder.path() / "streamed.nrrd");
  const LabelImage whole = read_label_image(folder.path() / "whole.nrrd");
  EXPECT_EQ(streamed.voxels, whole.voxels);
  EXPECT_EQ(streamed.frame.spacing_mm, whole.frame.spacing_mm);
  EXPECT_EQ(streamed.frame.direction, whole.frame.direction);
  EXPECT_THROW(write_phantom(phantom, folder.path() / "streamed.nii.gz", 1000), InputError);
}

// Labels whose shape is known have, at every voxel centre, the sign that the voxel has; and from place to
// place the distance changes by no more than the way between them.
TEST_P(PaperPhantom, TrueDistanceAgreesWithTheVoxels) {
  const Phantom phantom = quarter(GetParam());
  const LabelImage image = make_phantom(phantom);
  const SignedDistance distance = phantom_signed_distance(phantom);
  constexpr std::size_t kSamples = 20000;
  int known = 0;
  for (std::size_t material = 1; material < image.labels.size(); ++material) {
    const Label label = image.labels[material];
    if (std::isnan(distance({0, 0, 0}, label))) {
      continue;
    }
    ++known;
    std::size_t inside = 0;
    for (std::size_t sample = 0; sample < kSamples; ++sample) {
      const auto voxel = static_cast<std::size_t>(uniform_at(material, sample) *
                                                  static_cast<double>(image.frame.voxel_count()));
      Index3 at = image.frame.index_of(voxel);
      at[2] = phantom.size[2] / 2 - 12 + at[2] % 24;  // where all labels are
      const Vec3 centre = image.frame.local_centre(at[0], at[1], at[2]);
      const double d = distance(centre, label);
      ASSERT_EQ(d <= 0, image.at(at[0], at[1], at[2]) == material) << at[0] << ' ' << at[1] << ' ' << at[2];
      inside += d <= 0 ? 1 : 0;
      const Vec3 step = image.frame.spacing_mm.x * Vec3{1, 0, 0};
      ASSERT_LE(std::abs(distance(centre + step, label) - d), step.norm() * (1 + 1e-9));
    }
    EXPECT_GT(inside, 0U) << label;
  }
  EXPECT_EQ(known, static_cast<int>(image.labels.size()) - (GetParam().starts_with("brain") ? 2 : 1));
}

INSTANTIATE_TEST_SUITE_P(All, PaperPhantom,
                         ::testing::Values("aneurysm", "brain-tumor", "brain-avm", "lumen-stent"));

/// Pairs of labels (0: background) that share a voxel face, the lesser first.
std::set<std::pair<Label, Label>> contacts_of(const LabelImage& image) {
  std::set<std::pair<Label, Label>> contacts;
  for (int k = 1; k < image.frame.size[2]; ++k) {
    for (int j = 1; j < image.frame.size[1]; ++j) {
      for (int i = 1; i < image.frame.size[0]; ++i) {
        const Label a = image.labels[image.at(i, j, k)];
        for (const MaterialId m : {image.at(i - 1, j, k), image.at(i, j - 1, k), image.at(i, j, k - 1)}) {
          const Label b = image.labels[m];
          if (a != b) {
            contacts.emplace(std::min(a, b), std::max(a, b));
          }
        }
      }
    }
  }
  return contacts;
}

TEST(PaperPhantoms, TumourTouchesVentriclesAndSurface) {
  const auto contacts = contacts_of(make_phantom(quarter("brain-tumor")));
  EXPECT_TRUE(contacts.contains({1, 2}));
  EXPECT_TRUE(contacts.contains({1, 3}));
  EXPECT_TRUE(contacts.contains({2, 3}));
  EXPECT_TRUE(contacts.contains({0, 3}));
}

TEST(PaperPhantoms, ArteryAndVeinReachTheNidus) {
  const auto contacts = contacts_of(make_phantom(quarter("brain-avm")));
  EXPECT_TRUE(contacts.contains({2, 4}));
  EXPECT_TRUE(contacts.contains({3, 4}));
  EXPECT_TRUE(contacts.contains({1, 4}));
  EXPECT_TRUE(contacts.contains({0, 3}));  // the vein runs along the surface
}

TEST(PaperPhantoms, StentLiesWithinTheLumen) {
  const LabelImage image = make_phantom(quarter("lumen-stent"));
  const auto voxels = image.voxels_per_material();
  EXPECT_GT(voxels[2], 1000U);
  EXPECT_GT(voxels[1], 10 * voxels[2]);
  EXPECT_TRUE(contacts_of(image).contains({1, 2}));
}

TEST(PaperPhantoms, CoarserImagesShowTheSameShape) {
  for (const char* name : {"brain-tumor", "lumen-stent"}) {
    Phantom coarse = quarter(name);
    Phantom finer = coarse;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      finer.size[axis] = coarse.size[axis] * 3 / 2;
    }
    finer.spacing_mm = coarse.spacing_mm * (2.0 / 3.0);
    const double ratio = static_cast<double>(make_phantom(finer).voxels_per_material()[1]) /
                         static_cast<double>(make_phantom(coarse).voxels_per_material()[1]);
    EXPECT_NEAR(ratio, 27.0 / 8, .15) << name;
  }
}

}  // namespace
}  // namespace cbc3d::cases
