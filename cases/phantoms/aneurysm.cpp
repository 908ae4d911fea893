// An internal carotid artery with its siphon, a large saccular aneurysm on it, and the tree of its branches.
#include <algorithm>

#include "cases/phantoms/models.hpp"
#include "cases/phantoms/random.hpp"

namespace cbc3d::cases {
namespace {

// Positions and lengths in units of which the image's side has 512.
constexpr double kUnitsPerSide = 512;
constexpr double kThinnest = 1.6;

struct Branch {
  Vec3 at, heading;
  double radius, length;
  int forks_left;
};

class Tree {
 public:
  Tree(const Vec3& extent_mm, double unit_mm, double thinnest_mm, std::uint64_t seed)
      : extent_mm_(extent_mm), unit_mm_(unit_mm), thinnest_mm_(thinnest_mm), random_(seed) {}

  /// A point given in units of a 512-box, wherever the image's own proportions put it, mm.
  [[nodiscard]] Vec3 place(const Vec3& units) const {
    return Vec3{units.x * extent_mm_.x, units.y * extent_mm_.y, units.z * extent_mm_.z} / kUnitsPerSide;
  }
  [[nodiscard]] double radius(double units) const { return std::max(units * unit_mm_, thinnest_mm_); }
  [[nodiscard]] Vec3 jitter(double units) { return random_.in_box(units * unit_mm_); }

  void add_path(const std::vector<Knot>& knots) { tubes_.add_path(smooth_path(knots, 8)); }

  /// Grows a branch and, where it ends, two more of it, until no fork is left.
  void grow(const Branch& branch) {
    const Branch end = grow_vessel(branch);
    if (branch.forks_left == 0) {
      return;
    }
    const Vec3 aside = end.heading.cross(random_.direction()).normalized();
    for (const double side : {1.0, -1.0}) {
      const double share = side > 0 ? random_.uniform(0.78, 0.88) : random_.uniform(0.62, 0.78);
      const double turn = side * random_.uniform(0.5, 0.9);
      grow({end.at, (end.heading + turn * aside).normalized(), share * end.radius,
            random_.uniform(0.72, 0.95) * branch.length, branch.forks_left - 1});
    }
  }
  [[nodiscard]] Tubes take() { return std::move(tubes_); }

 private:
  /// One vessel that meanders and tapers; returns where, whither and how wide it ends.
  Branch grow_vessel(const Branch& branch) {
    constexpr int kSteps = 12;
    constexpr double kTaper = 0.85;
    Branch now = branch;
    std::vector<Knot> knots{{now.at, std::max(now.radius, thinnest_mm_)}};
    Vec3 drift = random_.direction();
    for (int step = 1; step <= kSteps; ++step) {
      drift = (drift + 0.5 * random_.direction()).normalized();
      now.heading = (now.heading + 0.14 * drift + inward(now.at)).normalized();
      now.at += branch.length / kSteps * now.heading;
      now.radius = branch.radius * (1 - (1 - kTaper) * step / kSteps);
      knots.push_back({now.at, std::max(now.radius, thinnest_mm_)});
    }
    tubes_.add_path(knots);
    return now;
  }
  /// Turns a vessel back before it comes to the image's border.
  [[nodiscard]] Vec3 inward(const Vec3& p) const {
    Vec3 push;
    for (int axis = 0; axis < 3; ++axis) {
      const double margin = 0.16 * extent_mm_[axis];
      const double low = (margin - p[axis]) / margin, high = (p[axis] - extent_mm_[axis] + margin) / margin;
      push[axis] = 0.9 * (std::max(low, 0.0) - std::max(high, 0.0));
    }
    return push;
  }

  Vec3 extent_mm_;
  double unit_mm_, thinnest_mm_;
  RandomSequence random_;
  Tubes tubes_;
};

}  // namespace

PhantomModel aneurysm_model(const Index3& size, const Vec3& spacing_mm, std::uint64_t seed) {
  const Vec3 extent{size[0] * spacing_mm.x, size[1] * spacing_mm.y, size[2] * spacing_mm.z};
  const double unit = extent.min_coeff() / kUnitsPerSide;
  Tree tree(extent, unit, std::max(kThinnest * unit, thinnest_radius_mm(spacing_mm)), seed);
  std::vector<Knot> carotid;
  for (const auto& [at, radius] : std::initializer_list<std::pair<Vec3, double>>{{{226, 300, 34}, 19},
                                                                                 {{232, 296, 80}, 18.5},
                                                                                 {{216, 268, 130}, 18},
                                                                                 {{236, 226, 168}, 17.5},
                                                                                 {{262, 254, 204}, 17},
                                                                                 {{246, 306, 232}, 16.5},
                                                                                 {{236, 296, 278}, 15.5},
                                                                                 {{250, 262, 306}, 14}}) {
    carotid.push_back({tree.place(at) + tree.jitter(4), tree.radius(radius)});
  }
  tree.add_path(carotid);
  const Vec3 siphon = carotid[4].at;
  const Vec3 sac = siphon + tree.jitter(4);
  tree.add_path({{sac + unit * Vec3{26, -10, 2}, 24 * unit},
                 {sac + unit * Vec3{48, -20, 4}, 41 * unit},
                 {sac + unit * Vec3{66, -26, 16}, 44 * unit},
                 {sac + unit * Vec3{82, -30, 34}, 33 * unit}});
  tree.add_path({{sac + unit * Vec3{98, -30, 2}, 21 * unit}, {sac + unit * Vec3{112, -34, -6}, 16 * unit}});
  const Vec3 fork = carotid.back().at;
  tree.grow({fork, Vec3{0.95, -0.2, 0.35}.normalized(), 11 * unit, 96 * unit, 5});
  tree.grow({fork, Vec3{-0.75, -0.5, 0.55}.normalized(), 9.5 * unit, 88 * unit, 5});
  tree.grow({carotid[6].at, Vec3{-0.5, 0.85, 0.3}.normalized(), 7.5 * unit, 76 * unit, 4});
  tree.grow({carotid[5].at, Vec3{-0.85, -0.5, -0.1}.normalized(), 5.5 * unit, 60 * unit, 3});
  return {{tube_layer(1, tree.take())}, 1};
}

}  // namespace cbc3d::cases
