#ifndef itkCBC3DImageToMeshFilter_hxx
#define itkCBC3DImageToMeshFilter_hxx

#include <array>
#include <cstdint>
#include <span>
#include <utility>

#include "itkCBC3DImageToMeshFilter.h"
#include "itkTetrahedronCell.h"
#include "mesher/core/error.hpp"
#include "mesher/core/runtime.hpp"
#include "mesher/pipeline/mesh_findings.hpp"

namespace itk
{
namespace CBC3D
{
/** The integer of the library that has the size and sign of a pixel. */
template <typename TPixel>
using Integer = std::conditional_t<
  sizeof(TPixel) == 1,
  std::conditional_t<std::is_signed<TPixel>::value, std::int8_t, std::uint8_t>,
  std::conditional_t<sizeof(TPixel) == 2,
                     std::conditional_t<std::is_signed<TPixel>::value, std::int16_t, std::uint16_t>,
                     std::conditional_t<sizeof(TPixel) == 4,
                                        std::conditional_t<std::is_signed<TPixel>::value, std::int32_t, std::uint32_t>,
                                        std::conditional_t<std::is_signed<TPixel>::value, std::int64_t, std::uint64_t>>>>;

/** Adds one tetrahedron and its label. */
template <typename TMesh>
void
AddTetrahedron(TMesh & mesh, const std::array<cbc3d::VertexId, 4> & nodes, cbc3d::Label label)
{
  using CellType = TetrahedronCell<typename TMesh::CellType>;
  typename TMesh::CellAutoPointer cell;
  cell.TakeOwnership(new CellType);
  for (std::size_t n = 0; n < 4; ++n)
  {
    cell->SetPointId(static_cast<int>(n), nodes[n]);
  }
  const auto id = mesh.GetNumberOfCells();
  mesh.SetCell(id, cell);
  mesh.SetCellData(id, static_cast<typename TMesh::CellPixelType>(label));
}
} // namespace CBC3D

template <typename TInputImage, typename TOutputMesh>
void
CBC3DImageToMeshFilter<TInputImage, TOutputMesh>::SetOption(const std::string & name, const std::string & value)
{
  try
  {
    const cbc3d::OptionRow & row = cbc3d::find_option(name);
    m_Options.emplace_back(row.name, cbc3d::checked_value(row, value));
  }
  catch (const cbc3d::InputError & error)
  {
    itkExceptionMacro(<< error.what());
  }
  this->Modified();
}

template <typename TInputImage, typename TOutputMesh>
void
CBC3DImageToMeshFilter<TInputImage, TOutputMesh>::ClearOptions()
{
  m_Options.clear();
  this->Modified();
}

template <typename TInputImage, typename TOutputMesh>
void
CBC3DImageToMeshFilter<TInputImage, TOutputMesh>::GenerateInputRequestedRegion()
{
  Superclass::GenerateInputRequestedRegion();
  if (auto * image = const_cast<TInputImage *>(this->GetInput()))
  {
    image->SetRequestedRegionToLargestPossibleRegion();
  }
}

template <typename TInputImage, typename TOutputMesh>
cbc3d::ImageFrame
CBC3DImageToMeshFilter<TInputImage, TOutputMesh>::FrameOfInput()
{
  const TInputImage * const image = this->GetInput();
  const auto                region = image->GetBufferedRegion();
  // Regions need not begin at index 0.
  typename TInputImage::PointType first;
  image->TransformIndexToPhysicalPoint(region.GetIndex(), first);
  cbc3d::ImageFrame frame;
  for (unsigned int row = 0; row < 3; ++row)
  {
    const int axis = static_cast<int>(row);
    frame.size[row] = static_cast<int>(region.GetSize()[row]);
    frame.spacing_mm[axis] = image->GetSpacing()[row];
    frame.origin_mm[axis] = first[row];
    for (unsigned int column = 0; column < 3; ++column)
    {
      frame.direction(axis, static_cast<int>(column)) = image->GetDirection()(row, column);
    }
  }
  return frame;
}

template <typename TInputImage, typename TOutputMesh>
cbc3d::Mesh
CBC3DImageToMeshFilter<TInputImage, TOutputMesh>::MeshInput()
{
  using Integer = CBC3D::Integer<InputPixelType>;
  const TInputImage * const image = this->GetInput();
  const cbc3d::ImageFrame   frame = this->FrameOfInput();
  const std::span<const Integer> labels(reinterpret_cast<const Integer *>(image->GetBufferPointer()), frame.voxel_count());
  cbc3d::MeshImageOptions options = cbc3d::preset_options(m_Preset, frame);
  cbc3d::apply_settings(m_Options, options);
  if (options.mixed)
  {
    throw cbc3d::InputError("mixed true: ITK has no cell for pyramids; give false");
  }
  cbc3d::set_thread_count(m_NumberOfThreads);
  cbc3d::LabelImage labelled = cbc3d::to_label_image(labels, frame);
  cbc3d::require_known_labels(options, labelled);
  const cbc3d::Progress progress([this](std::string_view, double fraction) {
    this->UpdateProgress(static_cast<float>(fraction));
    return !this->GetAbortGenerateData();
  });
  m_Report = {};
  cbc3d::Mesh mesh = cbc3d::mesh_image(std::move(labelled), options, progress, m_Report);
  if (mesh.cell_count() == 0)
  {
    throw cbc3d::JobError("the mesh is empty: no label is larger than the lattice; give a smaller lattice-spacing");
  }
  for (std::string & finding : cbc3d::mesh_findings(mesh, m_Report, frame))
  {
    m_Report.warnings.push_back(std::move(finding));
  }
  return mesh;
}

template <typename TInputImage, typename TOutputMesh>
void
CBC3DImageToMeshFilter<TInputImage, TOutputMesh>::SetPoints(const cbc3d::Mesh & mesh)
{
  auto points = TOutputMesh::PointsContainer::New();
  points->Reserve(mesh.points.size());
  for (std::size_t v = 0; v < mesh.points.size(); ++v)
  {
    typename TOutputMesh::PointType point;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      point[axis] = static_cast<typename TOutputMesh::CoordRepType>(mesh.points[v][static_cast<int>(axis)]);
    }
    points->SetElement(v, point);
  }
  this->GetOutput()->SetPoints(points);
}

