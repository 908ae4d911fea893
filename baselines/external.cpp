#include "baselines/external.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "mesher/core/error.hpp"
#include "mesher/core/json_text.hpp"
#include "mesher/core/plain_name.hpp"

namespace cbc3d::baselines {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using Texts = std::vector<std::string>;

/// The JSON file, with the checks that name file and key when they fail.
struct Description {
  const fs::path& file;
  json content;

  [[noreturn]] void fail(const std::string& key, const std::string& finding) const {
    throw InputError("'" + file.string() + "': \"" + key + "\" " + finding);
  }
  [[nodiscard]] std::string text(const json& object, const std::string& key,
                                 const std::string& remedy) const {
    const auto found = object.find(key);
    if (found == object.end()) fail(key, "is missing; give " + remedy);
    if (!found->is_string() || found->get<std::string>().empty())
      fail(key, "is " + found->dump() + "; give " + remedy);
    return found->get<std::string>();
  }
  [[nodiscard]] Texts texts(const std::string& key) const {
    const json& list = content.at(key);
    const bool good = list.is_array() && !list.empty() &&
                      std::all_of(list.begin(), list.end(), [](const json& t) { return t.is_string(); }) &&
                      !list.front().get<std::string>().empty();
    if (!good) fail(key, "is " + list.dump() + "; give a list of texts, the program first");
    return list.get<Texts>();
  }
  [[nodiscard]] bool flag(const std::string& key, bool fallback) const {
    const auto found = content.find(key);
    if (found == content.end()) return fallback;
    if (!found->is_boolean()) fail(key, "is " + found->dump() + "; give true or false");
    return found->get<bool>();
  }
  void require_known(const json& object, const std::set<std::string>& known) const {
    for (const auto& [key, value] : object.items()) {
      std::string names;
      for (const std::string& name : known) names += (names.empty() ? "" : ", ") + name;
      if (!known.contains(key)) fail(key, "is not a key here; there are " + names);
    }
  }
};

Description read_description(const fs::path& file) {
  std::ifstream stream(file);
  if (!stream)
    throw InputError("cannot read '" + file.string() + "'; give the JSON file of an external mesher");
  Description description{file, parse_json<json>(stream, "'" + file.string() + "'")};
  if (!description.content.is_object())
    throw InputError("'" + file.string() + "' is no JSON object; see baselines/external.hpp for its keys");
  return description;
}

/// Puts values for the names in braces. `value` may throw for a name that it does not know.
std::string expand(const std::string& text, const std::function<std::string(const std::string&)>& value) {
  std::string expanded;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t close = text.find('}', at);
    if (text[at] != '{') {
      expanded += text[at++];
    } else if (text.compare(at, 2, "{{") == 0) {
      expanded += '{';
      at += 2;
    } else if (close == std::string::npos) {
      expanded += value(text.substr(at + 1));
      at = text.size();
    } else {
      expanded += value(text.substr(at + 1, close - at - 1));
      at = close + 1;
    }
  }
  return expanded;
}

ParameterSpecs read_parameters(const Description& description) {
  ParameterSpecs specs;
  if (!description.content.contains("parameters")) return specs;
  const json& list = description.content["parameters"];
  if (!list.is_array()) description.fail("parameters", "is " + list.dump() + "; give a list of objects");
  for (const json& entry : list) {
    if (!entry.is_object()) description.fail("parameters", "holds " + entry.dump() + "; give objects");
    description.require_known(entry, {"key", "default", "unit", "description"});
    specs.push_back({description.text(entry, "key", "the parameter's name"),
                     description.text(entry, "default", "its default as a text"),
                     entry.contains("unit") ? description.text(entry, "unit", "a unit as a text") : "",
                     description.text(entry, "description", "one line")});
  }
  return specs;
}

