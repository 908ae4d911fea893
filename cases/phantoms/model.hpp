// A phantom as layers of solids, each painted over those before it, slice by slice: an image of any size can
// be made a slab at a time.
#pragma once

#include <functional>
#include <vector>

#include "cases/phantoms/tubes.hpp"
#include "mesher/core/label_image.hpp"

namespace cbc3d::cases {

/// Signed distance of a label's region at a physical position, mm, negative inside.
using SignedDistance = std::function<double(const Vec3& physical_mm, Label label)>;

struct Layer {
  MaterialId material;
  /// Paints slice k of a frame; safe to call from several threads.
  std::function<void(const ImageFrame&, int k, PaintedVoxel* slice)> paint;
  /// Signed distance of the layer's solid at a local position, mm, negative inside; empty: not known.
  std::function<double(const Vec3& local_mm)> distance_mm;
};

struct PhantomModel {
  std::vector<Layer> layers;
  int label_count = 0;  ///< material m has label m, 1..label_count
};

/// A layer of tubes: their distance is known.
Layer tube_layer(MaterialId material, Tubes tubes);

/// A layer of the voxels whose centres a predicate on local positions holds: its distance is not known.
Layer predicate_layer(MaterialId material, std::function<bool(const Vec3& local_mm)> holds);

/// Paints the slices first..last-1 into `voxels`, in parallel; overwrites what was there.
void paint_slab(const PhantomModel& model, const ImageFrame& frame, int first, int last,
                PaintedVoxel* voxels);

/// Signed distance of a label's region at a local position, mm, negative inside: the label's solids less
/// those painted over them. The sign is that of the voxels at every voxel centre, and where two solids meet
/// at an edge the size is a lower bound. NaN when one of these solids has no known distance.
double signed_distance_mm(const PhantomModel& model, const Vec3& local_mm, MaterialId material);

/// Radius below which tubes begin to fall apart into specks: three quarters of the mean spacing, a little
/// more than half the diagonal of a voxel's face. The phantoms make no tube thinner.
double thinnest_radius_mm(const Vec3& spacing_mm);

}  // namespace cbc3d::cases
