#ifndef itkCBC3DImageToMeshFilter_h
#define itkCBC3DImageToMeshFilter_h

#include <array>
#include <string>
#include <type_traits>
#include <vector>

#include "itkDefaultStaticMeshTraits.h"
#include "itkImageToMeshFilter.h"
#include "itkMesh.h"
#include "mesher/mesh_formats/file_mesh.hpp"
#include "mesher/pipeline/mesh_array.hpp"
#include "mesher/pipeline/option_table.hpp"
#include "mesher/preprocess/choose_labels.hpp"

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

  /** The labels that are meshed; the rest becomes background, or one label with KeepRest. Empty: all. */
  void SetLabels(const std::vector<int>& labels);
  const std::vector<int>& GetLabels() const { return m_Choice.labels; }

  /** Values that are background; without 0 among them, pixels of value 0 get the first one as their label.
   * Empty: 0. */
  void SetBackground(const std::vector<int>& values);
  const std::vector<int>& GetBackground() const { return m_Choice.background; }

  /** With Labels: the other labels become one label, the largest plus one, instead of background. */
  void SetKeepRest(bool keep);
  bool GetKeepRest() const { return m_Choice.keep_rest; }
  itkBooleanMacro(KeepRest);

  /** 1: tetrahedra of four nodes; 2: of ten, the edges on boundaries along the smooth ones. ITK has no cell
   * of ten nodes, so that the cells are those of the corners, the points are all, and GetQuadraticNodes() has
   * the ten of every cell. */
  itkSetMacro(Order, int);
  itkGetConstMacro(Order, int);

  /** Of every cell the ten nodes among the output's points, in VTK's order; empty for order 1. */
  const std::vector<std::array<IdentifierType, 10>>& GetQuadraticNodes() const { return m_QuadraticNodes; }

  /** Every label has points of its own where it meets others, for contact problems. */
  itkSetMacro(SplitInterfaces, bool);
  itkGetConstMacro(SplitInterfaces, bool);
  itkBooleanMacro(SplitInterfaces);

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
  cbc3d::LabelImage ReadInput(std::vector<std::string>& warnings);
  cbc3d::MeshImageOptions OptionsFor(const cbc3d::LabelImage& image) const;
  void MeshInput();
  void Finish(const cbc3d::Mesh& mesh, const cbc3d::ImageFrame& frame,
              const std::vector<std::string>& warnings);
  void SetOutput(const cbc3d::FileMesh& mesh);
  void SetPoints(const cbc3d::FileMesh& mesh);
  void SetCells(const cbc3d::FileMesh& mesh);

  std::string m_Preset{"quality"};
  int m_NumberOfThreads{0};
  int m_Order{1};
  bool m_SplitInterfaces{false};
  cbc3d::LabelChoice m_Choice;
  std::vector<std::array<IdentifierType, 10>> m_QuadraticNodes;
  cbc3d::OptionSettings m_Options;
  cbc3d::MeshImageReport m_Report;
};
}  // namespace itk

#ifndef ITK_MANUAL_INSTANTIATION
#include "itkCBC3DImageToMeshFilter.hxx"
#endif

#endif
