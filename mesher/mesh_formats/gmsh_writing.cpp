#include "mesher/mesh_formats/gmsh_writing.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "mesher/core/error.hpp"
#include "mesher/mesh_formats/mesh_statements.hpp"
#include "mesher/mesh_formats/surface_groups.hpp"
#include "mesher/mesh_formats/text_file.hpp"

namespace cbc3d {
namespace {

namespace fs = std::filesystem;

constexpr int kTriangle = 2, kQuad = 3, kQuadraticTriangle = 9;

int type_of_facet(std::size_t nodes) {
  return nodes == 3 ? kTriangle : nodes == 4 ? kQuad : kQuadraticTriangle;
}

/// Writes node numbers, which count from 1; Gmsh has the last two nodes of a quadratic tet the other way
/// about.
void add_nodes(TextFile& out, std::span<const VertexId> nodes) {
  const bool quadratic_tet = nodes.size() == 10;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const std::size_t from = quadratic_tet && n >= 8 ? 17 - n : n;
    out.add(' ', nodes[from] + 1);
  }
  out.add('\n');
}

void add_header(TextFile& out, const FileMesh& mesh, const std::vector<SurfaceGroup>& groups,
                const char* version, const MeshFileOptions& options) {
  out.add("$MeshFormat\n", version, " 0 8\n$EndMeshFormat\n$Comments\n", coordinates_statement(options),
          '\n');
  for (const std::string& line : name_statements(options.names, mesh.labels())) out.add(line, '\n');
  out.add("$EndComments\n$PhysicalNames\n", groups.size() + mesh.labels().size(), '\n');
  for (std::size_t g = 0; g < groups.size(); ++g) {
    out.add("2 ", g + 1, " \"", groups[g].name, "\"\n");
  }
  for (const Label label : mesh.labels()) {
    out.add("3 ", label, " \"", options.names.identifier(label), "\"\n");
  }
  out.add("$EndPhysicalNames\n");
}

std::size_t facet_count(const std::vector<SurfaceGroup>& groups) {
  std::size_t count = 0;
  for (const SurfaceGroup& group : groups) count += group.facets->size();
  return count;
}

void add_elements22(TextFile& out, const FileMesh& mesh, const std::vector<SurfaceGroup>& groups) {
  std::size_t number = 0;
  std::array<VertexId, 6> nodes;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    for (const CellFacet& facet : *groups[g].facets) {
      const std::size_t count = mesh.nodes_of(facet, nodes);
      out.add(++number, ' ', type_of_facet(count), " 2 ", g + 1, ' ', g + 1);
      add_nodes(out, std::span(nodes).first(count));
    }
  }
  for (const FileCells& block : mesh.blocks()) {
    for (std::size_t c = 0; c < block.size(); ++c) {
      out.add(++number, ' ', block.row().gmsh, " 2 ", block.labels[c], ' ', block.labels[c]);
      add_nodes(out, block.nodes_of(c));
    }
  }
}

/// A surface or volume of version 4.1: its number, which is also that of its physical group, and its bounding
/// box.
struct Entity {
  int dimension;
  int tag;
  Vec3 low{kFar, kFar, kFar}, high{-kFar, -kFar, -kFar};
  std::vector<int> bounds;         // surfaces of a volume
  std::vector<VertexId> vertices;  // those that are classified on it

  static constexpr double kFar = std::numeric_limits<double>::max();
  void include(const Vec3& p) {
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], p[axis]);
      high[axis] = std::max(high[axis], p[axis]);
    }
  }
};

