#include "mesher/mesh_formats/xdmf_writing.hpp"

#include <array>
#include <string>
#include <string_view>

#include "mesher/mesh_formats/grid_arrays.hpp"
#include "mesher/mesh_formats/mesh_statements.hpp"
#include "mesher/mesh_formats/text_file.hpp"

namespace cbc3d {
namespace {

/// What XDMF calls a kind of cells, alone and among others.
struct Topology {
  const char* name;
  int number;
};

constexpr std::array<Topology, 4> kTopologies = {
    {{"Tetrahedron", 6}, {"Pyramid", 7}, {"Wedge", 8}, {"Hexahedron", 9}}};
constexpr Topology kQuadraticTopology = {"Tetrahedron_10", 38};

const Topology& topology_of(const FileCells& block) {
  return block.is_quadratic() ? kQuadraticTopology : kTopologies[static_cast<std::size_t>(block.kind)];
}

/// Readers refuse Information that they do not know, and pass over comments, in which there are no two
/// hyphens in turn.
void add_comment(TextFile& out, std::string_view text) {
  out.add("<!-- ");
  char last = ' ';
  for (const char c : text) {
    if (c == '-' && last == '-') out.add(' ');
    out.add(c);
    last = c;
  }
  out.add(" -->\n");
}

/// XDMF's wedge is VTK's.
void add_cell_nodes(TextFile& out, const FileCells& block, std::size_t cell) {
  const auto nodes = block.nodes_of(cell);
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    out.add(n == 0 ? "" : " ", nodes[block.kind == CellKind::wedge ? kWedgeOrder[n] : n]);
  }
  out.add('\n');
}

/// Cells of one kind are a list of nodes; among others each begins with the number of its kind.
void add_topology(TextFile& out, const FileMesh& mesh) {
  const bool mixed = mesh.blocks().size() > 1;
  std::size_t numbers = 0;
  for (const FileCells& block : mesh.blocks()) numbers += block.nodes.size() + (mixed ? block.size() : 0);
  const FileCells& first = mesh.blocks().front();
  out.add("<Topology TopologyType=\"", mixed ? "Mixed" : topology_of(first).name, "\" NumberOfElements=\"",
          mesh.cell_count(),
          "\">\n<DataItem NumberType=\"UInt\" Precision=\"8\" Format=\"XML\" Dimensions=\"");
  if (mixed) {
    out.add(numbers, "\">\n");
  } else {
    out.add(first.size(), ' ', first.nodes_per_cell, "\">\n");
  }
  for (const FileCells& block : mesh.blocks()) {
    for (std::size_t c = 0; c < block.size(); ++c) {
      if (mixed) out.add(topology_of(block).number, ' ');
      add_cell_nodes(out, block, c);
    }
  }
  out.add("</DataItem>\n</Topology>\n");
}

void add_geometry(TextFile& out, const FileMesh& mesh) {
  out.add(
      "<Geometry GeometryType=\"XYZ\">\n<DataItem NumberType=\"Float\" Precision=\"8\" Format=\"XML\" "
      "Dimensions=\"",
      mesh.points().size(), " 3\">\n");
  for (const Vec3& p : mesh.points()) {
    out.add_point(p, " ");
    out.add('\n');
  }
  out.add("</DataItem>\n</Geometry>\n");
}

void add_labels(TextFile& out, const FileMesh& mesh) {
  out.add(
      "<Attribute Name=\"label\" AttributeType=\"Scalar\" Center=\"Cell\">\n<DataItem NumberType=\"Int\" "
      "Precision=\"4\" Format=\"XML\" Dimensions=\"",
      mesh.cell_count(), "\">\n");
  for (const FileCells& block : mesh.blocks()) {
    for (const Label label : block.labels) out.add(label, '\n');
  }
  out.add("</DataItem>\n</Attribute>\n");
}

}  // namespace

void write_xdmf(const FileMesh& mesh, const std::filesystem::path& path, const MeshFileOptions& options) {
  TextFile out(path);
  out.add("<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<Xdmf Version=\"3.0\">\n<Domain>\n",
          "<Grid Name=\"CBC3D\" GridType=\"Uniform\">\n");
  add_comment(out, coordinates_statement(options));
  for (const std::string& line : name_statements(options.names, mesh.labels())) add_comment(out, line);
  add_geometry(out, mesh);
  add_topology(out, mesh);
  add_labels(out, mesh);
  out.add("</Grid>\n</Domain>\n</Xdmf>\n");
  out.close();
}

}  // namespace cbc3d
