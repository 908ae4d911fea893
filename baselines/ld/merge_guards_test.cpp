#include "baselines/ld/merge_guards.hpp"

#include "baselines/ld/testing_lattice_mesh.hpp"
#include "mesher/testing/test_images.hpp"

namespace cbc3d::baselines::ld {
namespace {

/// A column of cells along x of the given materials, with background around, and its vertices by place.
class Column {
 public:
  explicit Column(std::vector<int> materials)
      : image_(cbc3d::testing::make_image(
            {static_cast<int>(materials.size()), 1, 1}, {1, 1, 1}, 2,
            [&](const Vec3& p) { return materials[static_cast<std::size_t>(p.x)]; })),
        grid_(image_, {.margin = 1, .block = 4}),
        mesh_(testing::whole_initial_mesh(grid_, {.with_background = true})) {}

  MergeMesh& mesh() { return mesh_; }
  VertexId corner(int i, int j, int k) {
    const LatticePoint place{2 * (i + 1), 2 * (j + 1), 2 * (k + 1)};
    for (VertexId v = 0; v < mesh_.vertex_count(); ++v) {
      if (mesh_.point(v) == place) return v;
    }
    return kNoVertex;
  }
  Fan fan(VertexId v) {
    Fan fan;
    fan.gather(mesh_, v);
    return fan;
  }

 private:
  LabelImage image_;
  CellGrid grid_;
  MergeMesh mesh_;
};

TEST(Fan, HoldsTheFacetsBetweenMaterialsAlone) {
  Column column({1, 2});
  const Fan fan = column.fan(column.corner(1, 0, 0));  // on the line of 0, 1 and 2
  EXPECT_EQ(fan.degree(column.corner(1, 1, 0)), 3);
  EXPECT_EQ(fan.degree(column.corner(1, 0, 1)), 3);
  EXPECT_TRUE(fan.has(column.corner(0, 0, 0)));
  EXPECT_FALSE(fan.has(column.corner(1, 1, 2)));
}

TEST(Guards, AThinColumnIsNotPinched) {
  Column column({1, 1, 1});
  const VertexId v = column.corner(1, 0, 0);
  const VertexId along = column.corner(2, 0, 0);
  const VertexId across = column.corner(1, 1, 0);
  EXPECT_TRUE(keeps_topology(Stratum::sheet, column.fan(v), along, column.fan(along)));
  EXPECT_TRUE(column.fan(v).has(across));
  const VertexId inside = column.corner(1, 1, 1);  // across the column's inside or along a diagonal in it
  EXPECT_FALSE(keeps_topology(Stratum::sheet, column.fan(v), inside, column.fan(inside)));
}

TEST(Guards, ALineVertexStaysOnItsLine) {
  Column column({1, 2});
  const VertexId v = column.corner(1, 0, 0);
  const VertexId off = column.corner(0, 0, 0);
  EXPECT_TRUE(column.fan(v).has(off));
  EXPECT_FALSE(keeps_topology(Stratum::line, column.fan(v), off, column.fan(off)));
}

TEST(Star, RefusesMergesThatInvertTets) {
  Column column({1, 1, 1});
  Star star({0.5, 0.5, 0.5});
  const VertexId v = column.corner(1, 0, 0);
  star.gather(column.mesh(), v);
  ASSERT_FALSE(star.neighbours().empty());
  const DihedralBounds none(0, 180);
  std::size_t accepted = 0;
  for (const VertexId w : star.neighbours()) {
    const bool is_accepted = star.accepts(column.mesh(), w, none);
    accepted += is_accepted ? 1 : 0;
    std::int64_t least = 1;  // of the tets that the merge leaves
    column.mesh().for_star(v, [&](TetId t, std::uint32_t node) {
      std::array<LatticePoint, 4> p;
      bool has_w = false;
      for (std::size_t n = 0; n < 4; ++n) {
        has_w = has_w || column.mesh().nodes(t)[n] == w;
        p[n] = column.mesh().point(n == node ? w : column.mesh().nodes(t)[n]);
      }
      if (!has_w) least = std::min(least, orientation(p[0], p[1], p[2], p[3]));
    });
    EXPECT_EQ(is_accepted, least > 0);
  }
  EXPECT_LT(accepted, star.neighbours().size());
}

}  // namespace
}  // namespace cbc3d::baselines::ld
