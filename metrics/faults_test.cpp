#include "metrics/faults.hpp"

#include <gtest/gtest.h>

#include "metrics/image_topology.hpp"
#include "metrics/surface.hpp"
#include "metrics/testing.hpp"

namespace cbc3d::metrics {
namespace {

/// A sound mesh with the findings about it, of which each test spoils one.
struct Findings {
  LabelImage image = test::two_boxes();
  Mesh mesh = sound_mesh(image);
  MeshView view{mesh, image};
  MeshQuality quality = element_quality(view);
  std::vector<Facet> facets = sorted_facets(view);
  Surface surface = extract_surface(view, facets);
  Topology connected = topology(view, facets, surface);
  SelfIntersections crossing = self_intersections(view, surface);
  ImageTopology in_image = image_topology(image);
  LabelComparison labels;

  [[nodiscard]] std::vector<std::string> describe() const {
    return describe_faults(view, quality, connected, crossing, in_image, image, labels);
  }

 private:
  // Without the lattice's vertices that no cell uses.
  static Mesh sound_mesh(const LabelImage& image) {
    const Mesh all = test::kuhn_mesh(image);
    Mesh mesh;
    std::vector<VertexId> renumbered(all.points.size(), ~VertexId{0});
    for (std::size_t t = 0; t < all.tets.size(); ++t) {
      std::array<VertexId, 4> tet = all.tets.nodes[t];
      for (VertexId& v : tet) {
        if (renumbered[v] == ~VertexId{0}) {
          renumbered[v] = static_cast<VertexId>(mesh.points.size());
          mesh.points.push_back(all.points[v]);
        }
        v = renumbered[v];
      }
      mesh.tets.add(tet, all.tets.labels[t]);
    }
    return mesh;
  }
};

using Lines = std::vector<std::string>;

TEST(Faults, ASoundMeshHasNone) {
  EXPECT_EQ(Findings().describe(), Lines());
}

TEST(Faults, AnInvertedCellIsNamedWithItsKindAndCentre) {
  Findings found;
  const Vec3 shift{3, -2, 1};
  found.mesh.points.resize(4);
  found.mesh.points[0] = shift;
  found.mesh.points[1] = shift + Vec3{4, 0, 0};
  found.mesh.points[2] = shift + Vec3{0, 4, 0};
  found.mesh.points[3] = shift + Vec3{0, 0, 4};
  found.mesh.tets.nodes[5] = {0, 1, 2, 3};
  found.quality.all.inverted = 3;
  found.quality.all.degenerate = 1;
  found.quality.all.negative_jacobian = 5;
  found.quality.all.first_inverted = 5;
  EXPECT_EQ(found.describe(),
            (Lines{"3 inverted or flat cells (1 of them flat), first tet (cell 5) at (4, -1, 2) mm",
                   "2 cells of positive volume are folded at a corner (scaled Jacobian not above 0)"}));
}

TEST(Faults, VerticesAreNamedWithTheirPlace) {
  Findings found;
  found.mesh.points[2] = {0.5, -1.25, 7};
  found.connected.hanging_vertices = {4, 2};
  found.connected.unused_vertices = {1, 2};
  EXPECT_EQ(found.describe(),
            (Lines{"4 vertices that hang in a facet or an edge of another cell (T-junctions), first vertex 2 "
                   "at (0.5, -1.25, 7) mm",
                   "1 vertices of no cell, first vertex 2 at (0.5, -1.25, 7) mm"}));
}

TEST(Faults, LabelsThatAreMissingOrUnknownAreNamed) {
  Findings found;
  found.labels.missing = {7};
  found.labels.unknown = {-3, 12};
  EXPECT_EQ(found.describe(),
            (Lines{"label 7 of the image is in no cell", "label -3 of the mesh is not in the image",
                   "label 12 of the mesh is not in the image"}));
}

TEST(Faults, ATunnelThatTheImageDoesNotHaveIsSaid) {
  Findings found;
  found.connected.betti.per_label[1].betti = Betti{{1, 1, 0}};
  EXPECT_EQ(found.describe(), (Lines{"label 7: 1 parts, 1 tunnels, 0 cavities in the mesh, "
                                     "1 parts, 0 tunnels, 0 cavities in the image"}));
  found.connected.betti.per_label[1].betti.reset();
  EXPECT_EQ(found.describe(), (Lines{"label 7: its cells do not fit together as a set in space; no Betti "
                                     "numbers"}));
}

TEST(Faults, SelfIntersectionsHaveACountAndAPlace) {
  Findings found;
  found.crossing.pairs = 9;
  found.crossing.first_at_mm = {1, 2, 3.5};
  EXPECT_EQ(
      found.describe(),
      (Lines{"9 pairs of surface facets that cut, touch or overlap each other, first at (1, 2, 3.5) mm"}));
}

}  // namespace
}  // namespace cbc3d::metrics
