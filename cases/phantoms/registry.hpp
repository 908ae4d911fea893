// The generators of label images, by name.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "cases/core/case.hpp"
#include "cases/phantoms/model.hpp"
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
  /// Those made of solids, in any number of slices at a time; then `generate` is nullptr.
  PhantomModel (*model)(const Index3& size, const Vec3& spacing_mm, std::uint64_t seed) = nullptr;
  /// The true shape behind `generate`, exact; nullptr where it is not known.
  SignedDistance (*distance)(const Index3& size, const Vec3& spacing_mm, std::uint64_t seed) = nullptr;
};

std::span<const PhantomKind> phantom_kinds();

/// nullptr when there is none of that name.
const PhantomKind* find_phantom(std::string_view name);

/// All names, for messages: "organs, shells, ...".
std::string phantom_names();

/// The generator of a phantom. Throws InputError for an unknown name, a size below 8 voxels or a spacing that
/// is not positive.
const PhantomKind& require_kind(const Phantom& phantom);

/// Throws as require_kind.
LabelImage make_phantom(const Phantom& phantom);

/// Makes a phantom as a file (atomic; formats as write_label_image) and returns the SHA-256 of its labels,
/// one byte per voxel, i fastest. Above `streamed_voxels` it is made slab by slab and written to an
/// uncompressed .nrrd, so that memory never holds more than a slab. Throws as make_phantom, InputError also
/// for an image of that size in another format, JobError when writing fails.
std::string write_phantom(const Phantom& phantom, const std::filesystem::path& path,
                          std::size_t streamed_voxels = std::size_t{1} << 30U);

/// The true shape behind a phantom. The sign agrees with the voxels at their centres; the size is exact but
/// where two solids meet at an edge, there a lower bound; NaN for labels whose shape is no closed form (the
/// folded brain). An empty function for phantoms that know none.
SignedDistance phantom_signed_distance(const Phantom& phantom);

}  // namespace cbc3d::cases
