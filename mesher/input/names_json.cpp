#include "mesher/input/names_json.hpp"

#include <charconv>
#include <string>

namespace cbc3d {

nlohmann::json names_json(const LabelNames& names) {
  nlohmann::json object = nlohmann::json::object();
  for (const NamedLabel& named : names.entries()) {
    if (!named.name.empty()) {
      object[std::to_string(named.label)] = named.name;
    }
  }
  return object;
}

LabelNames names_of_json(const nlohmann::json& object) {
  LabelNames names;
  if (!object.is_object()) {
    return names;
  }
  for (const auto& [key, value] : object.items()) {
    Label label = 0;
    const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), label);
    if (error == std::errc() && end == key.data() + key.size() && value.is_string()) {
      names.set({.label = label, .name = value.get<std::string>()});
    }
  }
  return names;
}

void add_names(nlohmann::json& json, const LabelNames& names) {
  if (names.empty()) {
    return;
  }
  if (json.is_object()) {
    const auto label = json.find("label");
    if (label != json.end() && label->is_number_integer()) {
      const NamedLabel* const named = names.find(label->get<Label>());
      if (named != nullptr && !named->name.empty()) {
        json["name"] = named->name;
      }
    }
  }
  if (json.is_structured()) {
    for (auto& value : json) {
      if (value.is_structured()) {
        add_names(value, names);
      }
    }
  }
}

}  // namespace cbc3d
