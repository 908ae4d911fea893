// What a VTK file says beside points and cells, as arrays of its field data:
//   label_values   integers, the labels that have a name or a colour;
//   label_names    strings, their names in the same order, UTF-8;
//   label_colours  three integers from 0 to 255 for each, -1 where it has none; left out where none has one;
//   SPACE          what the points are given in, RAS or voxel; left out for LPS. 3D Slicer writes and reads
//   it.
#pragma once

#include <vtkUnstructuredGrid.h>

#include "mesher/mesh_formats/mesh_io.hpp"

namespace cbc3d {

/// Adds the arrays that there is something to say in.
void add_field_data(vtkUnstructuredGrid& grid, const MeshFileOptions& options);

/// What the arrays of a grid say; arrays of other lengths or types are left aside.
MeshFileOptions field_data_of(vtkUnstructuredGrid& grid);

}  // namespace cbc3d
