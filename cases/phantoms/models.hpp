// The models of the paper's four cases. Lengths scale with the image, so that any size works; at a coarser
// spacing of the same extent the shape is the same, but for tubes that would fall apart (see model.hpp).
#pragma once

#include <cstdint>

#include "cases/phantoms/model.hpp"

namespace cbc3d::cases {

PhantomModel aneurysm_model(const Index3& size, const Vec3& spacing_mm, std::uint64_t seed);
PhantomModel brain_tumor_model(const Index3& size, const Vec3& spacing_mm, std::uint64_t seed);
PhantomModel brain_avm_model(const Index3& size, const Vec3& spacing_mm, std::uint64_t seed);
PhantomModel lumen_stent_model(const Index3& size, const Vec3& spacing_mm, std::uint64_t seed);

}  // namespace cbc3d::cases
