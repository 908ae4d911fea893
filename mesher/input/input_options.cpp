#include "mesher/input/input_options.hpp"

#include <algorithm>
#include <charconv>

#include "mesher/command_line/number_range.hpp"
#include "mesher/core/error.hpp"
#include "mesher/input/image_input.hpp"

namespace cbc3d {
namespace {

std::vector<InputOption> table() {
  return {
      {.name = "accept-shear",
       .parameter = "accept_shear",
       .text = "take the nearest orthogonal frame of an image whose axes are sheared by more than 1e-3",
       .field = [](ImageInput& i) { return &i.read.accept_shear; }},
      {.name = "round",
       .parameter = "round_values",
       .text = "take values within 1e-4 of an integer as that integer, of images of floats",
       .field = [](ImageInput& i) { return &i.read.round_values; }},
      {.name = "volume",
       .parameter = "volume=N",
       .source = InputSource::array,
       .symbol = "N",
       .text = "volume of a 4-D image, counted from 0",
       .default_text = "a 3-D image",
       .field = [](ImageInput& i) { return &i.read.volume; }},
      {.name = "layer",
       .parameter = "layer=N",
       .symbol = "N",
       .text = "layer of a segmentation whose segments overlap, counted from 0",
       .default_text = "all layers; where segments overlap, the last one in the file has the voxel",
       .field = [](ImageInput& i) { return &i.read.layer; }},
      {.name = "background",
       .source = InputSource::volume,
       .symbol = "V1,V2",
       .text = "values that are background; without 0 among them, voxels of value 0 get the first one as "
               "their label",
       .default_text = "0",
       .field = [](ImageInput& i) { return &i.choice.background; }},
      {.name = "labels",
       .source = InputSource::volume,
       .symbol = "L1,L2",
       .text = "labels that are taken; the rest becomes background",
       .default_text = "all",
       .field = [](ImageInput& i) { return &i.choice.labels; }},
      {.name = "keep-rest",
       .source = InputSource::volume,
       .text =
           "with --labels: the other labels become one label, the largest plus one, instead of background",
       .field = [](ImageInput& i) { return &i.choice.keep_rest; }},
      {.name = "names",
       .source = InputSource::array,
       .symbol = "FILE",
       .text = "table of label names and colours: BIDS .tsv, ITK-SNAP, FreeSurfer, 3D Slicer .ctbl, .csv or "
               ".json",
       .default_text = "names in the image's file; a table beside it",
       .field = [](ImageInput& i) { return &i.names_file; }},
      {.name = "many-labels",
       .parameter = "many_labels",
       .scope = InputScope::image,
       .source = InputSource::volume,
       .text = "take an image that looks grey (more than 30 labels, and 5 % of the voxels without a "
               "neighbour of their label or half of the neighbours unlike) or like noise (half of the voxels "
               "without one, or a contact at an edge for every ten voxels)",
       .field = [](ImageInput& i) { return &i.many_labels; }},
      {.name = "long-work",
       .parameter = "long_work",
       .scope = InputScope::meshing,
       .text = "take a file of less than 16 KB whose boundaries look like minutes of work",
       .field = [](ImageInput& i) { return &i.long_work; }},
  };
}

/// Adds the flag of a field by its type.
struct Adder {
  CLI::App& command;
  const InputOption& option;

  [[nodiscard]] std::string flag() const { return "--" + option.name; }
  [[nodiscard]] std::string help() const { return option.text + " [" + option.default_text + "]"; }

  CLI::Option* operator()(bool* value) const { return command.add_flag(flag(), *value, option.text); }
  CLI::Option* operator()(std::optional<int>* value) const {
    constexpr int kMostVolumes = 1000000;
    return command.add_option(flag(), *value, help())->check(whole_number_between(0, kMostVolumes));
  }
  CLI::Option* operator()(std::string* value) const { return command.add_option(flag(), *value, help()); }
  CLI::Option* operator()(std::vector<Label>* value) const {
    return command.add_option(flag(), *value, help())
        ->delimiter(',')
        ->allow_extra_args(false)
        ->check(label_value());
  }
};

/// Takes a value as the command line does.
struct Setter {
  const InputOption& option;
  const std::string& text;

  void operator()(bool* value) const {
    if (text != "true" && text != "false") fail("true or false");
    *value = text == "true";
  }
  void operator()(std::string* value) const { *value = text; }
  void operator()(std::optional<int>* value) const {
    const auto numbers = whole_numbers();
    if (numbers.size() != 1 || numbers.front() < 0) fail("a whole number from 0 on");
    *value = numbers.front();
  }
  void operator()(std::vector<Label>* value) const { *value = whole_numbers(); }

 private:
  [[noreturn]] void fail(const std::string& remedy) const {
    throw InputError(option.name + " '" + text.substr(0, 40) + "': give " + remedy, option.name);
  }
  [[nodiscard]] std::vector<Label> whole_numbers() const {
    std::vector<Label> numbers;
    const char* at = text.data();
    for (const char* const end = at + text.size();;) {
      const auto [after, error] = std::from_chars(at, end, numbers.emplace_back());
      if (error != std::errc()) fail("whole numbers of 32 bits, separated by commas");
      at = std::find_if(after, end, [](char c) { return c != ' '; });
      if (at == end) return numbers;
      if (*at != ',') fail("whole numbers of 32 bits, separated by commas");
      at = std::find_if(at + 1, end, [](char c) { return c != ' '; });
    }
  }
};

}  // namespace

const std::vector<InputOption>& input_options() {
  static const std::vector<InputOption> kTable = table();
  return kTable;
}

std::vector<const InputOption*> input_options_of(InputSource source, InputScope scope) {
  std::vector<const InputOption*> chosen;
  for (const InputOption& option : input_options()) {
    if (option.source <= source && option.scope <= scope) chosen.push_back(&option);
  }
  return chosen;
}

void set_input_option(const InputOption& option, const std::string& value, ImageInput& input) {
  std::visit(Setter{option, value}, option.field(input));
}

std::string input_heading() {
  return "Input image";
}

void add_input_options(CLI::App& command, InputScope scope, ImageInput& input) {
  for (const InputOption& option : input_options()) {
    if (option.scope > scope) continue;
    CLI::Option* added = std::visit(Adder{command, option}, option.field(input));
    added->group(input_heading());
    if (!option.symbol.empty()) {
      added->type_name(option.symbol);
    }
  }
}

}  // namespace cbc3d
