// From the values of an array, a file's or a caller's, to labels and materials.
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <string>
#include <type_traits>
#include <unordered_map>
#include <utility>
#include <vector>

#include "mesher/core/error.hpp"
#include "mesher/core/image_io.hpp"
#include "mesher/core/label_image.hpp"
#include "mesher/core/voxel_rows.hpp"

namespace cbc3d {

/// Turns label values into material indices in two steps: it collects the distinct values, then looks each
/// voxel's up. What it throws begins with `subject` ("cannot read 'a.nrrd'"), so that the user knows whose
/// values are at fault.
template <typename T>
class Classifier {
 public:
  Classifier(const T* values, std::size_t count, std::string subject)
      : values_(values), count_(count), subject_(std::move(subject)) {}

  /// Finds the labels of the image. Throws InputError for a fractional value, one that does not fit 32 bits,
  /// and more than 65536 different values.
  void find_labels(LabelImage& image) {
    collect();
    assign_labels(image);
    labels_ = image.labels.size();
  }

  /// True when every value is one byte and the number of its material: the bytes can stay as they are.
  [[nodiscard]] bool values_are_materials() const {
    return sizeof(T) == 1 && std::all_of(material_.begin(), material_.end(), [](const auto& known) {
             return known.first == static_cast<T>(known.second) && known.first >= T{};
           });
  }

  [[nodiscard]] LabelVoxels voxels() const {
    LabelVoxels voxels = LabelVoxels::unwritten(count_, labels_);
    voxels.visit([this](auto* to) { this->look_up(to); });
    return voxels;
  }

  /// Writes the material of every voxel to `to`; values of one byte may be there themselves.
  template <typename Voxel>
  void look_up(Voxel* to) const {
#pragma omp parallel
    {
      T last = T{};
      auto material = static_cast<Voxel>(material_.at(T{}));
#pragma omp for
      for (std::size_t v = 0; v < count_; ++v) {
        if (values_[v] != last) {
          last = values_[v];
          material = static_cast<Voxel>(material_.at(last));
        }
        to[v] = material;
      }
    }
  }

 private:
  void collect() {
    material_[T{}] = kBackground;
    if constexpr (sizeof(T) == 1) {
      collect_bytes();
    } else {
      collect_values();
    }
    if (material_.size() > kMostLabels) {
      fail("it has more than 65536 different values; give a label image, not a grey one");
    }
  }

  /// The same with a table of all values, run by run.
  void collect_bytes() {
    constexpr std::size_t kPiece = std::size_t{1} << 20U;
    const auto* bytes = reinterpret_cast<const unsigned char*>(values_);
    std::array<bool, 256> present{};
#pragma omp parallel
    {
      std::array<bool, 256> mine{};
#pragma omp for nowait
      for (std::size_t begin = 0; begin < count_; begin += kPiece) {
        const auto length = static_cast<int>(std::min(kPiece, count_ - begin));
        for (int i = 0; i < length; i = end_of_run(bytes + begin, i, length)) {
          mine[bytes[begin + static_cast<std::size_t>(i)]] = true;
        }
      }
#pragma omp critical(cbc3d_classifier)
      std::transform(mine.begin(), mine.end(), present.begin(), present.begin(), std::logical_or<>());
    }
    for (std::size_t byte = 0; byte < present.size(); ++byte) {
      if (present[byte]) {
        material_.emplace(static_cast<T>(byte), kBackground);
      }
    }
  }

  void collect_values() {
#pragma omp parallel
    {
      std::unordered_map<T, MaterialId> mine;
      T last = T{};
#pragma omp for nowait
      for (std::size_t v = 0; v < count_; ++v) {
        if (values_[v] != last) {
          last = values_[v];
          if (mine.size() <= kMostLabels) {
            mine.emplace(last, kBackground);
          }
        }
      }
#pragma omp critical(cbc3d_classifier)
      material_.insert(mine.begin(), mine.end());
    }
  }

  void assign_labels(LabelImage& image) {
    std::vector<T> distinct;
    for (const auto& [value, material] : material_) {
      require_label(value);
      if (value != T{}) {
        distinct.push_back(value);
      }
    }
    std::sort(distinct.begin(), distinct.end());
    image.labels.assign(1, 0);
    for (const T value : distinct) {
      material_[value] = static_cast<MaterialId>(image.labels.size());
      image.labels.push_back(static_cast<Label>(value));
    }
  }

  void require_label(T value) const {
    char digits[64];
    const std::string text(std::begin(digits),
                           std::to_chars(std::begin(digits), std::end(digits), value).ptr);
    if constexpr (std::is_floating_point_v<T>) {
      if (!std::isfinite(value)) {
        fail("it has the value " + text + ", which is no finite number; set such voxels to the background");
      }
      if (value != std::floor(value)) {
        fail("it has the fractional value " + text +
             (std::fabs(value - std::nearbyint(value)) <= kRoundingTolerance
                  ? "; round_values takes what is within 1e-4 of an integer"
                  : "; give integer labels (threshold or round it first)"));
      }
    }
    if (static_cast<long double>(value) > std::numeric_limits<Label>::max() ||
        static_cast<long double>(value) < std::numeric_limits<Label>::min()) {
      fail("its label " + text + " does not fit 32 bits; renumber the labels");
    }
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw InputError(subject_ + ": " + what);
  }

  static constexpr std::size_t kMostLabels = 65536;
  const T* values_;
  std::size_t count_;
  std::string subject_;
  std::unordered_map<T, MaterialId> material_;
  std::size_t labels_ = 1;
};

}  // namespace cbc3d