/// Every vertex is classified on the first surface that it lies on, or else on the volume of its label.
class Entities {
 public:
  Entities(const FileMesh& mesh, const std::vector<SurfaceGroup>& groups)
      : owner_(mesh.points().size(), kNone) {
    for (std::size_t g = 0; g < groups.size(); ++g) add_surface(mesh, groups[g], static_cast<int>(g) + 1);
    for (const Label label : mesh.labels()) add_volume(groups, label);
    surfaces_ = groups.size();
    for (const FileCells& block : mesh.blocks()) {
      for (std::size_t n = 0; n < block.nodes.size(); ++n) {
        take_vertex(mesh, block.nodes[n], volume_of(mesh, block.labels[n / block.nodes_per_cell]));
      }
    }
    for (std::size_t v = 0; v < owner_.size(); ++v) {
      if (owner_[v] != kNone) all_[owner_[v]].vertices.push_back(static_cast<VertexId>(v));
    }
  }
  [[nodiscard]] const std::vector<Entity>& all() const { return all_; }
  [[nodiscard]] std::size_t surfaces() const { return surfaces_; }

 private:
  static constexpr std::size_t kNone = ~std::size_t{0};

  [[nodiscard]] std::size_t volume_of(const FileMesh& mesh, Label label) const {
    const auto& labels = mesh.labels();
    return surfaces_ +
           static_cast<std::size_t>(std::lower_bound(labels.begin(), labels.end(), label) - labels.begin());
  }
  void take_vertex(const FileMesh& mesh, VertexId v, std::size_t entity) {
    if (owner_[v] == kNone) owner_[v] = entity;
    all_[entity].include(mesh.points()[v]);
  }
  void add_surface(const FileMesh& mesh, const SurfaceGroup& group, int tag) {
    all_.push_back({.dimension = 2, .tag = tag, .bounds = {}, .vertices = {}});
    std::array<VertexId, 6> nodes;
    for (const CellFacet& facet : *group.facets) {
      const std::size_t count = mesh.nodes_of(facet, nodes);
      for (std::size_t n = 0; n < count; ++n) take_vertex(mesh, nodes[n], all_.size() - 1);
    }
  }
  void add_volume(const std::vector<SurfaceGroup>& groups, Label label) {
    all_.push_back({.dimension = 3, .tag = label, .bounds = {}, .vertices = {}});
    for (std::size_t g = 0; g < groups.size(); ++g) {
      if (groups[g].label == label) all_.back().bounds.push_back(static_cast<int>(g) + 1);
    }
  }

  std::vector<Entity> all_;
  std::size_t surfaces_ = 0;
  std::vector<std::size_t> owner_;  // of every vertex
};

void add_entities(TextFile& out, const Entities& entities) {
  out.add("$Entities\n0 0 ", entities.surfaces(), ' ', entities.all().size() - entities.surfaces(), '\n');
  for (const Entity& entity : entities.all()) {
    out.add(entity.tag, ' ');
    out.add_point(entity.low, " ");
    out.add(' ');
    out.add_point(entity.high, " ");
    out.add(" 1 ", entity.tag, ' ', entity.bounds.size());
    for (const int bound : entity.bounds) out.add(' ', bound);
    out.add('\n');
  }
  out.add("$EndEntities\n");
}

void add_nodes41(TextFile& out, const FileMesh& mesh, const Entities& entities) {
  std::size_t used = 0;
  for (const Entity& entity : entities.all()) used += entity.vertices.size();
  out.add("$Nodes\n", entities.all().size(), ' ', used, " 1 ", mesh.points().size(), '\n');
  for (const Entity& entity : entities.all()) {
    out.add(entity.dimension, ' ', entity.tag, " 0 ", entity.vertices.size(), '\n');
    for (const VertexId v : entity.vertices) out.add(v + 1, '\n');
    for (const VertexId v : entity.vertices) {
      out.add_point(mesh.points()[v], " ");
      out.add('\n');
    }
  }
  out.add("$EndNodes\n");
}

/// The facets of a group, or the cells of a block with one label, that have one type: what version 4.1 lists
/// together.
struct ElementList {
  int dimension, tag, type;
  std::vector<std::size_t> elements;
};

