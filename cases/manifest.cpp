#include "cases/manifest.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <initializer_list>
#include <set>
#include <string_view>

#include "cases/phantoms/registry.hpp"
#include "mesher/core/error.hpp"
#include "mesher/core/json_text.hpp"
#include "mesher/core/plain_name.hpp"

namespace cbc3d::cases {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::size_t kMostInstances = 1000;

// A JSON object with the words to complain about it.
struct Section {
  const json& object;
  const fs::path& file;
  std::string prefix;  // of its keys in messages, "image." for one

  [[noreturn]] void fail(std::string_view key, std::string_view finding) const {
    throw InputError("'" + file.string() + "': \"" + prefix + std::string(key) + "\" " +
                     std::string(finding) + "; see cases/README.md");
  }
  void require_known_keys(std::initializer_list<std::string_view> known) const {
    for (const auto& [key, value] : object.items()) {
      if (std::find(known.begin(), known.end(), key) == known.end()) {
        fail(key, "is not a key of a manifest");
      }
    }
  }
  [[nodiscard]] const json& at(std::string_view key) const {
    const auto found = object.find(key);
    if (found == object.end()) {
      fail(key, "is missing");
    }
    return *found;
  }
  [[nodiscard]] std::string text(std::string_view key) const {
    const json& value = at(key);
    if (!value.is_string() || value.get_ref<const std::string&>().empty()) {
      fail(key, "is " + value.dump() + ", not a text");
    }
    return value.get<std::string>();
  }
  [[nodiscard]] Section section(std::string_view key) const {
    const json& value = at(key);
    if (!value.is_object()) {
      fail(key, "is " + value.dump() + ", not an object");
    }
    return {value, file, prefix + std::string(key) + "."};
  }
};

template <class Number>
std::array<Number, 3> three_numbers(const Section& section, std::string_view key) {
  const json& value = section.at(key);
  std::array<Number, 3> result{};
  bool good = value.is_array() && value.size() == 3;
  for (std::size_t axis = 0; good && axis < 3; ++axis) {
    const json& number = value[axis];
    good = std::is_integral_v<Number> ? number.is_number_integer() : number.is_number();
    good = good && number.get<double>() > 0 && number.get<double>() < 1e6;
    result[axis] = good ? number.get<Number>() : Number{};
  }
  if (!good) {
    section.fail(key, "is " + value.dump() + ", not three positive numbers");
  }
  return result;
}

std::string read_sha256(const Section& section) {
  std::string digest = section.text("sha256");
  if (digest.size() != 64 || digest.find_first_not_of("0123456789abcdef") != std::string::npos) {
    section.fail("sha256", "is not 64 lower-case hexadecimal digits");
  }
  return digest;
}

Phantom read_phantom(const Section& section) {
  section.require_known_keys({"name", "size", "spacing_mm", "seed", "sha256"});
  Phantom phantom;
  phantom.name = section.text("name");
  if (find_phantom(phantom.name) == nullptr) {
    section.fail("name", "is \"" + phantom.name + "\", not one of " + phantom_names());
  }
  phantom.size = three_numbers<int>(section, "size");
  const auto spacing = three_numbers<double>(section, "spacing_mm");
  phantom.spacing_mm = {spacing[0], spacing[1], spacing[2]};
  const json& seed = section.at("seed");
  if (!seed.is_number_unsigned()) {
    section.fail("seed", "is " + seed.dump() + ", not a whole number from 0 on");
  }
  phantom.seed = seed.get<std::uint64_t>();
  if (section.object.contains("sha256")) {
    phantom.sha256 = read_sha256(section);
  }
  return phantom;
}

void read_image(const Section& image, Case& result) {
  if (image.object.contains("phantom")) {
    image.require_known_keys({"phantom"});
    result.phantom = read_phantom(image.section("phantom"));
    return;
  }
  image.require_known_keys({"file", "sha256", "source"});
  result.image_file = image.text("file");
  const fs::path path = fs::path(*result.image_file).lexically_normal();
  if (path.is_absolute() || *path.begin() == "..") {
    image.fail("file", "is " + json(path.string()).dump() + ", not a name within a data folder");
  }
  result.image_sha256 = read_sha256(image);
  result.image_source = image.text("source");
}

Derivation read_derivation(const Section& derive) {
  derive.require_known_keys({"fill_holes", "repeat"});
  Derivation result;
  if (derive.object.contains("fill_holes")) {
    const json& fill_holes = derive.at("fill_holes");
    if (!fill_holes.is_boolean()) {
      derive.fail("fill_holes", "is " + fill_holes.dump() + ", neither true nor false");
    }
    result.fill_holes = fill_holes.get<bool>();
  }
  if (derive.object.contains("repeat")) {
    result.repeat = three_numbers<int>(derive, "repeat");
  }
  return result;
}

MesherParameters read_parameters(const Section& parameters) {
  MesherParameters result;
  for (const auto& [mesher, unused] : parameters.object.items()) {
    const Section options = parameters.section(mesher);
    auto& into = result[mesher];
    for (const auto& [key, value] : options.object.items()) {
      if (!value.is_string() && !value.is_number()) {
        options.fail(key, "is " + value.dump() + ", neither a text nor a number");
      }
      into[key] = value.is_string() ? value.get<std::string>() : value.dump();
    }
  }
  return result;
}

DeformationPattern read_deformation_pattern(const Section& section) {
  section.require_known_keys({"pattern", "image", "before"});
  DeformationPattern result{section.text("pattern"), section.text("image"), section.text("before")};
  constexpr std::array<std::string_view, 4> kPatterns{"vertex", "edge", "face", "no"};
  if (std::find(kPatterns.begin(), kPatterns.end(), result.pattern) == kPatterns.end()) {
    section.fail("pattern", "is \"" + result.pattern + "\", not one of vertex, edge, face, no");
  }
  return result;
}

/// A text that stands in a row of a table.
std::string one_line(const Section& section, std::string_view key) {
  std::string text = section.text(key);
  if (std::any_of(text.begin(), text.end(), [](unsigned char c) { return c < ' '; })) {
    section.fail(key, "is " + json(text).dump() + ", not one line");
  }
  return text;
}

json parse_file(const fs::path& file) {
  std::ifstream in(file);
  if (!in) {
    throw InputError("cannot read '" + file.string() + "'; check its permissions");
  }
  const json parsed = parse_json<json>(in, "'" + file.string() + "'");
  if (!parsed.is_object()) {
    throw InputError("'" + file.string() + "' is not a JSON object; see cases/README.md");
  }
  return parsed;
}

/// A table row needs both its jobs, so a slip in the name of the case before is found at once.
void require_cases_before(const std::vector<Case>& cases, const std::vector<fs::path>& files,
                          const std::set<std::string>& names) {
  for (std::size_t n = 0; n < cases.size(); ++n) {
    const auto& pattern = cases[n].deformation_pattern;
    if (pattern && !names.contains(pattern->before)) {
      throw InputError("'" + files[n].string() + "': \"deformation_pattern.before\" is \"" + pattern->before +
                       "\", which no manifest has as its name; see " + "cases/README.md");
    }
  }
}

Case read_case(const Section& top) {
  const json& parsed = top.object;
  top.require_known_keys({"name", "title", "suites", "image", "derive", "parameters", "parameter_sets",
                          "deformation_pattern", "paper", "instances"});
  Case result;
  result.name = top.text("name");
  if (!is_plain_name(result.name)) {
    top.fail("name", "is " + json(result.name).dump() + "; give " + kPlainName);
  }
  result.title = one_line(top, "title");
  const json& suites = top.at("suites");
  if (!suites.is_array() || suites.empty() ||
      !std::all_of(suites.begin(), suites.end(), [](const json& suite) { return suite.is_string(); })) {
    top.fail("suites", "is " + suites.dump() + ", not a list of names");
  }
  result.suites = suites.get<std::vector<std::string>>();
  read_image(top.section("image"), result);
  if (parsed.contains("derive")) {
    result.derive = read_derivation(top.section("derive"));
  }
  if (parsed.contains("parameters")) {
    result.parameters = read_parameters(top.section("parameters"));
  }
  if (parsed.contains("parameter_sets")) {
    const Section sets = top.section("parameter_sets");
    for (const auto& [set, unused] : sets.object.items()) {
      result.parameter_sets[set] = read_parameters(sets.section(set));
    }
  }
  if (parsed.contains("deformation_pattern")) {
    result.deformation_pattern = read_deformation_pattern(top.section("deformation_pattern"));
  }
  if (parsed.contains("paper")) {
    result.paper = top.section("paper").object;
  }
  return result;
}

/// The cases of a manifest: itself, or as many instances of its phantom, each with the seed after the last
/// one's.
std::vector<Case> read_cases(const fs::path& file) {
  const json parsed = parse_file(file);
  const Section top{parsed, file, ""};
  const Case one = read_case(top);
  if (!parsed.contains("instances")) return {one};
  const json& instances = top.at("instances");
  const bool phantoms = one.phantom && one.phantom->sha256.empty();
  if (!phantoms || !instances.is_number_unsigned() || instances < 1 || instances > kMostInstances) {
    top.fail("instances", "is " + instances.dump() +
                              ", not a number of phantoms (without sha256) from 1 to " +
                              std::to_string(kMostInstances));
  }
  std::vector<Case> cases(instances.get<std::size_t>(), one);
  for (std::size_t n = 0; n < cases.size(); ++n) {
    const std::string number = std::to_string(n);
    Case& instance = cases[n];
    instance.name += "-" + std::string(number.size() < 3 ? 3 - number.size() : 0, '0') + number;
    instance.title += " (" + number + ")";
    if (instance.phantom) instance.phantom->seed += n;
  }
  return cases;
}

}  // namespace

