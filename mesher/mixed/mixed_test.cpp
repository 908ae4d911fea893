// Mixed elements: what is merged, what stays, and what a solver sees of it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <set>

#include "mesher/core/error.hpp"
#include "mesher/deform/element_stiffness.hpp"
#include "mesher/mixed/mix_elements.hpp"
#include "mesher/pipeline/mesh_image.hpp"
#include "mesher/pipeline/presets.hpp"
#include "mesher/testing/test_images.hpp"
#include "mesher/topology/cell_quality.hpp"
#include "mesher/topology/interface_facets.hpp"

namespace cbc3d {
namespace {

/// A block of two materials, so that there are an interface and coarse insides.
LabelImage block_image() {
  return testing::make_image({56, 44, 44}, {1, 1, 1}, 2, [](const Vec3& p) {
    const bool inside = p.x > 2 && p.x < 53 && p.y > 2 && p.y < 41 && p.z > 2 && p.z < 41;
    return !inside ? 0 : p.x + 0.2 * p.y < 30 ? 1 : 2;
  });
}

MaterialMesh mesh_of(const LabelImage& image, bool mixed, int iterations) {
  MeshImageOptions options = preset_options("paper", image.frame);
  options.lattice_spacing_mm = 4;
  options.refine.finest_spacing_mm = 4;
  options.mixed = mixed;
  options.deform.iterations = iterations;
  Progress quiet;
  MeshImageReport report;
  return to_material_mesh(mesh_image(image, options, quiet, report), image);
}

template <std::size_t Nodes>
std::array<Vec3, Nodes> points_of(const MaterialMesh& mesh, const std::array<VertexId, Nodes>& cell) {
  std::array<Vec3, Nodes> points;
  std::transform(cell.begin(), cell.end(), points.begin(), [&](VertexId v) { return mesh.points[v]; });
  return points;
}

/// Volume of a pyramid or hex with planar faces or not: the divergence theorem over its facets, fanned from
/// their means.
double volume_of_cell(const MaterialMesh& mesh, CellId cell) {
  const auto n = mesh.nodes_of(cell);
  if (n.size() == 4) {
    return six_volumes(mesh.points[n[0]], mesh.points[n[1]], mesh.points[n[2]], mesh.points[n[3]]) / 6;
  }
  MaterialMesh one;
  one.points = mesh.points;
  if (n.size() == 5) {
    one.pyramids.add({n[0], n[1], n[2], n[3], n[4]}, 1);
  } else {
    one.hexes.add({n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7]}, 1);
  }
  double six = 0;
  for (const InterfaceFacet& f : interface_facets(one, cells_of_vertices(one))) {
    const std::size_t corners = f.nodes[3] == kNoVertex ? 3 : 4;
    Vec3 mean;
    for (std::size_t c = 0; c < corners; ++c) {
      mean += mesh.points[f.nodes[c]] / static_cast<double>(corners);
    }
    for (std::size_t c = 0; c < corners; ++c) {
      six += mean.dot(mesh.points[f.nodes[c]].cross(mesh.points[f.nodes[(c + 1) % corners]]));
    }
  }
  return -six / 6;  // the normals point from background, the lower number, into the cell
}

double volume_of_material(const MaterialMesh& mesh, MaterialId material) {
  double sum = 0;
  for (CellId c = 0; c < mesh.cell_count(); ++c) {
    sum += mesh.material_of(c) == material ? volume_of_cell(mesh, c) : 0;
  }
  return sum;
}

/// The interface and surface facets by the positions of their nodes.
std::multiset<std::array<double, 9>> surface_of(const MaterialMesh& mesh) {
  std::multiset<std::array<double, 9>> facets;
  for (const InterfaceFacet& f : interface_facets(mesh, cells_of_vertices(mesh))) {
    EXPECT_EQ(f.nodes[3], kNoVertex) << "a quadrilateral on a surface";
    std::array<std::array<double, 3>, 3> corners;
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3& p = mesh.points[f.nodes[c]];
      corners[c] = {p.x, p.y, p.z};
    }
    std::sort(corners.begin(), corners.end());
    std::array<double, 9> key{};
    for (std::size_t c = 0; c < 9; ++c) {
      key[c] = corners[c / 3][c % 3];
    }
    facets.insert(key);
  }
  return facets;
}

