#include "reports/interfaces/python/work.hpp"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mesher/core/error.hpp"
#include "mesher/core/runtime.hpp"
#include "mesher/input/named_text.hpp"
#include "mesher/input/names_json.hpp"
#include "mesher/pipeline/improve_given_mesh.hpp"
#include "mesher/pipeline/mesh_findings.hpp"
#include "mesher/pipeline/mesh_image.hpp"
#include "mesher/pipeline/presets.hpp"
#include "metrics/evaluate_mesh.hpp"
#include "reports/interfaces/python/input_values.hpp"
#include "reports/interfaces/python/keyword_names.hpp"
#include "reports/interfaces/python/label_names.hpp"
#include "reports/interfaces/python/label_values.hpp"
#include "reports/interfaces/python/option_values.hpp"
#include "reports/interfaces/python/watched_work.hpp"

namespace cbc3d::python {
namespace {

namespace py = pybind11;
using py::literals::operator""_a;
using Numbers3 = std::array<double, 3>;
using Numbers9 = std::array<double, 9>;

/// A label array with its place in space, as Python hands it over.
struct PlacedArray {
  py::array array;
  Numbers3 spacing_mm, origin_mm;
  Numbers9 direction;
  std::string axes;
};

PlacedArray placed(const py::tuple& image) {
  return {image[0].cast<py::array>(), image[1].cast<Numbers3>(), image[2].cast<Numbers3>(),
          image[3].cast<Numbers9>(), image[4].cast<std::string>()};
}

/// What of the array had to be copied is freed before this returns.
LabelImage label_image(const PlacedArray& placed) {
  const LabelValues values = label_values(placed.array, placed.axes);
  const py::gil_scoped_release released;
  return to_label_image(values.values,
                        frame_of(values.size, placed.spacing_mm, placed.origin_mm, placed.direction));
}

LabelImage read(const PlacedArray& placed, ImageInput& input) {
  LabelImage image = label_image(placed);
  const py::gil_scoped_release released;
  apply_choices(image, input);
  return image;
}

/// Warnings of the choices, then those of the work.
std::vector<std::string> warnings_of(const ImageInput& input, const std::vector<std::string>& of_work,
                                     const LabelNames& names) {
  std::vector<std::string> all;
  for (const auto* const some : {&input.warnings, &of_work}) {
    for (const std::string& warning : *some) all.push_back(with_names(with_keywords(warning), names));
  }
  return all;
}

py::dict seconds_of(const StageSeconds& stages) {
  py::dict seconds;
  for (const auto& [name, value] : stages) {
    seconds[name.c_str()] = value;
  }
  return seconds;
}

/// A mesh of either order, and what happened on the way to it.
struct Meshed {
  std::shared_ptr<Mesh> mesh;
  std::shared_ptr<QuadraticMesh> quadratic;
  MeshImageReport report;

  [[nodiscard]] py::object object() const { return quadratic ? py::cast(quadratic) : py::cast(mesh); }
};

struct MeshWork {
  LabelImage image;
  MeshImageOptions options;
  int order = 1, threads = 0;

  Meshed operator()(const ProgressObserver& observer) {
    set_thread_count(threads);
    Meshed meshed;
    const ImageFrame frame = image.frame;
    const Progress progress(observer);
    Mesh linear;
    if (order == 2) {
      meshed.quadratic = std::make_shared<QuadraticMesh>(
          mesh_image_quadratic(std::move(image), options, progress, meshed.report));
      linear = corner_mesh(*meshed.quadratic);
    } else {
      linear = mesh_image(std::move(image), options, progress, meshed.report);
    }
    if (linear.cell_count() == 0) {
      throw JobError(
          "the mesh is empty: no label is larger than the lattice; give a smaller lattice_spacing_mm");
    }
    for (std::string& finding : mesh_findings(linear, meshed.report, frame)) {
      meshed.report.warnings.push_back(std::move(finding));
    }
    if (order == 1) meshed.mesh = std::make_shared<Mesh>(std::move(linear));
    return meshed;
  }
};

py::object mesh_array(const py::tuple& given, const std::string& preset, int order, int threads,
                      py::dict keywords, const py::object& progress) {
  if (order != 1 && order != 2) throw InputError("order " + std::to_string(order) + ": give 1 or 2", "order");
  ImageInput input = take_choices(keywords);
  const OptionSettings settings = settings_of(keywords);
  set_thread_count(threads);
  MeshWork work{.image = read(placed(given), input), .options = {}, .order = order, .threads = threads};
  work.options = preset_options(preset, work.image.frame);
  apply_settings(settings, work.options);
  require_known_labels(work.options, work.image);
  const Meshed meshed = watched(progress, std::move(work));
  py::object result = meshed.object();
  set_names(result, input.names);
  result.attr("warnings") = warnings_of(input, meshed.report.warnings, input.names);
  result.attr("seconds") = seconds_of(meshed.report.stage_seconds);
  return result;
}

struct Improved {
  std::shared_ptr<Mesh> mesh;
  ImproveGivenMeshReport report;
};

struct ImproveWork {
  std::shared_ptr<const Mesh> mesh;
  std::optional<LabelImage> image;
  ImproveGivenMeshOptions options;
  int threads = 0;

