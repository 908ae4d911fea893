// The cleaning as a whole.
#include <gtest/gtest.h>
#include <omp.h>

#include "mesher/preprocess/clean_image.hpp"
#include "mesher/preprocess/testing_contacts.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d {
namespace {

using testing::contacts_by_definition;

TEST(CleanImage, SameAtOneAndTwoThreads) {
  LabelImage one = testing::noise_image(40, 0.5, 9);
  LabelImage two = one;
  CleanOptions options;
  options.relabel_noise = NoisyVoxels::both;
  omp_set_num_threads(1);
  clean_image(one, options, true);
  omp_set_num_threads(2);
  clean_image(two, options, true);
  EXPECT_EQ(one.voxels, two.voxels);
  EXPECT_EQ(one.labels, two.labels);
}

TEST(CleanImage, RegionsOfTheCleanImageTouchByFacesOrNotAtAll) {
  LabelImage image = testing::noise_image(30, 0.25, 3);
  CleanOptions options;
  options.region_tolerance = 0;
  clean_image(image, options, true);
  for (std::size_t v = 0; v < image.voxels.size(); ++v) {  // back to one material a label
    image.voxels.set(v, static_cast<MaterialId>(image.labels[image.voxels[v]]));
  }
  EXPECT_EQ(contacts_by_definition(image), 0U);
}

}  // namespace
}  // namespace cbc3d
