#include "mesher/mesh_formats/parallel_deflate.hpp"

#include <libdeflate.h>

#include <algorithm>
#include <cstring>
#include <memory>

namespace cbc3d {

namespace {

using Compressor = std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)>;

/// Compresses into a zlib stream; returns an empty one when there is no memory for it.
std::vector<std::uint8_t> compress(Compressor& with, std::span<const std::uint8_t> data) {
  if (with == nullptr) {
    return {};
  }
  std::vector<std::uint8_t> stream(libdeflate_zlib_compress_bound(with.get(), data.size()));
  stream.resize(libdeflate_zlib_compress(with.get(), data.data(), data.size(), stream.data(), stream.size()));
  stream.shrink_to_fit();
  return stream;
}

}  // namespace

void ParallelDeflate::foresee(std::span<const std::uint8_t> array, std::size_t block_bytes) {
  Array& mine = arrays_.emplace_back();
  mine.blocks.resize((array.size() + block_bytes - 1) / block_bytes);
#pragma omp parallel
  {
    Compressor compressor(libdeflate_alloc_compressor(GetCompressionLevel()), &libdeflate_free_compressor);
#pragma omp for schedule(dynamic)
    for (std::size_t b = 0; b < mine.blocks.size(); ++b) {
      Block& block = mine.blocks[b];
      block.data = array.subspan(b * block_bytes, std::min(block_bytes, array.size() - b * block_bytes));
      block.compressed = compress(compressor, block.data);
    }
  }
}

std::size_t ParallelDeflate::CompressBuffer(const unsigned char* data, std::size_t bytes,
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
