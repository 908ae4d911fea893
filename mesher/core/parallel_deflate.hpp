// The compression of VTK files by all threads and a quicker library than VTK's own, which does one block
// after the other; what comes out are zlib streams like its own.
#pragma once

#include <vtkObjectFactory.h>
#include <vtkZLibDataCompressor.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cbc3d {

/// Compresses arrays ahead, block by block in parallel, and hands VTK's writer the results when it comes to
/// them; what was not foreseen it compresses there and then.
class ParallelDeflate : public vtkZLibDataCompressor {
 public:
  static ParallelDeflate* New() { VTK_STANDARD_NEW_BODY(ParallelDeflate); }

  /// An array that will be written in blocks of that many bytes; to be called after the level is set. It must
  /// outlive the writing.
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
    std::size_t next = 0;  // to be asked for
  };
  std::vector<Array> arrays_;
  std::size_t ready_ = 0;
};

}  // namespace cbc3d
