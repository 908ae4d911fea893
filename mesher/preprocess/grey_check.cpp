#include "mesher/preprocess/grey_check.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

#include "mesher/preprocess/voxel_contacts.hpp"

namespace cbc3d {
namespace {

constexpr std::array<Index3, 3> kForward = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

/// Adds what voxel (i, j, k) is and what its faces towards larger indices are.
void add_voxel(const LabelImage& image, int i, int j, int k, LabelTexture& sum) {
  const MaterialId material = image.at(i, j, k);
  if (material == kBackground) {
    return;
  }
  bool alone = true;
  for (const Index3& step : kForward) {
    const MaterialId after = image.at_or_background(i + step[0], j + step[1], k + step[2]);
    alone = alone && after != material &&
            image.at_or_background(i - step[0], j - step[1], k - step[2]) != material;
    sum.faces += after != kBackground ? 1 : 0;
    sum.unlike_faces += after != kBackground && after != material ? 1 : 0;
  }
  ++sum.voxels;
  sum.single_voxels += alone ? 1 : 0;
}

double share(std::size_t part, std::size_t whole) {
  return whole > 0 ? static_cast<double>(part) / static_cast<double>(whole) : 0;
}

std::string noise_text(double figure, const char* what, double limit) {
  char text[200];
  std::snprintf(text, sizeof text,
                "it looks like noise: for every 100 labelled voxels there are %.0f %s (more than %.0f)",
                100 * figure, what, 100 * limit);
  return text;
}

/// Some slices tell whether voxels stand alone, so that large images cost no time.
std::string why_noise(const LabelImage& image) {
  constexpr int kSlices = 64;
  if (image.voxels.size() < std::min(kManySingleVoxels, kManyContacts)) {
    return "";
  }
  const int step = std::max(1, image.frame.size[2] / kSlices);
  const LabelTexture t = texture_of(image, step);
  const double single = share(t.single_voxels, t.voxels);
  if (single > kMostNoise && t.single_voxels * static_cast<std::size_t>(step) >= kManySingleVoxels) {
    return noise_text(single, "that stand alone", kMostNoise);
  }
  const std::size_t contacts = count_voxel_contacts(image).edge_contacts;
  const double crowded = share(contacts, t.voxels * static_cast<std::size_t>(step));
  return crowded > kMostContacts && contacts >= kManyContacts
             ? noise_text(crowded, "contacts of one label at an edge alone", kMostContacts)
             : "";
}

}  // namespace

LabelTexture texture_of(const LabelImage& image, int slice_step) {
  const auto& size = image.frame.size;
  std::size_t voxels = 0, singles = 0, faces = 0, unlike = 0;
#pragma omp parallel for schedule(static) reduction(+ : voxels, singles, faces, unlike)
  for (int k = 0; k < size[2]; k += slice_step) {
    LabelTexture slice;
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0]; ++i) {
        add_voxel(image, i, j, k, slice);
      }
    }
    voxels += slice.voxels;
    singles += slice.single_voxels;
    faces += slice.faces;
    unlike += slice.unlike_faces;
  }
  return {image.labels.size() - 1, voxels, singles, faces, unlike};
}

std::string why_grey(const LabelImage& image) {
  if (image.labels.size() <= kManyLabels + 1) {
    return why_noise(image);
  }
  const LabelTexture t = texture_of(image);
  const double single = share(t.single_voxels, t.voxels);
  const double unlike = share(t.unlike_faces, t.faces);
  if (single <= kMostSingleVoxels && unlike <= kMostUnlikeFaces) {
    return "";
  }
  char text[300];
  std::snprintf(text, sizeof text,
                "it looks like a grey image: %zu labels, %.0f %% of the labelled voxels stand alone (more "
                "than %.0f %%) "
                "or %.0f %% of neighbours differ (more than %.0f %%)",
                t.labels, 100 * single, 100 * kMostSingleVoxels, 100 * unlike, 100 * kMostUnlikeFaces);
  return text;
}

}  // namespace cbc3d
