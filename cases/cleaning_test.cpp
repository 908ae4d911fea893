// The mesher's cleaning on a phantom of the size of the paper's first case.
#include <gtest/gtest.h>

#include "cases/phantoms/registry.hpp"
#include "mesher/preprocess/clean_image.hpp"

namespace cbc3d::cases {
namespace {

/// Contacts of label 1, by looking at all 2x2x2 cells; shares no code with the cleaning. A cell's eight
/// voxels are the bits of a byte; the byte says whether two of them touch only by an edge or a vertex.
bool has_contact(unsigned cell) {
  for (unsigned a = 0; a < 8; ++a) {
    for (unsigned b = a + 1; b < 8; ++b) {
      const unsigned apart = a ^ b;  // the axes along which the two differ
      if ((cell >> a & 1U) == 0 || (cell >> b & 1U) == 0 || __builtin_popcount(apart) < 2) {
        continue;
      }
      unsigned others = 0;  // labelled voxels in the block between the two
      for (unsigned c = 0; c < 8; ++c) {
        others += c != a && c != b && ((c ^ a) & ~apart) == 0 ? cell >> c & 1U : 0;
      }
      if (others == 0) {
        return true;
      }
    }
  }
  return false;
}

std::size_t cells_with_contact(const LabelImage& image) {
  std::array<bool, 256> bad{};
  for (unsigned cell = 0; cell < 256; ++cell) {
    bad[cell] = has_contact(cell);
  }
  const auto& size = image.frame.size;
  std::size_t count = 0;
#pragma omp parallel for reduction(+ : count)
  for (int k = 0; k < size[2] - 1; ++k) {
    for (int j = 0; j < size[1] - 1; ++j) {
      for (int i = 0; i < size[0] - 1; ++i) {
        unsigned cell = 0;
        for (unsigned c = 0; c < 8; ++c) {
          cell |= image.at(i + static_cast<int>(c & 1U), j + static_cast<int>(c >> 1U & 1U),
                           k + static_cast<int>(c >> 2U)) == 1
                      ? 1U << c
                      : 0U;
        }
        count += bad[cell] ? 1 : 0;
      }
    }
  }
  return count;
}

TEST(Cleaning, SpeckledVesselsAtFullSizeEndWithoutContact) {
  LabelImage image = make_phantom({"vessels-noisy", {512, 512, 508}, {1, 1, 1}, 3, ""});
  ASSERT_GT(cells_with_contact(image), 1000U);
  CleanOptions options;
  options.region_tolerance = 0;
  const CleanReport report = clean_image(image, options, false);
  EXPECT_EQ(cells_with_contact(image), 0U);
  EXPECT_GT(report.contacts.voxels_changed, 1000U);
}

}  // namespace
}  // namespace cbc3d::cases
