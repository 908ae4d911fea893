// cbc3d-solve: judges a mesh by what a finite-element solver makes of it. GetFEM is linked into this one
// program alone.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"
#include "mesher/core/image_io.hpp"
#include "mesher/core/json_text.hpp"
#include "mesher/core/runtime.hpp"
#include "mesher/core/terminal_progress.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"
#include "metrics/solver/manufactured.hpp"
#include "metrics/solver/sphere_phantoms.hpp"

namespace {

using cbc3d::InputError;
using cbc3d::Label;
using cbc3d::Vec3;
namespace solver = cbc3d::solver;

struct Options {
  std::string mesh, json, image;
  std::vector<std::string> problems{"poisson"};
  std::vector<int> orders{1, 2};
  std::vector<double> box, centre{0, 0, 0}, place, moment{0, 0, 1};
  std::vector<std::string> conductivity, young, poisson_ratio, layers;
  double cavity_radius_mm = 0, pressure = 1;
  int threads = 0;
  bool quiet = false;
};

/// LABEL=VALUE of an option.
std::pair<Label, double> parse_pair(const std::string& option, const std::string& text) {
  std::istringstream in(text);
  Label label = 0;
  char equals = 0;
  double value = 0;
  if (!(in >> label >> equals >> value) || equals != '=' || !in.eof()) {
    throw InputError(option + " " + text + ": not of the form LABEL=NUMBER, as 2=0.33");
  }
  return {label, value};
}

void set_values(solver::ByLabel& by_label, const std::string& option, const std::vector<std::string>& texts) {
  for (const std::string& text : texts) {
    by_label.values.insert_or_assign(parse_pair(option, text).first, parse_pair(option, text).second);
  }
}

std::vector<solver::Layer> parse_layers(const std::vector<std::string>& texts) {
  std::vector<solver::Layer> layers;
  for (const std::string& text : texts) {
    const auto [label, radius] = parse_pair("--layer", text);
    layers.push_back({label, radius});
  }
  return layers;
}

Vec3 to_vec3(const std::vector<double>& v) {
  return {v[0], v[1], v[2]};
}

/// The box, in the mesh's frame, around the box of the labelled voxels in the image's.
solver::Box box_of_labels(const cbc3d::LabelImage& image) {
  cbc3d::Index3 first = image.frame.size, last{-1, -1, -1};
  for (std::size_t v = 0; v < image.voxels.size(); ++v) {
    if (image.voxels[v] != cbc3d::kBackground) {
      const cbc3d::Index3 at = image.frame.index_of(v);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        first[axis] = std::min(first[axis], at[axis]);
        last[axis] = std::max(last[axis], at[axis]);
      }
    }
  }
  cbc3d::Mesh corners;
  for (unsigned corner = 0; corner < 8; ++corner) {
    Vec3 place;
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      const double index = (corner >> a & 1U) == 0 ? first[a] - .5 : last[a] + .5;
      place[axis] = index * image.frame.spacing_mm[axis];
    }
    corners.points.push_back(image.frame.to_physical(place));
  }
  corners.hexes.add({0, 1, 2, 3, 4, 5, 6, 7}, 1);
  return solver::bounding_box(corners);
}

/// The box of the exact fields, and where it is from.
std::pair<solver::Box, std::string> find_box(const Options& options, const solver::FiniteElementMesh& mesh) {
  if (!options.box.empty()) {
    const auto& b = options.box;
    return {{{b[0], b[1], b[2]}, {b[3], b[4], b[5]}}, "option"};
  }
  if (!options.image.empty()) {
    return {box_of_labels(cbc3d::read_label_image(options.image)), "image"};
  }
  return {mesh.box(), "mesh"};
}

/// The figures of the problems, and beside them what differs from run to run.
struct Results {
  nlohmann::json figures = nlohmann::json::object(), seconds = nlohmann::json::object();

  template <typename Figures>
  void add(const std::string& key, const Figures& found, const solver::SolveFigures& solve) {
    figures[key] = found;
    seconds[key] = {{"assembly", solve.assembly_seconds}, {"solve", solve.solve_seconds}};
  }
};

