// The voxels of a label image: one byte each while the materials allow it, in memory or in a mapped file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "mesher/core/large_pages.hpp"
#include "mesher/core/mapped_voxels.hpp"
#include "mesher/core/voxel_bytes.hpp"

namespace cbc3d {

/// Index into LabelImage::labels; material 0 is background.
using MaterialId = std::uint16_t;

inline constexpr MaterialId kBackground = 0;

/// The bytes of an image's voxels as its file has them: the file itself, or memory that they were read into.
using FileVoxels = std::variant<MappedVoxels, VoxelBytes>;

/// The first voxel's first byte.
inline void* data_of(const FileVoxels& voxels) {
  return std::visit([](const auto& from) -> void* { return from.data(); }, voxels);
}

/// Material indices, one byte each until one above 255 is written, then two. Reading costs a branch that is
/// always taken the same way; loops over rows choose the type once by `visit`.
class LabelVoxels {
 public:
  LabelVoxels() = default;
  /// `count` voxels of background, narrow.
  explicit LabelVoxels(std::size_t count) : narrow_(count, 0) { point_to_own(); }
  /// The first `count` bytes of a file, each of them a material index. What is written stays in memory.
  LabelVoxels(FileVoxels file, std::size_t count)
      : file_(std::in_place, std::move(file)),
        count_(count),
        bytes_(static_cast<std::uint8_t*>(data_of(*file_))) {}
  /// `count` voxels, of indices below `materials`, to be written before they are read.
  static LabelVoxels unwritten(std::size_t count, std::size_t materials);

  /// A copy is in memory, whatever it is of.
  LabelVoxels(const LabelVoxels& other);
  LabelVoxels(LabelVoxels&& other) noexcept;
  LabelVoxels& operator=(LabelVoxels other) noexcept;
  ~LabelVoxels() = default;

  [[nodiscard]] std::size_t size() const { return count_; }
  /// True when a voxel has two bytes.
  [[nodiscard]] bool is_wide() const { return words_ != nullptr; }
  [[nodiscard]] std::size_t bytes() const { return count_ * (is_wide() ? 2 : 1); }

  [[nodiscard]] MaterialId operator[](std::size_t v) const {
    return bytes_ != nullptr ? MaterialId{bytes_[v]} : words_[v];
  }

  /// Several threads may set voxels at once if hold() was called for their materials before.
  void set(std::size_t v, MaterialId material) {
    if (bytes_ != nullptr && material > kMostNarrow) {
      widen();
    }
    if (bytes_ != nullptr) {
      bytes_[v] = static_cast<std::uint8_t>(material);
    } else {
      words_[v] = material;
    }
  }

  /// A voxel to be read or set.
  class Reference {
   public:
    Reference(LabelVoxels& voxels, std::size_t v) : voxels_(voxels), v_(v) {}
    Reference(const Reference&) = default;
    Reference& operator=(const Reference& other) { return *this = static_cast<MaterialId>(other); }
    Reference& operator=(MaterialId material) {
      voxels_.set(v_, material);
      return *this;
    }
    operator MaterialId() const { return std::as_const(voxels_)[v_]; }  // NOLINT: it stands for the voxel

   private:
    LabelVoxels& voxels_;
    std::size_t v_;
  };
  [[nodiscard]] Reference operator[](std::size_t v) { return {*this, v}; }

  /// Makes room for material indices below `materials`: widens the voxels when one byte is too small.
  void hold(std::size_t materials) {
    if (bytes_ != nullptr && materials > std::size_t{kMostNarrow} + 1) {
      widen();
    }
  }

  /// Replaces all voxels by `count` voxels of one material.
  void assign(std::size_t count, MaterialId material);
  /// Replaces all voxels by `count` voxels of background.
  void resize(std::size_t count) { assign(count, kBackground); }
  void push_back(MaterialId material);

  /// Calls f(pointer to the first voxel), of const std::uint8_t or const std::uint16_t; returns what f does.
  template <typename F>
  decltype(auto) visit(F&& f) const {
    return words_ != nullptr ? std::forward<F>(f)(static_cast<const std::uint16_t*>(words_))
                             : std::forward<F>(f)(static_cast<const std::uint8_t*>(bytes_));
  }
  /// The same for writing. The indices written must fit (see hold()).
  template <typename F>
  decltype(auto) visit(F&& f) {
    return words_ != nullptr ? std::forward<F>(f)(words_) : std::forward<F>(f)(bytes_);
  }

  /// Call this when no voxel is read for a while: a large mapped file leaves the memory until one is read.
  void page_out() const {
    const auto* mapped = file_ ? std::get_if<MappedVoxels>(&*file_) : nullptr;
    if (mapped != nullptr && count_ >= kLarge) {
      mapped->page_out();
    }
  }

  /// The first voxel while each is one byte, null when they are wide.
  [[nodiscard]] std::uint8_t* narrow() { return bytes_; }

  bool operator==(const LabelVoxels& other) const;

 private:
  static constexpr MaterialId kMostNarrow = 255;
  static constexpr std::size_t kLarge = std::size_t{1} << 30U;

  void point_to_own();
  void widen();

  std::optional<FileVoxels> file_;
  std::vector<std::uint8_t, LargePages<std::uint8_t>> narrow_;
  std::vector<std::uint16_t, LargePages<std::uint16_t>> wide_;
  std::size_t count_ = 0;
  std::uint8_t* bytes_ = nullptr;   // into the file or narrow_; null when wide
  std::uint16_t* words_ = nullptr;  // into wide_; null when narrow
};

}  // namespace cbc3d
