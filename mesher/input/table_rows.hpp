// A row of a table of labels, and what all kinds of tables refuse.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesher/core/label_names.hpp"

namespace cbc3d {

using Colour = std::array<std::uint8_t, 3>;

/// Collects the rows of a table. What it throws is InputError: "SUBJECT: line 3 'TEXT' ...".
class TableRows {
 public:
  explicit TableRows(std::string subject) : subject_(std::move(subject)) {}

  /// Goes on to the next line of the file, which messages name.
  void begin_line(std::size_t number, std::string_view text);
  /// Adds a row of this line; a label that stands twice is refused.
  void add(const std::string& number, const std::string& name, std::optional<Colour> colour);
  [[noreturn]] void fail(const std::string& what) const;

  /// "#ff8000", "255 128 0", "1.0,0.5,0.0"; none of an empty text and "n/a".
  [[nodiscard]] std::optional<Colour> colour(const std::string& text) const;
  [[nodiscard]] std::optional<Colour> colour(const std::vector<std::string>& numbers) const;

  /// The names. Throws InputError where there is no row.
  [[nodiscard]] LabelNames names() const;

 private:
  std::string subject_, text_;
  std::size_t line_ = 0;
  std::map<Label, std::size_t> line_of_;
  LabelNames names_;
};

}  // namespace cbc3d
