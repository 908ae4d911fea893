#include "mesher/mesh_formats/febio_writing.hpp"

#include <algorithm>

#include "mesher/mesh_formats/surface_groups.hpp"
#include "mesher/mesh_formats/text_file.hpp"

namespace cbc3d {
namespace {

/// The cells of one label in one block.
struct Domain {
  std::string name, material;
  const FileCells* block;
  std::size_t first;  // number of the block's first cell
  std::vector<std::size_t> cells;
};

/// The domain of a label's first block has the label's name; those of further blocks have the kind's behind
/// it.
std::vector<Domain> domains_of(const FileMesh& mesh, const LabelNames& names) {
  std::vector<Domain> domains;
  std::size_t first = 1;
  for (const FileCells& block : mesh.blocks()) {
    const std::size_t before = domains.size();
    for (const std::size_t c : cells_by_label(block)) {
      const std::string material = names.identifier(block.labels[c]);
      if (domains.size() == before || domains.back().material != material) {
        const bool again = std::any_of(domains.begin(), domains.end(),
                                       [&](const Domain& domain) { return domain.material == material; });
        const std::string name = again ? material + "__" + block.row().febio : material;
        domains.push_back({name, material, &block, first, {}});
      }
      domains.back().cells.push_back(c);
    }
    first += block.size();
  }
  return domains;
}

void add_materials(TextFile& out, const FileMesh& mesh, const LabelNames& names) {
  out.add("  <!-- Placeholders: give every label its own material. -->\n  <Material>\n");
  std::size_t number = 0;
  for (const Label label : mesh.labels()) {
    out.add("    <material id=\"", ++number, "\" name=\"", names.identifier(label),
            "\" type=\"neo-Hookean\"><density>1</density><E>1</E><v>0.3</v></material>\n");
  }
  out.add("  </Material>\n");
}

void add_ids(TextFile& out, std::span<const VertexId> nodes) {
  for (std::size_t n = 0; n < nodes.size(); ++n) out.add(n == 0 ? "" : ",", nodes[n] + 1);
}

void add_nodes(TextFile& out, const FileMesh& mesh) {
  out.add("    <Nodes name=\"all_nodes\">\n");
  for (std::size_t v = 0; v < mesh.points().size(); ++v) {
    out.add("      <node id=\"", v + 1, "\">");
    out.add_point(mesh.points()[v], ",");
    out.add("</node>\n");
  }
  out.add("    </Nodes>\n");
}

void add_elements(TextFile& out, const std::vector<Domain>& domains) {
  for (const Domain& domain : domains) {
    out.add("    <Elements type=\"", domain.block->row().febio, "\" name=\"", domain.name, "\">\n");
    for (const std::size_t c : domain.cells) {
      out.add("      <elem id=\"", domain.first + c, "\">");
      add_ids(out, domain.block->nodes_of(c));
      out.add("</elem>\n");
    }
    out.add("    </Elements>\n");
  }
}

void add_surfaces(TextFile& out, const FileMesh& mesh, const LabelNames& names) {
  std::array<VertexId, 6> nodes;
  for (const SurfaceGroup& group : surface_groups(mesh, names)) {
    out.add("    <Surface name=\"", group.name, "\">\n");
    std::size_t number = 0;
    for (const CellFacet& facet : *group.facets) {
      const std::size_t count = mesh.nodes_of(facet, nodes);
      const char* const type = count == 3 ? "tri3" : count == 4 ? "quad4" : "tri6";
      out.add("      <", type, " id=\"", ++number, "\">");
      add_ids(out, std::span(nodes).first(count));
      out.add("</", type, ">\n");
    }
    out.add("    </Surface>\n");
  }
}

}  // namespace

void write_febio(const FileMesh& mesh, const std::filesystem::path& path, const MeshFileOptions& options) {
  const std::vector<Domain> domains = domains_of(mesh, options.names);
  TextFile out(path);
  out.add(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<febio_spec version=\"4.0\">\n  <!-- CBC3D mesh, "
      "coordinates ",
      options.coordinates, options.coordinates == "voxel" ? "" : ", mm",
      " -->\n  <Module type=\"solid\"/>\n");
  add_materials(out, mesh, options.names);
  out.add("  <Mesh>\n");
  add_nodes(out, mesh);
  add_elements(out, domains);
  add_surfaces(out, mesh, options.names);
  out.add("  </Mesh>\n  <MeshDomains>\n");
  for (const Domain& domain : domains) {
    out.add("    <SolidDomain name=\"", domain.name, "\" mat=\"", domain.material, "\"/>\n");
  }
  out.add("  </MeshDomains>\n</febio_spec>\n");
  out.close();
}

}  // namespace cbc3d
