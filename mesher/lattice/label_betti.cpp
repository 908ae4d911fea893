#include "mesher/lattice/label_betti.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "mesher/core/disjoint_sets.hpp"

namespace cbc3d {
namespace {

/// The facets of all labels' surfaces, each with the same number of corners.
template <std::size_t kCorners>
class LabelSurfaces {
 public:
  /// `volume`: six times that of the cone over the facet from any one place, positive where the label is
  /// within; its scale does not matter.
  void add(Label label, const std::array<std::size_t, kCorners>& corners, double volume) {
    facets_.push_back({label, corners, volume});
  }

  /// Adds the facets of another after those that are there.
  void add(const LabelSurfaces& other) {
    facets_.insert(facets_.end(), other.facets_.begin(), other.facets_.end());
  }

  [[nodiscard]] std::map<Label, Betti> betti() const {
    const std::vector<Corner> corners = distinct_corners();
    const std::vector<Numbers> numbers = numbers_in(corners);
    DisjointSets sets(corners.size());
    for (const Numbers& of_facet : numbers) {
      for (std::size_t c = 1; c < kCorners; ++c) {
        sets.join(of_facet[0], of_facet[c]);
      }
    }
    std::vector<double> volume(corners.size(), 0);
    std::map<Label, std::ptrdiff_t> facets;
    for (std::size_t f = 0; f < facets_.size(); ++f) {
      volume[sets.root(numbers[f][0])] += facets_[f].volume;
      ++facets[facets_[f].label];
    }
    std::map<Label, Betti> result;
    // Of the surface: corners less edges, each of two facets, plus facets.
    std::map<Label, std::ptrdiff_t> euler;
    for (const auto& [label, count] : facets) {
      euler[label] = count - count * static_cast<std::ptrdiff_t>(kCorners) / 2;
    }
    for (std::uint32_t n = 0; n < corners.size(); ++n) {
      ++euler[corners[n].first];
      if (sets.root(n) == n) {
        Betti& betti = result[corners[n].first];
        ++(volume[n] > 0 ? betti.parts : betti.cavities);
      }
    }
    for (auto& [label, betti] : result) {
      betti.tunnels = betti.parts + betti.cavities - euler[label] / 2;
    }
    return result;
  }

 private:
  struct Facet {
    Label label;
    std::array<std::size_t, kCorners> corners;
    double volume;
  };
  using Corner = std::pair<Label, std::size_t>;
  using Numbers = std::array<std::uint32_t, kCorners>;

  [[nodiscard]] std::vector<Corner> distinct_corners() const {
    std::vector<Corner> corners;
    corners.reserve(facets_.size() * kCorners);
    for (const Facet& facet : facets_) {
      for (const std::size_t corner : facet.corners) {
        corners.emplace_back(facet.label, corner);
      }
    }
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    return corners;
  }

  /// Of each facet's corners, their places among the distinct ones.
  [[nodiscard]] std::vector<Numbers> numbers_in(const std::vector<Corner>& corners) const {
    std::vector<Numbers> numbers(facets_.size());
#pragma omp parallel for schedule(static)
    for (std::size_t f = 0; f < facets_.size(); ++f) {
      for (std::size_t c = 0; c < kCorners; ++c) {
        const Corner corner = {facets_[f].label, facets_[f].corners[c]};
        numbers[f][c] = static_cast<std::uint32_t>(std::lower_bound(corners.begin(), corners.end(), corner) -
                                                   corners.begin());
      }
    }
    return numbers;
  }

