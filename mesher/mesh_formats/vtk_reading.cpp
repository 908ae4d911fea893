#include "mesher/mesh_formats/vtk_reading.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCommand.h>
#include <vtkDataArraySelection.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <string>
#include <string_view>
#include <utility>

#include "mesher/core/child_process.hpp"
#include "mesher/core/error.hpp"
#include "mesher/mesh_formats/grid_arrays.hpp"
#include "mesher/mesh_formats/vtk_faults.hpp"
#include "mesher/mesh_formats/vtk_field_data.hpp"

namespace cbc3d {
namespace fs = std::filesystem;
namespace {

constexpr const char* kLabelArray = "label";

/// What the child found, before the arrays.
enum class Finding : std::uint64_t { grid, no_grid, no_label_array, arrays_of_no_length };

template <typename T>
void send(const ChildOutput& out, const std::vector<T>& values) {
  const std::uint64_t count = values.size();
  out.write(std::as_bytes(std::span(&count, 1)));
  out.write(std::as_bytes(std::span(values)));
}

/// False where the child ends before. Its count is bounded by what its memory could hold.
template <typename T>
bool receive(ChildProcess& child, std::uint64_t most_bytes, std::vector<T>& values) {
  std::uint64_t count = 0;
  if (!child.read(std::as_writable_bytes(std::span(&count, 1))) || count > most_bytes / sizeof(T)) {
    return false;
  }
  values.resize(count);
  return child.read(std::as_writable_bytes(std::span(values)));
}

std::vector<std::int64_t> integers_of(vtkDataArray& array) {
  std::vector<std::int64_t> values(static_cast<std::size_t>(array.GetNumberOfValues()));
  for (std::size_t n = 0; n < values.size(); ++n) {
    values[n] = static_cast<std::int64_t>(array.GetComponent(static_cast<vtkIdType>(n), 0));
  }
  return values;
}

GridArrays arrays_of(vtkUnstructuredGrid& grid, vtkDataArray& labels) {
  GridArrays arrays;
  arrays.points.resize(static_cast<std::size_t>(grid.GetNumberOfPoints()));
  for (std::size_t v = 0; v < arrays.points.size(); ++v) {
    grid.GetPoint(static_cast<vtkIdType>(v), &arrays.points[v].x);
  }
  vtkUnsignedCharArray& types = *grid.GetCellTypesArray();
  arrays.types.assign(types.GetPointer(0), types.GetPointer(0) + types.GetNumberOfValues());
  arrays.offsets = integers_of(*grid.GetCells()->GetOffsetsArray());
  arrays.connectivity = integers_of(*grid.GetCells()->GetConnectivityArray());
  arrays.labels.resize(static_cast<std::size_t>(labels.GetNumberOfTuples()));
  for (std::size_t c = 0; c < arrays.labels.size(); ++c) {
    arrays.labels[c] = labels.GetComponent(static_cast<vtkIdType>(c), 0);
  }
  return arrays;
}

/// What a file states, as arrays: labels, their names one line each, their colours, and the coordinates.
struct StatedArrays {
  std::vector<Label> labels;
  std::vector<char> names, coordinates;
  std::vector<std::int16_t> colours;  // three for each label, negative where it has none
};

StatedArrays arrays_of(const MeshFileOptions& stated) {
  StatedArrays arrays;
  for (const NamedLabel& named : stated.names.entries()) {
    arrays.labels.push_back(named.label);
    arrays.names.insert(arrays.names.end(), named.name.begin(), named.name.end());
    arrays.names.push_back('\n');
    std::array<std::int16_t, 3> colour{-1, -1, -1};
    if (named.colour) {
      std::copy(named.colour->begin(), named.colour->end(), colour.begin());
    }
    arrays.colours.insert(arrays.colours.end(), colour.begin(), colour.end());
  }
  arrays.coordinates.assign(stated.coordinates.begin(), stated.coordinates.end());
  return arrays;
}

MeshFileOptions stated_by(const StatedArrays& arrays) {
  MeshFileOptions stated;
  auto name = arrays.names.begin();
  for (std::size_t n = 0; n < arrays.labels.size() && 3 * n + 2 < arrays.colours.size(); ++n) {
    const auto end = std::find(name, arrays.names.end(), '\n');
    NamedLabel named{.label = arrays.labels[n], .name = std::string(name, end), .colour = {}};
    if (const auto* const rgb = &arrays.colours[3 * n]; rgb[0] >= 0) {
      named.colour = {static_cast<std::uint8_t>(rgb[0]), static_cast<std::uint8_t>(rgb[1]),
                      static_cast<std::uint8_t>(rgb[2])};
    }
    stated.names.set(std::move(named));
    name = end == arrays.names.end() ? end : end + 1;
  }
  stated.coordinates.assign(arrays.coordinates.begin(), arrays.coordinates.end());
  return stated;
}

void send_stated(const MeshFileOptions& stated, const ChildOutput& out) {
  const StatedArrays arrays = arrays_of(stated);
  send(out, arrays.labels);
  send(out, arrays.names);
  send(out, arrays.colours);
  send(out, arrays.coordinates);
}

bool receive_stated(ChildProcess& child, std::uint64_t most_bytes, MeshFileOptions& stated) {
  StatedArrays arrays;
  const bool whole = receive(child, most_bytes, arrays.labels) && receive(child, most_bytes, arrays.names) &&
                     receive(child, most_bytes, arrays.colours) &&
                     receive(child, most_bytes, arrays.coordinates);
  stated = stated_by(arrays);
  return whole;
}

/// "SPACE=RAS" in the title of a legacy file, as 3D Slicer writes it; empty where the title says nothing.
std::string space_in_title(const char* title) {
  constexpr std::string_view kKey = "SPACE=";
  const std::string_view text(title == nullptr ? "" : title);
  const std::size_t at = text.find(kKey);
  if (at == std::string_view::npos) {
    return "";
  }
  const std::string_view rest = text.substr(at + kKey.size());
  return std::string(rest.substr(0, rest.find_first_of(" \t\r\n;.,")));
}

std::string space_in_title(vtkUnstructuredGridReader& reader) {
  return space_in_title(reader.GetHeader());
}
std::string space_in_title(vtkXMLUnstructuredGridReader& /*reader*/) {
  return "";
}

std::string cell_arrays_of(vtkUnstructuredGrid& grid) {
  std::string names;
  for (int a = 0; a < grid.GetCellData()->GetNumberOfArrays(); ++a) {
    const char* const name = grid.GetCellData()->GetArrayName(a);
    names += std::string(names.empty() ? "'" : ", '") + (name == nullptr ? "" : name) + "'";
  }
  return names;
}

void send_grid(vtkUnstructuredGrid* grid, const std::string& label_array, const std::string& others,
               const std::string& space, const ChildOutput& out) {
  const auto say = [&out](Finding finding) { out.write(std::as_bytes(std::span(&finding, 1))); };
  if (grid == nullptr || grid->GetNumberOfCells() == 0 || grid->GetPoints() == nullptr ||
      grid->GetCellTypesArray() == nullptr) {
    return say(Finding::no_grid);
  }
  vtkDataArray* const labels = grid->GetCellData()->GetArray(label_array.c_str());
  if (labels == nullptr) {
    say(Finding::no_label_array);
    const std::string found = others.empty() ? cell_arrays_of(*grid) : others;
    return send(out, std::vector<char>(found.begin(), found.end()));
  }
  if (labels->GetNumberOfTuples() != grid->GetNumberOfCells() ||
      grid->GetCellTypesArray()->GetNumberOfValues() != grid->GetNumberOfCells()) {
    return say(Finding::arrays_of_no_length);
  }
  const GridArrays arrays = arrays_of(*grid, *labels);
  say(Finding::grid);
  send(out, arrays.points);
  send(out, arrays.types);
  send(out, arrays.offsets);
  send(out, arrays.connectivity);
  send(out, arrays.labels);
  MeshFileOptions stated = field_data_of(*grid);
  if (!space.empty()) {
    stated.coordinates = space;
  }
  send_stated(stated, out);
}

/// Arrays that are not asked for are not read, so that they cannot be damaged.
/// Returns the names of all cell arrays where the reader knows them beforehand.
std::string select_label_array(vtkXMLUnstructuredGridReader& reader, const std::string& label_array) {
  reader.UpdateInformation();
  reader.GetPointDataArraySelection()->DisableAllArrays();
  vtkDataArraySelection& arrays = *reader.GetCellDataArraySelection();
  std::string names;
  for (int a = 0; a < arrays.GetNumberOfArrays(); ++a) {
    names += std::string(names.empty() ? "'" : ", '") + arrays.GetArrayName(a) + "'";
  }
  arrays.DisableAllArrays();
  arrays.EnableArray(label_array.c_str());
  return names;
}
std::string select_label_array(vtkUnstructuredGridReader& /*reader*/, const std::string& /*label_array*/) {
  return {};
}

template <typename Reader>
void read_and_send(const fs::path& path, const std::string& label_array, const ChildOutput& out) {
  const VtkSilence silence;
  vtkNew<Reader> reader;
  vtkNew<VtkFaults> faults;
  vtkNew<VtkWindow> window;
  vtkOutputWindow::SetInstance(window);  // of this child process
  reader->AddObserver(vtkCommand::ErrorEvent, faults);
  reader->SetFileName(path.c_str());
  const std::string arrays = select_label_array(*reader, label_array);
  reader->Update();
  send_grid(faults->text.empty() && !window->faulty ? reader->GetOutput() : nullptr, label_array, arrays,
            space_in_title(*reader), out);
}

/// Memory for the most that deflate can pack into the file, and time for a slow disk.
ChildLimits limits_of(const fs::path& path) {
  constexpr std::uint64_t kLeastMemory = std::uint64_t{1} << 29U, kMostPacked = 1100;
  constexpr std::uint64_t kBytesPerSecond = 2000000;
  const std::uint64_t bytes = fs::file_size(path);
  return {.memory_bytes = kLeastMemory + kMostPacked * bytes,
          .cpu_seconds = static_cast<unsigned>(3 + bytes / kBytesPerSecond)};
}

[[noreturn]] void fail(const fs::path& path, const std::string& what) {
  throw InputError("cannot read '" + path.string() + "': " + what);
}

[[noreturn]] void fail_without_labels(const fs::path& path, const std::string& label_array,
                                      const std::string& others) {
  fail(path, "it has no cell array '" + label_array + "'" +
                 (others.empty()
                      ? "; add one integer label for each cell"
                      : ", but " + others.substr(0, 200) + "; name the one with the labels by label_array"));
}

std::string bytes_of(const fs::path& path, std::uint64_t from, std::size_t count) {
  std::string bytes(count, '\0');
  std::ifstream in(path, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(from));
  in.read(bytes.data(), static_cast<std::streamsize>(count));
  bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(in.gcount(), 0)));
  return bytes;
}

