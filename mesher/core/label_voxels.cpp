#include "mesher/core/label_voxels.hpp"

#include <algorithm>

namespace cbc3d {

void LabelVoxels::point_to_own() {
  const bool wide = !wide_.empty();
  count_ = wide ? wide_.size() : narrow_.size();
  words_ = wide ? wide_.data() : nullptr;
  bytes_ = wide ? nullptr : narrow_.data();
}

LabelVoxels LabelVoxels::unwritten(std::size_t count, std::size_t materials) {
  LabelVoxels voxels;
  if (materials > std::size_t{kMostNarrow} + 1) {
    voxels.wide_.resize(count);
  } else {
    voxels.narrow_.resize(count);
  }
  voxels.point_to_own();
  return voxels;
}

LabelVoxels::LabelVoxels(const LabelVoxels& other) {
  if (other.is_wide()) {
    wide_ = other.wide_;
  } else {
    narrow_.assign(other.bytes_, other.bytes_ + other.count_);
  }
  point_to_own();
}

// Vectors and mappings keep their memory when they are moved, so the pointers stay valid.
LabelVoxels::LabelVoxels(LabelVoxels&& other) noexcept
    : file_(std::exchange(other.file_, std::nullopt)),
      narrow_(std::exchange(other.narrow_, {})),
      wide_(std::exchange(other.wide_, {})),
      count_(std::exchange(other.count_, 0)),
      bytes_(std::exchange(other.bytes_, nullptr)),
      words_(std::exchange(other.words_, nullptr)) {}

LabelVoxels& LabelVoxels::operator=(LabelVoxels other) noexcept {
  file_.swap(other.file_);
  narrow_.swap(other.narrow_);
  wide_.swap(other.wide_);
  std::swap(count_, other.count_);
  std::swap(bytes_, other.bytes_);
  std::swap(words_, other.words_);
  return *this;
}

void LabelVoxels::widen() {
  wide_.assign(bytes_, bytes_ + count_);
  narrow_ = {};
  file_.reset();
  point_to_own();
}

void LabelVoxels::assign(std::size_t count, MaterialId material) {
  LabelVoxels fresh;
  if (material > kMostNarrow) {
    fresh.wide_.assign(count, material);
  } else {
    fresh.narrow_.assign(count, static_cast<std::uint8_t>(material));
  }
  fresh.point_to_own();
  *this = std::move(fresh);
}

void LabelVoxels::push_back(MaterialId material) {
  if (file_) {
    *this = LabelVoxels(*this);
  }
  hold(std::size_t{material} + 1);
  if (is_wide()) {
    wide_.push_back(material);
  } else {
    narrow_.push_back(static_cast<std::uint8_t>(material));
  }
  point_to_own();
}

bool LabelVoxels::operator==(const LabelVoxels& other) const {
  return count_ == other.count_ && visit([&](const auto* mine) {
           return other.visit([&](const auto* its) { return std::equal(mine, mine + count_, its); });
         });
}

}  // namespace cbc3d
