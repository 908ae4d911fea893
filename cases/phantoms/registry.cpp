#include "cases/phantoms/registry.hpp"

#include <algorithm>
#include <array>

#include "cases/phantoms/generators.hpp"
#include "mesher/core/error.hpp"

namespace cbc3d::cases {
namespace {

constexpr std::array<PhantomKind, 4> kKinds{{
    {"organs",
     "body (1) with an organ (2), a ring-shaped vessel (3) around and into it, and a lesion (4) in it",
     {96, 96, 64},
     {1, 1, 1.5},
     1,
     organs_phantom},
    {"shells", "four nested balls, label 1 outermost", {80, 80, 54}, {1, 1, 1.5}, 1, shells_phantom},
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

LabelImage make_phantom(const Phantom& phantom) {
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
  if (!phantom.spacing_mm.all_finite() || !(phantom.spacing_mm.min_coeff() > 0)) {
    throw InputError("phantom spacing must be positive along every axis");
  }
  return kind->generate(phantom.size, phantom.spacing_mm, phantom.seed);
}

}  // namespace cbc3d::cases
