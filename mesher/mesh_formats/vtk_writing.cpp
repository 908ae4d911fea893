#include "mesher/mesh_formats/vtk_writing.hpp"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkIdTypeArray.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <cstring>
#include <string>

#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"
#include "mesher/mesh_formats/grid_arrays.hpp"
#include "mesher/mesh_formats/parallel_deflate.hpp"
#include "mesher/mesh_formats/vtk_faults.hpp"
#include "mesher/mesh_formats/vtk_field_data.hpp"

namespace cbc3d {
namespace fs = std::filesystem;
namespace {

constexpr const char* kLabelArray = "label";

/// The arrays of a grid, filled block by block of cells.
class VtkArrays {
 public:
  explicit VtkArrays(const FileMesh& mesh) {
    const auto cells = static_cast<vtkIdType>(mesh.cell_count());
    std::size_t nodes = 0;
    for (const FileCells& block : mesh.blocks()) nodes += block.nodes.size();
    offsets_->SetNumberOfValues(cells + 1);
    offsets_->SetValue(0, 0);
    connectivity_->SetNumberOfValues(static_cast<vtkIdType>(nodes));
    types_->SetNumberOfValues(cells);
    labels_->SetNumberOfValues(cells);
    labels_->SetName(kLabelArray);
  }

  void append(const FileCells& block) {
    const std::size_t per_cell = block.nodes_per_cell;
    const bool is_wedge = block.kind == CellKind::wedge;
    const auto type = static_cast<unsigned char>(block.row().vtk);
    vtkIdType* const offsets = offsets_->GetPointer(cells_ + 1);
    vtkIdType* const ids = connectivity_->GetPointer(nodes_);
    unsigned char* const types = types_->GetPointer(cells_);
    int* const labels = labels_->GetPointer(cells_);
#pragma omp parallel for schedule(static)
    for (std::size_t c = 0; c < block.size(); ++c) {
      for (std::size_t n = 0; n < per_cell; ++n) {
        ids[per_cell * c + n] = block.nodes[per_cell * c + (is_wedge ? kWedgeOrder[n] : n)];
      }
      offsets[c] = nodes_ + static_cast<vtkIdType>(per_cell * (c + 1));
      types[c] = type;
      labels[c] = block.labels[c];
    }
    cells_ += static_cast<vtkIdType>(block.size());
    nodes_ += static_cast<vtkIdType>(block.nodes.size());
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

vtkSmartPointer<vtkUnstructuredGrid> to_vtk(const FileMesh& mesh, const MeshFileOptions& options) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(mesh.points().size()));
  if (!mesh.points().empty()) {
    static_assert(sizeof(Vec3) == 3 * sizeof(double));
    std::memcpy(points->GetVoidPointer(0), mesh.points().data(), mesh.points().size() * sizeof(Vec3));
  }
  VtkArrays arrays(mesh);
  for (const FileCells& block : mesh.blocks()) arrays.append(block);
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  grid->SetPoints(points);
  arrays.give_to(*grid);
  add_field_data(*grid, options);
  return grid;
}

template <typename Writer>
void run_writer(Writer& writer, vtkUnstructuredGrid& grid, const fs::path& path) {
  const VtkSilence silence;
  vtkNew<VtkFaults> faults;
  writer.AddObserver(vtkCommand::ErrorEvent, faults);
  writer.SetInputData(&grid);
  writer.SetFileName(path.c_str());
  errno = 0;
  if (writer.Write() != 1 || writer.GetErrorCode() != 0 || !faults->text.empty()) {
    fail_to_write(path);
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

void write_legacy(const FileMesh& mesh, const fs::path& path, int file_type, const MeshFileOptions& options) {
  vtkNew<vtkUnstructuredGridWriter> writer;
  writer->SetFileVersion(vtkDataWriter::VTK_LEGACY_READER_VERSION_4_2);
  writer->SetFileType(file_type);
  if (options.coordinates != MeshFileOptions{}.coordinates) {
    writer->SetHeader(("CBC3D mesh. SPACE=" + options.coordinates).c_str());  // where 3D Slicer looks for it
  }
  run_writer(*writer, *to_vtk(mesh, options), path);
}

}  // namespace

void write_vtu(const FileMesh& mesh, const fs::path& path, const MeshFileOptions& options) {
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  vtkNew<ParallelDeflate> compressor;
  writer->SetDataModeToAppended();
  writer->EncodeAppendedDataOff();
  writer->SetCompressor(compressor);
  writer->SetCompressionLevel(1);
  const auto grid = to_vtk(mesh, options);
  foresee_arrays(*grid, writer->GetBlockSize(), *compressor);
  run_writer(*writer, *grid, path);
}

void write_vtk(const FileMesh& mesh, const fs::path& path, const MeshFileOptions& options) {
  write_legacy(mesh, path, VTK_BINARY, options);
}

void write_vtk_text(const FileMesh& mesh, const fs::path& path, const MeshFileOptions& options) {
  write_legacy(mesh, path, VTK_ASCII, options);
}

}  // namespace cbc3d