std::vector<Case> load_cases(const fs::path& manifest_dir) {
  std::error_code error;
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(manifest_dir, error)) {
    if (entry.path().extension() == ".json") {
      files.push_back(entry.path());
    }
  }
  if (error || files.empty()) {
    throw InputError("'" + manifest_dir.string() + "' " +
                     (error ? "cannot be read: " + error.message() : "holds no case manifest (*.json)") +
                     "; name the folder of the case manifests");
  }
  std::sort(files.begin(), files.end());
  std::vector<Case> cases;
  std::set<std::string> names;
  std::vector<fs::path> file_of_case;
  for (const fs::path& file : files) {
    for (Case& read : read_cases(file)) {
      if (!names.insert(read.name).second) {
        throw InputError("'" + file.string() + "': \"name\" is \"" + read.name +
                         "\", which another manifest has too; choose another");
      }
      cases.push_back(std::move(read));
      file_of_case.push_back(file);
    }
  }
  require_cases_before(cases, file_of_case, names);
  return cases;
}

void use_parameter_set(Case& which, const std::string& set) {
  const auto found = which.parameter_sets.find(set);
  if (found == which.parameter_sets.end()) {
    std::string known;
    for (const auto& [name, unused] : which.parameter_sets) {
      known += (known.empty() ? "" : ", ") + name;
    }
    throw InputError("case '" + which.name + "' has no parameter set '" + set + "'; it has " +
                     (known.empty() ? "none" : known));
  }
  for (const auto& [mesher, options] : found->second) {
    for (const auto& [key, value] : options) {
      which.parameters[mesher][key] = value;
    }
  }
}

}  // namespace cbc3d::cases
