// Label images of all sorts, another for each seed: what a mesher meets that is run over hundreds of
// segmentations.
//
// The seed draws the kind (in turn, so that a run of seeds has as many of each), how many voxels, how far
// they are from cubes, how the axes lie, which values the labels have, and the shape.
//
// Contacts at edges and corners are resolved (well_composed.hpp), so that every label has one topology,
// whichever way it is seen, and a mesh's can be compared with it.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "cases/phantoms/generators.hpp"
#include "cases/phantoms/noise.hpp"
#include "cases/phantoms/random.hpp"
#include "cases/phantoms/shapes.hpp"
#include "mesher/preprocess/well_composed.hpp"

namespace cbc3d::cases {
namespace {

struct Draw {
  Index3 size;
  Vec3 spacing_mm;
  RandomSequence random;
  std::uint64_t seed;

  [[nodiscard]] Vec3 extent_mm() const {
    return {(size[0] - 1) * spacing_mm.x, (size[1] - 1) * spacing_mm.y, (size[2] - 1) * spacing_mm.z};
  }
  /// A place at least this share of the extent away from every side.
  Vec3 place(double margin) {
    const Vec3 e = extent_mm();
    const double x = random.uniform(margin, 1 - margin), y = random.uniform(margin, 1 - margin),
                 z = random.uniform(margin, 1 - margin);
    return {x * e.x, y * e.y, z * e.z};
  }
  int whole(int low, int high) { return low + static_cast<int>(random.uniform(0, high - low + 1)); }
  [[nodiscard]] double shortest_mm() const { return extent_mm().min_coeff(); }
  [[nodiscard]] double voxel_mm() const { return spacing_mm.max_coeff(); }
};

/// Up to six balls that overlap, each of a label of its own.
LabelImage balls(Draw& draw) {
  struct Ball {
    Vec3 centre;
    double radius;
  };
  std::vector<Ball> all;
  for (int n = draw.whole(1, 6); n > 0; --n) {
    all.push_back({draw.place(.2), draw.random.uniform(.1, .35) * draw.shortest_mm() + draw.voxel_mm()});
  }
  LabelImage image = blank_image(draw.size, draw.spacing_mm, static_cast<int>(all.size()));
  fill_image(image, [&](const Vec3& p) {
    MaterialId material = 0;
    for (std::size_t n = 0; n < all.size(); ++n) {
      if ((p - all[n].centre).norm() < all[n].radius) material = static_cast<MaterialId>(n + 1);
    }
    return material;
  });
  return image;
}

/// Shells around a core, one to three voxels thick, some of them hollow.
LabelImage thin_shells(Draw& draw) {
  const Vec3 centre = draw.place(.45);
  const int count = draw.whole(1, 4);
  const bool hollow = draw.random.uniform(0, 1) < .5;
  const double thickness = draw.random.uniform(1, 3) * draw.voxel_mm(),
               outer = .45 * draw.shortest_mm() + draw.voxel_mm();
  LabelImage image = blank_image(draw.size, draw.spacing_mm, count);
  fill_image(image, [&](const Vec3& p) {
    const double depth = (outer - (p - centre).norm()) / thickness;
    const int shell = static_cast<int>(std::floor(depth)) + 1;
    return static_cast<MaterialId>(depth < 0 ? 0 : shell <= count ? shell : hollow ? 0 : count);
  });
  return image;
}

/// A tree of vessels, in half of the images with noise.
LabelImage tree(Draw& draw) {
  return draw.random.uniform(0, 1) < .5 ? vessels_phantom(draw.size, draw.spacing_mm, draw.seed)
                                        : noisy_vessels_phantom(draw.size, draw.spacing_mm, draw.seed);
}

/// An ellipsoid parted into the cells of points: as an atlas, every label touches others, at curves and
/// places too.
LabelImage cells(Draw& draw) {
  std::vector<Vec3> seeds;
  for (int n = draw.whole(4, 40); n > 0; --n) seeds.push_back(draw.place(.1));
  const Vec3 radii = .47 * draw.extent_mm(), middle = .5 * draw.extent_mm();
  LabelImage image = blank_image(draw.size, draw.spacing_mm, static_cast<int>(seeds.size()));
  fill_image(image, [&](const Vec3& p) {
    const Vec3 d = p - middle, q{d.x / radii.x, d.y / radii.y, d.z / radii.z};
    if (q.squared_norm() > 1) return MaterialId{0};
    const auto nearest = std::min_element(seeds.begin(), seeds.end(), [&](const Vec3& a, const Vec3& b) {
      return (p - a).squared_norm() < (p - b).squared_norm();
    });
    return static_cast<MaterialId>(nearest - seeds.begin() + 1);
  });
  return image;
}

/// What lies above a level of noise: sponge-like, with many tunnels, up to the image's border.
LabelImage porous(Draw& draw) {
  const double feature_mm = draw.random.uniform(6, 14) * draw.voxel_mm(),
               level = draw.random.uniform(-.1, .25);
  LabelImage image = blank_image(draw.size, draw.spacing_mm, 1);
  fill_image(image, [&](const Vec3& p) {
    return static_cast<MaterialId>(gradient_noise(draw.seed, (1 / feature_mm) * p) > level ? 1 : 0);
  });
  return image;
}

/// Slanted layers, one to five voxels thick, of two or three labels in turn, some of them background.
LabelImage layers(Draw& draw) {
  const Vec3 normal = draw.random.direction();
  const double thickness = draw.random.uniform(1, 5) * draw.voxel_mm();
  const int labels = draw.whole(1, 3);
  LabelImage image = blank_image(draw.size, draw.spacing_mm, labels);
  fill_image(image, [&](const Vec3& p) {
    const int layer = static_cast<int>(std::floor(p.dot(normal) / thickness));
    return static_cast<MaterialId>(((layer % (labels + 1)) + labels + 1) % (labels + 1));
  });
  return image;
}

LabelImage rings(Draw& draw) {
  return rings_phantom(draw.size, draw.spacing_mm, draw.seed);
}

/// Straight wires about as thin as a voxel, some through a block of another label.
LabelImage wires(Draw& draw) {
  struct Wire {
    Vec3 at, along;
  };
  std::vector<Wire> all;
  for (int n = draw.whole(1, 8); n > 0; --n) {
    const Vec3 at = draw.place(.2);
    all.push_back({at, draw.random.direction()});
  }
  const double radius = draw.random.uniform(.75, 1.5) * draw.voxel_mm();
  const double block = draw.random.uniform(0, .3) * draw.shortest_mm();
  const Vec3 middle = .5 * draw.extent_mm();
  LabelImage image = blank_image(draw.size, draw.spacing_mm, 2);
  fill_image(image, [&](const Vec3& p) {
    for (const Wire& wire : all) {
      const Vec3 d = p - wire.at;
      if ((d - d.dot(wire.along) * wire.along).squared_norm() < radius * radius) return MaterialId{1};
    }
    const Vec3 d = p - middle;
    const bool in_block = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}) < block;
    return static_cast<MaterialId>(in_block ? 2 : 0);
  });
  return image;
}

