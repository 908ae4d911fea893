#include "cases/phantoms/registry.hpp"

#include <algorithm>
#include <array>

#include "cases/phantoms/generators.hpp"
#include "cases/phantoms/models.hpp"
#include "cases/phantoms/shapes.hpp"
#include "mesher/core/error.hpp"

namespace cbc3d::cases {
namespace {

constexpr std::array<PhantomKind, 10> kKinds{{
    {"organs",
     "body (1) with an organ (2), a ring-shaped vessel (3) around and into it, and a lesion (4) in it",
     {96, 96, 64},
     {1, 1, 1.5},
     1,
     organs_phantom},
    {"shells",
     "four nested balls, label 1 outermost",
     {80, 80, 54},
     {1, 1, 1.5},
     1,
     shells_phantom,
     nullptr,
     shells_distance},
    {"rings",
     "three linked rings, of thick (1), thin (2) and very thin (3) tubes",
     {80, 80, 80},
     {1, 1, 1},
     1,
     rings_phantom,
     nullptr,
     rings_distance},
    {"vessels",
     "tree of tapering vessels with an aneurysm (1)",
     {128, 128, 127},
     {1, 1, 1},
     1,
     vessels_phantom},
    {"vessels-noisy",
     "the same with specks outside and holes inside, two voxels in a thousand",
     {128, 128, 127},
     {1, 1, 1},
     1,
     noisy_vessels_phantom},
    {"assorted",
     "another image for each seed: of ten kinds, up to the given size, with other voxels, frames and labels",
     {44, 44, 44},
     {1, 1, 1},
     2,
     assorted_phantom},
    {"aneurysm",
     "carotid artery with its branches and a saccular aneurysm (1)",
     {512, 512, 508},
     {1, 1, 1},
     1,
     nullptr,
     aneurysm_model},
    {"brain-tumor",
     "folded brain (1), ventricles (2), irregular tumour that touches both (3)",
     {384, 512, 176},
     {.48, .48, 1},
     1,
     nullptr,
     brain_tumor_model},
    {"brain-avm",
     "folded brain (1), feeding artery (2), draining vein (3), nidus of tangled vessels (4)",
     {320, 320, 100},
     {.7, .7, 1.6},
     1,
     nullptr,
     brain_avm_model},
    {"lumen-stent",
     "lumen of a sidewall aneurysm (1), braided wires of a flow diverter (2)",
     {1001, 1001, 4182},
     {.012, .012, .024},
     1,
     nullptr,
     lumen_stent_model},
}};

}  // namespace

std::span<const PhantomKind> phantom_kinds() {
  return kKinds;
}

const PhantomKind* find_phantom(std::string_view name) {
  const auto* found = std::find_if(kKinds.begin(), kKinds.end(),
                                   [name](const PhantomKind& kind) { return kind.name == name; });
  return found == kKinds.end() ? nullptr : found;
}

std::string phantom_names() {
  std::string names;
  for (const PhantomKind& kind : kKinds) {
    names += (names.empty() ? "" : ", ") + std::string(kind.name);
  }
  return names;
}

const PhantomKind& require_kind(const Phantom& phantom) {
  constexpr int kSmallest = 8;
  const PhantomKind* kind = find_phantom(phantom.name);
  if (kind == nullptr) {
    throw InputError("phantom '" + phantom.name + "' is unknown; choose one of " + phantom_names());
  }
  if (*std::min_element(phantom.size.begin(), phantom.size.end()) < kSmallest) {
    throw InputError("phantom size " + std::to_string(phantom.size[0]) + "," +
                     std::to_string(phantom.size[1]) + "," + std::to_string(phantom.size[2]) +
                     " is too small; every side needs at least " + std::to_string(kSmallest) + " voxels");
  }
  constexpr double kMostVoxels = 4e9;
  if (1.0 * phantom.size[0] * phantom.size[1] * phantom.size[2] > kMostVoxels) {
    throw InputError("phantom size " + std::to_string(phantom.size[0]) + "," +
                     std::to_string(phantom.size[1]) + "," + std::to_string(phantom.size[2]) +
                     " is too large; it may have 4e9 voxels in all");
  }
  if (!phantom.spacing_mm.all_finite() || !(phantom.spacing_mm.min_coeff() > 0)) {
    throw InputError("phantom spacing must be positive along every axis");
  }
  return *kind;
}

LabelImage make_phantom(const Phantom& phantom) {
  const PhantomKind& kind = require_kind(phantom);
  if (kind.model == nullptr) {
    return kind.generate(phantom.size, phantom.spacing_mm, phantom.seed);
  }
  const PhantomModel model = kind.model(phantom.size, phantom.spacing_mm, phantom.seed);
  LabelImage image = blank_image(phantom.size, phantom.spacing_mm, model.label_count);
  paint_slab(model, image.frame, 0, phantom.size[2], image.voxels.narrow());
  return image;
}

SignedDistance phantom_signed_distance(const Phantom& phantom) {
  const PhantomKind& kind = require_kind(phantom);
  if (kind.distance != nullptr) {
    return kind.distance(phantom.size, phantom.spacing_mm, phantom.seed);
  }
  if (kind.model == nullptr) {
    return {};
  }
  // Phantoms have their origin at 0 and axes along the patient's: local positions are physical ones.
  return [model = kind.model(phantom.size, phantom.spacing_mm, phantom.seed)](const Vec3& physical_mm,
                                                                              Label label) {
    return signed_distance_mm(model, physical_mm, static_cast<MaterialId>(label));
  };
}

}  // namespace cbc3d::cases
