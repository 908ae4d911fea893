#include "mesher/core/parallel_zlib.hpp"

#include <algorithm>
#include <cstring>

namespace cbc3d {

void ParallelZlib::foresee(std::span<const std::uint8_t> array, std::size_t block_bytes) {
  Array& mine = arrays_.emplace_back();
  mine.blocks.resize((array.size() + block_bytes - 1) / block_bytes);
#pragma omp parallel for schedule(dynamic)
  for (std::size_t b = 0; b < mine.blocks.size(); ++b) {
    Block& block = mine.blocks[b];
    block.data = array.subspan(b * block_bytes, std::min(block_bytes, array.size() - b * block_bytes));
    block.compressed.resize(GetMaximumCompressionSpace(block.data.size()));
    block.compressed.resize(vtkZLibDataCompressor::CompressBuffer(
        block.data.data(), block.data.size(), block.compressed.data(), block.compressed.size()));
  }
}

std::size_t ParallelZlib::CompressBuffer(const unsigned char* data, std::size_t bytes,
                                         unsigned char* compressed, std::size_t space) {
  for (Array& array : arrays_) {
    if (array.next == array.blocks.size()) {
      continue;
    }
    const Block& block = array.blocks[array.next];
    const bool same = block.data.size() == bytes &&
                      (block.data.data() == data || std::memcmp(block.data.data(), data, bytes) == 0);
    if (same && !block.compressed.empty() && block.compressed.size() <= space) {
      std::memcpy(compressed, block.compressed.data(), block.compressed.size());
      ++array.next;
      ++ready_;
      return block.compressed.size();
    }
  }
  return vtkZLibDataCompressor::CompressBuffer(data, bytes, compressed, space);
}

}  // namespace cbc3d
