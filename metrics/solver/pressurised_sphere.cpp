#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "mesher/core/error.hpp"
#include "mesher/core/runtime.hpp"
#include "metrics/solver/manufactured.hpp"
#include "metrics/solver/sphere_phantoms.hpp"

namespace cbc3d::solver {

namespace {

constexpr getfem::size_type kCavity = FiniteElementMesh::kFirstFreeRegion;
constexpr getfem::size_type kOuter = FiniteElementMesh::kFirstFreeRegion + 1;

void split_boundary(FiniteElementMesh& mesh, const PressurisedSphereOptions& options) {
  getfem::mesh_region cavity, outer;
  const double middle = (options.cavity_radius_mm + options.layers.back().outer_radius_mm) / 2;
  const getfem::mesh_region boundary = mesh.cells().region(FiniteElementMesh::kBoundary);
  for (getfem::mr_visitor face(boundary); !face.finished(); ++face) {
    const auto corners = mesh.cells().points_of_face_of_convex(face.cv(), face.f());
    Vec3 sum{};
    for (const auto& p : corners) {
      sum += Vec3{p[0], p[1], p[2]};
    }
    const double radius = (sum / static_cast<double>(corners.size()) - options.centre_mm).norm();
    (radius < middle ? cavity : outer).add(face.cv(), face.f());
  }
  if (cavity.size() == 0) {
    throw InputError("the mesh has no facet near a cavity of radius " +
                     std::to_string(options.cavity_radius_mm) +
                     " mm for the pressure to act on; check --centre and --cavity-radius");
  }
  mesh.cells().region(kCavity) = cavity;
  mesh.cells().region(kOuter) = outer;
}

Formulas lame_formulas(const FiniteElementMesh& mesh, const PressurisedSphereOptions& options) {
  std::vector<ElasticLayer> layers;
  layers.reserve(options.layers.size());
  for (const Layer& layer : options.layers) {
    layers.push_back({layer.outer_radius_mm, options.young.at(layer.label, "Young's modulus"),
                      options.poisson_ratio.at(layer.label, "Poisson's ratio")});
  }
  const auto exact = pressurised_layers(options.cavity_radius_mm, options.pressure, layers);
  const auto layer_of = [&](Label label) {
    for (std::size_t i = 0; i < options.layers.size(); ++i) {
      if (options.layers[i].label == label) {
        return i;
      }
    }
    throw InputError("label " + std::to_string(label) +
                     " of the mesh is no layer; give its --layer LABEL=RADIUS_MM");
  };
  const auto lame = [&](Label label) {
    const ElasticLayer& layer = layers[layer_of(label)];
    return lame_of(layer.young, layer.poisson_ratio);
  };
  Formulas formulas;
  formulas.constants["centre"] = {options.centre_mm.x, options.centre_mm.y, options.centre_mm.z};
  formulas.constants["pressure"] = {options.pressure};
  formulas.cell_fields["La"] = per_cell(mesh, [&](Label label) { return lame(label).lambda; });
  formulas.cell_fields["Mu"] = per_cell(mesh, [&](Label label) { return lame(label).mu; });
  formulas.cell_fields["A"] = per_cell(mesh, [&](Label label) { return exact[layer_of(label)].a; });
  formulas.cell_fields["B"] = per_cell(mesh, [&](Label label) { return exact[layer_of(label)].b; });
  formulas.macros.emplace_back("away", "(X-centre)");
  formulas.macros.emplace_back("exact", "((A+B/pow(Norm(away),3))*away)");
  // Written out, for A and B must not be derived with it.
  formulas.macros.emplace_back("strain",
                               "((A+B/pow(Norm(away),3))*Id(3)-(3*B/pow(Norm(away),5))*(away@away))");
  formulas.macros.emplace_back("stress", "(La*Trace(strain)*Id(3)+2*Mu*strain)");
  formulas.macros.emplace_back("stress_h", "(La*Div_u*Id(3)+Mu*(Grad_u+Grad_u'))");
  formulas.macros.emplace_back("radial", "(away/Norm(away))");
  return formulas;
}

double relative(Galerkin& method, const std::string& error, const std::string& whole,
                const std::vector<double>& u) {
  const double of = method.integral(whole, u, FiniteElementMesh::kInterfaces);
  return std::sqrt(method.integral(error, u, FiniteElementMesh::kInterfaces) / of);
}

ErrorFigures displacement_error(Galerkin& method, const std::vector<double>& u) {
  const auto relative_norm = [&](const char* error, const char* whole) {
    return std::sqrt(method.integral(error, u) / method.integral(whole, u));
  };
  return {.h1_relative = relative_norm("Norm_sqr(Grad_u-strain)", "Norm_sqr(strain)"),
          .l2_relative = relative_norm("Norm_sqr(u-exact)", "Norm_sqr(exact)")};
}

}  // namespace

PressurisedSphereFigures solve_pressurised_sphere(FiniteElementMesh& mesh,
                                                  const PressurisedSphereOptions& options) {
  if (!(options.cavity_radius_mm > 0)) {
    throw InputError("a pressurised sphere needs the radius of its cavity, more than 0 mm: --cavity-radius");
  }
  require_nested(options.layers, options.cavity_radius_mm);
  PressurisedSphereFigures figures;
  const Stopwatch watch;
  split_boundary(mesh, options);
  Formulas formulas = lame_formulas(mesh, options);
  double largest = 0;
  for (std::size_t cell = 0; cell < mesh.labels().size(); ++cell) {
    largest = std::max(largest, formulas.cell_fields["La"][cell] + 2 * formulas.cell_fields["Mu"][cell]);
  }
  Galerkin method(mesh, options.order, 3, std::move(formulas));
  const auto matrix = method.matrix(kElasticForm);
  // The pressure pushes against the outward normal of the body.
  const std::vector<double> right_side = method.vector("-pressure*Normal.Test_u", kCavity);
  const std::vector<bool> held = method.on_region(kOuter);
  std::vector<double> u = method.interpolate("exact");
  figures.problem.solve.assembly_seconds = watch.seconds();
  solve_for_free(matrix, right_side, held, mesh.mean_size_mm() * largest, kResidual, u,
                 figures.problem.solve);
  figures.problem.error = displacement_error(method, u);
  figures.has_interface = mesh.cells().region(FiniteElementMesh::kInterfaces).size() > 0;
  if (figures.has_interface) {
    figures.interface_stress_relative = relative(method, "Norm_sqr(stress_h-stress)", "Norm_sqr(stress)", u);
    figures.interface_radial_stress_relative =
        relative(method, "sqr(((stress_h-stress)*radial).radial)", "sqr((stress*radial).radial)", u);
  }
  return figures;
}

void to_json(nlohmann::json& json, const PressurisedSphereFigures& figures) {
  json = figures.problem;
  if (figures.has_interface) {
    json["interface_stress_relative"] = figures.interface_stress_relative;
    json["interface_radial_stress_relative"] = figures.interface_radial_stress_relative;
  } else {
    json["interface_stress_relative"] = json["interface_radial_stress_relative"] = nullptr;
  }
}

}  // namespace cbc3d::solver
