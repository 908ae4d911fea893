#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <numeric>

#include "mesher/core/error.hpp"
#include "mesher/core/runtime.hpp"
#include "metrics/solver/sphere_phantoms.hpp"

namespace cbc3d::solver {

namespace {

/// Both potentials at the nodes of the outer surface, with the nodes' shares of it.
struct SurfacePotentials {
  std::vector<double> discrete, exact, share;

  void remove_mean(std::vector<double>& values) const {
    const double total = std::accumulate(share.begin(), share.end(), 0.0);
    const double mean = std::inner_product(share.begin(), share.end(), values.begin(), 0.0) / total;
    for (double& value : values) {
      value -= mean;
    }
  }

  /// |x a - y b|
  [[nodiscard]] double norm(double x, double y) const {
    double sum = 0;
    for (std::size_t i = 0; i < share.size(); ++i) {
      const double difference = x * discrete[i] - y * exact[i];
      sum += share[i] * difference * difference;
    }
    return std::sqrt(sum);
  }
};

std::vector<double> components(const Vec3& v) {
  return {v.x, v.y, v.z};
}

std::vector<double> layer_conductivities(const DipoleSphereOptions& options) {
  std::vector<double> found;
  for (const Layer& layer : options.layers) {
    found.push_back(options.conductivity.at(layer.label, "conductivity"));
    if (!(found.back() > 0)) {
      throw InputError("the conductivity of label " + std::to_string(layer.label) + " is not positive");
    }
  }
  return found;
}

Formulas dipole_formulas(const FiniteElementMesh& mesh, const DipoleSphereOptions& options,
                         const std::vector<double>& conductivities) {
  Formulas formulas;
  formulas.constants["place"] = components(options.dipole_place_mm);
  formulas.constants["moment"] = components(options.dipole_moment);
  formulas.constants["s0"] = {conductivities.front()};
  formulas.constants["unit"] = {1 / (4 * std::numbers::pi * conductivities.front())};
  formulas.cell_fields["sigma"] = per_cell(mesh, [&](Label label) {
    for (std::size_t i = 0; i < options.layers.size(); ++i) {
      if (options.layers[i].label == label) {
        return conductivities[i];
      }
    }
    throw InputError("label " + std::to_string(label) +
                     " of the mesh is no layer; give its --layer LABEL=RADIUS_MM");
  });
  formulas.macros.emplace_back("away", "(X-place)");
  formulas.macros.emplace_back("u0", "(unit*(moment.away)/pow(Norm(away),3))");
  formulas.macros.emplace_back("grad_u0",
                               "(unit*(moment/pow(Norm(away),3)-(3*(moment.away)/pow(Norm(away),5))*away))");
  return formulas;
}

std::vector<double> right_side_of(Galerkin& method) {
  std::vector<double> right_side = method.vector("(s0-sigma)*grad_u0.Grad_Test_u");
  const std::vector<double> flux = method.vector("-s0*(grad_u0.Normal)*Test_u", FiniteElementMesh::kBoundary);
  double sum = 0;
  for (std::size_t i = 0; i < right_side.size(); ++i) {
    sum += right_side[i] += flux[i];
  }
  // The constants are the matrix' null space; what quadrature leaves of them must go for a solution to exist.
  for (double& value : right_side) {
    value -= sum / static_cast<double>(right_side.size());
  }
  return right_side;
}

SurfacePotentials potentials_on_surface(Galerkin& method, const DipoleSphereOptions& options,
                                        const DipolePotential& exact, const std::vector<double>& correction) {
  const std::vector<double> share = method.vector("Test_u", FiniteElementMesh::kBoundary);
  const std::vector<double> u0 = method.interpolate("u0");
  const std::vector<bool> on_surface = method.on_region(FiniteElementMesh::kBoundary);
  SurfacePotentials potentials;
  for (std::size_t dof = 0; dof < share.size(); ++dof) {
    if (on_surface[dof]) {
      const auto at = method.space().point_of_basic_dof(dof);
      const Vec3 place = Vec3{at[0], at[1], at[2]} - options.centre_mm;
      potentials.discrete.push_back(u0[dof] + correction[dof]);
      potentials.exact.push_back(exact.at(place.normalized()));
      potentials.share.push_back(share[dof]);
    }
  }
  potentials.remove_mean(potentials.discrete);
  potentials.remove_mean(potentials.exact);
  return potentials;
}

}  // namespace

DipoleSphereFigures solve_dipole_sphere(const FiniteElementMesh& mesh, const DipoleSphereOptions& options) {
  require_nested(options.layers, 0);
  if (!(options.dipole_moment.norm() > 0)) {
    throw InputError("the dipole's moment is 0; give a direction and size");
  }
  const std::vector<double> conductivities = layer_conductivities(options);
  std::vector<double> radii;
  radii.reserve(options.layers.size());
  for (const Layer& layer : options.layers) {
    radii.push_back(layer.outer_radius_mm);
  }
  const DipolePotential exact(radii, conductivities, options.dipole_place_mm - options.centre_mm,
                              options.dipole_moment);
  DipoleSphereFigures figures;
  const Stopwatch watch;
  Galerkin method(mesh, options.order, 1, dipole_formulas(mesh, options, conductivities));
  const auto matrix = method.matrix("sigma*Grad_Test_u.Grad_Test2_u");
  const std::vector<double> right_side = right_side_of(method);
  std::vector<double> correction(method.dof_count());
  figures.solve.assembly_seconds = watch.seconds();
  const double largest = *std::max_element(conductivities.begin(), conductivities.end());
  solve_for_free(matrix, right_side, std::vector<bool>(method.dof_count(), false),
                 mesh.mean_size_mm() * largest, kResidual, correction, figures.solve);
  const SurfacePotentials surface = potentials_on_surface(method, options, exact, correction);
  const double discrete_norm = surface.norm(1, 0), exact_norm = surface.norm(0, 1);
  figures.rdm = surface.norm(1 / discrete_norm, 1 / exact_norm);
  figures.mag = discrete_norm / exact_norm;
  figures.potential_relative = surface.norm(1, 1) / exact_norm;
  return figures;
}

void to_json(nlohmann::json& json, const DipoleSphereFigures& figures) {
  json = figures.solve;
  json["rdm"] = figures.rdm;
  json["mag"] = figures.mag;
  json["potential_relative"] = figures.potential_relative;
}

}  // namespace cbc3d::solver
