// The two phantoms whose true solutions are known: a dipole in conducting layers, and elastic layers around a
// cavity under pressure. Here a mesh's surface counts too: its facets are not the sphere, its labels not the
// layers.
#pragma once

#include "metrics/solver/galerkin.hpp"
#include "metrics/solver/spherical_layers.hpp"

namespace cbc3d::solver {

struct DipoleSphereOptions {
  int order = 1;
  Vec3 centre_mm{};
  std::vector<Layer> layers{};  ///< from inside outwards
  ByLabel conductivity{};       ///< of every layer; only the ratios change the figures
  Vec3 dipole_place_mm{};       ///< in the mesh's frame, inside the innermost layer
  Vec3 dipole_moment{};
};

/// Errors on the outer surface, in the norm |v|^2 = integral of v^2 with each vertex' share of the surface;
/// u_h discrete and u exact potential, each less its mean.
struct DipoleSphereFigures {
  SolveFigures solve;
  double rdm = 0;  ///< | u_h/|u_h| - u/|u| |, 0 to 2: the difference in shape (Meijs et al. 1989)
  double mag = 0;  ///< |u_h| / |u|: the difference in size; 1 at best
  double potential_relative = 0;  ///< |u_h - u| / |u|
};

/// The forward problem of EEG by full subtraction (Wolters et al., "Numerical mathematics of the subtraction
/// approach for the modeling of a current dipole in EEG source reconstruction using finite element head
/// models", SIAM J. Sci. Comput. 30, 2007): u = u0 + w with u0 the dipole in an endless medium of the
/// innermost layer's conductivity s0, and
///   integral of s grad w . grad v = integral of (s0 - s) grad u0 . grad v - boundary integral of s0 du0/dn
///   v.
/// The dipole's singularity is never integrated, for s = s0 around it. Throws InputError for a label without
/// layer.
DipoleSphereFigures solve_dipole_sphere(const FiniteElementMesh& mesh, const DipoleSphereOptions& options);

struct PressurisedSphereOptions {
  int order = 1;
  Vec3 centre_mm{};
  double cavity_radius_mm = 0;
  std::vector<Layer> layers{};
  double pressure = 1;  ///< in the cavity, in the unit of Young's modulus
  ByLabel young{}, poisson_ratio{};
};

/// The exact field in a cell is that of the cell's label.
struct PressurisedSphereFigures {
  ProblemFigures problem;  ///< errors of the displacement
  /// Over the facets between labels, from both sides: |s_h - s| / |s| of the stress tensor, and of its radial
  /// component, which is continuous. null without such facets.
  double interface_stress_relative = 0, interface_radial_stress_relative = 0;
  bool has_interface = false;
};

/// Lame's problem. The cavity's facets carry the pressure, the outer ones are held at the exact displacement,
/// so that the body cannot move as a whole. Boundary facets belong to the nearer of the two spheres. Throws
/// InputError for a label without layer, and where the mesh has no facet at the cavity.
PressurisedSphereFigures solve_pressurised_sphere(FiniteElementMesh& mesh,
                                                  const PressurisedSphereOptions& options);

void to_json(nlohmann::json& json, const DipoleSphereFigures& figures);
void to_json(nlohmann::json& json, const PressurisedSphereFigures& figures);

}  // namespace cbc3d::solver
