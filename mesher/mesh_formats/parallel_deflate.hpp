// The compression of VTK files by all threads and a faster library; VTK's own compressor takes one block
// after the other. Both write zlib streams.
#pragma once

#include <vtkObjectFactory.h>
#include <vtkZLibDataCompressor.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cbc3d {

/// Compresses arrays in advance, block by block in parallel, and gives VTK's writer the results when it asks
/// for them; it compresses a block that was not announced when it is asked for.
class ParallelDeflate : public vtkZLibDataCompressor {
 public:
  static ParallelDeflate* New() { VTK_STANDARD_NEW_BODY(ParallelDeflate); }

  /// Announces an array that will be written in blocks of `block_bytes`; call it after the level is set. The
  /// array must outlive the writing.
  void foresee(std::span<const std::uint8_t> array, std::size_t block_bytes);
  /// How many blocks were ready when they were asked for.
  [[nodiscard]] std::size_t blocks_ready() const { return ready_; }

 protected:
  std::size_t CompressBuffer(const unsigned char* data, std::size_t bytes, unsigned char* compressed,
                             std::size_t space) override;

 private:
  struct Block {
    std::span<const std::uint8_t> data;
    std::vector<std::uint8_t> compressed;
  };
  struct Array {
    std::vector<Block> blocks;
    std::size_t next = 0;  // block that the writer asks for next
  };
  std::vector<Array> arrays_;
  std::size_t ready_ = 0;
};

}  // namespace cbc3d
