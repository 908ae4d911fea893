#include "mesher/mesh_formats/medit_writing.hpp"

#include "mesher/mesh_formats/mesh_statements.hpp"
#include "mesher/mesh_formats/surface_groups.hpp"
#include "mesher/mesh_formats/text_file.hpp"

namespace cbc3d {
namespace {

void add_comments(TextFile& out, const FileMesh& mesh, const std::vector<SurfaceGroup>& groups,
                  const MeshFileOptions& options) {
  out.add("# CBC3D mesh, ", coordinates_statement(options), '\n');
  for (const Label label : mesh.labels()) {
    out.add("# volume ", label, " = ", options.names.identifier(label), '\n');
  }
  for (const std::string& line : name_statements(options.names, mesh.labels())) out.add("# ", line, '\n');
  for (std::size_t g = 0; g < groups.size(); ++g) {
    out.add("# surface ", g + 1, " = ", groups[g].name, '\n');
  }
}

void add_facets(TextFile& out, const FileMesh& mesh, const std::vector<SurfaceGroup>& groups,
                std::size_t corners) {
  const std::size_t facets = facets_with(mesh, groups, corners);
  if (facets == 0) return;
  out.add(corners == 4          ? "Quadrilaterals"
          : mesh.is_quadratic() ? "TrianglesP2"
                                : "Triangles",
          '\n', facets, '\n');
  std::array<VertexId, 6> nodes;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    for (const CellFacet& facet : *groups[g].facets) {
      const std::size_t count = mesh.nodes_of(facet, nodes);
      if (corners_of_facet(count) != corners) continue;
      for (const VertexId v : std::span(nodes).first(count)) out.add(v + 1, ' ');
      out.add(g + 1, '\n');
    }
  }
}

}  // namespace

void write_medit(const FileMesh& mesh, const std::filesystem::path& path, const MeshFileOptions& options) {
  const std::vector<SurfaceGroup> groups = surface_groups(mesh, options.names);
  TextFile out(path);
  out.add("MeshVersionFormatted 2\n");
  add_comments(out, mesh, groups, options);
  out.add("Dimension 3\nVertices\n", mesh.points().size(), '\n');
  for (const Vec3& p : mesh.points()) {
    out.add_point(p, " ");
    out.add(" 0\n");
  }
  add_facets(out, mesh, groups, 3);
  add_facets(out, mesh, groups, 4);
  for (const FileCells& block : mesh.blocks()) {
    out.add(block.row().medit, '\n', block.size(), '\n');
    for (std::size_t c = 0; c < block.size(); ++c) {
      for (const VertexId v : block.nodes_of(c)) out.add(v + 1, ' ');
      out.add(block.labels[c], '\n');
    }
  }
  out.add("End\n");
  out.close();
}

}  // namespace cbc3d
