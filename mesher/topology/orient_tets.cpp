#include "mesher/topology/orient_tets.hpp"

#include <algorithm>

#include "mesher/core/error.hpp"

namespace cbc3d {
namespace {

double signed_volume(const MaterialMesh& mesh, TetId t) {
  const auto& n = mesh.tets[t];
  return six_volumes(mesh.points[n[0]], mesh.points[n[1]], mesh.points[n[2]], mesh.points[n[3]]);
}

std::size_t drop_degenerate(MaterialMesh& mesh) {
  std::size_t kept = 0;
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    auto sorted = mesh.tets[t];
    std::sort(sorted.begin(), sorted.end());
    if (std::adjacent_find(sorted.begin(), sorted.end()) == sorted.end()) {
      mesh.tets[kept] = mesh.tets[t];
      mesh.materials[kept++] = mesh.materials[t];
    }
  }
  const std::size_t dropped = mesh.tets.size() - kept;
  mesh.tets.resize(kept);
  mesh.materials.resize(kept);
  return dropped;
}

/// True when two tets see the face they share, opposite to a's node n, in opposite senses, as is right.
bool agree(const std::array<VertexId, 4>& a, std::size_t n, const std::array<VertexId, 4>& b) {
  const auto& face = kTetFace[n];
  const auto in_b = [&](std::size_t i) {
    return static_cast<std::size_t>(std::find(b.begin(), b.end(), a[face[i]]) - b.begin());
  };
  const std::size_t i = in_b(0);
  const std::size_t j = in_b(1);
  const auto& other = kTetFace[6 - i - j - in_b(2)];
  const auto at = static_cast<std::size_t>(std::find(other.begin(), other.end(), i) - other.begin());
  return other[(at + 1) % 3] != j;
}

/// Follows the faces from one tet, turning what disagrees; the tets in order of first sight.
std::vector<TetId> follow(MaterialMesh& mesh, const TetNeighbours& neighbours, TetId first,
                          std::vector<std::uint8_t>& seen, std::vector<std::uint8_t>& turned) {
  std::vector<TetId> part = {first};
  seen[first] = 1;
  for (std::size_t i = 0; i < part.size(); ++i) {
    // The neighbours are numbered by the nodes as they were, before a turn swapped the first two.
    const TetId t = part[i];
    for (std::size_t n = 0; n < 4; ++n) {
      const TetId next = neighbours[t][turned[t] != 0 && n < 2 ? 1 - n : n];
      if (next == kNoTet || seen[next] != 0) {
        continue;
      }
      seen[next] = 1;
      part.push_back(next);
      if (!agree(mesh.tets[t], n, mesh.tets[next])) {
        std::swap(mesh.tets[next][0], mesh.tets[next][1]);
        turned[next] = 1;
      }
    }
  }
  return part;
}

}  // namespace

std::size_t count_not_positive(const MaterialMesh& mesh) {
  std::size_t count = 0;
  for (TetId t = 0; t < mesh.tets.size(); ++t) {
    count += signed_volume(mesh, t) > 0 ? 0 : 1;
  }
  return count;
}

OrientReport orient_tets(MaterialMesh& mesh) {
  OrientReport report;
  report.degenerate = drop_degenerate(mesh);
  TetNeighbours neighbours;
  try {
    neighbours = tet_neighbours(mesh.tets, mesh.points.size());
  } catch (const JobError&) {
    throw InputError(
        "the mesh has a face that belongs to more than two tets; give one whose tets meet face to face");
  }
  std::vector<std::uint8_t> seen(mesh.tets.size(), 0);
  std::vector<std::uint8_t> turned(mesh.tets.size(), 0);
  for (TetId t = 0; t < mesh.tets.size(); ++t) {
    if (seen[t] != 0) {
      continue;
    }
    const std::vector<TetId> part = follow(mesh, neighbours, t, seen, turned);
    double volume = 0;
    for (const TetId p : part) {
      volume += signed_volume(mesh, p);
    }
    for (const TetId p : part) {
      if (volume < 0) {
        std::swap(mesh.tets[p][0], mesh.tets[p][1]);
        turned[p] ^= 1;
      }
      report.turned += turned[p];
    }
  }
  report.not_positive = count_not_positive(mesh);
  return report;
}

}  // namespace cbc3d
