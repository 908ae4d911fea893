#include "mesher/mesh_formats/abaqus_writing.hpp"

#include "mesher/mesh_formats/mesh_statements.hpp"
#include "mesher/mesh_formats/surface_groups.hpp"
#include "mesher/mesh_formats/text_file.hpp"

namespace cbc3d {
namespace {

constexpr int kDigits = 12;

/// The number of a label in a comment, from which our reader has it again where its set has a name; the names
/// as people read them, and colours.
void add_labels(TextFile& out, const FileMesh& mesh, const LabelNames& names) {
  for (const Label label : mesh.labels()) {
    out.add("** LABEL ", label, " = ", names.identifier(label), '\n');
  }
  for (const std::string& line : name_statements(names, mesh.labels())) out.add("** ", line, '\n');
}

/// The format has no counts, so that our reader could not tell a file that is cut short between two elements.
void add_counts(TextFile& out, const FileMesh& mesh) {
  out.add("** NODES ", mesh.points().size(), ", ELEMENTS ", mesh.cell_count(), '\n');
}

void add_nodes(TextFile& out, const FileMesh& mesh) {
  out.add("*NODE, NSET=ALL_NODES\n");
  for (std::size_t v = 0; v < mesh.points().size(); ++v) {
    out.add(v + 1, ", ");
    out.add_point(mesh.points()[v], ", ");
    out.add('\n');
  }
}

void add_elements(TextFile& out, const FileMesh& mesh, const LabelNames& names) {
  std::size_t first = 1;
  for (const FileCells& block : mesh.blocks()) {
    bool any = false;
    Label last = 0;
    for (const std::size_t c : cells_by_label(block)) {
      const Label label = block.labels[c];
      if (!any || label != last) {
        out.add("*ELEMENT, TYPE=", block.row().abaqus, ", ELSET=", names.identifier(label), '\n');
      }
      any = true;
      last = label;
      out.add(first + c);
      for (const VertexId v : block.nodes_of(c)) out.add(", ", v + 1);
      out.add('\n');
    }
    first += block.size();
  }
}

void add_surfaces(TextFile& out, const FileMesh& mesh, const LabelNames& names) {
  for (const SurfaceGroup& group : surface_groups(mesh, names)) {
    out.add("*SURFACE, NAME=", group.name, ", TYPE=ELEMENT\n");
    for (const CellFacet& facet : *group.facets) {
      out.add(facet.cell + 1, ", S", facet.number + 1, '\n');
    }
  }
}

}  // namespace

void write_abaqus(const FileMesh& mesh, const std::filesystem::path& path, const MeshFileOptions& options) {
  TextFile out(path, kDigits);
  out.add("*HEADING\nCBC3D mesh, ", coordinates_statement(options), '\n');
  add_counts(out, mesh);
  add_labels(out, mesh, options.names);
  add_nodes(out, mesh);
  add_elements(out, mesh, options.names);
  add_surfaces(out, mesh, options.names);
  out.close();
}

}  // namespace cbc3d
