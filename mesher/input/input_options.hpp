// The choices about the image that a command reads, one row each. From this table are made the flags of every
// command that reads an image, what its report says of them, `cbc3d mesh --describe-options` and the flags in
// messages. A row holds no default: a default is what the field of an ImageInput holds.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "mesher/core/label_image.hpp"

namespace cbc3d {

struct ImageInput;

/// Which commands have a choice: each scope has those of the scopes before it.
enum class InputScope {
  reading,  ///< whatever reads a label image
  image,    ///< and asks it to look like a segmentation
  meshing,  ///< and meshes it from nothing
};

/// What the image may be: each has the choices of those before it.
enum class InputSource {
  volume,  ///< an image of three axes in memory, or a label map of another program
  array,   ///< any array in memory
  file,    ///< a file with what it states
};

/// Where the value of a choice lies. An empty text, list or number is a choice not made.
using InputField = std::variant<bool*, std::optional<int>*, std::string*, std::vector<Label>*>;

struct InputOption {
  std::string name;       ///< on the command line two hyphens precede it; in the report _ stands for -
  std::string parameter;  ///< as the library's messages name it, where they do
  InputScope scope = InputScope::reading;
  InputSource source = InputSource::file;
  std::string symbol;        ///< stands for the value in a help text: "N", "L1,L2"; empty for a switch
  std::string text;          ///< what it does, one line
  std::string default_text;  ///< what holds where the choice is not made; empty for a switch
  std::function<InputField(ImageInput&)> field;
};

/// All choices, in the order in which a help text shows them.
const std::vector<InputOption>& input_options();

/// The choices that a source has of those of a scope.
std::vector<const InputOption*> input_options_of(InputSource source, InputScope scope);

/// Makes a choice by a text, as on the command line: "2,5" for labels; "true" and "false" for switches.
/// Throws InputError.
void set_input_option(const InputOption& option, const std::string& value, ImageInput& input);

/// What users see over these options: "Input image".
std::string input_heading();

/// Adds the flags of a scope; `input` must outlive the command.
void add_input_options(CLI::App& command, InputScope scope, ImageInput& input);

}  // namespace cbc3d
