#include "baselines/cbc3d/adapter.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "mesher/core/error.hpp"
#include "mesher/core/json_text.hpp"

namespace cbc3d::baselines {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kSwitch = "true|false";

/// A preset of `cbc3d mesh`; the empty name stands for the first, which is the default.
struct Preset {
  std::string name;
  bool mixed = false;
};

/// The path as one word of the shell's.
std::string quoted(const fs::path& path) {
  std::string text = "'";
  for (const char c : path.string()) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

/// What the program writes to its standard output.
std::string output_of(const std::string& command) {
  std::FILE* pipe = ::popen(command.c_str(), "r");
  if (pipe == nullptr) throw JobError("cannot start " + command);
  std::string text;
  std::array<char, 4096> buffer{};
  while (const std::size_t size = std::fread(buffer.data(), 1, buffer.size(), pipe))
    text.append(buffer.data(), size);
  if (::pclose(pipe) != 0) throw InputError(command + " failed; build the target cbc3d again");
  return text;
}

std::string joined(const json& names) {
  std::string text;
  for (const json& name : names) text += (text.empty() ? "" : "|") + name.get<std::string>();
  return text;
}

/// What stands in the unit's place: the names that a switch or an enumeration takes, the form of values of
/// labels.
std::string unit_of(const json& option) {
  const auto kind = option.at("kind").get<std::string>();
  if (kind == "switch") return kSwitch;
  if (kind == "enumeration") return joined(option.at("values"));
  return option.at(kind == "label_numbers" ? "symbol" : "unit").get<std::string>();
}

ParameterSpecs specs_of(const json& options) {
  ParameterSpecs specs;
  for (const json& option : options) {
    specs.push_back({.key = option.at("name").get<std::string>(),
                     .default_value = option.at("default_text").get<std::string>(),
                     .unit = unit_of(option),
                     .description = option.at("text").get<std::string>()});
  }
  return specs;
}

bool is_built(const fs::path& bin_dir) {
  std::error_code ignored;
  return fs::is_regular_file(bin_dir / "cbc3d", ignored);
}

ParameterSpecs described_by_program(const Preset& preset, const fs::path& bin_dir) {
  if (!is_built(bin_dir)) return {};
  const std::string command = quoted(bin_dir / "cbc3d") + " mesh --describe-options";
  try {
    const json description = parse_json<json>(output_of(command), command);
    for (const json& described : description.at("presets")) {
      const bool is_named = preset.name.empty() || described.at("preset") == preset.name;
      if (is_named && described.at("mixed") == preset.mixed) return specs_of(described.at("options"));
    }
  } catch (const json::exception& error) {
    throw InputError(command + ": " + error.what() + "; build the target cbc3d again");
  }
  throw InputError(command + " names no preset " + preset.name + "; build the target cbc3d again");
}

bool is_switch(const ParameterSpecs& specs, const std::string& key) {
  return std::any_of(specs.begin(), specs.end(),
                     [&](const ParameterSpec& spec) { return spec.key == key && spec.unit == kSwitch; });
}

bool has_parameter(const ParameterSpecs& specs, const std::string& key) {
  return std::any_of(specs.begin(), specs.end(), [&](const ParameterSpec& spec) { return spec.key == key; });
}

/// A number of elements where the program takes one. Else the spacing of the finest lattice, at an eighth of
/// the coarsest one's, with a fidelity that no lattice meets: as long as the fidelity decides, a lattice of
/// half the spacing gives the same mesh.
std::optional<SizeDial> dial_of(const Preset& preset, const ParameterSpecs& specs) {
  if (preset.name.empty() && has_parameter(specs, "elements")) {
    return SizeDial{.parameter = "elements",
                    .exponent = 1,
                    .first = 100000,
                    .lowest = 100,
                    .highest = 1e9,
                    .counts_elements = true};
  }
  if (!has_parameter(specs, "finest-spacing")) return std::nullopt;
  constexpr double kCoarsestOverFinest = 8;
  return SizeDial{.parameter = "finest-spacing",
                  .exponent = -2.5,
                  .first = 2,
                  .lowest = 0.02,
                  .highest = 1000,
                  .followers = {{"lattice-spacing", kCoarsestOverFinest}},
                  .fixed = {{"fidelity", "1"}}};
}

std::vector<std::string> words_of(const std::string& mesher, const ParameterSpecs& specs,
                                  const std::string& key, const std::string& value) {
  if (!is_switch(specs, key)) return {"--" + key, value};
  if (value != "true" && value != "false")
    throw InputError(mesher + "." + key + "=" + value + ": a switch; give true or false");
  return {"--" + key + (value == "true" ? "" : "=false")};
}

std::vector<std::string> preset_words(const Preset& preset) {
  std::vector<std::string> words;
  if (!preset.name.empty()) words = {"--preset", preset.name};
  if (preset.mixed) words.emplace_back("--mixed");
  return words;
}

Adapter make(const std::string& name, const std::string& description, const Preset& preset) {
  Adapter adapter;
  adapter.name = name;
  adapter.description = description;
  adapter.licence = "Apache-2.0";
  adapter.multithreaded = true;
  adapter.openmp = true;
  adapter.parameters =
      ParameterSource([preset](const fs::path& bin_dir) { return described_by_program(preset, bin_dir); });
  adapter.size_dial = [preset, source = adapter.parameters](const fs::path& bin_dir) {
    return dial_of(preset, source.in(bin_dir));
  };
  adapter.availability = [](const fs::path& bin_dir) {
    return executable_availability(bin_dir, "cbc3d",
                                   "the program cbc3d is not built: build the target cbc3d");
  };
  adapter.command = [name, preset, source = adapter.parameters](const fs::path& bin_dir, const MeshJob& job) {
    const ParameterSpecs& specs = source.in(bin_dir);
    if (is_built(bin_dir)) require_known_parameters(name, specs, job.parameters);
    std::vector<std::string> argv{(bin_dir / "cbc3d").string(),
                                  "mesh",
                                  job.image.string(),
                                  "--out",
                                  job.mesh.string(),
                                  "--report",
                                  job.report.string(),
                                  "--threads",
                                  std::to_string(job.threads),
                                  "--quiet",
                                  "--long-work"};
    const auto append = [&](const std::vector<std::string>& words) {
      argv.insert(argv.end(), words.begin(), words.end());
    };
    append(preset_words(preset));
    for (const auto& [key, value] : job.parameters) append(words_of(name, specs, key, value));
    return argv;
  };
  return adapter;
}

}  // namespace

std::vector<Adapter> cbc3d_adapters() {
  return {make("cbc3d", "CBC3D with its default preset", {}),
          make("cbc3d-paper", "CBC3D with the paper's settings", {.name = "paper"}),
          make("cbc3d-mixed", "CBC3D with the paper's settings and mixed elements",
               {.name = "paper", .mixed = true})};
}

}  // namespace cbc3d::baselines
