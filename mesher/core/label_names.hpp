// Names and colours of labels, as segmentation files and tables beside them state them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesher/core/label_image.hpp"

namespace cbc3d {

struct NamedLabel {
  Label label = 0;
  std::string name;                                   ///< UTF-8, one line
  std::optional<std::array<std::uint8_t, 3>> colour;  ///< red, green, blue
};

/// A table from labels to names; a label that it lacks is known by its number alone.
class LabelNames {
 public:
  /// Adds a label, or replaces what is known of it; control characters in the name become spaces,
  /// and a name that is no UTF-8 is taken for Latin-1.
  void set(NamedLabel named);

  /// Adds the entries of labels that this table lacks.
  void add_unknown(const LabelNames& other);

  /// The entry of a label, or null.
  [[nodiscard]] const NamedLabel* find(Label label) const;

  /// How a person reads the label: "right lung (5)", or "label 5" without a name.
  [[nodiscard]] std::string text(Label label) const;

  /// A name for files that want an identifier of letters, digits and underscores that begins with a letter:
  /// "right_lung", or "label_5" ("label_m5" for -5). Two labels of one name, and names without letters or
  /// digits, get their number too.
  [[nodiscard]] std::string identifier(Label label) const;

  /// The entries of these labels alone that have a name or a colour.
  [[nodiscard]] LabelNames of(const std::vector<Label>& labels) const;

  [[nodiscard]] bool empty() const { return entries_.empty(); }
  [[nodiscard]] const std::vector<NamedLabel>& entries() const { return entries_; }  ///< ascending by label

 private:
  std::vector<NamedLabel> entries_;
};

}  // namespace cbc3d
