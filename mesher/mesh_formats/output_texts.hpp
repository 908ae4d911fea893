// What users read of choices about a mesh's file, wherever they meet them: the command, 3D Slicer, Python.
#pragma once

namespace cbc3d {

inline constexpr const char* kOrderText =
    "1: tets of four nodes; 2: of ten, the edges on boundaries along the smooth ones";
inline constexpr const char* kSplitInterfacesText =
    "every label has nodes of its own where it meets others, for contact problems";

}  // namespace cbc3d
