#ifndef itkCBC3DImageToMeshFilter_hxx
#define itkCBC3DImageToMeshFilter_hxx

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string_view>
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
AddTetrahedron(TMesh & mesh, std::span<const cbc3d::VertexId> nodes, cbc3d::Label label)
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

/** The text with the filter's names in place of the command's flags. */
inline std::string
WithNames(std::string text)
{
  for (const auto & [flag, name] :
       { std::pair("--labels", "Labels"), std::pair("--keep-rest", "KeepRest"), std::pair("--background", "Background") })
  {
    for (std::size_t at = text.find(flag); at != std::string::npos; at = text.find(flag, at))
    {
      text.replace(at, std::string_view(flag).size(), name);
    }
  }
  return text;
}
} // namespace CBC3D

template <typename TInputImage, typename TOutputMesh>
void
CBC3DImageToMeshFilter<TInputImage, TOutputMesh>::SetLabels(const std::vector<int> & labels)
{
  m_Choice.labels = labels;
  this->Modified();
}

template <typename TInputImage, typename TOutputMesh>
void
CBC3DImageToMeshFilter<TInputImage, TOutputMesh>::SetBackground(const std::vector<int> & values)
{
  m_Choice.background = values;
  this->Modified();
}

template <typename TInputImage, typename TOutputMesh>
void
CBC3DImageToMeshFilter<TInputImage, TOutputMesh>::SetKeepRest(bool keep)
{
  m_Choice.keep_rest = keep;
  this->Modified();
}

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
cbc3d::LabelImage
CBC3DImageToMeshFilter<TInputImage, TOutputMesh>::ReadInput(std::vector<std::string> & warnings)
{
  using Integer = CBC3D::Integer<InputPixelType>;
  const cbc3d::ImageFrame        frame = this->FrameOfInput();
  const std::span<const Integer> labels(reinterpret_cast<const Integer *>(this->GetInput()->GetBufferPointer()),
                                        frame.voxel_count());
  cbc3d::LabelImage image = cbc3d::to_label_image(labels, frame);
  cbc3d::LabelNames names;
  cbc3d::choose_labels(image, names, m_Choice, "the input image", warnings);
  return image;
}

template <typename TInputImage, typename TOutputMesh>
cbc3d::MeshImageOptions
CBC3DImageToMeshFilter<TInputImage, TOutputMesh>::OptionsFor(const cbc3d::LabelImage & image) const
{
  if (m_Order != 1 && m_Order != 2)
  {
    throw cbc3d::InputError("Order " + std::to_string(m_Order) + ": give 1 or 2");
  }
  cbc3d::MeshImageOptions options = cbc3d::preset_options(m_Preset, image.frame);
  cbc3d::apply_settings(m_Options, options);
  if (options.mixed)
  {
    throw cbc3d::InputError("mixed true: ITK has no cell for pyramids; give false");
  }
  cbc3d::require_known_labels(options, image);
  return options;
}

template <typename TInputImage, typename TOutputMesh>
void
CBC3DImageToMeshFilter<TInputImage, TOutputMesh>::MeshInput()
{
  cbc3d::set_thread_count(m_NumberOfThreads);
  std::vector<std::string>      warnings;
  cbc3d::LabelImage             image = this->ReadInput(warnings);
  const cbc3d::ImageFrame       frame = image.frame;
  const cbc3d::MeshImageOptions options = this->OptionsFor(image);
  const cbc3d::Progress         progress([this](std::string_view, double fraction) {
    this->UpdateProgress(static_cast<float>(fraction));
    return !this->GetAbortGenerateData();
  });
  m_Report = {};
  if (m_Order == 2)
  {
    const cbc3d::QuadraticMesh mesh = cbc3d::mesh_image_quadratic(std::move(image), options, progress, m_Report);
    this->Finish(cbc3d::corner_mesh(mesh), frame, warnings);
    this->SetOutput(cbc3d::FileMesh(mesh, { .interfaces = false, .split = m_SplitInterfaces }));
  }
  else
  {
    const cbc3d::Mesh mesh = cbc3d::mesh_image(std::move(image), options, progress, m_Report);
    this->Finish(mesh, frame, warnings);
    this->SetOutput(cbc3d::FileMesh(mesh, { .interfaces = false, .split = m_SplitInterfaces }));
  }
}

