#include "metrics/cells.hpp"

#include <gtest/gtest.h>

#include "mesher/core/error.hpp"
#include "metrics/testing.hpp"
#include "metrics/volumes.hpp"

namespace cbc3d::metrics {
namespace {

/// A cube of hexes, a pyramid, a wedge and a tet, each apart, of labels 3, 5, 7 and 9.
Mesh one_of_each() {
  Mesh mesh;
  for (int k = 0; k < 2; ++k) {
    for (int j = 0; j < 2; ++j) {
      for (int i = 0; i < 2; ++i) mesh.points.push_back({double(i), double(j), double(k)});
    }
  }
  mesh.hexes.add({0, 1, 3, 2, 4, 5, 7, 6}, 3);
  mesh.pyramids.add({0, 1, 3, 2, 4}, 5);
  mesh.wedges.add({0, 1, 2, 4, 5, 6}, 7);
  mesh.tets.add({0, 1, 2, 4}, 9);
  return mesh;
}

LabelImage any_image() {
  return test::empty_image({3, 3, 3}, {1, 1, 1}, {0, 1});
}

TEST(MeshView, NumbersCellsByKindAndLabelsByValue) {
  const Mesh mesh = one_of_each();
  const MeshView view(mesh, any_image());
  EXPECT_EQ(view.cell_count(), 4U);
  EXPECT_EQ(view.labels(), (std::vector<Label>{3, 5, 7, 9}));
  EXPECT_EQ(view.cell(0).kind, CellKind::kTet);
  EXPECT_EQ(view.cell(1).kind, CellKind::kPyramid);
  EXPECT_EQ(view.cell(2).kind, CellKind::kWedge);
  EXPECT_EQ(view.cell(3).kind, CellKind::kHex);
  EXPECT_EQ(view.cell(3).nodes.size(), 8U);
  EXPECT_EQ(view.label_index(3), 0U);
  EXPECT_EQ(view.find_label(7), 2U);
  EXPECT_FALSE(view.find_label(4).has_value());
}

TEST(MeshView, TheTetsOfACellFillIt) {
  const Mesh mesh = one_of_each();
  const MeshView view(mesh, any_image());
  const std::vector<double> volumes = label_volumes_mm3(view);
  EXPECT_NEAR(volumes[0], 1, 1e-15);
  EXPECT_NEAR(volumes[1], 1.0 / 3, 1e-15);
  EXPECT_NEAR(volumes[2], 0.5, 1e-15);
  EXPECT_NEAR(volumes[3], 1.0 / 6, 1e-15);
  for (std::size_t cell = 0; cell < view.cell_count(); ++cell) {
    const TetSplit split = split_into_tets(view.cell(cell));
    for (int n = 0; n < split.count; ++n) {
      const auto& t = split.tets[static_cast<std::size_t>(n)];
      const auto& p = mesh.points;
      EXPECT_GT(six_volumes(p[t[0]], p[t[1]], p[t[2]], p[t[3]]), 0) << cell;
    }
  }
}

TEST(MeshView, EveryFaceOfACellLooksOutwards) {
  const Mesh mesh = one_of_each();
  const MeshView view(mesh, any_image());
  for (std::size_t cell = 0; cell < view.cell_count(); ++cell) {
    const CellView found = view.cell(cell);
    Vec3 centre{};
    for (const VertexId v : found.nodes) centre += mesh.points[v] / double(found.nodes.size());
    const CellShape& shape = shape_of(found.kind);
    for (int f = 0; f < shape.face_count; ++f) {
      const auto& face = shape.faces[static_cast<std::size_t>(f)];
      const auto at = [&](std::size_t n) {
        return mesh.points[found.nodes[static_cast<std::size_t>(face[n])]];
      };
      EXPECT_LT(six_volumes(at(0), at(1), at(2), centre), 0) << cell << ", face " << f;
    }
  }
}

TEST(MeshView, RefusesWhatIsNoMesh) {
  Mesh mesh = one_of_each();
  mesh.tets.add({0, 1, 2, 99}, 1);
  EXPECT_THROW(MeshView(mesh, any_image()), InputError);
  mesh = one_of_each();
  mesh.points[3].x = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(MeshView(mesh, any_image()), InputError);
}

}  // namespace
}  // namespace cbc3d::metrics