template <typename TInputImage, typename TOutputMesh>
void
CBC3DImageToMeshFilter<TInputImage, TOutputMesh>::SetCells(const cbc3d::Mesh & mesh)
{
  TOutputMesh & output = *this->GetOutput();
  output.SetCellsAllocationMethod(MeshEnums::MeshClassCellsAllocationMethod::CellsAllocatedDynamicallyCellByCell);
  for (std::size_t c = 0; c < mesh.tets.size(); ++c)
  {
    CBC3D::AddTetrahedron(output, mesh.tets.nodes[c], mesh.tets.labels[c]);
  }
}

template <typename TInputImage, typename TOutputMesh>
void
CBC3DImageToMeshFilter<TInputImage, TOutputMesh>::GenerateData()
{
  try
  {
    const cbc3d::Mesh mesh = this->MeshInput();
    this->SetPoints(mesh);
    this->SetCells(mesh);
  }
  catch (const cbc3d::Cancelled &)
  {
    throw ProcessAborted(__FILE__, __LINE__);
  }
  catch (const cbc3d::InputError & error)
  {
    itkExceptionMacro(<< error.what());
  }
  catch (const cbc3d::JobError & error)
  {
    itkExceptionMacro(<< error.what());
  }
}

template <typename TInputImage, typename TOutputMesh>
void
CBC3DImageToMeshFilter<TInputImage, TOutputMesh>::PrintSelf(std::ostream & os, Indent indent) const
{
  Superclass::PrintSelf(os, indent);
  os << indent << "Preset: " << m_Preset << '\n' << indent << "NumberOfThreads: " << m_NumberOfThreads << '\n';
  for (const auto & [name, value] : m_Options)
  {
    os << indent << "Option " << name << ": " << cbc3d::value_text(value) << '\n';
  }
}
} // namespace itk

#endif