template <typename TInputImage, typename TOutputMesh>
void
CBC3DImageToMeshFilter<TInputImage, TOutputMesh>::Finish(const cbc3d::Mesh &               mesh,
                                                         const cbc3d::ImageFrame &         frame,
                                                         const std::vector<std::string> & warnings)
{
  if (mesh.cell_count() == 0)
  {
    throw cbc3d::JobError("the mesh is empty: no label is larger than the lattice; give a smaller lattice-spacing");
  }
  for (std::string & finding : cbc3d::mesh_findings(mesh, m_Report, frame))
  {
    m_Report.warnings.push_back(std::move(finding));
  }
  for (const std::string & warning : warnings)
  {
    m_Report.warnings.push_back(CBC3D::WithNames(warning));
  }
}

template <typename TInputImage, typename TOutputMesh>
void
CBC3DImageToMeshFilter<TInputImage, TOutputMesh>::SetOutput(const cbc3d::FileMesh & mesh)
{
  this->SetPoints(mesh);
  this->SetCells(mesh);
}

template <typename TInputImage, typename TOutputMesh>
void
CBC3DImageToMeshFilter<TInputImage, TOutputMesh>::SetPoints(const cbc3d::FileMesh & mesh)
{
  auto points = TOutputMesh::PointsContainer::New();
  points->Reserve(mesh.points().size());
  for (std::size_t v = 0; v < mesh.points().size(); ++v)
  {
    typename TOutputMesh::PointType point;
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      point[axis] = static_cast<typename TOutputMesh::CoordRepType>(mesh.points()[v][static_cast<int>(axis)]);
    }
    points->SetElement(v, point);
  }
  this->GetOutput()->SetPoints(points);
}

template <typename TInputImage, typename TOutputMesh>
void
CBC3DImageToMeshFilter<TInputImage, TOutputMesh>::SetCells(const cbc3d::FileMesh & mesh)
{
  TOutputMesh & output = *this->GetOutput();
  output.SetCellsAllocationMethod(MeshEnums::MeshClassCellsAllocationMethod::CellsAllocatedDynamicallyCellByCell);
  m_QuadraticNodes.clear();
  for (const cbc3d::FileCells & block : mesh.blocks())
  {
    for (std::size_t c = 0; c < block.size(); ++c)
    {
      const auto nodes = block.nodes_of(c);
      CBC3D::AddTetrahedron(output, nodes, block.labels[c]);
      if (block.is_quadratic())
      {
        std::copy(nodes.begin(), nodes.end(), m_QuadraticNodes.emplace_back().begin());
      }
    }
  }
}

template <typename TInputImage, typename TOutputMesh>
void
CBC3DImageToMeshFilter<TInputImage, TOutputMesh>::GenerateData()
{
  try
  {
    this->MeshInput();
  }
  catch (const cbc3d::Cancelled &)
  {
    throw ProcessAborted(__FILE__, __LINE__);
  }
  catch (const cbc3d::InputError & error)
  {
    itkExceptionMacro(<< CBC3D::WithNames(error.what()));
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
  os << indent << "Order: " << m_Order << '\n' << indent << "SplitInterfaces: " << m_SplitInterfaces << '\n';
  os << indent << "Labels: " << (m_Choice.labels.empty() ? "all" : cbc3d::labels_text(m_Choice.labels)) << '\n';
  os << indent << "KeepRest: " << m_Choice.keep_rest << '\n';
  os << indent << "Background: " << (m_Choice.background.empty() ? "0" : cbc3d::labels_text(m_Choice.background))
     << '\n';
  for (const auto & [name, value] : m_Options)
  {
    os << indent << "Option " << name << ": " << cbc3d::value_text(value) << '\n';
  }
}
} // namespace itk

#endif