TEST(MixElements, KeepSurfacesVolumesAndSaveVertices) {
  const LabelImage image = block_image();
  const MaterialMesh tets = mesh_of(image, false, 0);
  const MaterialMesh mixed = mesh_of(image, true, 0);
  ASSERT_GT(mixed.hexes.size(), 100U);
  EXPECT_GT(mixed.pyramids.size(), 100U);
  EXPECT_LT(static_cast<double>(mixed.points.size()), 0.8 * static_cast<double>(tets.points.size()));
  EXPECT_EQ(surface_of(mixed), surface_of(tets));
  for (const MaterialId m : {1, 2}) {
    EXPECT_NEAR(volume_of_material(mixed, m), volume_of_material(tets, m),
                1e-9 * volume_of_material(tets, m));
  }
}

TEST(MixElements, MakeCubesAndTheLatticesPyramids) {
  const MaterialMesh mixed = mesh_of(block_image(), true, 0);
  for (const auto& cell : mixed.hexes.nodes) {
    EXPECT_NEAR(scaled_jacobian_hex(points_of(mixed, cell)), 1, 1e-12);
  }
  for (const auto& cell : mixed.pyramids.nodes) {
    EXPECT_NEAR(scaled_jacobian_pyramid(points_of(mixed, cell)), 1, 1e-12);
  }
}

TEST(MixElements, EveryInnerFacetHasTwoCells) {
  // A facet that a hex shows as a quadrilateral and a tet as triangles would come out as a surface within a
  // material.
  for (const int iterations : {0, 5}) {
    const MaterialMesh mixed = mesh_of(block_image(), true, iterations);
    for (const InterfaceFacet& f : interface_facets(mixed, cells_of_vertices(mixed))) {
      EXPECT_NE(f.lower, f.higher);
      EXPECT_EQ(f.nodes[3], kNoVertex);
    }
  }
}

TEST(MixElements, MergeADeformedMeshToo) {
  const LabelImage image = block_image();
  MaterialMesh mesh = mesh_of(image, false, 3);
  const auto surface = surface_of(mesh);
  const MixReport strict = [&] {
    MaterialMesh copy = mesh;
    return mix_elements(copy, {});
  }();
  const MixReport report = mix_elements(mesh, {false, 0.4});
  EXPECT_GT(report.hexes, 0U);
  EXPECT_GT(report.hexes, strict.hexes) << "deformed tets are not red any more";
  EXPECT_EQ(surface_of(mesh), surface);
  for (const auto& cell : mesh.hexes.nodes) {
    EXPECT_GE(scaled_jacobian_hex(points_of(mesh, cell)), 0.4);
  }
}

TEST(MixElements, FindNothingInATetMeshWithoutUniformStars) {
  MaterialMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.tets = {{0, 1, 2, 3}};
  mesh.materials = {1};
  const MixReport report = mix_elements(mesh, {});
  EXPECT_EQ(report.hexes + report.pyramids + report.tets_merged, 0U);
  EXPECT_EQ(mesh.points.size(), 4U);
}

TEST(CellQuality, OfUnitElementsAndTheirMirrorImages) {
  const std::array<Vec3, 8> cube = {
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}};
  EXPECT_NEAR(scaled_jacobian_hex(cube), 1, 1e-15);
  std::array<Vec3, 8> mirrored;
  std::transform(cube.begin(), cube.end(), mirrored.begin(), [](const Vec3& p) {
    return Vec3{-p.x, p.y, p.z};
  });
  EXPECT_NEAR(scaled_jacobian_hex(mirrored), -1, 1e-15);
  const std::array<Vec3, 5> pyramid = {cube[0], cube[1], cube[2], cube[3], Vec3{0.5, 0.5, 0.5}};
  EXPECT_NEAR(scaled_jacobian_pyramid(pyramid), 1, 1e-15);
  EXPECT_LT(
      scaled_jacobian_pyramid(std::array<Vec3, 5>{cube[0], cube[1], cube[2], cube[3], Vec3{0.5, 0.5, -0.5}}),
      0);
  const double s = std::numbers::sqrt2;  // the lattice's tet: 60 and 90 degrees
  const std::array<Vec3, 4> tet = {{{-1, 0, 0}, {1, 0, 0}, {0, -1, 1}, {0, 1, 1}}};
  EXPECT_NEAR(min_dihedral_deg(tet[1], tet[0], tet[2], tet[3]), 60, 1e-9);
  EXPECT_EQ(min_dihedral_deg(tet[0], tet[1], tet[2], tet[3]), 0) << "inverted";
  EXPECT_NEAR(min_dihedral_deg({0, 0, 0}, {s, 0, 0}, {0, s, 0}, {0, 0, s}),
              std::acos(1 / std::numbers::sqrt3) * 180 / std::numbers::pi, 1e-9);
}