void run_poisson(const Options& options, const solver::FiniteElementMesh& mesh, const solver::Box& box,
                 int order, Results& results) {
  solver::PoissonOptions problem{.order = order, .box = box};
  set_values(problem.conductivity, "--conductivity", options.conductivity);
  const auto found = solver::solve_poisson(mesh, problem);
  results.add("poisson_p" + std::to_string(order), found, found.solve);
}

void run_elasticity(const Options& options, const solver::FiniteElementMesh& mesh, const solver::Box& box,
                    int order, Results& results) {
  solver::ElasticityOptions problem{.order = order, .box = box};
  set_values(problem.young, "--young", options.young);
  set_values(problem.poisson_ratio, "--poisson-ratio", options.poisson_ratio);
  const auto found = solver::solve_elasticity(mesh, problem);
  results.add("elasticity_p" + std::to_string(order), found, found.solve);
}

void run_dipole_sphere(const Options& options, const solver::FiniteElementMesh& mesh, int order,
                       Results& results) {
  solver::DipoleSphereOptions problem{.order = order, .centre_mm = to_vec3(options.centre)};
  problem.layers = parse_layers(options.layers);
  set_values(problem.conductivity, "--conductivity", options.conductivity);
  // Halfway out along z is deep enough for a coarse mesh and still not the trivial centre.
  problem.dipole_place_mm =
      !options.place.empty()
          ? to_vec3(options.place)
          : problem.centre_mm +
                Vec3{0, 0, problem.layers.empty() ? 0 : problem.layers.front().outer_radius_mm / 2};
  problem.dipole_moment = to_vec3(options.moment);
  const auto found = solver::solve_dipole_sphere(mesh, problem);
  results.add("dipole_sphere_p" + std::to_string(order), found, found.solve);
}

void run_pressurised_sphere(const Options& options, solver::FiniteElementMesh& mesh, int order,
                            Results& results) {
  solver::PressurisedSphereOptions problem{
      .order = order, .centre_mm = to_vec3(options.centre), .cavity_radius_mm = options.cavity_radius_mm};
  problem.layers = parse_layers(options.layers);
  problem.pressure = options.pressure;
  set_values(problem.young, "--young", options.young);
  set_values(problem.poisson_ratio, "--poisson-ratio", options.poisson_ratio);
  const auto found = solver::solve_pressurised_sphere(mesh, problem);
  results.add("pressurised_sphere_p" + std::to_string(order), found, found.problem.solve);
}

void run_problem(const std::string& name, const Options& options, solver::FiniteElementMesh& mesh,
                 const solver::Box& box, int order, Results& results) {
  if (name == "poisson") {
    run_poisson(options, mesh, box, order, results);
  } else if (name == "elasticity") {
    run_elasticity(options, mesh, box, order, results);
  } else if (name == "dipole-sphere") {
    run_dipole_sphere(options, mesh, order, results);
  } else {
    run_pressurised_sphere(options, mesh, order, results);
  }
}

void write(const Options& options, const nlohmann::json& report) {
  const std::string text = cbc3d::json_text(report) + "\n";
  if (options.json.empty()) {
    std::cout << text;
  } else {
    cbc3d::write_text_file(options.json, text);
  }
}

int run(const Options& options) {
  cbc3d::set_thread_count(options.threads);
  if (!options.json.empty()) {
    cbc3d::require_writable(options.json);
  }
  cbc3d::TerminalProgress progress(options.quiet);
  progress.step("reading", 0);
  solver::FiniteElementMesh mesh(cbc3d::read_mesh(options.mesh), options.mesh);
  const auto [box, box_from] = find_box(options, mesh);
  Results results;
  const auto count = static_cast<double>(options.problems.size() * options.orders.size());
  double done = 0;
  for (const std::string& problem : options.problems) {
    for (const int order : options.orders) {
      progress.step(problem + ", order " + std::to_string(order), .1 + .9 * done++ / count);
      run_problem(problem, options, mesh, box, order, results);
    }
  }
  results.figures["box_mm"] = {box.lower.x, box.lower.y, box.lower.z, box.upper.x, box.upper.y, box.upper.z};
  results.figures["box_from"] = box_from;
  write(options, {{"solver", results.figures},
                  {"time_s", results.seconds},
                  {"peak_rss_bytes", cbc3d::process_peak_rss_bytes()}});
  return cbc3d::kExitSuccess;
}

