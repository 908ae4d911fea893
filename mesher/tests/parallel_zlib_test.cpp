// Blocks that were compressed ahead are VTK's own, whatever else it asks for.
#include "mesher/core/parallel_zlib.hpp"

#include <gtest/gtest.h>
#include <vtkNew.h>

#include <random>

namespace cbc3d {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes sample(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  Bytes bytes(count);
  for (std::uint8_t& byte : bytes) {
    byte = static_cast<std::uint8_t>(random() % 11);
  }
  return bytes;
}

Bytes compressed(vtkDataCompressor& compressor, const Bytes& bytes) {
  Bytes out(compressor.GetMaximumCompressionSpace(bytes.size()));
  out.resize(compressor.Compress(bytes.data(), bytes.size(), out.data(), out.size()));
  return out;
}

TEST(ParallelZlib, BlocksAreThoseOfVtkInAnyOrderOfTheArrays) {
  constexpr std::size_t kBlock = 4096;
  const Bytes first = sample(3 * kBlock + 100, 1), second = sample(2 * kBlock, 2), none,
              other = sample(700, 3);
  for (const int level : {1, 6}) {
    vtkNew<vtkZLibDataCompressor> vtks;
    vtkNew<ParallelZlib> ours;
    vtks->SetCompressionLevel(level);
    ours->SetCompressionLevel(level);
    ours->foresee(first, kBlock);
    ours->foresee(second, kBlock);
    ours->foresee(none, kBlock);
    EXPECT_EQ(compressed(*ours, other), compressed(*vtks, other));
    EXPECT_EQ(ours->blocks_ready(), 0U);
    for (const Bytes* array : {&second, &first}) {
      for (std::size_t begin = 0; begin < array->size(); begin += kBlock) {  // copies: not where they were
        const Bytes block(
            array->begin() + static_cast<std::ptrdiff_t>(begin),
            array->begin() + static_cast<std::ptrdiff_t>(std::min(begin + kBlock, array->size())));
        EXPECT_EQ(compressed(*ours, block), compressed(*vtks, block));
      }
    }
    EXPECT_EQ(ours->blocks_ready(), 6U);
    EXPECT_EQ(compressed(*ours, second), compressed(*vtks, second));
  }
}

}  // namespace
}  // namespace cbc3d
