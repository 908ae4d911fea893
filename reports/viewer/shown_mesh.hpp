// A mesh as the page's 3D view shows it: tets alone, with their quality, and no more than a page can hold.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "mesher/core/mesh.hpp"

namespace cbc3d::reports {

/// One of the worst tets, exactly as it is.
struct WorstTet {
  std::array<Vec3, 4> points;
  std::uint16_t label = 0;  ///< index into ShownMesh::labels
  double min_dihedral_deg = 0, mean_ratio = 0;
};

struct ShownMesh {
  std::vector<Vec3> points;
  std::vector<std::array<VertexId, 4>> tets;
  std::vector<std::uint16_t> label_index;  ///< of each tet, into `labels`
  std::vector<float> min_dihedral_deg;     ///< of each tet
  std::vector<float> mean_ratio;           ///< of each tet; negative for an inverted one
  std::vector<std::uint8_t> boundary;      ///< of each tet: bit i, its face opposite corner i is a facet
  std::vector<Label> labels;               ///< distinct, ascending
  std::vector<WorstTet> worst;             ///< by smallest dihedral angle, the worst first
  std::size_t tets_of_mesh = 0;            ///< before vertices were merged
  double merged_within_mm = 0;             ///< edge of the grid whose vertices were merged; 0: none were
};

/// Tets are shown as they are while there are at most `most_tets`. Of more, vertices within the cells of a
/// grid become one, those on boundaries of labels apart from those inside (Rossignac and Borrel 1993:
/// multi-resolution 3D approximations), with the finest grid that leaves no more. Tets then keep the quality
/// that they had; the `most_worst` worst keep their shape too. Pyramids, wedges and hexes are split into
/// tets, whose quality it is. Throws InputError when a cell names a vertex that does not exist.
ShownMesh shown_mesh(const Mesh& mesh, std::size_t most_tets, std::size_t most_worst = 100);

/// How many tets each mesh may show where all together may have `total`: those with fewer than their share
/// leave the rest to the others.
std::size_t tets_for_each(std::vector<std::size_t> counts, std::size_t total);

}  // namespace cbc3d::reports