/// Boxes along the voxels' axes: flat faces, sharp edges, contacts at edges and corners, faces on the image's
/// border.
LabelImage boxes(Draw& draw) {
  struct Box {
    Index3 low, high;
  };
  std::vector<Box> all;
  for (int n = draw.whole(2, 12); n > 0; --n) {
    Box box{};
    for (std::size_t a = 0; a < 3; ++a) {
      const int side = draw.whole(1, std::max(2, draw.size[a] / 3));
      box.low[a] = draw.whole(0, draw.size[a] - side);
      box.high[a] = box.low[a] + side;
    }
    all.push_back(box);
  }
  const int labels = draw.whole(1, 5);
  LabelImage image = blank_image(draw.size, draw.spacing_mm, labels);
  for (std::size_t n = 0; n < all.size(); ++n) {
    for (int k = all[n].low[2]; k < all[n].high[2]; ++k) {
      for (int j = all[n].low[1]; j < all[n].high[1]; ++j) {
        for (int i = all[n].low[0]; i < all[n].high[0]; ++i) {
          image.voxels[image.frame.offset(i, j, k)] =
              static_cast<MaterialId>(1 + n % static_cast<std::size_t>(labels));
        }
      }
    }
  }
  return image;
}

/// A body with organs, and voxels at random of any label: a segmentation that nobody cleaned.
LabelImage noisy_organs(Draw& draw) {
  LabelImage image = organs_phantom(draw.size, draw.spacing_mm, draw.seed);
  const double share = draw.random.uniform(0, .004);
  for (std::size_t v = 0; v < image.voxels.size(); ++v) {
    if (uniform_at(draw.seed + 1, v) < share) {
      image.voxels[v] = static_cast<MaterialId>(mix_bits(draw.seed ^ v) % image.labels.size());
    }
  }
  return image;
}

