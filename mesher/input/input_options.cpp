#include "mesher/input/input_options.hpp"

#include "mesher/command_line/number_range.hpp"
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
       .symbol = "V1,V2",
       .text = "values that are background; without 0 among them, voxels of value 0 get the first one as "
               "their label",
       .default_text = "0",
       .field = [](ImageInput& i) { return &i.choice.background; }},
      {.name = "labels",
       .symbol = "L1,L2",
       .text = "labels that are taken; the rest becomes background",
       .default_text = "all",
       .field = [](ImageInput& i) { return &i.choice.labels; }},
      {.name = "keep-rest",
       .text =
           "with --labels: the other labels become one label, the largest plus one, instead of background",
       .field = [](ImageInput& i) { return &i.choice.keep_rest; }},
      {.name = "names",
       .symbol = "FILE",
       .text = "table of label names and colours: BIDS .tsv, ITK-SNAP, FreeSurfer, 3D Slicer .ctbl, .csv or "
               ".json",
       .default_text = "names in the image's file; a table beside it",
       .field = [](ImageInput& i) { return &i.names_file; }},
      {.name = "many-labels",
       .parameter = "many_labels",
       .scope = InputScope::image,
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

}  // namespace

const std::vector<InputOption>& input_options() {
  static const std::vector<InputOption> kTable = table();
  return kTable;
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
