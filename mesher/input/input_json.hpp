// The choices about the image that a command reads, as JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "mesher/input/image_input.hpp"

namespace cbc3d {

/// What was chosen, for a report: {"labels": [2, 5], "keep_rest": true}, an object without the choices that
/// were not made.
nlohmann::json chosen_json(const ImageInput& input);

/// The table for `cbc3d mesh --describe-options`: [{"name": "volume", "kind": "number", "symbol": "N",
/// "default_text": "a 3-D image", "text": "..."}, ...]; "kind" is switch, number, text or labels.
nlohmann::json describe_input_options();

}  // namespace cbc3d
