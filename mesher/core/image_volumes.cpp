#include "mesher/core/image_volumes.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <set>
#include <type_traits>
#include <unordered_map>
#include <utility>

#include "mesher/formats/component_type.hpp"

namespace cbc3d {
namespace {

using formats::Component;
using formats::FormatError;
using formats::ImageHeader;
using formats::Segment;
using formats::with_type;

/// A value of one layer.
using LayerValue = std::pair<std::size_t, std::int64_t>;

/// What a value of a layer stands for: of several in a voxel the highest rank has it.
struct Entry {
  int rank = 0;
  Label label = 0;
};
using LayerTables = std::vector<std::unordered_map<std::int64_t, Entry>>;

std::size_t voxel_count(const ImageHeader& header) {
  return header.size[0] * header.size[1] * header.size[2];
}

/// Where the value of a voxel in a volume lies among all values.
struct ValueIndex {
  explicit ValueIndex(const ImageHeader& header)
      : voxel_step(header.volumes_interleaved ? header.volumes : 1),
        volume_step(header.volumes_interleaved ? 1 : voxel_count(header)) {}
  [[nodiscard]] std::size_t operator()(std::size_t voxel, std::size_t volume) const {
    return voxel * voxel_step + volume * volume_step;
  }
  std::size_t voxel_step, volume_step;
};

std::string range_of(std::size_t count) {
  return "from 0 to " + std::to_string(count - 1);
}

std::size_t chosen(const char* kind, int number, std::size_t count) {
  if (number < 0 || static_cast<std::size_t>(number) >= count) {
    throw FormatError(
        "it has no " + std::string(kind) + " " + std::to_string(number) +
        (count == 1 ? ", for it has one alone; leave the choice out" : "; choose one " + range_of(count)));
  }
  return static_cast<std::size_t>(number);
}

[[noreturn]] void refuse_volumes(const ImageHeader& header, const FileVoxels& voxels) {
  const std::string count = std::to_string(header.volumes);
  if (!probability_in(header, voxels).empty()) {
    throw FormatError("it has " + count +
                      " volumes of fractions from 0 to 1, probability maps; take the most likely label of "
                      "every voxel first (FSL: fslmaths IN -Tmaxn OUT)");
  }
  throw FormatError("it is 4-dimensional with " + count + " volumes; volume=N takes one of them, " +
                    range_of(header.volumes));
}

/// Distinct values of all layers that are not background.
template <typename T>
std::set<LayerValue> values_of_layers(const ImageHeader& header, const T* values) {
  constexpr std::size_t kMost = 65536;
  const ValueIndex index(header);
  const std::size_t count = voxel_count(header);
  std::set<LayerValue> all;
#pragma omp parallel for schedule(dynamic)
  for (std::size_t layer = 0; layer < header.volumes; ++layer) {
    std::set<LayerValue> mine;
    T last = T{};
    for (std::size_t v = 0; v < count && mine.size() <= kMost; ++v) {
      const T value = values[index(v, layer)];
      if (value != last && value != T{}) {
        mine.emplace(layer, static_cast<std::int64_t>(value));
      }
      last = value;
    }
#pragma omp critical(cbc3d_layers)
    all.merge(mine);
  }
  if (all.size() > kMost) {
    throw FormatError("its layers have more than 65536 different values; give a segmentation");
  }
  return all;
}

/// Segments in the order of the file, then the values that no segment has.
std::vector<LayerValue> layer_values_in_order(const ImageHeader& header, std::set<LayerValue> present) {
  std::vector<LayerValue> ordered;
  for (const Segment& segment : header.segments) {
    ordered.emplace_back(segment.layer, segment.value);
    present.erase(ordered.back());
  }
  ordered.insert(ordered.end(), present.begin(), present.end());
  return ordered;
}

bool has_one_value_twice(const std::vector<LayerValue>& ordered) {
  std::map<std::int64_t, std::size_t> layer_of;
  return std::any_of(ordered.begin(), ordered.end(), [&](const LayerValue& entry) {
    return layer_of.try_emplace(entry.second, entry.first).first->second != entry.first;
  });
}

Label label_of(std::int64_t value) {
  if (value > std::numeric_limits<Label>::max() || value < std::numeric_limits<Label>::min()) {
    throw FormatError("its label " + std::to_string(value) + " does not fit 32 bits; renumber the labels");
  }
  return static_cast<Label>(value);
}

/// The tables of all layers; the segments take their new values.
LayerTables tables_of(ImageHeader& header, const std::vector<LayerValue>& ordered) {
  const bool renumbers = has_one_value_twice(ordered);
  LayerTables tables(header.volumes);
  const auto named = static_cast<int>(header.segments.size());
  for (std::size_t n = 0; n < ordered.size(); ++n) {
    const auto [layer, value] = ordered[n];
    const int rank = static_cast<int>(n) < named ? static_cast<int>(n) : static_cast<int>(n) - (1 << 30);
    const Label label = renumbers ? static_cast<Label>(n + 1) : label_of(value);
    tables[layer].try_emplace(value, Entry{rank, label});
    if (n < header.segments.size()) {
      header.segments[n].value = label;
    }
  }
  if (renumbers) {
    header.warnings.push_back(
        "its layers have the same values for different segments; the labels are the segments' numbers in the "
        "order of the file, 1 to " +
        std::to_string(ordered.size()));
  }
  return tables;
}

/// Voxels in several segments, and which segment lies over which.
struct Overlaps {
  std::size_t voxels = 0;
  std::set<std::pair<Label, Label>> pairs;  ///< the label that has the voxel, and another one
};

template <typename T>
std::size_t combine(const ImageHeader& header, const T* values, const LayerTables& tables, std::int32_t* out,
                    std::set<std::pair<Label, Label>>& pairs) {
  const ValueIndex index(header);
  const std::size_t count = voxel_count(header);
  std::size_t shared = 0;
#pragma omp parallel reduction(+ : shared)
  {
    std::set<std::pair<Label, Label>> mine;
    std::vector<Entry> here;
    std::vector<std::pair<T, Entry>> last(header.volumes);  // of each layer: runs of one value are long
#pragma omp for schedule(static)
    for (std::size_t v = 0; v < count; ++v) {
      here.clear();
      for (std::size_t layer = 0; layer < header.volumes; ++layer) {
        const T value = values[index(v, layer)];
        if (value != T{}) {
          if (value != last[layer].first) {
            last[layer] = {value, tables[layer].at(static_cast<std::int64_t>(value))};
          }
          here.push_back(last[layer].second);
        }
      }
      const auto top = std::max_element(here.begin(), here.end(),
                                        [](const Entry& a, const Entry& b) { return a.rank < b.rank; });
      out[v] = here.empty() ? 0 : top->label;
      shared += here.size() > 1 ? 1 : 0;
      for (const Entry& other : here) {
        if (other.rank != top->rank) {
          mine.emplace(top->label, other.label);
        }
      }
    }
#pragma omp critical(cbc3d_overlaps)
    pairs.merge(mine);
  }
  return shared;
}

void warn_of_overlaps(const Overlaps& overlaps, ImageHeader& header) {
  constexpr std::size_t kFew = 3;
  if (overlaps.voxels == 0) {
    return;
  }
  ImageHeader quiet = header;
  const LabelNames names = names_of_segments(quiet);
  std::string text;
  std::size_t left = overlaps.pairs.size();
  for (const auto& [over, under] : overlaps.pairs) {
    if (overlaps.pairs.size() - left == kFew) {
      break;
    }
    text += (text.empty() ? "" : ", ") + names.text(over) + " over " + names.text(under);
    --left;
  }
  text += left > 0 ? " and " + std::to_string(left) + " other pairs" : "";
  header.warnings.push_back(std::to_string(overlaps.voxels) + " voxels lie in several segments (" + text +
                            "); each has the one that comes last in the file, layer=N takes one layer alone");
}

/// The layer alone: its segments keep their values.
void keep_layer(ImageHeader& header, std::size_t layer) {
  std::erase_if(header.segments, [layer](const Segment& segment) { return segment.layer != layer; });
}

}  // namespace

std::string probability_in(const ImageHeader& header, const FileVoxels& voxels) {
  std::string found;
  with_type(header.component, [&](const auto* type) {
    using T = std::remove_const_t<std::remove_pointer_t<decltype(type)>>;
    if constexpr (std::is_floating_point_v<T>) {
      const auto* const values = static_cast<const T*>(data_of(voxels));
      const std::size_t count = formats::voxel_bytes(header) / sizeof(T);
      const bool all_within =
          std::all_of(values, values + count, [](T value) { return value >= 0 && value <= 1; });
      const auto* const fraction =
          std::find_if(values, values + count, [](T value) { return value != std::floor(value); });
      if (all_within && fraction != values + count) {
        char digits[64];
        found.assign(std::begin(digits), std::to_chars(std::begin(digits), std::end(digits), *fraction).ptr);
      }
    }
  });
  return found;
}

VoxelBytes volume_of(const ImageHeader& header, const FileVoxels& voxels, std::size_t volume) {
  const ValueIndex index(header);
  const std::size_t count = voxel_count(header);
  VoxelBytes one(0, count * formats::bytes_of(header.component));
  with_type(header.component, [&](const auto* type) {
    using T = std::remove_const_t<std::remove_pointer_t<decltype(type)>>;
    const auto* const from = static_cast<const T*>(data_of(voxels));
    auto* const to = reinterpret_cast<T*>(one.data());
#pragma omp parallel for schedule(static)
    for (std::size_t v = 0; v < count; ++v) {
      to[v] = from[index(v, volume)];
    }
  });
  return one;
}

FileVoxels combine_layers(ImageHeader& header, const FileVoxels& voxels) {
  VoxelBytes combined(0, voxel_count(header) * sizeof(std::int32_t));
  auto* const out = reinterpret_cast<std::int32_t*>(combined.data());
  Overlaps overlaps;
  with_type(header.component, [&](const auto* type) {
    using T = std::remove_const_t<std::remove_pointer_t<decltype(type)>>;
    if constexpr (std::is_floating_point_v<T>) {
      throw FormatError("its layers hold floating-point numbers; save the segmentation with integer values");
    } else {
      const auto* const values = static_cast<const T*>(data_of(voxels));
      const auto ordered = layer_values_in_order(header, values_of_layers(header, values));
      const LayerTables tables = tables_of(header, ordered);
      overlaps.voxels = combine(header, values, tables, out, overlaps.pairs);
    }
  });
  warn_of_overlaps(overlaps, header);
  header.component = Component::int32;
  header.volumes = 1;
  return combined;
}

FileVoxels one_value_per_voxel(ImageHeader& header, FileVoxels voxels, const ReadImageOptions& options) {
  const bool has_layers = !header.segments.empty();
  if (has_layers && options.volume) {
    throw FormatError("it is a segmentation, which has layers and no volumes; layer=N chooses one, " +
                      range_of(header.volumes));
  }
  if (!has_layers && options.layer) {
    throw FormatError("it names no segments and so has no layers; leave the choice out or use volume=N");
  }
  const auto choice = has_layers ? options.layer : options.volume;
  const std::size_t number = choice ? chosen(has_layers ? "layer" : "volume", *choice, header.volumes) : 0;
  if (header.volumes == 1) {
    return voxels;
  }
  if (!choice && has_layers) {
    return combine_layers(header, voxels);
  }
  if (!choice) {
    refuse_volumes(header, voxels);
  }
  VoxelBytes one = volume_of(header, voxels, number);
  if (has_layers) {
    keep_layer(header, number);
  }
  header.volumes = 1;
  return one;
}

LabelNames names_of_segments(ImageHeader& header) {
  LabelNames names;
  for (const Segment& segment : header.segments) {
    const auto label = static_cast<Label>(segment.value);
    if (label != segment.value) {
      header.warnings.push_back("its segment '" + segment.name + "' has the value " +
                                std::to_string(segment.value) + ", which no label can have; it is left out");
    } else if (const NamedLabel* known = names.find(label)) {
      header.warnings.push_back("its segments '" + known->name + "' and '" + segment.name +
                                "' have one value, " + std::to_string(label) + "; the first name is taken");
    } else if (label != 0) {
      names.set({.label = label, .name = segment.name, .colour = segment.colour});
    }
  }
  return names;
}

}  // namespace cbc3d
