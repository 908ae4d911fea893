#include "reports/picture/scene.hpp"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkCutter.h>
#include <vtkDataObject.h>
#include <vtkDataSetSurfaceFilter.h>
#include <vtkExtractGeometry.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkImageResize.h>
#include <vtkIntArray.h>
#include <vtkJPEGWriter.h>
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
#include <vtkThreshold.h>
#include <vtkUnstructuredGrid.h>
#include <vtkWindowToImageFilter.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"
#include "mesher/core/label_colours.hpp"

namespace cbc3d::reports {
namespace {

using Colour = std::array<double, 3>;

constexpr std::size_t kLegendLabels = 12;
const char* const kMaterialArray = "material";

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
    const Colour c = m == 0 ? Colour{1, 1, 1} : label_colour(m - 1);  // background has no cells
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
  text->GetTextProperty()->SetBackgroundColor(1, 1, 1);
  text->GetTextProperty()->SetBackgroundOpacity(0.8);
  text->GetTextProperty()->SetVerticalJustificationToTop();
  text->GetPositionCoordinate()->SetCoordinateSystemToNormalizedViewport();
  text->SetPosition(0.02, 0.98);
  renderer->AddActor2D(text);
}

/// Names the labels, each on its colour, unless they are too many to be distinguished.
void add_legend(vtkRenderer* renderer, const LabelImage& image, const PictureOptions& options) {
  const std::size_t count = image.labels.size() - 1;
  if (count > kLegendLabels) {
    return;
  }
  constexpr double kLineHeight = 0.036;
  for (std::size_t m = 1; m <= count; ++m) {
    const Colour colour = label_colour(m - 1);
    vtkNew<vtkTextActor> text;
    text->SetInput((" " + options.names.text(image.labels[m]) + " ").c_str());
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

/// A copy of half the width as JPEG: a page of many loads fast.
void write_small(vtkImageData* pixels, const std::filesystem::path& png, const PictureOptions& options) {
  constexpr int kQuality = 82;
  constexpr int kDivisor = 2;
  std::array<int, 3> size{};
  pixels->GetDimensions(size.data());
  vtkNew<vtkImageResize> resize;
  resize->SetInputData(pixels);
  resize->SetOutputDimensions(size[0] / kDivisor, size[1] / kDivisor, 1);
  AtomicFile file(options.small_dir / png.stem().concat(".jpg"));
  vtkNew<vtkJPEGWriter> writer;
  writer->SetInputConnection(resize->GetOutputPort());
  writer->SetQuality(kQuality);
  writer->SetFileName(file.temporary().c_str());
  writer->Write();
  file.commit();
}

/// Draws the renderers side by side.
void write_png(const std::vector<vtkRenderer*>& renderers, const PictureOptions& options,
               const std::filesystem::path& png) {
  vtkNew<vtkRenderWindow> window;
  window->SetOffScreenRendering(1);
  window->SetMultiSamples(8);
  const int count = static_cast<int>(renderers.size());
  window->SetSize(count * options.size_px, options.size_px);
  for (int n = 0; n < count; ++n) {
    renderers[static_cast<std::size_t>(n)]->SetViewport(static_cast<double>(n) / count, 0,
                                                        static_cast<double>(n + 1) / count, 1);
    window->AddRenderer(renderers[static_cast<std::size_t>(n)]);
  }
  window->Render();
  vtkNew<vtkWindowToImageFilter> pixels;
  pixels->SetInput(window);
  pixels->ReadFrontBufferOff();
  pixels->Update();
  AtomicFile file(png);
  errno = 0;
  vtkNew<vtkPNGWriter> writer;
  writer->SetInputData(pixels->GetOutput());
  writer->SetFileName(file.temporary().c_str());
  writer->Write();
  if (!std::filesystem::exists(file.temporary()) || std::filesystem::file_size(file.temporary()) == 0) {
    fail_to_write(png);
  }
  file.commit();
  if (!options.small_dir.empty()) {
    write_small(pixels->GetOutput(), png, options);
  }
}

/// Looks at the middle of the labelled voxels, which fill the picture.
void set_camera(vtkRenderer* renderer, const View& view, const Vec3& towards_eye, const Vec3& up,
                double zoom = 1) {
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
  camera->SetParallelScale(kMargin * half_size_mm / zoom);
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

/// Obliquely from the front.
Vec3 oblique_view(const View& view) {
  return (-0.45 * view.axes.column(0) - 0.8 * view.axes.column(1) + 0.4 * view.axes.column(2)).normalized();
}

/// Centre of the labelled voxel that is nearest to an eye far away.
Vec3 nearest_voxel_mm(const LabelImage& image, const Vec3& towards_eye) {
  Vec3 nearest;
  double farthest = -std::numeric_limits<double>::infinity();
  for (std::size_t offset = 0; offset < image.voxels.size(); ++offset) {
    if (image.voxels[offset] == kBackground) {
      continue;
    }
    const Index3 index = image.frame.index_of(offset);
    const Vec3 centre = image.frame.to_physical(image.frame.local_centre(index[0], index[1], index[2]));
    if (centre.dot(towards_eye) > farthest) {
      farthest = centre.dot(towards_eye);
      nearest = centre;
    }
  }
  return nearest;
}

vtkNew<vtkPlane> cut_plane(const View& view) {
  const Vec3 towards_eye = -view.axes.column(2);
  vtkNew<vtkPlane> plane;
  plane->SetOrigin(view.centre_mm.x, view.centre_mm.y, view.centre_mm.z);
  plane->SetNormal(towards_eye.x, towards_eye.y, towards_eye.z);
  return plane;
}

vtkNew<vtkRenderer> cut_scene(const Mesh& mesh, const LabelImage& image, const PictureOptions& options) {
  const View view = view_of(image);
  vtkNew<vtkExtractGeometry> half;
  half->SetInputData(grid_of(mesh, image));
  half->SetImplicitFunction(cut_plane(view));
  half->ExtractInsideOn();
  half->ExtractBoundaryCellsOn();
  half->Update();
  const vtkNew<vtkActor> actor = surface_actor(half->GetOutput(), image);
  actor->GetProperty()->EdgeVisibilityOn();
  actor->GetProperty()->SetEdgeColor(0.2, 0.2, 0.22);
  actor->GetProperty()->SetAmbient(0.35);
  actor->GetProperty()->SetDiffuse(0.65);
  vtkNew<vtkRenderer> renderer = renderer_of(actor, image, options);
  set_camera(renderer, view, -view.axes.column(2), -view.axes.column(1));
  return renderer;
}

/// The labelled voxels that the cut plane goes through, as squares a little behind the plane.
vtkNew<vtkActor> voxel_actor(const LabelImage& image, const View& view) {
  const ImageFrame& frame = image.frame;
  const double slice = frame.to_local(view.centre_mm).z / frame.spacing_mm.z;
  const int k = std::clamp(static_cast<int>(std::lround(slice)), 0, frame.size[2] - 1);
  vtkNew<vtkPoints> points;
  vtkNew<vtkCellArray> squares;
  vtkNew<vtkIntArray> colours;
  for (int j = 0; j < frame.size[1]; ++j) {
    for (int i = 0; i < frame.size[0]; ++i) {
      if (image.at(i, j, k) == kBackground) {
        continue;
      }
      squares->InsertNextCell(4);
      for (const auto& [x, y] :
           {std::pair{-.5, -.5}, std::pair{.5, -.5}, std::pair{.5, .5}, std::pair{-.5, .5}}) {
        const Vec3 local{(i + x) * frame.spacing_mm.x, (j + y) * frame.spacing_mm.y,
                         (slice + 0.25) * frame.spacing_mm.z};
        const Vec3 corner = frame.to_physical(local);
        squares->InsertCellPoint(points->InsertNextPoint(corner.x, corner.y, corner.z));
      }
      colours->InsertNextValue(image.at(i, j, k));
    }
  }
  vtkNew<vtkPolyData> slice_of_voxels;
  slice_of_voxels->SetPoints(points);
  slice_of_voxels->SetPolys(squares);
  slice_of_voxels->GetCellData()->SetScalars(colours);
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(slice_of_voxels);
  mapper->SetLookupTable(colour_table(image));
  mapper->UseLookupTableScalarRangeOn();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->LightingOff();
  actor->GetProperty()->SetOpacity(0.65);
  return actor;
}

/// The lines in which the surface of one material's elements crosses the cut plane.
vtkNew<vtkActor> outline_actor(vtkUnstructuredGrid* grid, int material, const View& view) {
  vtkNew<vtkThreshold> part;
  part->SetInputData(grid);
  part->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, kMaterialArray);
  part->SetLowerThreshold(material);
  part->SetUpperThreshold(material);
  part->SetThresholdFunction(vtkThreshold::THRESHOLD_BETWEEN);
  vtkNew<vtkDataSetSurfaceFilter> surface;
  surface->SetInputConnection(part->GetOutputPort());
  vtkNew<vtkCutter> cutter;
  cutter->SetInputConnection(surface->GetOutputPort());
  cutter->SetCutFunction(cut_plane(view));
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputConnection(cutter->GetOutputPort());
  mapper->ScalarVisibilityOff();
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  actor->GetProperty()->SetColor(0.05, 0.05, 0.3);
  actor->GetProperty()->SetLineWidth(2);
  actor->GetProperty()->LightingOff();
  return actor;
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
  const vtkNew<vtkRenderer> renderer = cut_scene(mesh, image, options);
  write_png({renderer}, options, png);
}

void draw_beside(const Mesh& left, const Mesh& right, const LabelImage& image,
                 const PictureOptions& left_options, const PictureOptions& right_options,
                 const std::filesystem::path& png) {
  const vtkNew<vtkRenderer> first = cut_scene(left, image, left_options);
  const vtkNew<vtkRenderer> second = cut_scene(right, image, right_options);
  write_png({first, second}, left_options, png);
}

void draw_overlay(const Mesh& mesh, const LabelImage& image, const PictureOptions& options,
                  const std::filesystem::path& png) {
  const View view = view_of(image);
  const Vec3 towards_eye = -view.axes.column(2);
  const vtkNew<vtkActor> voxels = voxel_actor(image, view);
  const vtkNew<vtkRenderer> renderer = renderer_of(voxels, image, options);
  const vtkNew<vtkUnstructuredGrid> grid = grid_of(mesh, image);
  for (std::size_t material = 0; material < image.labels.size(); ++material) {
    renderer->AddActor(outline_actor(grid, static_cast<int>(material), view));
  }
  set_camera(renderer, view, towards_eye, -view.axes.column(1));
  write_png({renderer}, options, png);
}

void draw_close_up(const Mesh& mesh, const LabelImage& image, const PictureOptions& options,
                   const std::filesystem::path& png) {
  constexpr double kZoom = 6;
  View view = view_of(image);
  const vtkNew<vtkActor> actor = surface_actor(grid_of(mesh, image), image);
  actor->GetProperty()->SetAmbient(0.15);
  actor->GetProperty()->SetDiffuse(0.85);
  actor->GetProperty()->EdgeVisibilityOn();
  actor->GetProperty()->SetEdgeColor(0.2, 0.2, 0.22);
  const vtkNew<vtkRenderer> renderer = renderer_of(actor, image, options);
  const Vec3 oblique = oblique_view(view);
  view.centre_mm = nearest_voxel_mm(image, oblique);
  set_camera(renderer, view, oblique, view.axes.column(2), kZoom);
  // What lies before the voxel's plane is part of the picture as well.
  renderer->GetActiveCamera()->SetClippingRange(0.1 * view.extent_mm.norm(), 4 * view.extent_mm.norm());
  write_png({renderer}, options, png);
}

void draw_surface(const Mesh& mesh, const LabelImage& image, const PictureOptions& options,
                  const std::filesystem::path& png) {
  const View view = view_of(image);
  const vtkNew<vtkActor> actor = surface_actor(grid_of(mesh, image), image);
  actor->GetProperty()->SetAmbient(0.15);
  actor->GetProperty()->SetDiffuse(0.85);
  const vtkNew<vtkRenderer> renderer = renderer_of(actor, image, options);
  const Vec3 oblique = oblique_view(view);
  set_camera(renderer, view, oblique, view.axes.column(2));
  write_png({renderer}, options, png);
}

}  // namespace cbc3d::reports