void add_material_options(CLI::App& app, Options& options) {
  app.add_option(
      "--conductivity", options.conductivity,
      "LABEL=NUMBER ...: conductivity of a label; poisson: .25, 1 or 4 (label modulo 3 = 0, 1, 2) unless "
      "given; dipole-sphere: of every layer");
  app.add_option(
      "--young", options.young,
      "LABEL=NUMBER ...: Young's modulus of a label; elasticity: as the conductivity unless given");
  app.add_option("--poisson-ratio", options.poisson_ratio,
                 "LABEL=NUMBER ...: Poisson's ratio of a label, below .5; elasticity: .3 unless given");
}

void add_sphere_options(CLI::App& app, Options& options) {
  app.add_option("--layer", options.layers,
                 "LABEL=RADIUS ...: outer radius of each layer of a sphere, from inside outwards [mm]");
  app.add_option("--centre", options.centre, "X,Y,Z of the sphere's centre [mm]")
      ->delimiter(',')
      ->expected(3)
      ->capture_default_str();
  app.add_option("--dipole-place", options.place,
                 "X,Y,Z of the dipole; unless given, above the centre by half the innermost radius [mm]")
      ->delimiter(',')
      ->expected(3);
  app.add_option("--dipole-moment", options.moment, "X,Y,Z of the dipole's moment; its size does not matter")
      ->delimiter(',')
      ->expected(3)
      ->capture_default_str();
  app.add_option("--cavity-radius", options.cavity_radius_mm, "radius of the pressurised cavity [mm]")
      ->check(CLI::PositiveNumber);
  app.add_option("--pressure", options.pressure, "in the cavity, in the unit of Young's modulus")
      ->capture_default_str();
}

void add_options(CLI::App& app, Options& options) {
  app.add_option("MESH", options.mesh, "mesh file: .vtu, .vtk or .msh")->required();
  app.add_option("--json", options.json, "JSON file to write; unless given, JSON goes to standard output");
  app.add_option("--problem", options.problems, "problems to solve")
      ->check(CLI::IsMember({"poisson", "elasticity", "dipole-sphere", "pressurised-sphere"}))
      ->capture_default_str();
  app.add_option("--order", options.orders, "orders of the elements, 1 and 2")
      ->check(CLI::IsMember({1, 2}))
      ->capture_default_str();
  CLI::Option* image = app.add_option(
      "--image", options.image,
      "label image of the mesh: the box of its labelled voxels places the exact field of poisson and "
      "elasticity, so that meshes of one image get one problem; unless given, the mesh's own box does");
  app.add_option("--box", options.box, "X0,Y0,Z0,X1,Y1,Z1: that box itself [mm]")
      ->delimiter(',')
      ->expected(6)
      ->excludes(image);
  add_material_options(app, options);
  add_sphere_options(app, options);
  app.add_option("--threads", options.threads, "threads; 0: all cores")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_flag("--quiet", options.quiet, "no progress");
}

}  // namespace

int main(int argc, char** argv) {
  cbc3d::open_standard_streams();
  cbc3d::let_waiting_threads_sleep(argv);
  CLI::App app{"Judges a mesh by finite-element solutions on it, against exact ones"};
  Options options;
  add_options(app, options);
  // What GetFEM has to say comes as an exception, not on standard output.
  gmm::set_warning_level(0);
  gmm::set_traces_level(0);
  try {
    app.parse(argc, argv);
    return run(options);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? cbc3d::kExitSuccess : cbc3d::kExitBadInput;
  } catch (const InputError& error) {
    std::cerr << error.what() << '\n';
    return cbc3d::kExitBadInput;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return cbc3d::kExitJobFailed;
  }
}