  std::vector<Facet> facets_;
};

/// The four corners of a voxel's side, of the grid of corners, which has one more along each axis.
std::array<std::size_t, 4> side_corners(const ImageFrame& frame, const Index3& at, std::size_t axis,
                                        int step) {
  std::array<std::size_t, 4> corners{};
  for (std::size_t c = 0; c < 4; ++c) {
    Index3 corner = at;
    corner[axis] += step > 0 ? 1 : 0;
    corner[(axis + 1) % 3] += static_cast<int>(c & 1U);
    corner[(axis + 2) % 3] += static_cast<int>(c >> 1U);
    const auto x = static_cast<std::size_t>(corner[0]);
    const auto y = static_cast<std::size_t>(corner[1]);
    const auto z = static_cast<std::size_t>(corner[2]);
    corners[c] = (z * (static_cast<std::size_t>(frame.size[1]) + 1) + y) *
                     (static_cast<std::size_t>(frame.size[0]) + 1) +
                 x;
  }
  return corners;
}

/// Adds the sides of a labelled voxel that its label ends at.
void add_sides(const LabelImage& image, const std::vector<Label>& labels, const Index3& at,
               LabelSurfaces<4>& surfaces) {
  const Label label = labels[image.at(at[0], at[1], at[2])];
  for (std::size_t axis = 0; axis < 3 && label != 0; ++axis) {
    for (const int step : {-1, 1}) {
      Index3 next = at;
      next[axis] += step;
      if (labels[image.at_or_background(next[0], next[1], next[2])] != label) {
        // The cone from the corner of the image: its height is the side's place along the axis.
        surfaces.add(label, side_corners(image.frame, at, axis, step), step > 0 ? at[axis] + 1 : -at[axis]);
      }
    }
  }
}

/// By the labels that `labels` gives to the materials.
std::map<Label, Betti> betti_of(const LabelImage& image, const std::vector<Label>& labels) {
  const Index3& size = image.frame.size;
  std::vector<LabelSurfaces<4>> of_slice(static_cast<std::size_t>(size[2]));
#pragma omp parallel for schedule(dynamic)
  for (int k = 0; k < size[2]; ++k) {
    for (int j = 0; j < size[1]; ++j) {
      for (int i = 0; i < size[0]; ++i) {
        if (is_boundary_voxel(image, i, j, k)) {
          add_sides(image, labels, {i, j, k}, of_slice[static_cast<std::size_t>(k)]);
        }
      }
    }
  }
  LabelSurfaces<4> surfaces;
  for (const LabelSurfaces<4>& slice : of_slice) {
    surfaces.add(slice);
  }
  return surfaces.betti();
}

/// Labels that tell every material from the others, with background as it is.
std::vector<Label> numbers_of(std::size_t materials) {
  std::vector<Label> numbers(materials);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

bool are_distinct(std::vector<Label> labels) {
  std::sort(labels.begin(), labels.end());
  return std::adjacent_find(labels.begin(), labels.end()) == labels.end();
}

}  // namespace

std::map<Label, Betti> betti_of_labels(const LabelImage& image) {
  return betti_of(image, image.labels);
}

std::map<Label, Betti> betti_of_labels(const CandidateMesh& mesh, const std::vector<Vec3>& points,
                                       const std::vector<Label>& labels) {
  LabelSurfaces<3> surfaces;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const Label label = labels[mesh.materials[t]];
    for (std::size_t n = 0; n < 4 && label != 0; ++n) {
      const TetId across = mesh.neighbours[t][n];
      if (across == kNoTet || labels[mesh.materials[across]] != label) {
        const auto& nodes = mesh.tets.nodes[t];
        const std::array<std::size_t, 3> corners = {nodes[kTetFace[n][0]], nodes[kTetFace[n][1]],
                                                    nodes[kTetFace[n][2]]};
        surfaces.add(label, corners, points[corners[0]].dot(points[corners[1]].cross(points[corners[2]])));
      }
    }
  }
  return surfaces.betti();
}

std::vector<LabelDifference> label_differences(const std::map<Label, Betti>& in_image,
                                               const std::map<Label, Betti>& in_mesh) {
  std::map<Label, LabelDifference> both;
  for (const auto& [label, betti] : in_image) {
    both[label].in_image = betti;
  }
  for (const auto& [label, betti] : in_mesh) {
    both[label].in_mesh = betti;
  }
  std::vector<LabelDifference> differences;
  for (auto& [label, difference] : both) {
    if (difference.in_image != difference.in_mesh) {
      difference.label = label;
      differences.push_back(difference);
    }
  }
  return differences;
}

std::vector<Label> labels_of(const std::vector<LabelDifference>& differences) {
  std::vector<Label> labels;
  labels.reserve(differences.size());
  for (const LabelDifference& difference : differences) {
    labels.push_back(difference.label);
  }
  return labels;
}

ImageBetti::ImageBetti(const LabelImage& image)
    : labels_(image.labels), of_labels_(betti_of_labels(image)), has_regions_(!are_distinct(labels_)) {
  if (has_regions_) {
    of_materials_ = betti_of(image, numbers_of(labels_.size()));
  }
}

std::vector<Label> ImageBetti::unlike_labels(const CandidateMesh& mesh,
                                             const std::vector<Vec3>& points) const {
  std::vector<Label> unlike =
      labels_of(label_differences(of_labels_, betti_of_labels(mesh, points, labels_)));
  if (!has_regions_) {
    return unlike;
  }
  const auto of_materials = betti_of_labels(mesh, points, numbers_of(labels_.size()));
  for (const Label material : labels_of(label_differences(of_materials_, of_materials))) {
    unlike.push_back(labels_[static_cast<std::size_t>(material)]);
  }
  std::sort(unlike.begin(), unlike.end());
  unlike.erase(std::unique(unlike.begin(), unlike.end()), unlike.end());
  return unlike;
}

}  // namespace cbc3d
