// The generators of label images, by name.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "cases/case.hpp"
#include "mesher/core/label_image.hpp"

namespace cbc3d::cases {

/// A generator. The same arguments give the same voxels at any thread count and, as no transcendental
/// function and no standard distribution is used, on any IEEE machine.
struct PhantomKind {
  std::string_view name;
  std::string_view description;
  Index3 size;      ///< default, voxels
  Vec3 spacing_mm;  ///< default
  int version;      ///< counts changes of the voxels, so that no stale cached image is taken for a new one
  LabelImage (*generate)(const Index3& size, const Vec3& spacing_mm, std::uint64_t seed);
};

std::span<const PhantomKind> phantom_kinds();

/// nullptr when there is none of that name.
const PhantomKind* find_phantom(std::string_view name);

/// All names, for messages: "organs, shells, ...".
std::string phantom_names();

/// Throws InputError for an unknown name, a size below 8 voxels or a spacing that is not positive.
LabelImage make_phantom(const Phantom& phantom);

}  // namespace cbc3d::cases
