#include "reports/interfaces/python/mesh_class.hpp"

#include <pybind11/numpy.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <cctype>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "mesher/core/error.hpp"
#include "mesher/core/mesh.hpp"
#include "mesher/core/mesh_coordinates.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"
#include "mesher/topology/quadratic_mesh.hpp"
#include "reports/interfaces/python/label_names.hpp"

namespace cbc3d::python {
namespace {

namespace py = pybind11;

template <typename Value>
using InputArray = py::array_t<Value, py::array::c_style | py::array::forcecast>;

/// A view of `rows` times `columns` values that belong to `owner`.
template <typename Value>
py::array view(const Value* values, std::size_t rows, std::size_t columns, const py::object& owner) {
  return py::array_t<Value>({static_cast<py::ssize_t>(rows), static_cast<py::ssize_t>(columns)}, values,
                            owner);
}

template <typename AnyMesh>
py::array points_of(const py::object& self) {
  const auto& points = self.cast<const AnyMesh&>().points;
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  return view(points.empty() ? nullptr : &points.data()->x, points.size(), 3, self);
}

template <int Nodes, typename AnyMesh = Mesh>
using BlockOf = CellBlock<Nodes> AnyMesh::*;

/// Nodes may not be written to: a node that is not there would be read.
template <int Nodes, typename AnyMesh>
py::array nodes_of(const py::object& self, BlockOf<Nodes, AnyMesh> block) {
  const auto& nodes = (self.cast<const AnyMesh&>().*block).nodes;
  py::array array = view(nodes.empty() ? nullptr : nodes.data()->data(), nodes.size(), Nodes, self);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

template <int Nodes, typename AnyMesh>
py::array labels_of_block(const py::object& self, BlockOf<Nodes, AnyMesh> block) {
  const auto& labels = (self.cast<const AnyMesh&>().*block).labels;
  return py::array_t<Label>(static_cast<py::ssize_t>(labels.size()), labels.data(), self);
}

template <int Nodes>
void add_block(py::class_<Mesh, std::shared_ptr<Mesh>>& type, const char* name, const char* labels_name,
               BlockOf<Nodes> block) {
  type.def_property_readonly(name,
                             [block](const py::object& self) { return nodes_of<Nodes, Mesh>(self, block); });
  type.def_property_readonly(
      labels_name, [block](const py::object& self) { return labels_of_block<Nodes, Mesh>(self, block); });
}

/// The labels of all cells: tets, pyramids, wedges, hexes.
py::array all_labels(const py::object& self) {
  const auto& mesh = self.cast<const Mesh&>();
  if (mesh.cell_count() == mesh.tets.size()) {
    return labels_of_block<4, Mesh>(self, &Mesh::tets);
  }
  py::array_t<Label> labels(static_cast<py::ssize_t>(mesh.cell_count()));
  Label* out = labels.mutable_data();
  for (const auto* block :
       {&mesh.tets.labels, &mesh.pyramids.labels, &mesh.wedges.labels, &mesh.hexes.labels}) {
    out = std::copy(block->begin(), block->end(), out);
  }
  return labels;
}

template <int Nodes>
void fill_block(CellBlock<Nodes>& block, const py::object& given, const char* name, std::size_t points) {
  if (given.is_none()) {
    return;
  }
  const auto nodes = InputArray<std::int64_t>::ensure(given);
  if (!nodes || nodes.ndim() != 2 || nodes.shape(1) != Nodes) {
    throw InputError(
        std::string(name) + ": give an array of whole numbers, " + std::to_string(Nodes) + " for each cell",
        name);
  }
  block.nodes.resize(static_cast<std::size_t>(nodes.shape(0)));
  const std::int64_t* value = nodes.data();
  for (auto& cell : block.nodes) {
    for (VertexId& node : cell) {
      if (*value < 0 || static_cast<std::size_t>(*value) >= points) {
        throw InputError(std::string(name) + ": node " + std::to_string(*value) + " is not among the " +
                             std::to_string(points) + " points",
                         name);
      }
      node = static_cast<VertexId>(*value++);
    }
  }
}

void fill_labels(Mesh& mesh, const py::object& given) {
  const auto labels = InputArray<Label>::ensure(given);
  if (!labels || labels.ndim() != 1 || static_cast<std::size_t>(labels.size()) != mesh.cell_count()) {
    throw InputError("labels: give one whole number for each of the " + std::to_string(mesh.cell_count()) +
                         " cells: tets, pyramids, wedges, hexes",
                     "labels");
  }
  const Label* next = labels.data();
  const auto fill = [&next](auto& block) {
    block.labels.assign(next, next + block.size());
    next += block.size();
  };
  fill(mesh.tets);
  fill(mesh.pyramids);
  fill(mesh.wedges);
  fill(mesh.hexes);
}

std::shared_ptr<Mesh> mesh_of_arrays(const py::object& points, const py::object& tets,
                                     const py::object& labels, const py::object& pyramids,
                                     const py::object& wedges, const py::object& hexes) {
  const auto places = InputArray<double>::ensure(points);
  if (!places || places.ndim() != 2 || places.shape(1) != 3) {
    throw InputError("points: give an array of numbers, 3 for each point", "points");
  }
  auto mesh = std::make_shared<Mesh>();
  mesh->points.resize(static_cast<std::size_t>(places.shape(0)));
  std::copy_n(places.data(), places.size(), mesh->points.empty() ? nullptr : &mesh->points.data()->x);
  fill_block(mesh->tets, tets, "tets", mesh->points.size());
  fill_block(mesh->pyramids, pyramids, "pyramids", mesh->points.size());
  fill_block(mesh->wedges, wedges, "wedges", mesh->points.size());
  fill_block(mesh->hexes, hexes, "hexes", mesh->points.size());
  fill_labels(*mesh, labels);
  return mesh;
}

/// RAS turns about an axis; the frame that indices of voxels need, a mesh does not know.
void turn(Mesh& mesh, const std::string& coordinates) {
  from_lps(mesh, coordinates, nullptr);
}
void turn(QuadraticMesh& mesh, const std::string& coordinates) {
  from_lps(mesh.points, coordinates, nullptr);
}

std::vector<Label> labels_in(const Mesh& mesh) {
  return labels_of(mesh);
}
std::vector<Label> labels_in(const QuadraticMesh& mesh) {
  return mesh.tets.labels;
}

template <typename AnyMesh>
void write_file(const AnyMesh& mesh, const std::filesystem::path& path, const MeshFileOptions& options) {
  const py::gil_scoped_release released;
  require_writable_mesh_path(path, options);
  require_writable_labels(labels_in(mesh), path);
  if (options.coordinates == MeshFileOptions{}.coordinates) return write_mesh(mesh, path, options);
  AnyMesh turned = mesh;
  turn(turned, options.coordinates);
  write_mesh(turned, path, options);
}

template <typename AnyMesh>
void write(const py::object& self, const std::filesystem::path& path,
           const std::optional<std::string>& format, bool split_interfaces, std::string coordinates) {
  std::transform(coordinates.begin(), coordinates.end(), coordinates.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  if (coordinates != "LPS" && coordinates != "RAS") {
    throw InputError("coordinates " + coordinates.substr(0, 40) + ": give LPS or RAS", "coordinates");
  }
  write_file(self.cast<const AnyMesh&>(), path,
             {.names = names_of(self),
              .coordinates = coordinates,
              .format = format.value_or(""),
              .split_interfaces = split_interfaces});
}

template <typename AnyMesh, typename Type>
void add_writing(Type& type) {
  type.def("write", &write<AnyMesh>, py::arg("path"), py::kw_only(), py::arg("format") = py::none(),
           py::arg("split_interfaces") = MeshFileOptions{}.split_interfaces,
           py::arg("coordinates") = MeshFileOptions{}.coordinates);
  add_names(type);
}

py::object read(const std::filesystem::path& path, const std::string& label_array) {
  MeshFileOptions stated;
  const auto mesh = [&] {
    const py::gil_scoped_release released;
    return std::make_shared<Mesh>(read_mesh(path, {.label_array = label_array}, nullptr, stated));
  }();
  py::object result = py::cast(mesh);
  set_names(result, stated.names);
  return result;
}

/// The straight tets of a quadratic mesh's corners.
py::object linear(const py::object& self) {
  py::object result = py::cast(std::make_shared<Mesh>(corner_mesh(self.cast<const QuadraticMesh&>())));
  set_names(result, names_of(self));
  return result;
}

std::string text_of_quadratic(const QuadraticMesh& mesh) {
  return "<cbc3d.QuadraticMesh: " + std::to_string(mesh.points.size()) + " points, " +
         std::to_string(mesh.tets.size()) + " tets>";
}

void add_quadratic_class(py::module_& module) {
  py::class_<QuadraticMesh, std::shared_ptr<QuadraticMesh>> type(module, "QuadraticMesh", py::dynamic_attr());
  type.def_property_readonly("points", &points_of<QuadraticMesh>);
  type.def_property_readonly(
      "tets", [](const py::object& self) { return nodes_of<10, QuadraticMesh>(self, &QuadraticMesh::tets); });
  type.def_property_readonly("labels", [](const py::object& self) {
    return labels_of_block<10, QuadraticMesh>(self, &QuadraticMesh::tets);
  });
  type.def_property_readonly("corners", [](const QuadraticMesh& mesh) { return mesh.corners; });
  type.def("linear", &linear);
  add_writing<QuadraticMesh>(type);
  type.def("__repr__", &text_of_quadratic);
}

std::string text_of(const Mesh& mesh) {
  std::string text = "<cbc3d.Mesh: " + std::to_string(mesh.points.size()) + " points";
  const auto add = [&text](std::size_t count, const char* kind) {
    text += count > 0 ? ", " + std::to_string(count) + " " + kind : "";
  };
  add(mesh.tets.size(), "tets");
  add(mesh.pyramids.size(), "pyramids");
  add(mesh.wedges.size(), "wedges");
  add(mesh.hexes.size(), "hexes");
  return text + ">";
}

}  // namespace

void add_mesh_class(py::module_& module) {
  py::class_<Mesh, std::shared_ptr<Mesh>> type(module, "Mesh", py::dynamic_attr());
  type.def(py::init(&mesh_of_arrays), py::arg("points"), py::arg("tets"), py::arg("labels"), py::kw_only(),
           py::arg("pyramids") = py::none(), py::arg("wedges") = py::none(), py::arg("hexes") = py::none());
  type.def_property_readonly("points", &points_of<Mesh>);
  add_block<4>(type, "tets", "tet_labels", &Mesh::tets);
  add_block<5>(type, "pyramids", "pyramid_labels", &Mesh::pyramids);
  add_block<6>(type, "wedges", "wedge_labels", &Mesh::wedges);
  add_block<8>(type, "hexes", "hex_labels", &Mesh::hexes);
  type.def_property_readonly("labels", &all_labels);
  add_writing<Mesh>(type);
  type.def_static("read", &read, py::arg("path"), py::kw_only(), py::arg("label_array") = "");
  type.def("__repr__", &text_of);
  add_quadratic_class(module);
}

}  // namespace cbc3d::python
