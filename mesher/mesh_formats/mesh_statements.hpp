// What the text formats say of names, colours and coordinates in lines that other programs pass over:
// comments of Abaqus's and Medit's files, and Gmsh's section $Comments.
//   coordinates LPS, mm
//   name 5 = right lung
//   colour 5 = #c85050
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "mesher/mesh_formats/mesh_io.hpp"

namespace cbc3d {

/// "coordinates LPS, mm", "coordinates voxel".
std::string coordinates_statement(const MeshFileOptions& options);

/// Lines with the names and colours of those of the labels that have any; a name is there as people read it,
/// not as the identifier of a group.
std::vector<std::string> name_statements(const LabelNames& names, const std::vector<Label>& labels);

/// Takes what a line says, behind the sign of a comment; other lines are left aside.
void take_statement(std::string_view line, MeshFileOptions& stated);

/// The same of a file's labels by what their groups are called: a group that is called after the number of
/// its label has no name, and names that are known already stay.
void take_group_name(Label label, std::string_view group, LabelNames& names);

}  // namespace cbc3d
