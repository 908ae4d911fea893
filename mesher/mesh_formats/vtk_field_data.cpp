#include "mesher/mesh_formats/vtk_field_data.hpp"

#include <vtkAbstractArray.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkStringArray.h>

#include <algorithm>
#include <array>
#include <limits>

namespace cbc3d {
namespace {

constexpr const char* kValues = "label_values";
constexpr const char* kNames = "label_names";
constexpr const char* kColours = "label_colours";
constexpr const char* kSpace = "SPACE";

void add_names(vtkFieldData& fields, const LabelNames& names) {
  vtkNew<vtkIntArray> values;
  vtkNew<vtkStringArray> texts;
  values->SetName(kValues);
  texts->SetName(kNames);
  for (const NamedLabel& named : names.entries()) {
    values->InsertNextValue(named.label);
    texts->InsertNextValue(named.name);
  }
  fields.AddArray(values);
  fields.AddArray(texts);
}

void add_colours(vtkFieldData& fields, const LabelNames& names) {
  vtkNew<vtkIntArray> colours;
  colours->SetName(kColours);
  colours->SetNumberOfComponents(3);
  for (const NamedLabel& named : names.entries()) {
    std::array<int, 3> colour{-1, -1, -1};
    if (named.colour) {
      std::copy(named.colour->begin(), named.colour->end(), colour.begin());
    }
    colours->InsertNextTypedTuple(colour.data());
  }
  fields.AddArray(colours);
}

std::optional<std::array<std::uint8_t, 3>> colour_of(vtkDataArray* colours, vtkIdType row) {
  if (colours == nullptr || colours->GetNumberOfComponents() != 3 || row >= colours->GetNumberOfTuples()) {
    return std::nullopt;
  }
  std::array<std::uint8_t, 3> colour{};
  for (int n = 0; n < 3; ++n) {
    const double value = colours->GetComponent(row, n);
    if (!(value >= 0 && value <= 255)) {
      return std::nullopt;
    }
    colour[static_cast<std::size_t>(n)] = static_cast<std::uint8_t>(value);
  }
  return colour;
}

bool is_label(double value) {
  return value >= std::numeric_limits<Label>::min() && value <= std::numeric_limits<Label>::max();
}

}  // namespace

void add_field_data(vtkUnstructuredGrid& grid, const MeshFileOptions& options) {
  vtkFieldData& fields = *grid.GetFieldData();
  const auto& entries = options.names.entries();
  if (!entries.empty()) {
    add_names(fields, options.names);
  }
  if (std::any_of(entries.begin(), entries.end(), [](const NamedLabel& named) { return named.colour; })) {
    add_colours(fields, options.names);
  }
  if (options.coordinates != MeshFileOptions{}.coordinates) {
    vtkNew<vtkStringArray> space;
    space->SetName(kSpace);
    space->InsertNextValue(options.coordinates);
    fields.AddArray(space);
  }
}

MeshFileOptions field_data_of(vtkUnstructuredGrid& grid) {
  MeshFileOptions stated;
  vtkFieldData& fields = *grid.GetFieldData();
  vtkDataArray* const values = fields.GetArray(kValues);
  auto* const texts = vtkStringArray::SafeDownCast(fields.GetAbstractArray(kNames));
  if (values != nullptr && texts != nullptr && values->GetNumberOfValues() == texts->GetNumberOfValues()) {
    for (vtkIdType n = 0; n < texts->GetNumberOfValues(); ++n) {
      const double value = values->GetComponent(n, 0);
      if (values->GetNumberOfComponents() == 1 && is_label(value)) {
        stated.names.set({.label = static_cast<Label>(value),
                          .name = texts->GetValue(n),
                          .colour = colour_of(fields.GetArray(kColours), n)});
      }
    }
  }
  auto* const space = vtkStringArray::SafeDownCast(fields.GetAbstractArray(kSpace));
  if (space != nullptr && space->GetNumberOfValues() == 1) {
    stated.coordinates = space->GetValue(0);
  }
  return stated;
}

}  // namespace cbc3d
