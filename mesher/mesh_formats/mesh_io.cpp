#include "mesher/mesh_formats/mesh_io.hpp"

#include <unistd.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkIdTypeArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"
#include "mesher/mesh_formats/gmsh_io.hpp"
#include "mesher/mesh_formats/grid_arrays.hpp"
#include "mesher/mesh_formats/parallel_deflate.hpp"
#include "mesher/mesh_formats/vtk_faults.hpp"
#include "mesher/mesh_formats/vtk_reading.hpp"

namespace cbc3d {
namespace fs = std::filesystem;
namespace {

constexpr const char* kLabelArray = "label";

/// The arrays of a grid, filled block by block of cells.
class VtkArrays {
 public:
  explicit VtkArrays(const Mesh& mesh) {
    const auto cells = static_cast<vtkIdType>(mesh.cell_count());
    const std::size_t nodes =
        4 * mesh.tets.size() + 5 * mesh.pyramids.size() + 6 * mesh.wedges.size() + 8 * mesh.hexes.size();
    offsets_->SetNumberOfValues(cells + 1);
    offsets_->SetValue(0, 0);
    connectivity_->SetNumberOfValues(static_cast<vtkIdType>(nodes));
    types_->SetNumberOfValues(cells);
    labels_->SetNumberOfValues(cells);
    labels_->SetName(kLabelArray);
  }

  template <int Nodes>
  void append(const CellBlock<Nodes>& block, int vtk_type) {
    vtkIdType* const offsets = offsets_->GetPointer(cells_ + 1);
    vtkIdType* const ids = connectivity_->GetPointer(nodes_);
    unsigned char* const types = types_->GetPointer(cells_);
    int* const labels = labels_->GetPointer(cells_);
#pragma omp parallel for schedule(static)
    for (std::size_t c = 0; c < block.size(); ++c) {
      for (std::size_t n = 0; n < Nodes; ++n) {
        const std::size_t from = vtk_type == VTK_WEDGE ? kWedgeOrder[n % 6] : n;
        ids[Nodes * c + n] = block.nodes[c][from];
      }
      offsets[c] = nodes_ + static_cast<vtkIdType>(Nodes * (c + 1));
      types[c] = static_cast<unsigned char>(vtk_type);
      labels[c] = block.labels[c];
    }
    cells_ += static_cast<vtkIdType>(block.size());
    nodes_ += static_cast<vtkIdType>(Nodes * block.size());
  }

  void give_to(vtkUnstructuredGrid& grid) const {
    vtkNew<vtkCellArray> cells;
    cells->SetData(offsets_, connectivity_);
    grid.SetCells(types_, cells);
    grid.GetCellData()->AddArray(labels_);
    grid.GetCellData()->SetActiveScalars(kLabelArray);
  }

 private:
  vtkNew<vtkIdTypeArray> offsets_, connectivity_;
  vtkNew<vtkUnsignedCharArray> types_;
  vtkNew<vtkIntArray> labels_;
  vtkIdType cells_ = 0, nodes_ = 0;  // appended so far
};

vtkSmartPointer<vtkUnstructuredGrid> to_vtk(const Mesh& mesh) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(mesh.points.size()));
  if (!mesh.points.empty()) {
    static_assert(sizeof(Vec3) == 3 * sizeof(double));
    std::memcpy(points->GetVoidPointer(0), mesh.points.data(), mesh.points.size() * sizeof(Vec3));
  }
  VtkArrays arrays(mesh);
  arrays.append(mesh.tets, VTK_TETRA);
  arrays.append(mesh.pyramids, VTK_PYRAMID);
  arrays.append(mesh.wedges, VTK_WEDGE);
  arrays.append(mesh.hexes, VTK_HEXAHEDRON);
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(points);
  arrays.give_to(*grid);
  return grid;
}

template <typename Writer>
void run_writer(Writer& writer, vtkUnstructuredGrid& grid, const fs::path& path) {
  const VtkSilence silence;
  vtkNew<VtkFaults> faults;
  writer.AddObserver(vtkCommand::ErrorEvent, faults);
  writer.SetInputData(&grid);
  writer.SetFileName(path.c_str());
  if (writer.Write() != 1 || writer.GetErrorCode() != 0 || !faults->text.empty()) {
    throw JobError("cannot write '" + path.string() + "': the disk is full or the file cannot be written");
  }
}

