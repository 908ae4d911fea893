#include "baselines/ld/label_octree.hpp"

#include <gtest/gtest.h>
#include <omp.h>

#include <cstdlib>

#include "mesher/domain/testing_random_image.hpp"

namespace cbc3d::baselines::ld {
namespace {

using testing::make_image;

// A ball in a corner and one voxel far from it.
LabelImage graded_image() {
  return make_image({40, 36, 33}, {1, 1, 1}, 2, [](const Vec3& p) {
    return p.norm() < 14.3 ? 1 : (p - Vec3{37, 30, 20}).norm() < 0.5 ? 2 : 0;
  });
}

std::vector<Leaf> leaves_of(const CellGrid& grid, const LabelOctree& octree) {
  std::vector<Leaf> leaves;
  for (int k = 0; k < grid.size()[2] / grid.block(); ++k) {
    for (int j = 0; j < grid.size()[1] / grid.block(); ++j) {
      for (int i = 0; i < grid.size()[0] / grid.block(); ++i) octree.append_leaves({i, j, k}, leaves);
    }
  }
  return leaves;
}

/// The level of the leaf that each cell is in, -1 where there is none; expects that no two share a cell.
class LevelMap {
 public:
  LevelMap(const CellGrid& grid, const std::vector<Leaf>& leaves) : size_(grid.size()) {
    levels_.assign(ImageFrame{.size = size_}.voxel_count(), -1);
    for (const Leaf& leaf : leaves) {
      const int side = 1 << leaf.level;
      for (int c = 0; c < side * side * side; ++c) {
        int& level = levels_[index(
            {leaf.low[0] + c % side, leaf.low[1] + c / side % side, leaf.low[2] + c / side / side})];
        EXPECT_EQ(level, -1);
        level = leaf.level;
        const MaterialId material =
            grid.at(leaf.low[0] + c % side, leaf.low[1] + c / side % side, leaf.low[2] + c / side / side);
        EXPECT_EQ(material, grid.at(leaf.low[0], leaf.low[1], leaf.low[2]));
      }
    }
  }
  [[nodiscard]] int at(const Index3& cell) const {
    for (std::size_t a = 0; a < 3; ++a) {
      if (cell[a] < 0 || cell[a] >= size_[a]) return -1;
    }
    return levels_[index(cell)];
  }
  [[nodiscard]] const Index3& size() const { return size_; }

 private:
  [[nodiscard]] std::size_t index(const Index3& c) const {
    return ImageFrame{.size = size_}.offset(c[0], c[1], c[2]);
  }
  Index3 size_;
  std::vector<int> levels_;
};

void expect_balanced(const LevelMap& levels) {
  for (int k = 0; k < levels.size()[2]; ++k) {
    for (int j = 0; j < levels.size()[1]; ++j) {
      for (int i = 0; i < levels.size()[0]; ++i) {
        const int own = levels.at({i, j, k});
        ASSERT_GE(own, 0);
        for (int step = 0; step < 27; ++step) {
          const Index3 d{step % 3 - 1, step / 3 % 3 - 1, step / 9 - 1};
          const int other = levels.at({i + d[0], j + d[1], k + d[2]});
          const bool is_corner = d[0] != 0 && d[1] != 0 && d[2] != 0;
          if (other >= 0 && !is_corner) {
            ASSERT_LE(std::abs(own - other), 1);
          }
        }
      }
    }
  }
}

TEST(LabelOctree, LeavesFillTheGridHaveOneMaterialEachAndAreBalanced) {
  for (const LabelImage& image : {graded_image(), testing::random_image({9, 8, 7}, {1, 1, 1}, 2, 5)}) {
    for (const int margin : {0, 2}) {
      const CellGrid grid(image, {.margin = margin, .block = 16});
      const LabelOctree octree(grid);
      EXPECT_EQ(octree.levels(), 4);
      expect_balanced(LevelMap(grid, leaves_of(grid, octree)));
    }
  }
}

TEST(LabelOctree, SplitsNoBoxWithoutNeed) {
  const LabelImage image = make_image({64, 64, 64}, {1, 1, 1}, 1, [](const Vec3&) { return 1; });
  const CellGrid grid(image, {.block = 32});
  EXPECT_EQ(leaves_of(grid, LabelOctree(grid)).size(), 8U);
  // One voxel in a corner: at each level the eight parts of the box that holds it, and no more.
  const LabelImage corner =
      make_image({32, 32, 32}, {1, 1, 1}, 1, [](const Vec3& p) { return p.norm() < 0.5 ? 1 : 0; });
  const CellGrid one(corner, {.block = 32});
  EXPECT_EQ(leaves_of(one, LabelOctree(one)).size(), 5U * 7 + 1);
}

TEST(LabelOctree, IsTheSameAtAnyThreadCount) {
  const LabelImage image = graded_image();
  const CellGrid grid(image, {.block = 16});
  std::vector<std::size_t> counts;
  const int before = omp_get_max_threads();
  for (const int threads : {1, 3}) {
    omp_set_num_threads(threads);
    counts.push_back(leaves_of(grid, LabelOctree(grid)).size());
  }
  omp_set_num_threads(before);
  EXPECT_EQ(counts[0], counts[1]);
}

}  // namespace
}  // namespace cbc3d::baselines::ld
