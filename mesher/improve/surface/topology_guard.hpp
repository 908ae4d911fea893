// Whether tets that are relabelled leave the topology of their labels as it was.
//
// The Euler characteristic of a label, vertices - edges + faces - tets of its closure, is its parts - tunnels
// + cavities. Relabelled tets change it by what their own vertices, edges and faces change alone, so it is
// counted there. An equal characteristic does not prove an equal topology: a tunnel less and a part less at
// one place cancel out. With groups of a few tets that is rare, and the finished mesh is compared as a whole.
#pragma once

#include "mesher/improve/surface/labelled_complex.hpp"

namespace cbc3d {

class TopologyGuard {
 public:
  /// Takes note of the materials, and of their labels, before `tets` are relabelled. `materials` are those
  /// that the tets have and are to have; none: nothing is guarded. A label that is non-manifold at one of the
  /// tets' vertices is not guarded, for it is to change there; neither is background.
  TopologyGuard(const LabelledComplex& complex, const std::vector<TetId>& tets,
                std::vector<MaterialId> materials);

  /// True while each of them has the characteristic that it had.
  [[nodiscard]] bool holds() const;

 private:
  struct Guarded {
    MaterialId material;
    bool as_label;  // with all materials of its label
    int characteristic;
  };

  void collect_cells(const std::vector<TetId>& tets);
  void guard(MaterialId material, bool as_label);
  [[nodiscard]] bool has(TetId t, const Guarded& what) const;
  [[nodiscard]] bool has_edge(const std::array<VertexId, 2>& edge, const Guarded& what) const;
  [[nodiscard]] int characteristic(const Guarded& what) const;

  const LabelledComplex& complex_;
  std::vector<VertexId> vertices_;
  std::vector<std::array<VertexId, 2>> edges_;
  std::vector<std::array<TetId, 2>> faces_;  // the tets on both sides, the second may be kNoTet
  std::vector<TetId> tets_;
  std::vector<Guarded> guarded_;
};

}  // namespace cbc3d
