// A mesh in parts: cut for the decimation of each by itself, and put together again.
#pragma once

#include <vector>

#include "baselines/ld/lattice_mesh.hpp"

namespace cbc3d::baselines::ld {

/// A piece of the boundary near a facet that no part can change, which is named by the places of its
/// vertices.
struct LoosePiece {
  std::array<LatticePoint, 3> corners{};
  std::array<LatticePoint, 3> facet{};
};

/// One mesh of all parts: frozen vertices of the same place become one, and none is frozen any more; one that
/// is open in a part stays open. Vertices and tets are in the order of the parts, which are emptied.
LatticeMesh joined(std::vector<LatticeMesh>& parts, const std::vector<LoosePiece>& loose_pieces = {});

/// A mesh cut into boxes: tets by their centroids. Those vertices of a part are frozen that other parts have
/// too.
class MeshParts {
 public:
  /// `side` and `shift` in cells: the first boxes begin `shift` before the lattice's origin. `mesh` must
  /// outlive the parts.
  MeshParts(const LatticeMesh& mesh, int side, int shift);

  /// The number of parts with tets.
  [[nodiscard]] std::size_t size() const { return begins_.size() - 1; }
  /// True when a vertex that is open is in this part alone.
  [[nodiscard]] bool has_work(std::size_t part) const { return has_work_[part] != 0; }
  [[nodiscard]] LatticeMesh part(std::size_t part) const;
  /// Pieces of the boundary that are in no part.
  [[nodiscard]] std::vector<LoosePiece> loose_pieces() const;

 private:
  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;
  static constexpr std::uint32_t kSeveral = 0xFFFFFFFEU;

  [[nodiscard]] std::uint32_t home_of(const BoundaryPiece& piece) const;
  void sort_tets(int side, int shift);
  void find_homes();
  void sort_pieces();

  const LatticeMesh& mesh_;
  std::vector<std::uint32_t> tets_;   // by part
  std::vector<std::size_t> begins_;   // of each part in tets_, and the end
  std::vector<std::uint32_t> homes_;  // of each vertex: its only part, or kSeveral
  std::vector<std::uint8_t> has_work_;
  std::vector<std::uint32_t> pieces_;  // by part
  std::vector<std::size_t> piece_begins_;
};

}  // namespace cbc3d::baselines::ld