/// The arrays of a grid in the order in which its writer asks for them; it leaves out the first offset, 0.
void foresee_arrays(vtkUnstructuredGrid& grid, std::size_t block_bytes, ParallelDeflate& compressor) {
  const auto foresee = [&](vtkDataArray* array, vtkIdType first) {
    const auto bytes = static_cast<std::size_t>(array->GetNumberOfValues() - first) *
                       static_cast<std::size_t>(array->GetDataTypeSize());
    compressor.foresee({static_cast<const std::uint8_t*>(array->GetVoidPointer(first)), bytes}, block_bytes);
  };
  foresee(grid.GetPoints()->GetData(), 0);
  foresee(grid.GetCells()->GetConnectivityArray(), 0);
  foresee(grid.GetCells()->GetOffsetsArray(), 1);
  foresee(grid.GetCellTypesArray(), 0);
  foresee(grid.GetCellData()->GetArray(kLabelArray), 0);
}

void write_vtu(const Mesh& mesh, const fs::path& path) {
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  vtkNew<ParallelDeflate> compressor;
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressor(compressor);
  writer->SetCompressionLevel(1);
  const auto grid = to_vtk(mesh);
  foresee_arrays(*grid, writer->GetBlockSize(), *compressor);
  run_writer(*writer, *grid, path);
}

void write_legacy_vtk(const Mesh& mesh, const fs::path& path) {
  vtkNew<vtkUnstructuredGridWriter> writer;
  writer->SetFileVersion(vtkDataWriter::VTK_LEGACY_READER_VERSION_4_2);
  writer->SetFileTypeToBinary();
  run_writer(*writer, *to_vtk(mesh), path);
}

enum class Format { vtu, vtk, msh };

Format format_of(const fs::path& path) {
  const std::string extension = path.extension().string();
  if (extension == ".vtu") return Format::vtu;
  if (extension == ".vtk") return Format::vtk;
  if (extension == ".msh") return Format::msh;
  throw InputError("'" + path.string() + "': unknown mesh format '" + extension +
                   "'; use .vtu, .vtk or .msh");
}

void write_as(Format format, const Mesh& mesh, const fs::path& path, const MeshFileOptions& options) {
  switch (format) {
    case Format::vtu:
      return write_vtu(mesh, path);
    case Format::vtk:
      return write_legacy_vtk(mesh, path);
    case Format::msh:
      return write_gmsh(mesh, path, options.names);
  }
}

void require_readable(const fs::path& path) {
  std::error_code error;
  if (fs::exists(path, error) && !fs::is_regular_file(path, error)) {
    throw InputError("cannot read '" + path.string() + "': it is a folder, device or pipe; name a mesh file");
  }
  if (!fs::is_regular_file(path, error)) {
    throw InputError("cannot read '" + path.string() + "': " +
                     (error && error != std::errc::no_such_file_or_directory
                          ? error.message() + "; check its permissions"
                          : "the file does not exist; check its name"));
  }
  if (::access(path.c_str(), R_OK) != 0) {
    throw InputError("cannot read '" + path.string() + "': the file cannot be opened (" +
                     std::strerror(errno) + "); check its permissions");
  }
}

}  // namespace

void require_writable_mesh_path(const fs::path& path) {
  format_of(path);
  require_writable(path);
}

void require_writable_labels(const std::vector<Label>& labels, const fs::path& path) {
  if (format_of(path) == Format::msh) {
    require_gmsh_labels(labels, path);
  }
}

void write_mesh(const Mesh& mesh, const fs::path& path, const MeshFileOptions& options) {
  const Format format = format_of(path);
  AtomicFile file(path);
  try {
    write_as(format, mesh, file.temporary(), options);
  } catch (const JobError&) {  // it names the temporary file
    throw JobError("cannot write '" + path.string() + "': the disk is full or the file cannot be written");
  }
  file.commit();
}

Mesh read_mesh(const fs::path& path) {
  const Format format = format_of(path);
  require_readable(path);
  switch (format) {
    case Format::vtk:
      return read_vtk(path, VtkFormat::legacy);
    case Format::msh:
      return read_gmsh(path);
    default:
      return read_vtk(path, VtkFormat::xml);
  }
}

}  // namespace cbc3d
