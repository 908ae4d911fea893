#include "reports/picture/scene.hpp"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkExtractGeometry.h>
#include <vtkIdList.h>
#include <vtkIntArray.h>
#include <vtkLookupTable.h>
#include <vtkNew.h>
#include <vtkPNGWriter.h>
#include <vtkPlane.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkTextActor.h>
#include <vtkTextProperty.h>
#include <vtkUnstructuredGrid.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <array>
#include <map>
#include <string>

#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"

namespace cbc3d::reports {
namespace {

using Colour = std::array<double, 3>;

constexpr std::size_t kLegendLabels = 12;
const char* const kMaterialArray = "material";

/// Distinct for the first ten, then steps around the colour circle by the golden angle.
Colour material_colour(std::size_t material) {
  static constexpr std::array<Colour, 10> kPalette{{{.85, .42, .36},
                                                    {.42, .62, .80},
                                                    {.95, .80, .42},
                                                    {.47, .71, .46},
                                                    {.66, .52, .75},
                                                    {.93, .60, .33},
                                                    {.40, .73, .71},
                                                    {.88, .60, .73},
                                                    {.68, .58, .44},
                                                    {.73, .75, .78}}};
  if (material >= 1 && material <= kPalette.size()) {
    return kPalette[material - 1];
  }
  vtkNew<vtkLookupTable> wheel;
  wheel->SetNumberOfTableValues(1);
  const double hue = std::fmod(0.618034 * static_cast<double>(material), 1.0);
  wheel->SetHueRange(hue, hue);
  wheel->SetSaturationRange(0.45, 0.45);
  wheel->SetValueRange(0.85, 0.85);
  wheel->ForceBuild();
  const double* colour = wheel->GetTableValue(0);
  return {colour[0], colour[1], colour[2]};
}

/// Cells of a kind with the index of their label in the image, by which they are coloured.
template <int Nodes>
void insert_cells(const CellBlock<Nodes>& cells, int type, const std::map<Label, int>& materials,
                  vtkUnstructuredGrid* grid, vtkIntArray* colours) {
  for (std::size_t c = 0; c < cells.size(); ++c) {
    std::array<vtkIdType, Nodes> nodes{};
    std::copy(cells.nodes[c].begin(), cells.nodes[c].end(), nodes.begin());
    if constexpr (Nodes == 6) {
      // VTK's wedge has its first triangle's normal outwards, Verdict's inwards.
      nodes = {nodes[0], nodes[2], nodes[1], nodes[3], nodes[5], nodes[4]};
    }
    grid->InsertNextCell(type, Nodes, nodes.data());
    const auto found = materials.find(cells.labels[c]);
    colours->InsertNextValue(found == materials.end() ? 0 : found->second);
  }
}

vtkNew<vtkUnstructuredGrid> grid_of(const Mesh& mesh, const LabelImage& image) {
  std::map<Label, int> materials;
  for (std::size_t m = 0; m < image.labels.size(); ++m) {
    materials[image.labels[m]] = static_cast<int>(m);
  }
  vtkNew<vtkPoints> points;
  for (const Vec3& p : mesh.points) {
    points->InsertNextPoint(p.x, p.y, p.z);
  }
  vtkNew<vtkIntArray> colours;
  colours->SetName(kMaterialArray);
  vtkNew<vtkUnstructuredGrid> grid;
  grid->SetPoints(points);
  grid->Allocate(static_cast<vtkIdType>(mesh.cell_count()));
  insert_cells(mesh.tets, VTK_TETRA, materials, grid, colours);
  insert_cells(mesh.pyramids, VTK_PYRAMID, materials, grid, colours);
  insert_cells(mesh.wedges, VTK_WEDGE, materials, grid, colours);
  insert_cells(mesh.hexes, VTK_HEXAHEDRON, materials, grid, colours);
  grid->GetCellData()->SetScalars(colours);
  return grid;
}

vtkNew<vtkLookupTable> colour_table(const LabelImage& image) {
  vtkNew<vtkLookupTable> table;
  table->SetNumberOfTableValues(static_cast<vtkIdType>(image.labels.size()));
  table->SetTableRange(0, static_cast<double>(image.labels.size()) - 1);
  for (std::size_t m = 0; m < image.labels.size(); ++m) {
    const Colour c = material_colour(m);
    table->SetTableValue(static_cast<vtkIdType>(m), c[0], c[1], c[2], 1);
  }
  return table;
}

vtkNew<vtkActor> surface_actor(vtkDataSet* cells, const LabelImage& image) {
  vtkNew<vtkDataSetSurfaceFilter> surface;
  surface->SetInputData(cells);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(surface->GetOutputPort());
  mapper->SetLookupTable(colour_table(image));
  mapper->UseLookupTableScalarRangeOn();
  mapper->SetScalarModeToUseCellData();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetInterpolationToFlat();
  return actor;
}

void add_caption(vtkRenderer* renderer, const PictureOptions& options) {
  vtkNew<vtkTextActor> text;
  text->SetInput(options.caption.c_str());
  text->GetTextProperty()->SetFontSize(options.size_px / 40);
  text->GetTextProperty()->SetColor(0.1, 0.1, 0.1);
  text->GetTextProperty()->SetVerticalJustificationToTop();
  text->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  text->SetPosition(0.02, 0.98);
  renderer->AddActor2D(text);
}

/// Names the labels, each on its colour, unless they are too many to be told apart.
void add_legend(vtkRenderer* renderer, const LabelImage& image, const PictureOptions& options) {
  const std::size_t count = image.labels.size() - 1;
  if (count > kLegendLabels) {
    return;
  }
  constexpr double kLineHeight = 0.036;
  for (std::size_t m = 1; m <= count; ++m) {
    const Colour colour = material_colour(m);
    vtkNew<vtkTextActor> text;
    text->SetInput((" label " + std::to_string(image.labels[m]) + " ").c_str());
    vtkTextProperty* style = text->GetTextProperty();
    style->SetFontSize(options.size_px / 48);
    style->SetColor(0.1, 0.1, 0.1);
    style->SetBackgroundColor(colour[0], colour[1], colour[2]);
    style->SetBackgroundOpacity(1);
    style->SetJustificationToRight();
    text->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
    text->SetPosition(0.98, 0.02 + kLineHeight * static_cast<double>(count - m));
    renderer->AddActor2D(text);
  }
}

void write_png(vtkRenderer* renderer, const PictureOptions& options, const std::filesystem::path& png) {
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(8);
  window->SetSize(options.size_px, options.size_px);
  window->AddRenderer(renderer);
  window->Render();
  vtkNew<vtkWindowToImageFilter> pixels;
  pixels->SetInput(window);
  pixels->ReadFrontBufferOff();
  AtomicFile file(png);
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputConnection(pixels->GetOutputPort());
  writer->SetFileName(file.temporary().c_str());
  writer->Write();
  if (!std::filesystem::exists(file.temporary()) || std::filesystem::file_size(file.temporary()) == 0) {
    throw JobError("cannot write '" + png.string() + "'");
  }
  file.commit();
}

/// Looks at the middle of the labelled voxels, which fill the picture.
void set_camera(vtkRenderer* renderer, const View& view, const Vec3& towards_eye, const Vec3& up) {
  const Vec3 right = up.cross(towards_eye).normalized();
  const Vec3 upright = towards_eye.cross(right);
  double half_size_mm = 0;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 offset;
    for (int axis = 0; axis < 3; ++axis) {
      const double side = (corner >> axis & 1) != 0 ? 0.5 : -0.5;
      offset += side * view.extent_mm[axis] * view.axes.column(axis);
    }
    half_size_mm = std::max({half_size_mm, std::abs(offset.dot(right)), std::abs(offset.dot(upright))});
  }
  const double distance_mm = 2 * view.extent_mm.norm();
  const Vec3 eye = view.centre_mm + distance_mm * towards_eye;
  vtkCamera* camera = renderer->GetActiveCamera();
  camera->SetFocalPoint(view.centre_mm.x, view.centre_mm.y, view.centre_mm.z);
  camera->SetPosition(eye.x, eye.y, eye.z);
  camera->SetViewUp(up.x, up.y, up.z);
  camera->ParallelProjectionOn();
  constexpr double kMargin = 1.12;  // for the caption above and the mesh's own overhang
  camera->SetParallelScale(kMargin * half_size_mm);
  camera->SetClippingRange(0.5 * distance_mm, 2 * distance_mm);
}

vtkNew<vtkRenderer> renderer_of(vtkActor* actor, const LabelImage& image, const PictureOptions& options) {
  vtkNew<vtkRenderer> renderer;
  renderer->SetBackground(1, 1, 1);
  renderer->AddActor(actor);
  add_caption(renderer, options);
  add_legend(renderer, image, options);
  return renderer;
}

}  // namespace

