#include "metrics/faults.hpp"

#include <array>
#include <cstdio>

namespace cbc3d::metrics {
namespace {

constexpr std::array<const char*, 4> kKindNames{"tet", "pyramid", "wedge", "hex"};

std::string place(const Vec3& p) {
  std::array<char, 96> text;
  std::snprintf(text.data(), text.size(), "(%.6g, %.6g, %.6g) mm", p.x, p.y, p.z);
  return text.data();
}

class FaultList {
 public:
  explicit FaultList(const MeshView& view) : view_(view) {}

  void add(const std::string& text) { lines_.push_back(text); }
  void add_at_cell(std::int64_t count, const std::string& what, std::size_t cell) {
    if (count > 0) {
      const CellView found = view_.cell(cell);
      Vec3 centre{};
      for (const VertexId v : found.nodes) {
        centre += view_.mesh().points[v] / static_cast<double>(found.nodes.size());
      }
      add(std::to_string(count) + " " + what + ", first " + kKindNames[static_cast<std::size_t>(found.kind)] +
          " (cell " + std::to_string(cell) + ") at " + place(centre));
    }
  }
  void add_at_vertex(const CountedFault& fault, const std::string& what) {
    if (fault.count > 0) {
      add(std::to_string(fault.count) + " " + what + ", first vertex " + std::to_string(fault.first) +
          " at " + place(view_.mesh().points[fault.first]));
    }
  }
  [[nodiscard]] std::vector<std::string> take() { return std::move(lines_); }

 private:
  const MeshView& view_;
  std::vector<std::string> lines_;
};

std::string text_of(const Betti& betti) {
  return std::to_string(betti.b[0]) + " parts, " + std::to_string(betti.b[1]) + " tunnels, " +
         std::to_string(betti.b[2]) + " cavities";
}

void add_betti(FaultList& faults, const std::string& who, const CellSetTopology& mesh,
               const VoxelSetTopology& image) {
  if (!mesh.betti) {
    faults.add(who + ": its cells do not fit together as a set in space; no Betti numbers");
  } else if (!(*mesh.betti == image.closed) && !(*mesh.betti == image.open)) {
    faults.add(who + ": " + text_of(*mesh.betti) + " in the mesh, " + text_of(image.closed) +
               " in the image" +
               (image.closed == image.open ? "" : " (" + text_of(image.open) + " as an open set)"));
  }
}

void add_label_faults(FaultList& faults, const MeshView& view, const Topology& topology,
                      const ImageTopology& image_topology, const LabelImage& image) {
  for (std::size_t l = 0; l < topology.per_label.size(); ++l) {
    const LabelTopology& one = topology.per_label[l];
    const std::string who = "label " + std::to_string(view.labels()[l]);
    if (one.non_manifold_edges + one.non_manifold_vertices > 0) {
      faults.add(who + ": its surface is non-manifold at " + std::to_string(one.non_manifold_edges) +
                 " edges and " + std::to_string(one.non_manifold_vertices) + " further vertices");
    }
    if (const VoxelSetTopology* in_image = find_label(image_topology, image, view.labels()[l])) {
      add_betti(faults, who, topology.betti.per_label[l], *in_image);
    }
  }
  add_betti(faults, "all labels together", topology.betti.all, image_topology.all);
}

}  // namespace

std::vector<std::string> describe_faults(const MeshView& view, const MeshQuality& quality,
                                         const Topology& topology, const SelfIntersections& crossing,
                                         const ImageTopology& image_topology, const LabelImage& image,
                                         const LabelComparison& labels) {
  FaultList faults(view);
  if (view.cell_count() == 0) {
    faults.add("the mesh has no cells");
  }
  const ElementQuality& all = quality.all;
  faults.add_at_cell(all.inverted,
                     "inverted or flat cells (" + std::to_string(all.degenerate) + " of them flat)",
                     all.first_inverted.value_or(0));
  if (all.negative_jacobian > all.inverted) {
    faults.add(std::to_string(all.negative_jacobian - all.inverted) +
               " cells of positive volume are folded at a corner (scaled Jacobian not above 0)");
  }
  const auto at_cell = [&](const CountedFault& fault, const char* what) {
    faults.add_at_cell(fault.count, what, fault.first);
  };
  at_cell(topology.overfull_facets, "facets with more than two cells");
  at_cell(topology.misoriented_facets, "facets whose two cells lie on the same side");
  faults.add_at_vertex(topology.duplicate_vertices, "vertices where another vertex is");
  faults.add_at_vertex(topology.hanging_vertices,
                       "vertices that hang in a facet or an edge of another cell (T-junctions)");
  faults.add_at_vertex(topology.unused_vertices, "vertices of no cell");
  if (crossing.pairs > 0) {
    faults.add(std::to_string(crossing.pairs) +
               " pairs of surface facets that cut, touch or overlap each other, first at " +
               place(crossing.first_at_mm));
  }
  for (const Label label : labels.missing) {
    faults.add("label " + std::to_string(label) + " of the image is in no cell");
  }
  for (const Label label : labels.unknown) {
    faults.add("label " + std::to_string(label) + " of the mesh is not in the image");
  }
  if (view.cell_count() > 0) {
    add_label_faults(faults, view, topology, image_topology, image);
  }
  return faults.take();
}

}  // namespace cbc3d::metrics
