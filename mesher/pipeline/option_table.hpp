// The options of the mesher, one row each. From this table are made the command line, the options in the JSON
// report and `cbc3d mesh --describe-options`, from which in turn the benchmark takes the parameters of its
// adapters; other front ends set options by name with set_option(). A row holds no default: a default is what
// the field of a preset's options holds.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "mesher/core/error.hpp"
#include "mesher/core/label_image.hpp"
#include "mesher/pipeline/mesh_image.hpp"

namespace cbc3d {

/// The part of the method that an option belongs to.
enum class OptionGroup { cleaning, lattice, mixed, improvement, deformation };

enum class OptionKind {
  number,         ///< a finite number in a range
  count,          ///< a whole number in a range
  on_off,         ///< a switch
  choice,         ///< one of some names
  label_numbers,  ///< numbers in a range, each of one label of the image
};

using LabelNumbers = std::map<Label, double>;

/// The value of an option, of the type that its kind asks for, or a text that is parsed as such: "0.5",
/// "true", "voxel-faces", "2=0.9,3=0.8".
using OptionValue = std::variant<bool, std::int64_t, double, std::string, LabelNumbers>;

struct NumberRange {
  double lowest;
  double highest;
  bool excludes_lowest = false;
  bool excludes_highest = false;

  [[nodiscard]] bool contains(double value) const;  ///< false for what is not finite
};

struct OptionRow {
  std::string name;  ///< of the parameter; on the command line two hyphens precede it
  OptionGroup group = OptionGroup::cleaning;
  std::string
      symbol;        ///< stands for the value in a help text: "MM", "LABEL=F"; empty for switches and choices
  std::string unit;  ///< "mm", "deg", "voxel diagonals"; empty for a bare number
  std::string key;   ///< in the JSON report; empty: the name with _ for -
  std::string label_key;            ///< key below that of a label, where several options share `key`
  std::string text;                 ///< what it does, one line
  std::string unset_text;           ///< the default in words, where the preset's value lies outside the range
  bool scales_with_voxels = false;  ///< the presets give the default in voxel diagonals
  bool negates_field = false;       ///< a switch that turns off what `key` names

  // Filled in by the table from the field's type.
  OptionKind kind = OptionKind::number;
  NumberRange range{0, 0};
  std::vector<std::string> choices;
  std::function<OptionValue(const MeshImageOptions&)> get;
  /// Takes a value that checked_value() gave. Numbers of labels join those that are there.
  std::function<void(MeshImageOptions&, const OptionValue&)> set;
};

/// An option that does not exist, or a value that it does not take. The message reads "NAME VALUE: give
/// REMEDY" and names the parameter without hyphens, for each front end has its own way to write it.
class OptionError : public InputError {
 public:
  using InputError::InputError;
};

/// All options, in the order in which a help text shows them.
const std::vector<OptionRow>& option_table();

/// The row of a name, in which _ may stand for -. Throws OptionError, naming the known ones, when there is
/// none.
const OptionRow& find_option(std::string_view name);

/// The value as the row's kind has it: parsed where it is a text, its range checked. Throws OptionError.
OptionValue checked_value(const OptionRow& row, const OptionValue& value);

/// Sets an option by name. Throws OptionError. Set `young-pa` and `poisson` before the same of single labels,
/// which take from them what is not their own.
void set_option(MeshImageOptions& options, std::string_view name, const OptionValue& value);

/// Settings by name, in the order given; a later one of the same name wins.
using OptionSettings = std::vector<std::pair<std::string, OptionValue>>;

/// Applies them, those of single labels last. Throws OptionError.
void apply_settings(const OptionSettings& settings, MeshImageOptions& options);

/// Throws OptionError when an option has a number for a label that the image lacks.
void require_known_labels(const MeshImageOptions& options, const LabelImage& image);

/// What users see over the options of a group: "Lattice and its refinement".
std::string heading(OptionGroup group);

/// "in (0, 1]", "above 0", "true or false", "none, holes, specks or both": what the option takes.
std::string range_text(const OptionRow& row);

/// The option's key in the JSON report.
std::string report_key(const OptionRow& row);

/// False for options of the improvement where the options' preset does not improve.
bool has_option(const MeshImageOptions& preset, const OptionRow& row);

/// The value as a text that checked_value() would take.
std::string value_text(const OptionValue& value);

/// True when the field holds no value of the option's range and so stands for what `unset_text` says.
bool is_unset(const OptionRow& row, const MeshImageOptions& options);

/// The default in a preset's options: the value, or words where it depends on the image. `options` are those
/// for an image whose voxels have the diagonal given.
std::string default_text(const OptionRow& row, const MeshImageOptions& options, double voxel_diagonal_mm);

}  // namespace cbc3d
