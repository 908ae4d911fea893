#include "mesher/core/voxel_rows.hpp"

#include <array>

namespace cbc3d {
namespace {

/// A row of voxels and the four rows that share a face with it.
template <typename Voxel>
struct RowsAround {
  const Voxel* row;
  std::array<const Voxel*, 4> around;

  /// Whether a voxel differs from one of its neighbours; `left` and `right` are those along the row.
  [[nodiscard]] bool is_boundary(int i, Voxel left, Voxel right) const {
    const Voxel own = row[i];
    return own != kBackground && (left != own || right != own || around[0][i] != own || around[1][i] != own ||
                                  around[2][i] != own || around[3][i] != own);
  }

  /// False when no voxel of the word at i differs from any of its neighbours.
  [[nodiscard]] bool any_differs(int i) const {
    const std::uint64_t own = voxel_word(row + i);
    const std::uint64_t differ = (own ^ voxel_word(row + i - 1)) | (own ^ voxel_word(row + i + 1)) |
                                 (own ^ voxel_word(around[0] + i)) | (own ^ voxel_word(around[1] + i)) |
                                 (own ^ voxel_word(around[2] + i)) | (own ^ voxel_word(around[3] + i));
    return differ != 0;
  }
};

template <typename Voxel>
void find_in_row(const RowsAround<Voxel>& rows, int size, std::vector<int>& found) {
  constexpr int kStep = kVoxelsInWord<Voxel>;
  for (int i = 0; i < size;) {
    if (i > 0 && i + kStep < size && !rows.any_differs(i)) {
      i += kStep;
      continue;
    }
    const int end = i > 0 && i + kStep < size ? i + kStep : i + 1;
    for (; i < end; ++i) {
      const Voxel left = i > 0 ? rows.row[i - 1] : Voxel{kBackground};
      const Voxel right = i + 1 < size ? rows.row[i + 1] : Voxel{kBackground};
      if (rows.is_boundary(i, left, right)) {
        found.push_back(i);
      }
    }
  }
}

}  // namespace

BoundaryRows::BoundaryRows(const LabelImage& image)
    : image_(image), none_(static_cast<std::size_t>(image.frame.size[0]), kBackground) {}

void BoundaryRows::find(int j, int k, std::vector<int>& found) const {
  const ImageFrame& frame = image_.frame;
  image_.voxels.visit([&]<typename Voxel>(const Voxel* voxels) {
    // A row of wide zeros serves as one of narrow zeros.
    const auto* none = reinterpret_cast<const Voxel*>(none_.data());
    const auto row = [&](int at_j, int at_k) {
      return frame.contains(0, at_j, at_k) ? voxels + frame.offset(0, at_j, at_k) : none;
    };
    find_in_row<Voxel>({row(j, k), {row(j - 1, k), row(j + 1, k), row(j, k - 1), row(j, k + 1)}},
                       frame.size[0], found);
  });
}

}  // namespace cbc3d