class ElementLists {
 public:
  ElementLists(const FileMesh& mesh, const std::vector<SurfaceGroup>& groups) : mesh_(mesh), groups_(groups) {
    std::array<VertexId, 6> nodes;
    for (std::size_t g = 0; g < groups.size(); ++g) {
      for (std::size_t f = 0; f < groups[g].facets->size(); ++f) {
        const int type = type_of_facet(mesh.nodes_of((*groups[g].facets)[f], nodes));
        list(2, static_cast<int>(g) + 1, type).push_back(f);
      }
    }
    for (const FileCells& block : mesh.blocks()) {
      for (const std::size_t c : cells_by_label(block))
        list(3, block.labels[c], block.row().gmsh).push_back(c);
    }
  }

  void write(TextFile& out) const {
    std::size_t count = 0, number = 0;
    for (const ElementList& each : lists_) count += each.elements.size();
    out.add("$Elements\n", lists_.size(), ' ', count, " 1 ", count, '\n');
    for (const ElementList& each : lists_) {
      out.add(each.dimension, ' ', each.tag, ' ', each.type, ' ', each.elements.size(), '\n');
      for (const std::size_t element : each.elements) {
        out.add(++number);
        write_nodes(out, each, element);
      }
    }
    out.add("$EndElements\n");
  }

 private:
  std::vector<std::size_t>& list(int dimension, int tag, int type) {
    const auto same = [&](const ElementList& each) {
      return each.dimension == dimension && each.tag == tag && each.type == type;
    };
    const auto found = std::find_if(lists_.rbegin(), lists_.rend(), same);
    if (found != lists_.rend()) return found->elements;
    lists_.push_back({dimension, tag, type, {}});
    return lists_.back().elements;
  }
  void write_nodes(TextFile& out, const ElementList& each, std::size_t element) const {
    if (each.dimension == 2) {
      std::array<VertexId, 6> nodes;
      const auto& facets = *groups_[static_cast<std::size_t>(each.tag - 1)].facets;
      add_nodes(out, std::span(nodes).first(mesh_.nodes_of(facets[element], nodes)));
      return;
    }
    const auto block = std::find_if(mesh_.blocks().begin(), mesh_.blocks().end(),
                                    [&](const FileCells& cells) { return cells.row().gmsh == each.type; });
    add_nodes(out, block->nodes_of(element));
  }

  const FileMesh& mesh_;
  const std::vector<SurfaceGroup>& groups_;
  std::vector<ElementList> lists_;
};

}  // namespace

void require_gmsh_labels(const std::vector<Label>& labels) {
  const auto lowest = std::min_element(labels.begin(), labels.end());
  if (lowest != labels.end() && *lowest <= 0) {
    throw InputError("Gmsh's physical groups must be positive and there is the label " +
                     std::to_string(*lowest) + "; write .vtu instead");
  }
}

void write_gmsh22(const FileMesh& mesh, const fs::path& path, const MeshFileOptions& options) {
  require_gmsh_labels(mesh.labels());
  const std::vector<SurfaceGroup> groups = surface_groups(mesh, options.names);
  TextFile out(path);
  add_header(out, mesh, groups, "2.2", options);
  out.add("$Nodes\n", mesh.points().size(), '\n');
  for (std::size_t v = 0; v < mesh.points().size(); ++v) {
    out.add(v + 1, ' ');
    out.add_point(mesh.points()[v], " ");
    out.add('\n');
  }
  out.add("$EndNodes\n$Elements\n", facet_count(groups) + mesh.cell_count(), '\n');
  add_elements22(out, mesh, groups);
  out.add("$EndElements\n");
  out.close();
}

void write_gmsh41(const FileMesh& mesh, const fs::path& path, const MeshFileOptions& options) {
  require_gmsh_labels(mesh.labels());
  const std::vector<SurfaceGroup> groups = surface_groups(mesh, options.names);
  const Entities entities(mesh, groups);
  TextFile out(path);
  add_header(out, mesh, groups, "4.1", options);
  add_entities(out, entities);
  add_nodes41(out, mesh, entities);
  ElementLists(mesh, groups).write(out);
  out.close();
}

}  // namespace cbc3d
