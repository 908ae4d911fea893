// How often every mesher succeeds over many images.
#pragma once

#include "reports/tables/table_input.hpp"

namespace cbc3d::reports {

/// With fewer images than this a share says little, and the table has no rows.
inline constexpr std::size_t kManyImages = 20;

/// Table `success`: over all images of the run, the per cent of the jobs (those that could run: neither
/// skipped nor unavailable) that gave a mesh; that gave a valid one, with nothing inverted, conforming,
/// manifold and without self-intersections; whose labels have the image's parts, tunnels and cavities; that
/// has every label; and all of these at once. Beneath: the smallest dihedral angle, the longest time, the
/// most elements and memory, each with the case where it was, the CPU seconds of all jobs, and how many
/// failed for each reason.
Table success_table(const TableInput& input);

}  // namespace cbc3d::reports
