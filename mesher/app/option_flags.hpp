// The table of options as a command line.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "mesher/pipeline/option_table.hpp"

namespace cbc3d {

/// Options whose values a help text shows as defaults.
struct DefaultColumn {
  std::string label;  ///< of the preset; empty where there is only one
  MeshImageOptions options;
};

/// The frame for which help texts show defaults: voxels of 1 mm.
ImageFrame frame_of_defaults();

/// One column for each preset.
std::vector<DefaultColumn> preset_columns();

/// The same for the deformation of a given mesh.
std::vector<DefaultColumn> deformation_columns();

/// Adds --NAME for this row; its value is checked at once and goes to `settings`, which must outlive the
/// command. The help text has the unit, the range and the default, by column where they differ.
void add_option_flag(CLI::App& command, const OptionRow& row, const std::vector<DefaultColumn>& columns,
                     OptionSettings& settings);

/// The same for all rows of a group, under its heading.
void add_option_flags(CLI::App& command, OptionGroup group, const std::vector<DefaultColumn>& columns,
                      OptionSettings& settings);

}  // namespace cbc3d
