// A surface net: the conforming interfaces of a label image as one triangle surface.
//
// The dual grid has a cell between every 2x2x2 voxel centres; a cell that sees more than one label holds one
// net vertex, and every voxel face between two labels becomes a quad between the four cells around it.
// Unsmoothed, with every vertex at its cell's centre, the net is exactly the voxels' boundary; smoothing
// moves each vertex within its own cell, so that no label can vanish and sheets hardly ever meet.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesher/core/label_image.hpp"

namespace cbc3d::baselines {

struct SurfaceNetOptions {
  int smoothing_steps =
      20;  ///< Jacobi steps, alternately shrinking and growing (Taubin), which keeps volumes
  /// Largest distance of a vertex from its cell's centre along each axis, as a share of the cell's edge:
  /// below one half, so that vertices of neighbouring cells cannot meet.
  double reach = 0.3;
};

/// Two materials on the sides of a net triangle: `behind` where its right-hand normal comes from, `ahead`
/// where it points to.
struct NetSides {
  MaterialId behind = kBackground;
  MaterialId ahead = kBackground;
};

/// Points are in local mm; the outside of the image counts as background.
struct SurfaceNet {
  std::vector<Vec3> points;   ///< one for each cell that sees more than one label
  std::vector<Vec3> centres;  ///< of those cells
  std::vector<std::array<int, 3>> triangles;
  std::vector<NetSides> sides;            ///< of each triangle
  std::vector<std::array<int, 6>> links;  ///< net vertices that a vertex is smoothed towards; -1: none
  Vec3 reach_mm;                          ///< largest distance of a point from its centre along each axis
};

/// The smoothed net of `image`. Every material has its closed surface in it.
SurfaceNet surface_net(const LabelImage& image, const SurfaceNetOptions& options);

/// Halves the distance to their cells' centres of the flagged vertices and of their neighbours in the net.
void retract(SurfaceNet& net, const std::vector<std::uint8_t>& flagged);

}  // namespace cbc3d::baselines
