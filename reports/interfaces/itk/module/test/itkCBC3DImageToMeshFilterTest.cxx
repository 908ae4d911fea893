// Tetrahedra with labels in the image's physical space, for pixels of several types; options, progress,
// abortion, errors.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <map>

#include "itkCBC3DImageToMeshFilter.h"
#include "itkCommand.h"
#include "itkImage.h"
#include "itkImageRegionIteratorWithIndex.h"

namespace {

int failures = 0;

void check(bool holds, const char* what) {
  if (!holds) {
    std::cerr << "does not hold: " << what << '\n';
    ++failures;
  }
}

/// Two balls of labels 3 and 100 whose image begins at index (5, -2, 0), turned and moved in space.
template <typename TPixel>
typename itk::Image<TPixel, 3>::Pointer two_balls() {
  using ImageType = itk::Image<TPixel, 3>;
  auto image = ImageType::New();
  image->SetRegions(typename ImageType::RegionType({{5, -2, 0}}, {{32, 24, 20}}));
  const double spacing[] = {1.0, 1.0, 1.25}, origin[] = {10.0, -7.0, 3.0};
  image->SetSpacing(spacing);
  image->SetOrigin(origin);
  typename ImageType::DirectionType direction;
  direction.SetIdentity();
  direction(0, 0) = direction(1, 1) = 0;
  direction(0, 1) = -1;
  direction(1, 0) = 1;
  image->SetDirection(direction);
  image->Allocate(true);
  for (itk::ImageRegionIteratorWithIndex<ImageType> it(image, image->GetBufferedRegion()); !it.IsAtEnd();
       ++it) {
    const double x = it.GetIndex()[0] - 5.0, y = it.GetIndex()[1] + 2.0, z = 1.25 * it.GetIndex()[2];
    const auto within = [&](double cx) { return std::hypot(x - cx, y - 12, z - 12) < 8; };
    it.Set(within(11) ? 3 : within(20) ? 100 : 0);
  }
  return image;
}

/// Six times the signed volume of a tetrahedron of the mesh.
double six_volumes(const itk::CBC3DMesh& mesh, const itk::CBC3DMesh::CellType& cell) {
  const auto* ids = cell.GetPointIds();
  const auto origin = mesh.GetPoint(ids[0]);
  const auto a = mesh.GetPoint(ids[1]) - origin, b = mesh.GetPoint(ids[2]) - origin,
             c = mesh.GetPoint(ids[3]) - origin;
  return itk::CrossProduct(a, b) * c;
}

template <typename TPixel>
void check_mesh() {
  const auto image = two_balls<TPixel>();
  auto filter = itk::CBC3DImageToMeshFilter<itk::Image<TPixel, 3>>::New();
  filter->SetInput(image);
  filter->Update();
  const itk::CBC3DMesh& mesh = *filter->GetOutput();
  check(mesh.GetNumberOfCells() > 100 && mesh.GetNumberOfPoints() > 50, "there is a mesh");
  check(mesh.GetCellData()->Size() == mesh.GetNumberOfCells(), "every cell has a label");
  std::map<int, double> volumes;
  bool positive = true, inside = true;
  auto label = mesh.GetCellData()->Begin();
  for (auto it = mesh.GetCells()->Begin(); it != mesh.GetCells()->End(); ++it, ++label) {
    check(it.Value()->GetType() == itk::CommonEnums::CellGeometry::TETRAHEDRON_CELL,
          "the cells are tetrahedra");
    const double six = six_volumes(mesh, *it.Value());
    positive = positive && six > 0;
    volumes[label.Value()] += six / 6;
  }
  for (auto it = mesh.GetPoints()->Begin(); it != mesh.GetPoints()->End(); ++it) {
    typename itk::Image<TPixel, 3>::IndexType index;
    inside = inside && image->TransformPhysicalPointToIndex(it.Value(), index);
  }
  check(positive, "every tetrahedron has a positive volume");
  check(inside, "the mesh lies where the image lies");
  check(volumes.size() == 2 && volumes[3] > 1500 && volumes[100] > 1000, "both balls are there");
}

void check_warnings() {
  using ImageType = itk::Image<short, 3>;
  const auto image = two_balls<short>();
  image->SetPixel({{7, 0, 1}}, 42);
  auto filter = itk::CBC3DImageToMeshFilter<ImageType>::New();
  filter->SetInput(image);
  filter->SetPreset("paper");
  filter->Update();
  bool named = false;
  for (const std::string& warning : filter->GetWarnings())
    named = named || warning.find("42") != std::string::npos;
  check(named, "a label that the mesh lacks is named");
}

void check_options_and_errors() {
  using ImageType = itk::Image<short, 3>;
  auto filter = itk::CBC3DImageToMeshFilter<ImageType>::New();
  filter->SetInput(two_balls<short>());
  filter->SetPreset("paper");
  filter->SetNumberOfThreads(1);
  filter->SetOption("iterations", "0");
  filter->Update();
  const auto paper = filter->GetOutput()->GetNumberOfCells();
  filter->SetPreset("quality");
  filter->ClearOptions();
  filter->Update();
  check(filter->GetOutput()->GetNumberOfCells() != paper, "presets differ, and the filter runs again");
  filter->Print(std::cout);
  const auto refuses = [&](const char* name, const char* value) {
    try {
      filter->SetOption(name, value);
      filter->Update();
      return false;
    } catch (const itk::ExceptionObject& error) {
      return std::string(error.GetDescription()).find(name) != std::string::npos;
    }
  };
  check(refuses("colour", "red"), "unknown options are refused");
  check(refuses("iterations", "many"), "values that are none are refused");
  filter->ClearOptions();
  check(refuses("mixed", "true"), "pyramids are refused");
  filter->ClearOptions();
  check(refuses("size", "9=1"), "labels that the image lacks are refused");
}

std::map<int, int> cells_by_label(const itk::CBC3DMesh& mesh) {
  std::map<int, int> cells;
  for (auto it = mesh.GetCellData()->Begin(); it != mesh.GetCellData()->End(); ++it) ++cells[it.Value()];
  return cells;
}

void check_choices() {
  using ImageType = itk::Image<short, 3>;
  auto filter = itk::CBC3DImageToMeshFilter<ImageType>::New();
  filter->SetInput(two_balls<short>());
  filter->SetPreset("paper");
  filter->SetOption("iterations", "0");
  const auto labels = [&filter] {
    filter->Update();
    std::vector<int> found;
    for (const auto& [label, count] : cells_by_label(*filter->GetOutput())) found.push_back(label);
    return found;
  };
  filter->SetLabels({100});
  check(labels() == std::vector<int>{100}, "the chosen label alone is meshed");
  filter->KeepRestOn();
  check(labels() == std::vector<int>{100, 101}, "the rest is one label");
  check(!filter->GetWarnings().empty() && filter->GetWarnings().back().find("101") != std::string::npos,
        "the new label is named");
  filter->KeepRestOff();
  filter->SetLabels({});
  filter->SetBackground({0, 3});
  check(labels() == std::vector<int>{100}, "background may be several values");
  filter->SetBackground({});
  filter->SetLabels({9});
  try {
    filter->Update();
    check(false, "labels that the image lacks are refused");
  } catch (const itk::ExceptionObject& error) {
    check(std::string(error.GetDescription()).find("no label 9, which Labels names") != std::string::npos,
          "the filter's own names stand in messages");
  }
}

void check_orders_and_split_interfaces() {
  using ImageType = itk::Image<short, 3>;
  auto filter = itk::CBC3DImageToMeshFilter<ImageType>::New();
  filter->SetInput(two_balls<short>());
  filter->SetPreset("paper");
  filter->SetOption("iterations", "0");
  filter->Update();
  const itk::CBC3DMesh& mesh = *filter->GetOutput();
  const auto points = mesh.GetNumberOfPoints();
  const auto cells = cells_by_label(mesh);
  check(filter->GetQuadraticNodes().empty(), "order 1 has no nodes on edges");
  filter->SplitInterfacesOn();
  filter->Update();
  check(mesh.GetNumberOfPoints() > points && cells_by_label(mesh) == cells, "every label has its own points");
  filter->SplitInterfacesOff();
  filter->SetOrder(2);
  filter->Update();
  check(cells_by_label(mesh) == cells && mesh.GetNumberOfPoints() > points, "order 2 adds points alone");
  const auto& nodes = filter->GetQuadraticNodes();
  check(nodes.size() == mesh.GetNumberOfCells(), "every cell has ten nodes");
  double farthest = 0, longest = 0;
  for (const auto& ten : nodes) {
    const auto a = mesh.GetPoint(ten[0]), b = mesh.GetPoint(ten[1]), middle = mesh.GetPoint(ten[4]);
    for (unsigned int axis = 0; axis < 3; ++axis) {
      farthest = std::max(farthest, std::abs(middle[axis] - (a[axis] + b[axis]) / 2));
    }
    longest = std::max(longest, a.EuclideanDistanceTo(b));
  }
  check(farthest < 0.3 * longest, "nodes 4 lie near the middle of the edges 01");
  filter->SetOrder(3);
  try {
    filter->Update();
    check(false, "other orders are refused");
  } catch (const itk::ExceptionObject& error) {
    check(std::string(error.GetDescription()).find("Order 3") != std::string::npos,
          "the message names what is refused");
  }
}

void check_progress_and_abortion() {
  using ImageType = itk::Image<unsigned char, 3>;
  auto filter = itk::CBC3DImageToMeshFilter<ImageType>::New();
  filter->SetInput(two_balls<unsigned char>());
  int steps = 0;
  auto command = itk::FunctionCommand::New();
  command->SetCallback([&](const itk::EventObject&) {
    if (++steps == 3) filter->SetAbortGenerateData(true);
  });
  filter->AddObserver(itk::ProgressEvent(), command);
  try {
    filter->Update();
    check(false, "an aborted filter throws");
  } catch (const itk::ProcessAborted&) {
    check(steps == 3, "the work ends at the step at which it is aborted");
  }
}

}  // namespace

int main() {
  check_mesh<unsigned char>();
  check_mesh<short>();
  check_mesh<long long>();
  check_warnings();
  check_options_and_errors();
  check_choices();
  check_orders_and_split_interfaces();
  check_progress_and_abortion();
  std::cout << failures << " checks failed\n";
  return failures == 0 ? 0 : 1;
}
