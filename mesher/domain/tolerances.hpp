// The tolerances of the quality preset: one place for each figure, with its meaning and, where it has one,
// its reason.
//
// Unit: all lengths are multiples of Domain::scale_mm, which is the voxel diagonal for an image: what an
// image is sure of. The ladder starts from there: a finished surface is about one diagonal from the voxels
// that it stands for, and later steps may give away a little of that for better elements.
#pragma once

namespace cbc3d::tolerances {

// ---- From the image to the mesh: a boundary voxel and the nearest vertex of its interface.

/// The reach: the refinement makes, and the improvement keeps, a vertex of its interface within this of every
/// boundary voxel.
inline constexpr double kReach = 1;
/// Edges of a decimated surface are this many times as long as the reach: measured on organs, vessels and
/// bones.
inline constexpr double kEdgesPerReach = 1.7;
/// What the reach may grow to while bad tets are repaired and self-intersections separated, in steps of
/// kRepairStep for each round: the last bad tets need a little more distance to move.
inline constexpr double kRepairReach = 1.1;
/// The reach of `cbc3d improve` with an image: a finished mesh is to come closer than the reach asks for.
inline constexpr double kImproveReach = 0.9;
/// The reach in thin parts, in multiples of the largest voxel spacing, where it is smaller than the reach: a
/// part one voxel thick loses its tips otherwise.
inline constexpr double kThinReachSpacings = 0.95;
/// A sample of a thin part that is farther from its vertex than the reach there may stay this many times as
/// far.
inline constexpr double kThinSlack = 1.05;

// ---- From the mesh to the image: a surface vertex and the nearest boundary voxel of its labels.

/// The refinement splits tets where a vertex of an interface is farther than this from where the image has
/// the interface. Found by trial; the improvement projects what is nearer.
inline constexpr double kLatticeFarLimit = 1.25;
/// Limit of both distances for the removal of surface defects and for relabelled tets.
inline constexpr double kFarLimit = kLatticeFarLimit;
/// Materials that meet at a vertex of the lattice mesh must meet in the image within this; otherwise the
/// lattice bridges a gap. Found by trial.
inline constexpr double kContact = 0.45;
/// How far nearest_boundary searches.
inline constexpr double kNearestSearch = 2;

// ---- Facets: how far their centres and the middles of their sides may be from the smooth boundary.

/// By default. Found by trial: smaller values follow the boundary more closely and cost tets.
inline constexpr double kDeviation = 0.35;
/// What the deviation may grow to while bad tets are repaired.
inline constexpr double kRepairDeviation = 0.5;
/// The growth of reach and deviation from one round of the repair of bad tets to the next.
inline constexpr double kRepairStep = 0.05;
/// Smoothing moves no vertex farther from the boundary: half a voxel, which is as far as the steps of an
/// image lie from the surface that was sampled.
inline constexpr double kSmoothnessCap = 0.29;
/// No inner vertex vanishes for longer edges than this, however far from the surfaces: coarser elements
/// interpolate badly whatever is solved on them.
inline constexpr double kLargestInner = 5;
/// With ImproveOptions::keep_distances: how much farther than it was a sample's vertex may be.
inline constexpr double kKeepSlack = 0.05;

// ---- Steps of vertices.

inline constexpr double kRelaxSkip = 0.01;       ///< shorter steps of the relaxation are not worth the guards
inline constexpr double kSeparationStep = 0.08;  ///< drawing self-intersecting facets apart, in each round
inline constexpr double kVolumeStep = 0.03;      ///< the volume correction, in each round

}  // namespace cbc3d::tolerances
