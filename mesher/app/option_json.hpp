// The table of options as JSON.
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "mesher/pipeline/option_table.hpp"

namespace cbc3d {

/// The options of these groups that `preset` has, by their keys in the report, as they are in `options`; null
/// where the field stands for a default in words.
nlohmann::json options_json(const MeshImageOptions& options, const MeshImageOptions& preset,
                            const std::vector<OptionGroup>& groups);

/// What `cbc3d mesh --describe-options` prints:
///   {"presets": [{"preset": "quality", "mixed": false, "options": [
///     {"name": "deviation", "group": "improvement", "kind": "number", "symbol": "DIAGONALS", "unit": "voxel
///     diagonals",
///      "default": 0.35, "default_text": "0.35",
///      "range": {"lowest": 0.01, "highest": 2, "excludes_lowest": false, "excludes_highest": false},
///      "values": [], "text": "..."}, ...]}, ...],
///    "input": as describe_input_options() has it}
/// "kind" is number, count, switch, enumeration or label_numbers; "default" is null where it depends on the
/// image, and "default_text" says how; "range" is null without one, its "highest" without a limit; "values"
/// are an enumeration's.
nlohmann::json describe_options();

}  // namespace cbc3d
