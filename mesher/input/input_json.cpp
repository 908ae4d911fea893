#include "mesher/input/input_json.hpp"

#include <algorithm>

#include "mesher/input/input_options.hpp"

namespace cbc3d {
namespace {

/// The value of a choice; null where it was not made.
struct ChosenValue {
  nlohmann::json operator()(const bool* value) const { return *value ? nlohmann::json(true) : nullptr; }
  nlohmann::json operator()(const std::optional<int>* value) const {
    return *value ? nlohmann::json(**value) : nullptr;
  }
  template <typename Values>
  nlohmann::json operator()(const Values* values) const {
    return values->empty() ? nullptr : nlohmann::json(*values);
  }
};

struct KindName {
  const char* operator()(const bool* /*value*/) const { return "switch"; }
  const char* operator()(const std::optional<int>* /*value*/) const { return "number"; }
  const char* operator()(const std::string* /*value*/) const { return "text"; }
  const char* operator()(const std::vector<Label>* /*value*/) const { return "labels"; }
};

std::string key_of(const InputOption& option) {
  std::string key = option.name;
  std::replace(key.begin(), key.end(), '-', '_');
  return key;
}

}  // namespace

nlohmann::json chosen_json(const ImageInput& input) {
  ImageInput copy = input;  // the table's fields can be written to
  nlohmann::json chosen = nlohmann::json::object();
  for (const InputOption& option : input_options()) {
    const nlohmann::json value = std::visit(ChosenValue{}, option.field(copy));
    if (!value.is_null()) {
      chosen[key_of(option)] = value;
    }
  }
  return chosen;
}

nlohmann::json describe_input_options() {
  ImageInput defaults;
  nlohmann::json options = nlohmann::json::array();
  for (const InputOption& option : input_options()) {
    options.push_back({{"name", option.name},
                       {"kind", std::visit(KindName{}, option.field(defaults))},
                       {"symbol", option.symbol},
                       {"default_text", option.symbol.empty() ? "false" : option.default_text},
                       {"text", option.text}});
  }
  return options;
}

}  // namespace cbc3d