/// Random tets from well shaped to slim, flat and inverted ones: what the quick test says is true, and it
/// says so of nearly all that are clearly above the bound.
TEST(CellQuality, QuickTestIsNeverWrongAndMostlyAnswers) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const Vec3 far = {300, -200, 500};
  std::size_t clear = 0;
  std::size_t answered = 0;
  for (int i = 0; i < 200000; ++i) {
    const double flat = std::pow(10, -4 * std::fabs(uniform(random)));
    std::array<Vec3, 4> p;
    for (Vec3& q : p) {
      q = far + Vec3{uniform(random), uniform(random), flat * uniform(random)};
    }
    for (const double bound_deg : {5.0, 20.0}) {
      const double bound = std::cos(bound_deg * std::numbers::pi / 180);
      const double cosine = max_dihedral_cosine(p[0], p[1], p[2], p[3]);
      const bool sure = surely_no_cosine_above(p[0], p[1], p[2], p[3], bound);
      EXPECT_TRUE(!sure || cosine <= bound) << cosine << " at " << bound_deg << " degrees";
      const bool is_clear = cosine < 0.99 * bound;
      clear += is_clear ? 1 : 0;
      answered += is_clear && sure ? 1 : 0;
    }
  }
  EXPECT_GT(clear, 10000U);
  EXPECT_GT(static_cast<double>(answered), 0.95 * static_cast<double>(clear));
}

// ---- stiffness
// ----------------------------------------------------------------------------------------------------

/// y = K u in double, assembled element by element.
std::vector<Vec3> forces_of(const MaterialMesh& mesh, const LameConstants& lame, const std::vector<Vec3>& u) {
  std::vector<Vec3> forces(mesh.points.size());
  for (CellId c = 0; c < mesh.cell_count(); ++c) {
    const auto nodes = mesh.nodes_of(c);
    std::array<Vec3, 8> p;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      p[n] = mesh.points[nodes[n]];
    }
    for (std::size_t own = 0; own < nodes.size(); ++own) {
      std::array<StiffnessBlock, 8> row{};
      std::array<StiffnessBlock*, 8> out{};
      for (std::size_t n = 0; n < nodes.size(); ++n) {
        out[n] = &row[n];
      }
      add_element_stiffness_row({p.data(), nodes.size()}, own, lame, {out.data(), nodes.size()});
      for (std::size_t n = 0; n < nodes.size(); ++n) {
        const Vec3& x = u[nodes[n]];
        const auto& k = row[n];
        forces[nodes[own]] += {k[0] * x.x + k[1] * x.y + k[2] * x.z, k[3] * x.x + k[4] * x.y + k[5] * x.z,
                               k[6] * x.x + k[7] * x.y + k[8] * x.z};
      }
    }
  }
  return forces;
}

Vec3 linear_field(const Vec3& p) {
  return {0.01 * p.x - 0.02 * p.y + 0.005 * p.z + 3, 0.015 * p.x + 0.03 * p.y - 0.01 * p.z - 1,
          -0.02 * p.x + 0.004 * p.y + 0.012 * p.z};
}

double dot(const std::vector<Vec3>& a, const std::vector<Vec3>& b) {
  double sum = 0;
  for (std::size_t v = 0; v < a.size(); ++v) {
    sum += a[v].dot(b[v]);
  }
  return sum;
}

