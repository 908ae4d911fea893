#include "metrics/solver/manufactured.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesher/core/error.hpp"
#include "mesher/core/runtime.hpp"

namespace cbc3d::solver {

namespace {

/// The place in waves of the exact field, and the names of its sines and cosines.
void add_waves(Formulas& formulas, const Box& box) {
  formulas.constants["origin"] = {box.lower.x, box.lower.y, box.lower.z};
  formulas.constants["wave"] = {4 * std::numbers::pi / 3 / box.longest_side()};
  for (const char* axis : {"1", "2", "3"}) {
    const std::string q = std::string("(wave*(X(") + axis + ")-origin(" + axis + ")))";
    formulas.macros.emplace_back(std::string("c") + axis, "cos" + q);
    formulas.macros.emplace_back(std::string("s") + axis, "sin" + q);
  }
}

ProblemFigures solve_manufactured(const FiniteElementMesh& mesh, int order, int components, Formulas formulas,
                                  const std::string& bilinear, const std::string& linear,
                                  double largest_coefficient, double residual) {
  ProblemFigures figures;
  const Stopwatch watch;
  Galerkin method(mesh, order, components, std::move(formulas));
  const auto matrix = method.matrix(bilinear);
  const auto right_side = method.vector(linear);
  const auto held = method.on_region(FiniteElementMesh::kBoundary);
  std::vector<double> u = method.interpolate("exact");
  figures.solve.assembly_seconds = watch.seconds();
  solve_for_free(matrix, right_side, held, mesh.mean_size_mm() * largest_coefficient, residual, u,
                 figures.solve);
  figures.error = method.error(u);
  return figures;
}

void require_box(const Box& box) {
  if (!(box.longest_side() > 0)) {
    throw InputError("the box of the exact field has no extent; give two different corners");
  }
}

}  // namespace

ProblemFigures solve_poisson(const FiniteElementMesh& mesh, const PoissonOptions& options) {
  require_box(options.box);
  Formulas formulas;
  add_waves(formulas, options.box);
  formulas.macros.emplace_back("exact", options.exact.empty() ? "c1*c2*c3" : options.exact);
  std::vector<double>& sigma = formulas.cell_fields["sigma"] =
      per_cell(mesh, [&](Label label) { return options.conductivity.at(label, "conductivity"); });
  const auto [least, most] = std::minmax_element(sigma.begin(), sigma.end());
  if (!(*least > 0)) {
    throw InputError("a conductivity of " + std::to_string(*least) + " is not positive");
  }
  const double largest = *most;
  return solve_manufactured(mesh, options.order, 1, std::move(formulas), "sigma*Grad_Test_u.Grad_Test2_u",
                            "sigma*Grad(exact).Grad_Test_u", largest, options.residual);
}

Lame lame_of(double young, double poisson_ratio) {
  if (!(young > 0) || !(poisson_ratio > -1 && poisson_ratio < .5)) {
    throw InputError("Young's modulus " + std::to_string(young) + " with Poisson's ratio " +
                     std::to_string(poisson_ratio) + ": the first must be positive, the second in (-1, .5)");
  }
  return {young * poisson_ratio / ((1 + poisson_ratio) * (1 - 2 * poisson_ratio)),
          young / (2 * (1 + poisson_ratio))};
}

ProblemFigures solve_elasticity(const FiniteElementMesh& mesh, const ElasticityOptions& options) {
  require_box(options.box);
  Formulas formulas;
  add_waves(formulas, options.box);
  formulas.macros.emplace_back("exact",
                               options.exact.empty() ? "[c1*c2*c3;s1*c2*c3;c1*s2*c3]" : options.exact);
  const auto lame = [&](Label label) {
    return lame_of(options.young.at(label, "Young's modulus"),
                   options.poisson_ratio.at(label, "Poisson's ratio"));
  };
  formulas.cell_fields["La"] = per_cell(mesh, [&](Label label) { return lame(label).lambda; });
  formulas.cell_fields["Mu"] = per_cell(mesh, [&](Label label) { return lame(label).mu; });
  // The modulus of a longitudinal wave, lambda + 2 mu, is the largest coefficient of a material.
  const auto stiffness = per_cell(mesh, [&](Label label) { return lame(label).lambda + 2 * lame(label).mu; });
  const double largest = *std::max_element(stiffness.begin(), stiffness.end());
  return solve_manufactured(mesh, options.order, 3, std::move(formulas), kElasticForm,
                            "(La*Trace(Grad(exact))*Id(3)+Mu*(Grad(exact)+Grad(exact)')):Grad_Test_u",
                            largest, options.residual);
}

}  // namespace cbc3d::solver
