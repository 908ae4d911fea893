// Element stiffness: the patch test, the energy of the continuum, rigid motions.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "mesher/deform/deform_mesh.hpp"
#include "mesher/deform/element_stiffness.hpp"
#include "mesher/deform/testing_paper_mesh.hpp"
#include "mesher/testing/cell_volumes.hpp"
#include "mesher/testing/test_images.hpp"
#include "mesher/topology/interface_facets.hpp"

namespace cbc3d {
namespace {

using testing::block_image;
using testing::volume_of_material;

MaterialMesh deformed_mixed_mesh() {
  LabelImage image = block_image();
  MaterialMesh mesh =
      testing::paper_mesh_of_cleaned(image, {.spacing_mm = 4, .finest_spacing_mm = 4, .mixed = true});
  DeformOptions options;
  options.iterations = 4;
  deform_mesh(mesh, image, options, [](int) {});
  return mesh;
}

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
  const MaterialMesh mesh = deformed_mixed_mesh();
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
  const MaterialMesh mesh = deformed_mixed_mesh();
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

}  // namespace
}  // namespace cbc3d