constexpr std::array kShapes{balls,  thin_shells, tree,  cells, porous,
                             layers, rings,       wires, boxes, noisy_organs};

/// Half to all of the given size along each axis, but at least 8 voxels.
Index3 drawn_size(const Index3& largest, RandomSequence& random) {
  Index3 size{};
  for (std::size_t a = 0; a < 3; ++a) {
    size[a] = std::max(8, static_cast<int>(random.uniform(.5, 1) * largest[a]));
  }
  return size;
}

/// Half of the images have cubes for voxels, most others slices thicker than their pixels.
Vec3 drawn_spacing(const Vec3& finest_mm, RandomSequence& random) {
  const double kind = random.uniform(0, 1), factor = random.uniform(1.5, 6);
  const int axis = static_cast<int>(random.uniform(0, 3));
  Vec3 spacing = finest_mm;
  if (kind > .5) spacing[axis] *= factor;
  if (kind > .85) spacing[(axis + 1) % 3] *= std::sqrt(factor);
  return spacing;
}

/// A third of the images are oblique, and a few of these have left-handed axes.
Mat3 drawn_direction(RandomSequence& random) {
  const Vec3 a = random.direction();
  const Vec3 raw = random.direction();
  const double kind = random.uniform(0, 1);
  const Vec3 rest = raw - raw.dot(a) * a;
  if (kind > .33 || rest.norm() < .1) return Mat3::identity();
  const Vec3 b = rest.normalized(), c = a.cross(b);
  return Mat3::from_columns(a, b, kind < .05 ? -1.0 * c : c);
}

/// Leaves out the labels that no voxel has, for others hide them or they are too small.
void drop_empty_labels(LabelImage& image) {
  const std::vector<std::size_t> voxels = image.voxels_per_material();
  std::vector<MaterialId> renumbered(voxels.size(), 0);
  MaterialId kept = 0;
  for (std::size_t m = 1; m < voxels.size(); ++m) {
    if (voxels[m] > 0) renumbered[m] = ++kept;
  }
  for (std::size_t v = 0; v < image.voxels.size(); ++v) {
    image.voxels[v] = renumbered[image.voxels[v]];
  }
  image.labels.resize(kept + 1U);
}

/// Half of the images have gaps between their labels' values.
void draw_labels(LabelImage& image, RandomSequence& random) {
  const int step = random.uniform(0, 1) < .5 ? 1 : static_cast<int>(random.uniform(2, 40));
  for (std::size_t m = 1; m < image.labels.size(); ++m) {
    image.labels[m] = static_cast<Label>(m) * step;
  }
}

}  // namespace

LabelImage assorted_phantom(const Index3& size, const Vec3& spacing_mm, std::uint64_t seed) {
  RandomSequence random(mix_bits(seed ^ 0x6173736F72746564ULL));
  const Index3 drawn = drawn_size(size, random);
  const Vec3 spacing = drawn_spacing(spacing_mm, random);
  const Mat3 direction = drawn_direction(random);
  const Vec3 origin = random.in_box(200);
  Draw draw{drawn, spacing, random, seed};
  LabelImage image = kShapes.at(seed % kShapes.size())(draw);
  make_well_composed(image);
  drop_empty_labels(image);
  draw_labels(image, draw.random);
  image.frame.direction = direction;
  image.frame.origin_mm = origin;
  return image;
}

}  // namespace cbc3d::cases
