// Galerkin's method on a labelled mesh with GetFEM: what the problems share.
//
// Notation: u the exact field, v a test function, u_h the discrete field; "basic dof" is GetFEM's word for a
// degree of freedom. Formulas are in GetFEM's language for weak forms (GWFL), where X is the place.
#pragma once

#include <getfem/getfem_generic_assembly.h>
#include <getfem/getfem_mesh_fem.h>
#include <getfem/getfem_mesh_im.h>

#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "metrics/solver/finite_element_mesh.hpp"
#include "metrics/solver/linear_system.hpp"

namespace cbc3d::solver {

/// A material's number for every label: what is set, or the default.
struct ByLabel {
  std::map<Label, double> values;
  std::function<double(Label)> otherwise;

  /// Throws InputError for a label that nothing is known of, saying `what` is missing.
  [[nodiscard]] double at(Label label, const char* what) const;
};

/// Constants, fields and macros that formulas may name.
struct Formulas {
  std::map<std::string, std::vector<double>> constants;
  /// One number per cell.
  std::map<std::string, std::vector<double>> cell_fields;
  /// In an order in which each uses only those before it.
  std::vector<std::pair<std::string, std::string>> macros;
};

/// What a solve costs and how well it is conditioned.
struct SolveFigures {
  std::size_t unknowns = 0;
  std::ptrdiff_t cg_iterations = 0;
  double lambda_max = 0;           ///< of the matrix scaled by its diagonal on both sides
  double lambda_max_h_scaled = 0;  ///< of the matrix itself, over mean cell size (mm) and largest coefficient
  double assembly_seconds = 0, solve_seconds = 0;
};

struct ErrorFigures {
  double h1_relative = 0;  ///< |grad (u - u_h)| / |grad u|, norms in L2 of the mesh
  double l2_relative = 0;  ///< |u - u_h| / |u|
};

struct ProblemFigures {
  SolveFigures solve;
  ErrorFigures error;
};

void to_json(nlohmann::json& json, const ProblemFigures& figures);
void to_json(nlohmann::json& json, const SolveFigures& figures);

/// Continuous piecewise polynomials of a mesh, of one or three components, with all quadrature that is
/// needed: on tets exact for the matrix, and of degree 5 (order 1) or 8 (order 2) for data; on the other
/// cells of degree 2 order + 4.
class Galerkin {
 public:
  /// `order` is 1 or 2; `mesh` must outlive this.
  Galerkin(const FiniteElementMesh& mesh, int order, int components, Formulas formulas);

  [[nodiscard]] std::size_t dof_count() const { return space_.nb_dof(); }
  /// Degrees of freedom on the faces of a region.
  [[nodiscard]] std::vector<bool> on_region(getfem::size_type region) const;
  [[nodiscard]] const getfem::mesh_fem& space() const { return space_; }

  /// The matrix of a form bilinear in Test_u and Test2_u.
  [[nodiscard]] getfem::model_real_sparse_matrix matrix(const std::string& form);
  /// The vector of a form linear in Test_u, over a region or all cells.
  [[nodiscard]] std::vector<double> vector(const std::string& form, getfem::size_type region = kAllCells);
  /// The integral of a formula that may use the discrete field u.
  [[nodiscard]] double integral(const std::string& formula, const std::vector<double>& u,
                                getfem::size_type region = kAllCells);
  /// The values of a formula at the nodes.
  [[nodiscard]] std::vector<double> interpolate(const std::string& formula);
  /// The error of u against the macro `exact`.
  [[nodiscard]] ErrorFigures error(const std::vector<double>& u);

 private:
  static constexpr getfem::size_type kAllCells = getfem::size_type(-1);
  void introduce(getfem::ga_workspace& workspace, const std::vector<double>& u) const;

  const FiniteElementMesh& mesh_;
  getfem::mesh_fem space_, per_cell_;
  getfem::mesh_im matrix_quadrature_, data_quadrature_;
  Formulas formulas_;
};

/// Solves matrix u = right_side for the degrees of freedom that are not held; held ones keep the value they
/// have in `u`. Fills unknowns, iterations, eigenvalues (that of the unscaled matrix over `scale`) and
/// seconds of solving.
void solve_for_free(const getfem::model_real_sparse_matrix& matrix, const std::vector<double>& right_side,
                    const std::vector<bool>& held, double scale, double residual, std::vector<double>& u,
                    SolveFigures& figures);

/// The numbers of every cell, by its label.
std::vector<double> per_cell(const FiniteElementMesh& mesh, const std::function<double(Label)>& value);

}  // namespace cbc3d::solver
