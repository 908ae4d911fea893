// Parts, tunnels and cavities of known bodies, as voxels and as tets.
#include "mesher/lattice/label_betti.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "mesher/lattice/bcc_lattice.hpp"
#include "mesher/lattice/red_green.hpp"
#include "mesher/testing/test_images.hpp"
#include "mesher/topology/tet_adjacency.hpp"

namespace cbc3d {
namespace {

/// A slab with two holes through it and a cavity between them; a block that touches it, and two loose blocks
/// of the same label.
LabelImage bodies() {
  return testing::make_image({24, 12, 12}, {1, 1, 1}, 2, [](const Vec3& p) {
    const auto in = [&](double x0, double x1, double y0, double y1, double z0, double z1) {
      return p.x > x0 && p.x < x1 && p.y > y0 && p.y < y1 && p.z > z0 && p.z < z1;
    };
    if (in(15.5, 18.5, 2.5, 8.5, 2.5, 8.5) || in(20.5, 22.5, 2.5, 4.5, 2.5, 4.5) ||
        in(20.5, 22.5, 7.5, 9.5, 7.5, 9.5)) {
      return 2;
    }
    if (!in(1.5, 15.5, 1.5, 9.5, 2.5, 8.5)) {
      return 0;
    }
    const bool hole = in(3.5, 5.5, 3.5, 6.5, 0, 12) || in(10.5, 12.5, 3.5, 6.5, 0, 12);
    return hole || in(6.8, 8.2, 4.8, 6.2, 4.8, 6.2) ? 0 : 1;
  });
}

/// A uniform lattice that takes its tets' materials at their centroids.
struct LatticeMesh {
  explicit LatticeMesh(const LabelImage& image) {
    const Lattice lattice = build_bcc_lattice(image, {1, 0.5});
    points = local_points(lattice);
    mesh.tets = extract_tets(lattice);
    mesh.neighbours = tet_neighbours(mesh.tets.nodes, points.size());
    for (std::size_t t = 0; t < mesh.tets.size(); ++t)
      mesh.materials.push_back(image.at_local(centroid_of(t)));
  }
  [[nodiscard]] Vec3 centroid_of(std::size_t t) const {
    const auto& n = mesh.tets.nodes[t];
    return 0.25 * (points[n[0]] + points[n[1]] + points[n[2]] + points[n[3]]);
  }

  std::vector<Vec3> points;
  CandidateMesh mesh;
};

const std::map<Label, Betti> kBodies = {{1, {1, 2, 1}}, {2, {3, 0, 0}}};

TEST(LabelBetti, OfVoxels) {
  EXPECT_EQ(betti_of_labels(bodies()), kBodies);
  LabelImage regions = bodies();  // a region of a label may be a material of its own
  regions.labels = {0, 7, 7};
  for (auto v = std::size_t{0}; v < regions.voxels.size(); ++v) {
    if (regions.frame.index_of(v)[0] >= 15) regions.voxels.set(v, 0);
  }
  EXPECT_EQ(betti_of_labels(regions), (std::map<Label, Betti>{{7, {1, 2, 1}}}));
}

TEST(LabelBetti, OfTets) {
  const LabelImage image = bodies();
  const LatticeMesh lattice(image);
  EXPECT_EQ(betti_of_labels(lattice.mesh, lattice.points, image.labels), kBodies);
}

/// One region of the label is cut in two and the other is gone: as many parts as before.
TEST(LabelBetti, AMaterialThatDiffersMakesItsLabelUnlike) {
  const auto block = [](double x, double low, double high) { return x > low && x < high; };
  const LabelImage image = testing::make_image({16, 6, 6}, {1, 1, 1}, 2, [&](const Vec3& p) {
    const bool inside = block(p.y, 1.5, 4.5) && block(p.z, 1.5, 4.5);
    return !inside ? 0 : block(p.x, 1.5, 8.5) ? 1 : block(p.x, 10.5, 13.5) ? 2 : 0;
  });
  LabelImage regions = image;
  regions.labels = {0, 7, 7};
  LatticeMesh lattice(image);
  CandidateMesh& mesh = lattice.mesh;
  EXPECT_TRUE(ImageBetti(regions).unlike_labels(mesh, lattice.points).empty());
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (mesh.materials[t] == 2 || block(lattice.centroid_of(t).x, 4.5, 6.5)) mesh.materials[t] = 0;
  }
  EXPECT_EQ(betti_of_labels(mesh, lattice.points, regions.labels), betti_of_labels(regions));
  EXPECT_EQ(ImageBetti(regions).unlike_labels(mesh, lattice.points), std::vector<Label>{7});
}

TEST(LabelBetti, DifferencesAreThoseOfEitherSide) {
  const auto differences = label_differences({{1, {1, 2, 0}}, {2, {1, 0, 0}}, {3, {1, 0, 0}}},
                                             {{1, {1, 1, 0}}, {2, {1, 0, 0}}, {4, {2, 0, 1}}});
  ASSERT_EQ(differences.size(), 3U);
  EXPECT_EQ(differences[0].label, 1);
  EXPECT_EQ(differences[0].in_mesh.tunnels, 1);
  EXPECT_EQ(differences[1].label, 3);
  EXPECT_EQ(differences[1].in_mesh, Betti{});
  EXPECT_EQ(differences[2].label, 4);
  EXPECT_EQ(differences[2].in_image, Betti{});
  EXPECT_EQ(labels_of(differences), (std::vector<Label>{1, 3, 4}));
}

}  // namespace
}  // namespace cbc3d
