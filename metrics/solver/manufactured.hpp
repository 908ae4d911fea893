// Poisson's equation and linear elasticity with an exact field that is chosen, on any mesh with any labels.
//
// The exact field is one smooth function over all labels, so with piecewise coefficients its flux jumps at
// interfaces. No source density is computed: the right-hand side is the weak form of the exact field itself,
//   find u_h in V_h: u_h = u at the boundary's nodes,  a(u_h, v) = a(u, v) for all v in V_h that vanish
//   there,
// which holds the jump exactly, wherever the interfaces lie. So u_h is the best approximation of u that V_h
// has in the energy norm, and its error is the mesh's alone, whatever surface it gives the image.
#pragma once

#include "metrics/solver/galerkin.hpp"

namespace cbc3d::solver {

struct PoissonOptions {
  int order = 1;  ///< of the elements: 1 or 2
  /// Where the exact field is laid: two meshes are compared by one box.
  Box box;
  /// By default .25, 1 or 4, as label modulo 3 is 0, 1 or 2.
  ByLabel conductivity{{}, [](Label label) { return label % 3 == 0 ? .25 : label % 3 == 1 ? 1.0 : 4.0; }};
  /// The exact field as a formula of X; empty: w(X) = cos(q1) cos(q2) cos(q3), q = 4 pi / 3 (X - lower corner
  /// of the box) / longest side of the box, a wave one and a half times as long as the box.
  std::string exact{};
  double residual = kResidual;
};

/// - div(conductivity grad u) = f with u given at the boundary.
ProblemFigures solve_poisson(const FiniteElementMesh& mesh, const PoissonOptions& options);

struct ElasticityOptions {
  int order = 1;
  Box box;
  /// Young's modulus, by default as the conductivity of PoissonOptions.
  ByLabel young{{}, PoissonOptions{}.conductivity.otherwise};
  ByLabel poisson_ratio{{}, [](Label) { return .3; }};
  /// The exact displacement; empty: (cos cos cos, sin cos cos, cos sin cos) of the q above.
  std::string exact{};
  double residual = kResidual;
};

/// - div(lambda div u I + mu (grad u + grad u^T)) = f with u given at the boundary.
ProblemFigures solve_elasticity(const FiniteElementMesh& mesh, const ElasticityOptions& options);

/// Lame's constants of Young's modulus E and Poisson's ratio nu. Throws InputError unless E > 0 and -1 < nu <
/// .5.
struct Lame {
  double lambda, mu;
};
Lame lame_of(double young, double poisson_ratio);

/// The elastic bilinear form, of cell fields La and Mu.
inline constexpr const char* kElasticForm =
    "La*Div_Test_u*Div_Test2_u+Mu*(Grad_Test_u+Grad_Test_u'):Grad_Test2_u";

}  // namespace cbc3d::solver
