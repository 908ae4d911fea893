#include "mesher/lattice/voxel_topology.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "mesher/domain/simple_point.hpp"

namespace cbc3d {
namespace {

/// The image on its way to the mesh's labels.
class Transition {
 public:
  Transition(const LabelImage& image, const std::vector<MisplacedPart>& misplaced,
             const std::vector<Label>& labels, int fewest)
      : image_(image),
        labels_(labels),
        parts_(voxel_parts(image.frame, fewest)),
        frame_(part_frame(image.frame, fewest)),
        misplaced_(misplaced),
        first_of_row_(static_cast<std::size_t>(frame_.size[1]) * static_cast<std::size_t>(frame_.size[2]) +
                      1),
        is_done_(misplaced.size(), 0) {
    std::size_t next = 0;
    for (std::size_t row = 0; row < first_of_row_.size(); ++row) {
      while (next < misplaced.size() && misplaced[next].offset < row * row_length()) {
        ++next;
      }
      first_of_row_[row] = next;
    }
  }

  /// Those of the misplaced that cannot change.
  std::vector<MisplacedPart> run() {
    std::vector<std::size_t> waiting(misplaced_.size());
    std::iota(waiting.begin(), waiting.end(), std::size_t{0});
    for (std::size_t before = waiting.size() + 1; waiting.size() < before;) {
      before = waiting.size();
      pass(waiting);
      std::reverse(waiting.begin(), waiting.end());  // a chain that goes the other way takes one pass too
    }
    std::vector<MisplacedPart> left;
    left.reserve(waiting.size());
    for (const std::size_t i : waiting) {
      left.push_back(misplaced_[i]);
    }
    return left;
  }

 private:
  /// Those of `waiting` that can change, do, one after the other.
  void pass(std::vector<std::size_t>& waiting) {
    std::size_t kept = 0;
    for (const std::size_t i : waiting) {
      if (can_change(i)) {
        is_done_[i] = 1;
      } else {
        waiting[kept++] = i;
      }
    }
    waiting.resize(kept);
  }

  [[nodiscard]] bool can_change(std::size_t i) const {
    const Index3 at = frame_.index_of(misplaced_[i].offset);
    std::array<Label, 27> label{};
    for (std::size_t n = 0; n < label.size(); ++n) {
      label[n] = label_now(voxel_neighbour(at, n));
    }
    const Label from = image_.labels[in_image(at)];
    const Label to = image_.labels[misplaced_[i].in_mesh];
    return from == to || (is_simple_for(label, from) && is_simple_for(label, to));
  }

  [[nodiscard]] bool is_simple_for(const std::array<Label, 27>& label, Label own) const {
    if (std::find(labels_.begin(), labels_.end(), own) == labels_.end()) {
      return true;
    }
    VoxelNeighbourhood around{};
    VoxelNeighbourhood others{};
    for (std::size_t n = 0; n < around.size(); ++n) {
      around[n] = label[n] == own;
      others[n] = label[n] != own;
    }
    return is_simple(around) && is_simple(others);
  }

  [[nodiscard]] Label label_now(const Index3& at) const {
    if (!frame_.contains(at[0], at[1], at[2])) {
      return 0;
    }
    const std::size_t offset = frame_.offset(at[0], at[1], at[2]);
    const std::size_t row = offset / row_length();
    const auto begin = misplaced_.begin() + static_cast<std::ptrdiff_t>(first_of_row_[row]);
    const auto end = misplaced_.begin() + static_cast<std::ptrdiff_t>(first_of_row_[row + 1]);
    const auto found = std::lower_bound(begin, end, offset,
                                        [](const MisplacedPart& p, std::size_t o) { return p.offset < o; });
    const bool is_changed = found != end && found->offset == offset &&
                            is_done_[static_cast<std::size_t>(found - misplaced_.begin())] != 0;
    return image_.labels[is_changed ? found->in_mesh : in_image(at)];
  }

  [[nodiscard]] std::size_t row_length() const { return static_cast<std::size_t>(frame_.size[0]); }

  [[nodiscard]] MaterialId in_image(const Index3& at) const {
    return image_.at(at[0] / parts_[0], at[1] / parts_[1], at[2] / parts_[2]);
  }

  const LabelImage& image_;
  const std::vector<Label>& labels_;
  const Index3 parts_;
  const ImageFrame frame_;  // of the parts
  const std::vector<MisplacedPart>& misplaced_;
  std::vector<std::size_t> first_of_row_;  // of the part frame, in misplaced_
  std::vector<std::uint8_t> is_done_;
};

}  // namespace

Index3 voxel_parts(const ImageFrame& image, int fewest) {
  constexpr int kLongest = 4;  // in shortest sides: the bound for needles and plates
  Index3 parts{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double length = image.spacing_mm[axis] / image.spacing_mm.min_coeff();
    parts[axis] = static_cast<int>(std::lround(fewest * std::min<double>(length, kLongest)));
  }
  return parts;
}

ImageFrame part_frame(const ImageFrame& image, int fewest) {
  const Index3 parts = voxel_parts(image, fewest);
  ImageFrame frame = image;
  Vec3 corner;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    frame.size[axis] *= parts[axis];
    frame.spacing_mm[axis] /= parts[axis];
    corner[axis] = (frame.spacing_mm[axis] - image.spacing_mm[axis]) / 2;
  }
  frame.origin_mm = image.to_physical(corner);
  return frame;
}

std::vector<std::size_t> find_topology_differences(const LabelImage& image,
                                                   const std::vector<MisplacedPart>& misplaced,
                                                   const std::vector<Label>& labels, int fewest) {
  return voxels_of_parts(image.frame, Transition(image, misplaced, labels, fewest).run(), fewest);
}

std::vector<std::size_t> voxels_of_parts(const ImageFrame& image, const std::vector<MisplacedPart>& parts,
                                         int fewest) {
  const Index3 cut = voxel_parts(image, fewest);
  const ImageFrame frame = part_frame(image, fewest);
  std::vector<std::size_t> voxels;
  for (const MisplacedPart& part : parts) {
    const Index3 at = frame.index_of(part.offset);
    voxels.push_back(image.offset(at[0] / cut[0], at[1] / cut[1], at[2] / cut[2]));
  }
  std::sort(voxels.begin(), voxels.end());
  voxels.erase(std::unique(voxels.begin(), voxels.end()), voxels.end());
  return voxels;
}

}  // namespace cbc3d