  Improved operator()(const ProgressObserver& observer) const {
    set_thread_count(threads);
    Improved improved;
    improved.mesh = std::make_shared<Mesh>(
        improve_given_mesh(*mesh, image ? &*image : nullptr, options, Progress(observer), improved.report));
    return improved;
  }
};

ImproveGivenMeshOptions improve_options(const py::object& min_dihedral, double max_deviation_mm,
                                        bool decimate) {
  if (!(max_deviation_mm >= 0)) {
    throw InputError("max_deviation: give a number of mm, at least 0", "max_deviation_mm");
  }
  MeshImageOptions all;
  all.improve = given_mesh_defaults();
  apply_settings(settings_of(py::dict("min_dihedral"_a = min_dihedral)), all);
  return {.improve = all.improve, .max_deviation_mm = max_deviation_mm, .decimate = decimate};
}

/// What is left of the keywords is none.
void require_no_more(const py::dict& keywords) {
  for (const auto& [keyword, value] : keywords) {
    throw InputError(std::string(py::str(keyword)) + ": there is no such option");
  }
}

py::object improve_mesh(const std::shared_ptr<Mesh>& mesh, const std::optional<py::tuple>& given,
                        const py::object& min_dihedral, double max_deviation_mm, bool decimate, int threads,
                        py::dict keywords, const py::object& progress) {
  ImageInput input = take_choices(keywords);
  require_no_more(keywords);
  ImproveWork work{.mesh = mesh,
                   .image = {},
                   .options = improve_options(min_dihedral, max_deviation_mm, decimate),
                   .threads = threads};
  set_thread_count(threads);
  if (given) work.image = read(placed(*given), input);
  input.names.add_unknown(names_of(py::cast(mesh)));
  const Improved improved = watched(progress, std::move(work));
  py::object result = py::cast(improved.mesh);
  set_names(result, input.names);
  result.attr("warnings") = warnings_of(input, improved.report.warnings, input.names);
  result.attr("seconds") = seconds_of(improved.report.improve.part_seconds);
  return result;
}

struct EvaluateWork {
  std::shared_ptr<const Mesh> mesh;
  LabelImage image;
  metrics::EvaluateMeshOptions options;
  int threads = 0;

  std::string operator()(const ProgressObserver& observer) const {
    set_thread_count(threads);
    return metrics::evaluate_mesh(*mesh, image, options, observer).json;
  }
};

/// The figures with names beside labels, as the command has them.
std::string evaluate_mesh(const std::shared_ptr<Mesh>& mesh, const py::tuple& given, bool smooth,
                          bool certified, double tolerance_mm, int threads, py::dict keywords,
                          const py::object& progress) {
  ImageInput input = take_choices(keywords);
  require_no_more(keywords);
  set_thread_count(threads);
  input.many_labels = true;
  EvaluateWork work{.mesh = mesh,
                    .image = read(placed(given), input),
                    .options = {.smooth = smooth, .certified = certified, .tolerance_mm = tolerance_mm},
                    .threads = threads};
  input.names.add_unknown(names_of(py::cast(mesh)));
  nlohmann::json found = nlohmann::json::parse(watched(progress, std::move(work)));
  found["label_names"] = names_json(input.names);
  cbc3d::add_names(found, input.names);
  return found.dump();
}

}  // namespace

void add_work(py::module_& module) {
  module.def("mesh_array", &mesh_array);
  module.def("improve_mesh", &improve_mesh);
  module.def("evaluate_mesh", &evaluate_mesh);
}

}  // namespace cbc3d::python