/// VTK's readers take a file that ends within its last array, or within a number, for another mesh. XML has
/// an end that is named; text has an end of its last line.
void require_end(const fs::path& path, VtkFormat format) {
  constexpr std::size_t kHead = 1024, kTail = 1024;
  const std::uint64_t length = fs::file_size(path);
  const std::string tail = bytes_of(path, length - std::min<std::uint64_t>(length, kTail), kTail);
  if (format == VtkFormat::xml) {
    if (tail.find("</VTKFile>") == std::string::npos) {
      fail(path, "it does not end with </VTKFile>; the file is truncated, write it again");
    }
    return;
  }
  const std::string head = bytes_of(path, 0, kHead);
  const bool is_text = head.find("\nASCII") != std::string::npos;
  if (is_text && !tail.ends_with('\n')) {
    fail(path, "its last line has no end; the file is truncated, write it again");
  }
}

GridArrays receive_grid(ChildProcess& child, std::uint64_t most_bytes, const fs::path& path,
                        const std::string& label_array, MeshFileOptions& stated) {
  Finding finding = Finding::no_grid;
  GridArrays grid;
  const bool told = child.read(std::as_writable_bytes(std::span(&finding, 1)));
  if (told && finding == Finding::no_grid) {
    fail(path, "not a VTK unstructured grid with cells, or a damaged one");
  }
  if (told && finding == Finding::no_label_array) {
    std::vector<char> others;
    receive(child, most_bytes, others);
    fail_without_labels(path, label_array, {others.begin(), others.end()});
  }
  if (told && finding == Finding::arrays_of_no_length) {
    fail(path,
         "its cells, their types and their labels are not as many; the file is damaged, write it again");
  }
  if (told && receive(child, most_bytes, grid.points) && receive(child, most_bytes, grid.types) &&
      receive(child, most_bytes, grid.offsets) && receive(child, most_bytes, grid.connectivity) &&
      receive(child, most_bytes, grid.labels) && receive_stated(child, most_bytes, stated)) {
    return grid;
  }
  fail(path, "VTK's reader fails on it (" + child.wait() + "); the file is damaged, write it again");
}

}  // namespace

Mesh read_vtk(const fs::path& path, VtkFormat format, const std::string& label_array,
              MeshFileOptions& stated) {
  const std::string array = label_array.empty() ? kLabelArray : label_array;
  require_end(path, format);
  const ChildLimits limits = limits_of(path);
  ChildProcess child(limits, [&](const ChildOutput& out) {
    format == VtkFormat::xml ? read_and_send<vtkXMLUnstructuredGridReader>(path, array, out)
                             : read_and_send<vtkUnstructuredGridReader>(path, array, out);
  });
  const GridArrays grid = receive_grid(child, limits.memory_bytes, path, array, stated);
  return mesh_of_grid(grid, "cannot read '" + path.string() + "'");
}

}  // namespace cbc3d