/// Solves K u = 0 inside for u given on the surface, by conjugate gradients.
std::vector<Vec3> solve_inside(const MaterialMesh& mesh, const LameConstants& lame,
                               const std::vector<bool>& fixed, std::vector<Vec3> u) {
  const auto free_part = [&](std::vector<Vec3> f) {
    for (std::size_t v = 0; v < f.size(); ++v) {
      f[v] = fixed[v] ? Vec3{} : f[v];
    }
    return f;
  };
  std::vector<Vec3> r = free_part(forces_of(mesh, lame, u));
  for (Vec3& x : r) {
    x = -x;
  }
  std::vector<Vec3> p = r;
  double rr = dot(r, r);
  const double start = rr;
  for (int i = 0; i < 2000 && rr > 1e-28 * start; ++i) {
    const std::vector<Vec3> q = free_part(forces_of(mesh, lame, p));
    const double alpha = rr / dot(p, q);
    for (std::size_t v = 0; v < u.size(); ++v) {
      u[v] += alpha * p[v];
      r[v] -= alpha * q[v];
    }
    const double next = dot(r, r);
    for (std::size_t v = 0; v < u.size(); ++v) {
      p[v] = r[v] + (next / rr) * p[v];
    }
    rr = next;
  }
  return u;
}

TEST(ElementStiffness, PassesThePatchTestOnADeformedMixedMesh) {
  const MaterialMesh mesh = mesh_of(block_image(), true, 4);
  ASSERT_GT(mesh.hexes.size(), 100U);
  std::vector<bool> fixed(mesh.points.size(), false);
  for (const InterfaceFacet& f : interface_facets(mesh, cells_of_vertices(mesh))) {
    for (std::size_t c = 0; c < 3; ++c) {
      fixed[f.nodes[c]] = fixed[f.nodes[c]] || f.lower == kBackground;
    }
  }
  std::vector<Vec3> start(mesh.points.size());
  for (std::size_t v = 0; v < start.size(); ++v) {
    start[v] = fixed[v] ? linear_field(mesh.points[v]) : Vec3{};
  }
  const std::vector<Vec3> u = solve_inside(mesh, lame_constants({}), fixed, start);
  for (std::size_t v = 0; v < u.size(); ++v) {
    EXPECT_LT((u[v] - linear_field(mesh.points[v])).norm(),
              1e-10 * linear_field(mesh.points[v]).norm() + 1e-10)
        << v;
  }
}

TEST(ElementStiffness, HasTheEnergyOfTheContinuum) {
  // u = e x along x: strain energy 1/2 V (lambda + 2 mu) e^2, so that u . K u = V (lambda + 2 mu) e^2.
  const MaterialMesh mesh = mesh_of(block_image(), true, 4);
  const LameConstants lame = lame_constants({5000, 0.3});
  std::vector<Vec3> u(mesh.points.size());
  std::vector<Vec3> turn(mesh.points.size());
  for (std::size_t v = 0; v < u.size(); ++v) {
    u[v] = {0.01 * mesh.points[v].x, 0, 0};
    turn[v] = Vec3{0.3, -0.2, 0.5}.cross(mesh.points[v]) + Vec3{1, 2, 3};
  }
  const double volume = volume_of_material(mesh, 1) + volume_of_material(mesh, 2);
  const double energy = dot(u, forces_of(mesh, lame, u));
  EXPECT_NEAR(energy, volume * (lame.lambda + 2 * lame.mu) * 1e-4, 1e-9 * energy);
  EXPECT_LT(std::abs(dot(turn, forces_of(mesh, lame, turn))), 1e-9) << "rigid motions cost nothing";
  EXPECT_NEAR(lame.mu, 5000e-6 / 2.6, 1e-15);
  EXPECT_NEAR(lame.lambda, 5000e-6 * 0.3 / (1.3 * 0.4), 1e-15);
}

TEST(MaterialMesh, ComesFromAFileWithTheImagesMaterials) {
  LabelImage image = block_image();
  for (const bool flipped : {false, true}) {
    image.frame = testing::oblique(block_image().frame, flipped);
    const MaterialMesh mesh = mesh_of(image, true, 0);
    const MaterialMesh back = to_material_mesh(to_physical_mesh(mesh, image), image);
    ASSERT_EQ(back.cell_count(), mesh.cell_count());
    for (CellId c = 0; c < mesh.cell_count(); ++c) {
      EXPECT_EQ(back.material_of(c), mesh.material_of(c));
      EXPECT_GT(volume_of_cell(back, c), 0);
    }
  }
  Mesh stranger;
  stranger.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  stranger.tets.add({0, 1, 2, 3}, 9);
  EXPECT_THROW(to_material_mesh(stranger, image), InputError);
  Mesh wedge;
  wedge.points.resize(6);
  wedge.wedges.add({0, 1, 2, 3, 4, 5}, 1);
  EXPECT_THROW(to_material_mesh(wedge, image), InputError);
}

}  // namespace
}  // namespace cbc3d