/// The size dial of `content`, whose parameter must be among `specs`.
SizeDial read_size_dial(const Description& description, const ParameterSpecs& specs) {
  const json& entry = description.content["size_dial"];
  if (!entry.is_object()) description.fail("size_dial", "is " + entry.dump() + "; give an object");
  description.require_known(entry, {"parameter", "exponent", "first", "lowest", "highest"});
  SizeDial dial;
  dial.parameter = description.text(entry, "parameter", "the key of a parameter");
  const auto is_named = [&](const ParameterSpec& spec) { return spec.key == dial.parameter; };
  if (std::none_of(specs.begin(), specs.end(), is_named)) {
    description.fail("size_dial",
                     "names \"" + dial.parameter + "\", which is no parameter; add it to \"parameters\"");
  }
  for (const auto& [key, field] : {std::pair("exponent", &dial.exponent), std::pair("first", &dial.first),
                                   std::pair("lowest", &dial.lowest), std::pair("highest", &dial.highest)}) {
    if (!entry.contains(key)) continue;
    if (!entry[key].is_number()) description.fail(key, "is " + entry[key].dump() + "; give a number");
    *field = entry[key].get<double>();
  }
  const bool in_order = dial.lowest > 0 && dial.lowest <= dial.first && dial.first <= dial.highest;
  if (!in_order || dial.exponent == 0) {
    description.fail("size_dial", "is " + entry.dump() +
                                      "; give 0 < lowest <= first <= highest, and an exponent other than 0");
  }
  return dial;
}

/// Every name in the command's braces must be known, and the command must use the image, the mesh and every
/// parameter.
void check_placeholders(const Description& description, const Texts& command, const ParameterSpecs& specs) {
  std::set<std::string> known{"image", "mesh", "report", "threads"};
  for (const ParameterSpec& spec : specs) {
    if (!known.insert(spec.key).second) description.fail("parameters", "has \"" + spec.key + "\" twice");
  }
  std::set<std::string> used;
  for (const std::string& argument : command) {
    expand(argument, [&](const std::string& name) {
      if (!known.contains(name)) {
        description.fail("command", "names {" + name +
                                        "}, which is no parameter; add it to \"parameters\" or " +
                                        "write {{ for a brace");
      }
      used.insert(name);
      return std::string();
    });
  }
  for (const std::string& name : known) {
    if (!used.contains(name) && name != "report" && name != "threads")
      description.fail("command", "lacks {" + name + "}; put it where the program expects it");
  }
}

std::string resolve_program(const std::string& program, const fs::path& folder) {
  const bool relative = program.find('/') != std::string::npos && program.front() != '/';
  return relative ? (folder / program).lexically_normal().string() : program;
}

Availability availability_of(const std::string& program, const fs::path& file) {
  const fs::path found = find_program(program);
  if (found.empty()) {
    return {false, "'" + program + "' of '" + file.filename().string() + "' is " +
                       (program.find('/') == std::string::npos ? "nowhere in PATH" : "no file") +
                       "; install it or correct \"command\""};
  }
  if (::access(found.c_str(), X_OK) != 0)
    return {false, "'" + found.string() + "' may not be executed; chmod +x it"};
  return {true, ""};
}

/// An argument list as a command of the shell, which takes each as it is.
std::string shell_command(const Texts& arguments) {
  std::string command;
  for (const std::string& argument : arguments) {
    command += command.empty() ? "'" : " '";
    for (const char c : argument) command += c == '\'' ? std::string("'\\''") : std::string(1, c);
    command += "'";
  }
  return command;
}

/// The first line, at most so long, of what `stream` still has, without control characters. All of it is
/// read, for a program whose output nobody takes would end with a signal.
std::string first_line(std::FILE* stream) {
  constexpr std::size_t kLongest = 300;
  std::string text;
  std::array<char, 4096> buffer{};
  while (const std::size_t size = std::fread(buffer.data(), 1, buffer.size(), stream))
    text.append(buffer.data(), std::min(size, kLongest));
  text = text.substr(0, std::min(text.find('\n'), kLongest));
  std::erase_if(text, [](unsigned char c) { return c < 0x20 || c == 0x7f; });
  return text;
}

/// What the probe says: success is available, else its first line is the reason.
Availability ask_probe(const Texts& probe, const fs::path& file) {
  const std::string name = "the probe '" + probe[0] + "' of '" + file.filename().string() + "'";
  std::FILE* pipe = ::popen((shell_command(probe) + " 2>&1 </dev/null").c_str(), "r");
  if (pipe == nullptr) return {false, name + " cannot be started; correct \"probe\""};
  const std::string reason = first_line(pipe);
  if (::pclose(pipe) == 0) return {true, ""};
  return {false, reason.empty() ? name + " failed and gave no reason; run it" : reason};
}

