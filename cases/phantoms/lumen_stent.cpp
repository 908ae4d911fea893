// The lumen of a sidewall aneurysm on a straight vessel (1) and the braided wires of a flow diverter along
// the vessel's wall across the neck (2).
#include <algorithm>

#include "cases/phantoms/models.hpp"
#include "cases/phantoms/noise.hpp"
#include "cases/phantoms/random.hpp"

namespace cbc3d::cases {
namespace {

// Lengths in mm for an image 12 mm wide.
constexpr double kWidth = 12, kVesselRadius = 2, kSacRadius = 3.2, kWireRadius = 0.036;
constexpr double kStentHalfLength = 8, kPitch = 8;  // of the wires: length of a turn
constexpr int kWiresEachWay = 12;

struct Vessel {
  Vec3 bottom, top;  ///< ends of its middle line
  double scale;      ///< mm a unit
};

Tubes lumen(const Vessel& vessel, std::uint64_t seed) {
  RandomSequence random(seed);
  const double s = vessel.scale;
  const Vec3 middle = 0.5 * (vessel.bottom + vessel.top);
  Tubes tubes;
  tubes.add_path({{vessel.bottom, kVesselRadius * s}, {vessel.top, kVesselRadius * s}});
  const Vec3 sac = middle + s * (Vec3{4.3, 0, 0} + random.in_box(0.1));
  tubes.add_ball(sac, kSacRadius * s);
  tubes.add_path({{sac + s * Vec3{0.6, 0.5, 1.6}, 2 * s}, {sac + s * Vec3{1.2, -0.4, 1.9}, 1.6 * s}});
  return tubes;
}

/// The wires of one direction pass above and below those of the other in turn.
Tubes braid(const Vessel& vessel, double wire_radius, std::uint64_t seed) {
  const double s = vessel.scale, pitch = kPitch * s, phase = uniform_at(mix_bits(seed), 77);
  const Vec3 middle = 0.5 * (vessel.bottom + vessel.top);
  const double half_length = std::min(kStentHalfLength * s, 0.45 * (vessel.top.z - vessel.bottom.z));
  const double sway = 1.05 * wire_radius;
  const double braid_radius = kVesselRadius * s - sway - 1.1 * wire_radius;
  const int steps = static_cast<int>(std::ceil(2 * half_length / pitch * 8 * kWiresEachWay));
  Tubes tubes;
  for (int wire = 0; wire < 2 * kWiresEachWay; ++wire) {
    const double way = wire % 2 == 0 ? 1 : -1;
    const int of_its_way = wire / 2;
    std::vector<Knot> knots;
    for (int step = 0; step <= steps; ++step) {
      const double z = half_length * (2.0 * step / steps - 1);
      const double turns = way * z / pitch + static_cast<double>(of_its_way) / kWiresEachWay + phase;
      const double radius = braid_radius + way * sway * circle_at(kWiresEachWay * z / pitch).cosine;
      const CircleNumbers around = circle_at(turns);
      knots.push_back({middle + Vec3{radius * around.cosine, radius * around.sine, z}, wire_radius});
    }
    tubes.add_path(knots);
  }
  return tubes;
}

}  // namespace

PhantomModel lumen_stent_model(const Index3& size, const Vec3& spacing_mm, std::uint64_t seed) {
  const Vec3 extent{size[0] * spacing_mm.x, size[1] * spacing_mm.y, size[2] * spacing_mm.z};
  const double scale = std::min({extent.x, extent.y, extent.z / 1.5}) / kWidth;
  const Vec3 left = Vec3{0.5 * extent.x - 2.9 * scale, 0.5 * extent.y, 0};
  const double margin = (kVesselRadius + 0.5) * scale;
  const Vessel vessel{left + Vec3{0, 0, margin}, left + Vec3{0, 0, extent.z - margin}, scale};
  const double wire_radius = std::max(kWireRadius * scale, thinnest_radius_mm(spacing_mm));
  PhantomModel model;
  model.label_count = 2;
  model.layers.push_back(tube_layer(1, lumen(vessel, seed)));
  model.layers.push_back(tube_layer(2, braid(vessel, wire_radius, seed)));
  return model;
}

}  // namespace cbc3d::cases
