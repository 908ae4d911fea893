// What the module says of itself to 3D Slicer: the XML of the Slicer Execution Model.
#pragma once

#include <string>
#include <vector>

#include "mesher/input/input_options.hpp"
#include "mesher/pipeline/option_table.hpp"

namespace cbc3d::slicer {

/// How an option is asked for in Slicer's panel.
enum class Widget {
  boolean,      ///< given without a value when it is ticked
  integer,      ///< a number with the one default that all presets have
  real,         ///< the same, not whole
  enumeration,  ///< one of the choices, or of true and false, or kPresetChoice
  text,         ///< anything else; empty for the preset's own
};

/// Stands among the choices for that of the preset.
inline constexpr const char* kPresetChoice = "as the preset has it";

/// Slicer gives every number with a default on the command line, whatever the preset; so only an option with
/// one default may be asked for as a number.
Widget widget_of(const OptionRow& row);

/// The options that most users look for first, by name; the others are in groups that Slicer folds.
const std::vector<std::string>& first_options();

/// The choices about the label map, which Slicer hands over without names and other layers.
std::vector<const InputOption*> module_input_options();

/// The description: a label map in, a model out, what of the map is meshed, the preset and every option of
/// the table.
std::string module_description(const std::string& version);

}  // namespace cbc3d::slicer
