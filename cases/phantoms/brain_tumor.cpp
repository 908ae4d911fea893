// A brain (1) with its ventricles (2) and an irregular tumour (3) that reaches from them to the surface.
#include <algorithm>

#include "cases/phantoms/brain.hpp"
#include "cases/phantoms/models.hpp"
#include "cases/phantoms/random.hpp"

namespace cbc3d::cases {
namespace {

Tubes tumour(const BrainShape& brain, std::uint64_t seed) {
  constexpr int kLobes = 70;
  RandomSequence random(mix_bits(seed ^ 0x74756D6F7572ULL));
  const Vec3 core{40, 26, 27};
  Tubes balls;
  balls.add_path({{brain.place(core - Vec3{7, 1, 2}), 13 * brain.scale()},
                  {brain.place(core + Vec3{6, 2, 2}), 14 * brain.scale()}});
  for (int lobe = 0; lobe < kLobes; ++lobe) {
    const Vec3 d = random.direction();
    const double away = random.uniform(9, 15);
    const Vec3 at = core + away * Vec3{1.35 * d.x, 1.05 * d.y, 0.95 * d.z};
    balls.add_ball(brain.place(at), random.uniform(2.5, 6.5) * brain.scale());
  }
  return balls;
}

}  // namespace

PhantomModel brain_tumor_model(const Index3& size, const Vec3& spacing_mm, std::uint64_t seed) {
  const Vec3 extent{size[0] * spacing_mm.x, size[1] * spacing_mm.y, size[2] * spacing_mm.z};
  const BrainShape brain(extent, seed);
  PhantomModel model;
  model.label_count = 3;
  model.layers.push_back(predicate_layer(1, [brain](const Vec3& p) { return brain.holds(p); }));
  model.layers.push_back(tube_layer(2, brain.ventricles(thinnest_radius_mm(spacing_mm))));
  model.layers.push_back(tube_layer(3, tumour(brain, seed)));
  return model;
}

}  // namespace cbc3d::cases