View view_of(const LabelImage& image) {
  Index3 lowest = image.frame.size;
  Index3 highest{-1, -1, -1};
  for (std::size_t offset = 0; offset < image.voxels.size(); ++offset) {
    if (image.voxels[offset] == kBackground) {
      continue;
    }
    const Index3 index = image.frame.index_of(offset);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      lowest[axis] = std::min(lowest[axis], index[axis]);
      highest[axis] = std::max(highest[axis], index[axis]);
    }
  }
  const Vec3 from = image.frame.local_centre(lowest[0], lowest[1], lowest[2]);
  const Vec3 to = image.frame.local_centre(highest[0], highest[1], highest[2]);
  View view;
  view.centre_mm = image.frame.to_physical(0.5 * (from + to));
  view.extent_mm = to - from + image.frame.spacing_mm;
  view.axes = image.frame.direction;
  return view;
}

void draw_cut_section(const Mesh& mesh, const LabelImage& image, const PictureOptions& options,
                      const std::filesystem::path& png) {
  const View view = view_of(image);
  const Vec3 towards_eye = -view.axes.column(2);
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(view.centre_mm.x, view.centre_mm.y, view.centre_mm.z);
  plane->SetNormal(towards_eye.x, towards_eye.y, towards_eye.z);
  vtkNew<vtkExtractGeometry> half;
  half->SetInputData(grid_of(mesh, image));
  half->SetImplicitFunction(plane);
  half->ExtractInsideOn();
  half->ExtractBoundaryCellsOn();
  half->Update();
  const vtkNew<vtkActor> actor = surface_actor(half->GetOutput(), image);
  actor->GetProperty()->EdgeVisibilityOn();
  actor->GetProperty()->SetEdgeColor(0.2, 0.2, 0.22);
  actor->GetProperty()->SetAmbient(0.35);
  actor->GetProperty()->SetDiffuse(0.65);
  const vtkNew<vtkRenderer> renderer = renderer_of(actor, image, options);
  set_camera(renderer, view, towards_eye, -view.axes.column(1));
  write_png(renderer, options, png);
}

void draw_surface(const Mesh& mesh, const LabelImage& image, const PictureOptions& options,
                  const std::filesystem::path& png) {
  const View view = view_of(image);
  const vtkNew<vtkActor> actor = surface_actor(grid_of(mesh, image), image);
  actor->GetProperty()->SetAmbient(0.15);
  actor->GetProperty()->SetDiffuse(0.85);
  const vtkNew<vtkRenderer> renderer = renderer_of(actor, image, options);
  const Vec3 oblique =
      (-0.45 * view.axes.column(0) - 0.8 * view.axes.column(1) + 0.4 * view.axes.column(2)).normalized();
  set_camera(renderer, view, oblique, view.axes.column(2));
  write_png(renderer, options, png);
}

}  // namespace cbc3d::reports