/// The answer of a probe does not change during a run, and is asked for when it is first needed.
std::function<Availability()> remembered_probe(const Texts& probe, const fs::path& file) {
  if (probe.empty()) return [] { return Availability{true, ""}; };
  return [probe, file, known = std::make_shared<std::optional<Availability>>()] {
    if (!*known) *known = ask_probe(probe, file);
    return known->value();
  };
}

Texts command_of(const Texts& command, const ParameterSpecs& specs, const MeshJob& job) {
  std::map<std::string, std::string> values{{"image", job.image.string()},
                                            {"mesh", job.mesh.string()},
                                            {"report", job.report.string()},
                                            {"threads", std::to_string(job.threads)}};
  for (const ParameterSpec& spec : specs) values[spec.key] = spec.default_value;
  for (const auto& [key, value] : job.parameters) values[key] = value;
  Texts argv;
  for (const std::string& argument : command)
    argv.push_back(expand(argument, [&](const std::string& name) { return values.at(name); }));
  return argv;
}

std::string checked_name(const Description& description) {
  std::string name = description.text(description.content, "name", "a name of letters, digits and hyphens");
  if (!is_plain_name(name)) description.fail("name", "is " + json(name).dump() + "; give " + kPlainName);
  return "external:" + name;
}

std::string checked_extension(const Description& description) {
  const std::string format = description.text(description.content, "output", "vtu, vtk or msh");
  if (format != "vtu" && format != "vtk" && format != "msh")
    description.fail("output", "is \"" + format + "\"; give vtu, vtk or msh");
  return "." + format;
}

/// The format in which the mesher takes images; empty: in that of the case.
std::string checked_image_extension(const Description& description) {
  if (!description.content.contains("image")) return "";
  const std::string format = description.text(description.content, "image", "nii, nii.gz, nrrd or mha");
  if (format != "nii" && format != "nii.gz" && format != "nrrd" && format != "mha")
    description.fail("image", "is \"" + format + "\"; give nii, nii.gz, nrrd or mha");
  return "." + format;
}

/// A command under `key`, its program found; empty where there is none.
Texts optional_command(const Description& description, const std::string& key, const fs::path& folder) {
  if (!description.content.contains(key)) return {};
  Texts command = description.texts(key);
  command[0] = resolve_program(command[0], folder);
  return command;
}

}  // namespace

Adapter load_external_mesher(const fs::path& file) {
  const Description description = read_description(file);
  description.require_known(description.content, {"name", "description", "licence", "command", "image",
                                                  "output", "probe", "version_command", "multithreaded",
                                                  "openmp", "deterministic", "parameters", "size_dial"});
  Adapter adapter;
  adapter.name = checked_name(description);
  adapter.description = description.text(description.content, "description", "one line");
  adapter.licence = description.text(description.content, "licence", "an SPDX expression, \"MIT\" for one");
  adapter.mesh_extension = checked_extension(description);
  adapter.image_extension = checked_image_extension(description);
  adapter.multithreaded = description.flag("multithreaded", false);
  adapter.openmp = description.flag("openmp", false);
  adapter.deterministic = description.flag("deterministic", true);
  const ParameterSpecs specs = read_parameters(description);
  adapter.parameters = ParameterSource(specs);
  if (description.content.contains("size_dial"))
    adapter.size_dial = [dial = read_size_dial(description, specs)](const fs::path&) { return dial; };
  if (!description.content.contains("command"))
    description.fail("command", "is missing; give a list of texts, the program first");
  Texts command = description.texts("command");
  check_placeholders(description, command, specs);
  const fs::path folder = fs::absolute(file).parent_path();
  command[0] = resolve_program(command[0], folder);
  adapter.version_command = optional_command(description, "version_command", folder);
  const Texts probe = optional_command(description, "probe", folder);
  adapter.availability = [program = command[0], file, ask = remembered_probe(probe, file)](const fs::path&) {
    const Availability found = availability_of(program, file);
    return found.available ? ask() : found;
  };
  adapter.command = [command, name = adapter.name, specs](const fs::path&, const MeshJob& job) {
    require_known_parameters(name, specs, job.parameters);
    return command_of(command, specs, job);
  };
  return adapter;
}

}  // namespace cbc3d::baselines
