// Tets that their circumcentres gave a material which they have no part of: repair by the neighbours.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "mesher/core/mesh.hpp"

namespace cbc3d::baselines::podm {

inline constexpr std::uint32_t kNoTet = 0xFFFFFFFFU;

/// All tets of a triangulation, background included.
struct LabelledComplex {
  std::vector<Vec3> points;
  TetNodes tets;                                         ///< positive
  std::vector<std::array<std::uint32_t, 4>> neighbours;  ///< across from each node; kNoTet on the hull
  std::vector<MaterialId> materials;                     ///< of the tets
};

/// Gives small pieces of a material to the material around them that has most facets with them: pieces of
/// fewer than `tets` tets, connected by facets, that are not the largest of their material and whose tets all
/// have other materials at their centroids, by `material_at`. So every facet between two materials was one
/// before, and what the image has stays. Returns the number of tets that changed.
std::size_t repair_orphans(LabelledComplex& complex, std::size_t tets,
                           const std::function<MaterialId(const Vec3&)>& material_at);

/// The mesh of the tets that are not background, with the labels of their materials.
Mesh mesh_of(const LabelledComplex& complex, const std::vector<Label>& labels);

}  // namespace cbc3d::baselines::podm
