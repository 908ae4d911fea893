#include "metrics/solver/galerkin.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "mesher/core/error.hpp"
#include "mesher/core/runtime.hpp"

namespace cbc3d::solver {

namespace {

constexpr std::size_t kHeld = static_cast<std::size_t>(-1);

void set_quadrature(getfem::mesh_im& quadrature, const FiniteElementMesh& mesh, int tet_degree,
                    int other_degree) {
  dal::bit_vector others = mesh.cells().convex_index();
  others.setminus(mesh.tets());
  if (mesh.tets().card() > 0) {
    quadrature.set_integration_method(mesh.tets(), static_cast<getfem::dim_type>(tet_degree));
  }
  if (others.card() > 0) {
    quadrature.set_integration_method(others, static_cast<getfem::dim_type>(other_degree));
  }
}

/// Numbers of the free degrees of freedom among themselves; kHeld for the others.
std::vector<std::size_t> number_free(const std::vector<bool>& held, std::size_t& count) {
  std::vector<std::size_t> number(held.size(), kHeld);
  count = 0;
  for (std::size_t i = 0; i < held.size(); ++i) {
    if (!held[i]) {
      number[i] = count++;
    }
  }
  return number;
}

/// The rows and columns of the free degrees of freedom, of a matrix that is symmetric, so its columns are its
/// rows.
SparseMatrix free_part(const getfem::model_real_sparse_matrix& matrix, const std::vector<std::size_t>& number,
                       std::size_t count) {
  SparseMatrix part(static_cast<Eigen::Index>(count), static_cast<Eigen::Index>(count));
  std::vector<int> sizes;
  for (std::size_t i = 0; i < number.size(); ++i) {
    if (number[i] != kHeld) {
      sizes.push_back(static_cast<int>(gmm::nnz(matrix.col(i))));
    }
  }
  part.reserve(sizes);
  for (std::size_t i = 0; i < number.size(); ++i) {
    if (number[i] == kHeld) {
      continue;
    }
    const auto& row = matrix.col(i);
    for (auto entry = row.begin(); entry != row.end(); ++entry) {
      const std::size_t j = number[entry->c];
      if (j != kHeld) {
        part.insert(static_cast<Eigen::Index>(number[i]), static_cast<Eigen::Index>(j)) = entry->e;
      }
    }
  }
  part.makeCompressed();
  return part;
}

/// The right-hand side without what the held values already make.
Eigen::VectorXd free_right_side(const getfem::model_real_sparse_matrix& matrix,
                                const std::vector<double>& right_side, const std::vector<std::size_t>& number,
                                std::size_t count, const std::vector<double>& u) {
  Eigen::VectorXd result(static_cast<Eigen::Index>(count));
  for (std::size_t i = 0; i < number.size(); ++i) {
    if (number[i] == kHeld) {
      continue;
    }
    double value = right_side[i];
    const auto& row = matrix.col(i);
    for (auto entry = row.begin(); entry != row.end(); ++entry) {
      if (number[entry->c] == kHeld) {
        value -= entry->e * u[entry->c];
      }
    }
    result[static_cast<Eigen::Index>(number[i])] = value;
  }
  return result;
}

/// A ratio of norms from their squares; rounding may make the upper one negative.
double ratio(double squared, double of_squared) {
  return of_squared > 0 ? std::sqrt(std::max(0.0, squared) / of_squared) : 0;
}

}  // namespace

double ByLabel::at(Label label, const char* what) const {
  const auto found = values.find(label);
  if (found != values.end()) {
    return found->second;
  }
  if (!otherwise) {
    throw InputError("label " + std::to_string(label) + " is in the mesh, but its " + what + " is not given");
  }
  return otherwise(label);
}

void to_json(nlohmann::json& json, const SolveFigures& figures) {
  json = {{"unknowns", figures.unknowns},
          {"cg_iterations", figures.cg_iterations},
          {"lambda_max", figures.lambda_max},
          {"lambda_max_h_scaled", figures.lambda_max_h_scaled}};
}

void to_json(nlohmann::json& json, const ProblemFigures& figures) {
  json = figures.solve;
  json["h1_relative"] = figures.error.h1_relative;
  json["l2_relative"] = figures.error.l2_relative;
}

Galerkin::Galerkin(const FiniteElementMesh& mesh, int order, int components, Formulas formulas)
    : mesh_(mesh),
      space_(mesh.cells(), static_cast<getfem::dim_type>(components)),
      per_cell_(mesh.cells()),
      matrix_quadrature_(mesh.cells()),
      data_quadrature_(mesh.cells()),
      formulas_(std::move(formulas)) {
  space_.set_classical_finite_element(static_cast<getfem::dim_type>(order));
  per_cell_.set_classical_discontinuous_finite_element(0);
  set_quadrature(matrix_quadrature_, mesh, order == 1 ? 1 : 2, 2 * order + 4);
  set_quadrature(data_quadrature_, mesh, order == 1 ? 5 : 8, 2 * order + 4);
  // GetFEM wants one number per degree of freedom of a field, numbered its own way.
  for (auto& [name, values] : formulas_.cell_fields) {
    std::vector<double> by_dof(values.size());
    for (std::size_t cell = 0; cell < values.size(); ++cell) {
      by_dof[per_cell_.ind_basic_dof_of_element(cell)[0]] = values[cell];
    }
    values.swap(by_dof);
  }
}

void Galerkin::introduce(getfem::ga_workspace& workspace, const std::vector<double>& u) const {
  workspace.add_fem_variable("u", space_, gmm::sub_interval(0, dof_count()), u);
  for (const auto& [name, values] : formulas_.constants) {
    workspace.add_fixed_size_constant(name, values);
  }
  for (const auto& [name, values] : formulas_.cell_fields) {
    workspace.add_fem_constant(name, per_cell_, values);
  }
  for (const auto& [name, formula] : formulas_.macros) {
    workspace.add_macro(name, formula);
  }
}

std::vector<bool> Galerkin::on_region(getfem::size_type region) const {
  const dal::bit_vector found = space_.basic_dof_on_region(mesh_.cells().region(region));
  std::vector<bool> is(dof_count(), false);
  for (dal::bv_visitor dof(found); !dof.finished(); ++dof) {
    is[dof] = true;
  }
  return is;
}

getfem::model_real_sparse_matrix Galerkin::matrix(const std::string& form) {
  const std::vector<double> u(dof_count());
  getfem::model_real_sparse_matrix matrix(dof_count(), dof_count());
  getfem::ga_workspace workspace;
  introduce(workspace, u);
  workspace.add_expression(form, matrix_quadrature_);
  workspace.set_assembled_matrix(matrix);
  workspace.assembly(2);
  return matrix;
}

std::vector<double> Galerkin::vector(const std::string& form, getfem::size_type region) {
  const std::vector<double> u(dof_count());
  getfem::ga_workspace workspace;
  introduce(workspace, u);
  workspace.add_expression(form, data_quadrature_, mesh_.cells().region(region));
  workspace.assembly(1);
  return workspace.assembled_vector();
}

double Galerkin::integral(const std::string& formula, const std::vector<double>& u,
                          getfem::size_type region) {
  getfem::ga_workspace workspace;
  introduce(workspace, u);
  workspace.add_expression(formula, data_quadrature_, mesh_.cells().region(region));
  workspace.assembly(0);
  return workspace.assembled_potential();
}

std::vector<double> Galerkin::interpolate(const std::string& formula) {
  const std::vector<double> u(dof_count());
  getfem::ga_workspace workspace;
  introduce(workspace, u);
  workspace.add_interpolation_expression(formula, mesh_.cells());
  std::vector<double> values(dof_count());
  getfem::ga_interpolation_Lagrange_fem(workspace, space_, values);
  return values;
}

ErrorFigures Galerkin::error(const std::vector<double>& u) {
  return {
      .h1_relative = ratio(integral("Norm_sqr(Grad_u-Grad(exact))", u), integral("Norm_sqr(Grad(exact))", u)),
      .l2_relative = ratio(integral("Norm_sqr(u-exact)", u), integral("Norm_sqr(exact)", u))};
}

void solve_for_free(const getfem::model_real_sparse_matrix& matrix, const std::vector<double>& right_side,
                    const std::vector<bool>& held, double scale, double residual, std::vector<double>& u,
                    SolveFigures& figures) {
  const Stopwatch watch;
  std::size_t count = 0;
  const std::vector<std::size_t> number = number_free(held, count);
  const SparseMatrix part = free_part(matrix, number, count);
  const Solution solution = solve(part, free_right_side(matrix, right_side, number, count, u), residual);
  for (std::size_t i = 0; i < number.size(); ++i) {
    if (number[i] != kHeld) {
      u[i] = solution.x[static_cast<Eigen::Index>(number[i])];
    }
  }
  figures.unknowns = count;
  figures.cg_iterations = solution.iterations;
  figures.solve_seconds = watch.seconds();
  figures.lambda_max = largest_scaled_eigenvalue(part);
  figures.lambda_max_h_scaled = largest_eigenvalue(part) / scale;
}

std::vector<double> per_cell(const FiniteElementMesh& mesh, const std::function<double(Label)>& value) {
  std::map<Label, double> known;
  std::vector<double> values;
  values.reserve(mesh.labels().size());
  for (const Label label : mesh.labels()) {
    auto found = known.find(label);
    if (found == known.end()) {
      found = known.emplace(label, value(label)).first;
    }
    values.push_back(found->second);
  }
  return values;
}

}  // namespace cbc3d::solver
