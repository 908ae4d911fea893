#include "mesher/core/mapped_voxels.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <utility>

namespace cbc3d {
namespace fs = std::filesystem;
MappedVoxels::MappedVoxels(MappedVoxels&& other) noexcept
    : mapping_(std::exchange(other.mapping_, nullptr)), length_(other.length_), offset_(other.offset_) {}

MappedVoxels& MappedVoxels::operator=(MappedVoxels&& other) noexcept {
  std::swap(mapping_, other.mapping_);
  std::swap(length_, other.length_);
  std::swap(offset_, other.offset_);
  return *this;
}

MappedVoxels::~MappedVoxels() {
  if (mapping_ != nullptr) {
    ::munmap(mapping_, length_);
  }
}

void MappedVoxels::page_out() const {
#ifdef MADV_PAGEOUT
  static_cast<void>(::madvise(mapping_, length_, MADV_PAGEOUT));  // the system may ignore this advice
#endif
}

std::optional<MappedVoxels> map_voxels(const fs::path& path, std::uint64_t offset, std::size_t bytes) {
  std::error_code error;
  const auto length = fs::file_size(path, error);
  if (error || offset > length || length - offset < bytes) {
    return std::nullopt;
  }
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  void* mapping = file < 0
                      ? MAP_FAILED
                      : ::mmap(nullptr, length, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_NORESERVE, file, 0);
  if (file >= 0) {
    ::close(file);
  }
  if (mapping == MAP_FAILED) {
    return std::nullopt;
  }
  return MappedVoxels(mapping, length, offset);
}

}  // namespace cbc3d
