// Surfaces of a volume mesh as triangles: STL, PLY, Wavefront OBJ and binary glTF.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "mesher/core/label_names.hpp"
#include "mesher/core/mesh.hpp"

namespace cbc3d {

enum class SurfaceParts : std::uint8_t {
  label,      ///< a part for each label: its whole surface, normals out of it
  interface,  ///< a part for each pair of labels, normals out of the lower one, and for each label's outer
              ///< surface
  all         ///< one part: every facet once
};

struct SurfacePart {
  std::string name;
  std::array<std::uint8_t, 3> colour{200, 200, 200};
  std::vector<std::array<VertexId, 3>> triangles;  ///< counter-clockwise seen from outside
};

struct SurfaceMesh {
  std::vector<Vec3> points;  ///< of the volume mesh
  std::vector<SurfacePart> parts;
};

/// The surfaces of a mesh; quadrilaterals are halved from their smallest node, alike for both labels. A label
/// has the colour of its name, or else one that differs from the others'. Throws InputError where a facet
/// belongs to more than two cells.
SurfaceMesh surface_of(const Mesh& mesh, SurfaceParts parts, const LabelNames& names);

/// Checks, before any long work, that the extension is .stl, .ply, .obj or .glb and that a file can be
/// created there. Throws InputError.
void require_writable_surface_path(const std::filesystem::path& path);

/// Writes the parts and returns the files. OBJ (groups) and glTF (named, coloured meshes in metres) have all
/// parts in one file. STL (binary) and PLY (binary, coloured) have one part each: of several, part "liver" of
/// "out.stl" is "out-liver.stl". `coordinates` is written into the file. Throws JobError when writing fails.
std::vector<std::filesystem::path> write_surface(const SurfaceMesh& surface,
                                                 const std::filesystem::path& path,
                                                 const std::string& coordinates = "LPS");

}  // namespace cbc3d
