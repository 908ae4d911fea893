#include "mesher/lattice/part_raster.hpp"

#include <algorithm>

namespace cbc3d {

std::vector<MisplacedPart> PartRaster::misplaced(const Lattice& lattice, const CandidateMesh& mesh) const {
  std::vector<MisplacedPart> misplaced;
#pragma omp parallel
  {
    std::vector<MisplacedPart> own;
#pragma omp for schedule(dynamic, 1024) nowait
    for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
      const auto& n = mesh.tets.nodes[t];
      add_misplaced({lattice.points[n[0]], lattice.points[n[1]], lattice.points[n[2]], lattice.points[n[3]]},
                    mesh.materials[t], own);
    }
#pragma omp critical(cbc3d_misplaced)
    misplaced.insert(misplaced.end(), own.begin(), own.end());
  }
  // Each part is in one tet, so the offsets differ and their order is that of no thread.
  std::sort(misplaced.begin(), misplaced.end(),
            [](const MisplacedPart& a, const MisplacedPart& b) { return a.offset < b.offset; });
  return misplaced;
}

void PartRaster::add_misplaced(const std::array<LatticePoint, 4>& tet, MaterialId own,
                               std::vector<MisplacedPart>& misplaced) const {
  raster_.for_each_row(tet, [&](int j, int k, int i_begin, int i_end) {
    for (int i = i_begin; i < i_end; ++i) {
      if (material_of(i, j, k) != own) {
        misplaced.push_back({frame_.offset(i, j, k), own});
      }
    }
  });
}

bool PartRaster::holds_other(const std::array<LatticePoint, 4>& tet, MaterialId own) const {
  bool found = false;
  raster_.for_each_row(tet, [&](int j, int k, int i_begin, int i_end) {
    for (int i = i_begin; i < i_end && !found; ++i) {
      found = material_of(i, j, k) != own;
    }
    return found;
  });
  return found;
}

TopologyDifferences find_topology_differences(const LabelImage& image, const Lattice& lattice,
                                              const CandidateMesh& mesh, const std::vector<Label>& labels) {
  constexpr std::size_t kMostHalves = 4000000;  // there are eight times as many quarters
  TopologyDifferences found;
  for (const int fewest : {kHalves, 2 * kHalves}) {
    const std::vector<MisplacedPart> parts =
        PartRaster(image, lattice.frame, fewest).misplaced(lattice, mesh);
    found.places = find_topology_differences(image, parts, labels, fewest);
    found.misplaced = voxels_of_parts(image.frame, parts, fewest);
    if (!found.places.empty() || parts.size() > kMostHalves) {
      break;
    }
  }
  return found;
}

}  // namespace cbc3d
