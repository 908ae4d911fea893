// Blocks that were compressed ahead are what VTK reads, whatever else it asks for.
#include "mesher/mesh_formats/parallel_deflate.hpp"

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

/// As VTK itself decompresses it.
Bytes decompressed(const Bytes& stream, std::size_t count) {
  vtkNew<vtkZLibDataCompressor> vtks;
  Bytes out(count);
  EXPECT_EQ(vtks->Uncompress(stream.data(), stream.size(), out.data(), out.size()), count);
  return out;
}

/// Compresses an array block by block, and checks that each is read back.
void expect_blocks(ParallelDeflate& compressor, const Bytes& array, std::size_t block_bytes) {
  for (std::size_t begin = 0; begin < array.size(); begin += block_bytes) {  // copies: not where they were
    const Bytes block(
        array.begin() + static_cast<std::ptrdiff_t>(begin),
        array.begin() + static_cast<std::ptrdiff_t>(std::min(begin + block_bytes, array.size())));
    const Bytes stream = compressed(compressor, block);
    EXPECT_LT(stream.size(), block.size() * 3 / 4);
    EXPECT_EQ(decompressed(stream, block.size()), block);
  }
}

TEST(ParallelDeflate, BlocksAreReadByVtkInAnyOrderOfTheArrays) {
  constexpr std::size_t kBlock = 4096;
  const Bytes first = sample(3 * kBlock + 100, 1), second = sample(2 * kBlock, 2), none,
              other = sample(700, 3);
  for (const int level : {1, 6}) {
    vtkNew<ParallelDeflate> ours;
    ours->SetCompressionLevel(level);
    ours->foresee(first, kBlock);
    ours->foresee(second, kBlock);
    ours->foresee(none, kBlock);
    expect_blocks(*ours, other, kBlock);
    EXPECT_EQ(ours->blocks_ready(), 0U);
    expect_blocks(*ours, second, kBlock);
    expect_blocks(*ours, first, kBlock);
    EXPECT_EQ(ours->blocks_ready(), 6U);
    expect_blocks(*ours, second, kBlock);
    EXPECT_EQ(ours->blocks_ready(), 6U);
  }
}

}  // namespace
}  // namespace cbc3d
