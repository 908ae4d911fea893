// Labelled meshes from files: what is refused, how labels are numbered, what is measured.
#include <gtest/gtest.h>

#include <limits>
#include <utility>
#include <vector>

#include "mesher/core/error.hpp"
#include "mesher/testing/kuhn_box.hpp"
#include "mesher/topology/labelled_tets.hpp"

namespace cbc3d {
namespace {

Mesh box_mesh() {
  const testing::KuhnBox box(2);
  Mesh mesh;
  mesh.points = box.points;
  for (std::size_t t = 0; t < box.tets.size(); ++t) {
    mesh.tets.add(box.tets[t], box.centroid(t).x < 1 ? 0 : box.centroid(t).y < 1 ? -5 : 3);
  }
  return mesh;
}

TEST(LabelledTets, WhatCannotBeImprovedIsRefused) {
  EXPECT_NO_THROW(require_improvable(box_mesh()));
  EXPECT_THROW(require_improvable(Mesh{}), InputError);
  Mesh mixed = box_mesh();
  mixed.pyramids.add({0, 1, 2, 3, 4}, 1);
  EXPECT_THROW(require_improvable(mixed), InputError);
  Mesh damaged = box_mesh();
  damaged.tets.nodes[3][1] = 27;
  EXPECT_THROW(require_improvable(damaged), InputError);
  damaged = box_mesh();
  damaged.points[4].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(require_improvable(damaged), InputError);
}

TEST(LabelledTets, LabelsAreNumberedInTheirOrderFromOne) {
  const Mesh mesh = box_mesh();
  std::vector<Label> labels;
  const MaterialMesh numbered = number_labels(mesh, labels);
  EXPECT_EQ(labels, (std::vector<Label>{0, -5, 0, 3}));
  ASSERT_EQ(numbered.tets, mesh.tets.nodes);
  EXPECT_EQ(numbered.points, mesh.points);
  for (std::size_t t = 0; t < numbered.tets.size(); ++t) {
    EXPECT_GE(numbered.materials[t], 1);
    EXPECT_EQ(labels[numbered.materials[t]], mesh.tets.labels[t]);
  }
}

TEST(LabelledTets, MeasuresOfABoxOfCubes) {
  std::vector<Label> labels;
  MaterialMesh mesh = number_labels(box_mesh(), labels);
  mesh.points.push_back({9, 9, 9});  // used by no tet
  const TetMeasures measures = measure_tets(mesh, 4);
  EXPECT_EQ(measures.vertices, 27U);
  EXPECT_EQ(measures.tets, 48U);
  EXPECT_EQ(measures.not_positive, 0U);
  EXPECT_NEAR(measures.min_dihedral_deg, 45, 1e-9);  // Kuhn's tet
  EXPECT_NEAR(measures.max_dihedral_deg, 90, 1e-9);
  EXPECT_NEAR(measures.volume_mm3[1], 2, 1e-12);  // label -5
  EXPECT_NEAR(measures.volume_mm3[2], 4, 1e-12);
  EXPECT_NEAR(measures.volume_mm3[3], 2, 1e-12);
  std::swap(mesh.tets[7][0], mesh.tets[7][1]);
  const TetMeasures tangled = measure_tets(mesh, 4);
  EXPECT_EQ(tangled.not_positive, 1U);
  EXPECT_EQ(tangled.min_dihedral_deg, 0);
  EXPECT_EQ(tangled.max_dihedral_deg, 180);
}

}  // namespace
}  // namespace cbc3d
