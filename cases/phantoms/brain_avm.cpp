// A brain (1) with an arteriovenous malformation: feeding artery (2), draining vein (3) and nidus (4).
#include <algorithm>

#include "cases/phantoms/brain.hpp"
#include "cases/phantoms/models.hpp"
#include "cases/phantoms/random.hpp"

namespace cbc3d::cases {
namespace {

const Vec3 kNidusCentre{38, 16, 34};  // in the brain's own frame
constexpr double kNidusRadius = 17;

class Malformation {
 public:
  Malformation(const BrainShape& brain, double thinnest_mm, std::uint64_t seed)
      : brain_(brain), thinnest_mm_(thinnest_mm), random_(mix_bits(seed ^ 0x6E69647573ULL)) {}

  /// Vessels that wind about within a ball.
  Tubes nidus() {
    constexpr int kStrands = 16, kSteps = 90;
    Tubes tubes;
    for (int strand = 0; strand < kStrands; ++strand) {
      const double away = random_.uniform(0, kNidusRadius);
      Vec3 at = kNidusCentre + away * random_.direction();
      Vec3 heading = random_.direction(), turn = random_.direction();
      const double radius = random_.uniform(0.8, 1.7);
      std::vector<Knot> knots;
      for (int step = 0; step < kSteps; ++step) {
        knots.push_back(knot(at, radius));
        turn = (turn + 0.6 * random_.direction()).normalized();
        const Vec3 back = (kNidusCentre - at) / kNidusRadius;
        heading = (heading + 0.3 * turn + 0.3 * back.squared_norm() * back).normalized();
        at += 1.3 * heading;
      }
      tubes.add_path(knots);
    }
    return tubes;
  }
  /// From the base of the brain to the nidus, forking before it.
  Tubes artery() {
    Tubes tubes;
    path(tubes, {{{8, -14, -34}, 2.8},
                 {{16, -20, -22}, 2.7},
                 {{26, -12, -8}, 2.5},
                 {{30, -12, 8}, 2.3},
                 {{36, -4, 18}, 2.1}});
    path(tubes, {{{36, -4, 18}, 2}, {{34, 2, 26}, 1.7}, {{38, 8, 30}, 1.4}, {{36, 14, 34}, 1.1}});
    path(tubes, {{{36, -4, 18}, 1.9}, {{44, 4, 20}, 1.6}, {{46, 12, 26}, 1.3}, {{42, 18, 30}, 1.1}});
    path(tubes, {{{30, -12, 8}, 1.6}, {{40, -18, 14}, 1.3}, {{48, -10, 24}, 1.1}, {{44, 4, 36}, 1}});
    return tubes;
  }
  /// From the nidus to the surface and along it to the sinus between the hemispheres.
  Tubes vein() {
    Tubes tubes;
    path(tubes, {{{40, 20, 40}, 2.2},
                 {{46, 28, 46}, 2.8},
                 {{38, 26, 58}, 3.2},
                 {{24, 34, 62}, 3.4},
                 {{12, 40, 66}, 3.6},
                 {{0, 50, 60}, 4}});
    path(tubes,
         {{{0, 4, 71}, 2.5}, {{0, 30, 68}, 3.2}, {{0, 50, 60}, 4}, {{0, 68, 46}, 4.3}, {{0, 82, 24}, 4.5}});
    path(tubes, {{{34, 22, 28}, 1.8},
                 {{30, 34, 22}, 2.2},
                 {{36, 46, 26}, 2.2},
                 {{24, 54, 40}, 2.5},
                 {{0, 62, 51}, 3}});
    return tubes;
  }

 private:
  [[nodiscard]] Knot knot(const Vec3& at, double radius) const {
    return {brain_.place(at), std::max(radius * brain_.scale(), thinnest_mm_)};
  }
  void path(Tubes& tubes, std::initializer_list<std::pair<Vec3, double>> anatomical) {
    std::vector<Knot> knots;
    for (const auto& [at, radius] : anatomical) {
      knots.push_back(knot(at + random_.in_box(1.5), radius));
    }
    tubes.add_path(smooth_path(knots, 8));
  }

  const BrainShape& brain_;
  double thinnest_mm_;
  RandomSequence random_;
};

}  // namespace

PhantomModel brain_avm_model(const Index3& size, const Vec3& spacing_mm, std::uint64_t seed) {
  const Vec3 extent{size[0] * spacing_mm.x, size[1] * spacing_mm.y, size[2] * spacing_mm.z};
  const BrainShape brain(extent, seed);
  Malformation vessels(brain, thinnest_radius_mm(spacing_mm), seed);
  PhantomModel model;
  model.label_count = 4;
  model.layers.push_back(predicate_layer(1, [brain](const Vec3& p) { return brain.holds(p); }));
  model.layers.push_back(tube_layer(2, vessels.artery()));
  model.layers.push_back(tube_layer(3, vessels.vein()));
  model.layers.push_back(tube_layer(4, vessels.nidus()));
  return model;
}

}  // namespace cbc3d::cases
