#ifndef itkCBC3DImageToMeshFilter_h
#define itkCBC3DImageToMeshFilter_h

#include <string>
#include <type_traits>
#include <vector>

#include "itkDefaultStaticMeshTraits.h"
#include "itkImageToMeshFilter.h"
#include "itkMesh.h"
#include "mesher/pipeline/mesh_array.hpp"
#include "mesher/pipeline/option_table.hpp"

namespace itk {
/** A mesh of labelled cells with coordinates of double precision. */
using CBC3DMesh = Mesh<int, 3, DefaultStaticMeshTraits<int, 3, 3, double, double, int>>;

/** \class CBC3DImageToMeshFilter
 * \brief Meshes every label of a label image: one conforming mesh of tetrahedra with smooth boundaries
 * between the labels.
 *
 * The input is a 3-D image of integers in which 0 is background. The output has a TetrahedronCell for every
 * tetrahedron, its label as cell data, and points in the image's physical space (LPS mm). What of the image
 * the mesh lacks stands in GetWarnings() after Update(). The option "mixed" is refused, for ITK has no cell
 * for its pyramids.
 *
 * Options are those of the command `cbc3d mesh`, by name: SetOption("max-distance", "1.5").
 *
 * \ingroup CBC3D
 */
template <typename TInputImage, typename TOutputMesh = CBC3DMesh>
class ITK_TEMPLATE_EXPORT CBC3DImageToMeshFilter : public ImageToMeshFilter<TInputImage, TOutputMesh> {
 public:
  ITK_DISALLOW_COPY_AND_MOVE(CBC3DImageToMeshFilter);

  using Self = CBC3DImageToMeshFilter;
  using Superclass = ImageToMeshFilter<TInputImage, TOutputMesh>;
  using Pointer = SmartPointer<Self>;
  using ConstPointer = SmartPointer<const Self>;

  using InputImageType = TInputImage;
  using InputPixelType = typename TInputImage::PixelType;
  using OutputMeshType = TOutputMesh;

  static_assert(TInputImage::ImageDimension == 3, "CBC3DImageToMeshFilter takes 3-D images");
  static_assert(std::is_integral<InputPixelType>::value, "CBC3DImageToMeshFilter takes images of integers");

  itkNewMacro(Self);
  itkTypeMacro(CBC3DImageToMeshFilter, ImageToMeshFilter);

  /** "quality" (the default) or "paper". */
  itkSetStringMacro(Preset);
  itkGetStringMacro(Preset);

  /** Number of threads of OpenMP; 0: all cores. The mesh is the same at any number. */
  itkSetMacro(NumberOfThreads, int);
  itkGetConstMacro(NumberOfThreads, int);

  /** Sets an option of the table by its name; the value is checked at once. Throws ExceptionObject. */
  void SetOption(const std::string& name, const std::string& value);

  /** Takes all options back to the preset's. */
  void ClearOptions();

  /** What the last mesh lacks of its image, one line each. */
  const std::vector<std::string>& GetWarnings() const { return m_Report.warnings; }

  /** What happened on the way to the last mesh. */
  const cbc3d::MeshImageReport& GetReport() const { return m_Report; }

 protected:
  CBC3DImageToMeshFilter() = default;
  ~CBC3DImageToMeshFilter() override = default;

  void GenerateData() override;

  /** A mesh is made of a whole image. */
  void GenerateInputRequestedRegion() override;

  void PrintSelf(std::ostream& os, Indent indent) const override;

 private:
  cbc3d::ImageFrame FrameOfInput();
  cbc3d::Mesh MeshInput();
  void SetPoints(const cbc3d::Mesh& mesh);
  void SetCells(const cbc3d::Mesh& mesh);

  std::string m_Preset{"quality"};
  int m_NumberOfThreads{0};
  cbc3d::OptionSettings m_Options;
  cbc3d::MeshImageReport m_Report;
};
}  // namespace itk

#ifndef ITK_MANUAL_INSTANTIATION
#include "itkCBC3DImageToMeshFilter.hxx"
#endif

#endif
