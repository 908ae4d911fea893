#include "reports/interfaces/python/work.hpp"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "mesher/core/error.hpp"
#include "mesher/core/runtime.hpp"
#include "mesher/pipeline/improve_given_mesh.hpp"
#include "mesher/pipeline/mesh_findings.hpp"
#include "mesher/pipeline/mesh_image.hpp"
#include "mesher/pipeline/presets.hpp"
#include "mesher/preprocess/grey_check.hpp"
#include "metrics/evaluate_mesh.hpp"
#include "reports/interfaces/python/keyword_names.hpp"
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

LabelImage label_image(const LabelValues& values, const PlacedArray& placed, bool many_labels) {
  const py::gil_scoped_release released;
  LabelImage image = to_label_image(
      values.values, frame_of(values.size, placed.spacing_mm, placed.origin_mm, placed.direction));
  const std::string reason = many_labels ? "" : why_grey(image);
  if (!reason.empty()) {
    throw InputError("the label array: " + reason + "; segment it first, or many_labels=True takes it",
                     "array");
  }
  return image;
}

/// What of the array had to be copied is freed before this returns.
LabelImage read(const PlacedArray& placed, bool many_labels) {
  return label_image(label_values(placed.array, placed.axes), placed, many_labels);
}

std::vector<std::string> in_keywords(std::vector<std::string> warnings) {
  for (std::string& warning : warnings) {
    warning = with_keywords(warning);
  }
  return warnings;
}

py::dict seconds_of(const StageSeconds& stages) {
  py::dict seconds;
  for (const auto& [name, value] : stages) {
    seconds[name.c_str()] = value;
  }
  return seconds;
}

struct Meshed {
  std::shared_ptr<Mesh> mesh = std::make_shared<Mesh>();
  MeshImageReport report;
};

Meshed mesh(LabelImage image, const MeshImageOptions& options, const ProgressObserver& observer) {
  Meshed meshed;
  const ImageFrame frame = image.frame;
  *meshed.mesh = mesh_image(std::move(image), options, Progress(observer), meshed.report);
  if (meshed.mesh->cell_count() == 0) {
    throw JobError(
        "the mesh is empty: no label is larger than the lattice; give a smaller lattice_spacing_mm");
  }
  for (std::string& finding : mesh_findings(*meshed.mesh, meshed.report, frame)) {
    meshed.report.warnings.push_back(std::move(finding));
  }
  return meshed;
}

py::object mesh_array(const py::tuple& given, const std::string& preset, bool many_labels, int threads,
                      const py::dict& keywords, const py::object& progress) {
  const PlacedArray array = placed(given);
  const OptionSettings settings = settings_of(keywords);
  set_thread_count(threads);
  LabelImage image = read(array, many_labels);
  MeshImageOptions options = preset_options(preset, image.frame);
  apply_settings(settings, options);
  require_known_labels(options, image);
  const Meshed meshed = watched(
      progress, [&](const ProgressObserver& observer) { return mesh(std::move(image), options, observer); });
  py::object result = py::cast(meshed.mesh);
  result.attr("warnings") = in_keywords(meshed.report.warnings);
  result.attr("seconds") = seconds_of(meshed.report.stage_seconds);
  return result;
}

struct Improved {
  std::shared_ptr<Mesh> mesh;
  ImproveGivenMeshReport report;
};

Improved improve(const Mesh& mesh, const LabelImage* image, const ImproveGivenMeshOptions& options,
                 const ProgressObserver& observer) {
  Improved improved;
  improved.mesh =
      std::make_shared<Mesh>(improve_given_mesh(mesh, image, options, Progress(observer), improved.report));
  return improved;
}

py::object improve_mesh(const Mesh& mesh, const std::optional<py::tuple>& given,
                        const py::object& min_dihedral, double max_deviation_mm, bool decimate,
                        bool many_labels, int threads, const py::object& progress) {
  MeshImageOptions all;
  all.improve = given_mesh_defaults();
  apply_settings(settings_of(py::dict("min_dihedral"_a = min_dihedral)), all);
  const ImproveGivenMeshOptions options{
      .improve = all.improve, .max_deviation_mm = max_deviation_mm, .decimate = decimate};
  if (!(max_deviation_mm >= 0)) {
    throw InputError("max_deviation: give a number of mm, at least 0", "max_deviation_mm");
  }
  set_thread_count(threads);
  std::optional<LabelImage> image;
  if (given) {
    image = read(placed(*given), many_labels);
  }
  const Improved improved = watched(progress, [&](const ProgressObserver& observer) {
    return improve(mesh, image ? &*image : nullptr, options, observer);
  });
  py::object result = py::cast(improved.mesh);
  result.attr("warnings") = in_keywords(improved.report.warnings);
  result.attr("seconds") = seconds_of(improved.report.improve.part_seconds);
  return result;
}

std::string evaluate_mesh(const Mesh& mesh, const py::tuple& given, bool smooth, bool certified,
                          double tolerance_mm, int threads, const py::object& progress) {
  const metrics::EvaluateMeshOptions options{
      .smooth = smooth, .certified = certified, .tolerance_mm = tolerance_mm};
  set_thread_count(threads);
  const LabelImage image = read(placed(given), true);
  return watched(progress, [&](const ProgressObserver& observer) {
    return metrics::evaluate_mesh(mesh, image, options, observer).json;
  });
}

}  // namespace

void add_work(py::module_& module) {
  module.def("mesh_array", &mesh_array);
  module.def("improve_mesh", &improve_mesh);
  module.def("evaluate_mesh", &evaluate_mesh);
}

}  // namespace cbc3d::python
