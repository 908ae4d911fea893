// Names of labels in JSON.
#pragma once

#include <nlohmann/json.hpp>

#include "mesher/core/label_names.hpp"

namespace cbc3d {

/// {"5": "right lung"}: the labels that have a name.
nlohmann::json names_json(const LabelNames& names);

/// The way back; what is no such object gives no names.
LabelNames names_of_json(const nlohmann::json& object);

/// Gives every object with an integer "label", at any depth, its "name" where there is one.
void add_names(nlohmann::json& json, const LabelNames& names);

}  // namespace cbc3d
