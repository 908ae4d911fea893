#include "mesher/input/image_input.hpp"

#include <algorithm>

#include "mesher/command_line/number_range.hpp"
#include "mesher/core/error.hpp"
#include "mesher/input/label_table.hpp"
#include "mesher/input/table_beside.hpp"
#include "mesher/preprocess/grey_check.hpp"

namespace cbc3d {
namespace {

constexpr const char* kGroup = "Input image";

bool names_any(const LabelNames& table, const std::vector<Label>& labels) {
  return std::any_of(labels.begin() + 1, labels.end(),
                     [&](Label label) { return table.find(label) != nullptr; });
}

std::vector<Label> without_background(const LabelImage& image) {
  return {image.labels.begin() + 1, image.labels.end()};
}

/// Names from the table that was asked for, or from one beside the image.
void add_table(const std::string& path, const LabelImage& image, ImageInput& input) {
  const bool asked = !input.names_file.empty();
  const auto table = asked ? std::filesystem::path(input.names_file) : table_beside(path);
  if (!table) {
    return;
  }
  try {
    const LabelNames names = read_label_table(*table);
    if (!names_any(names, image.labels)) {
      input.warnings.push_back("'" + table->string() + "' names none of the labels of '" + path +
                               "', which are " + labels_text(without_background(image)));
    }
    if (asked) {
      input.names = names;
    } else {
      input.names.add_unknown(names);
    }
  } catch (const InputError& error) {
    if (asked) {
      throw;
    }
    input.warnings.push_back(std::string(error.what()) +
                             "; the labels have no names from this table, which lies beside the image");
  }
}

}  // namespace

void add_reading_options(CLI::App& command, ImageInput& input) {
  const auto add_flag = [&](const char* name, bool& value, const char* text) {
    command.add_flag(name, value, text)->group(kGroup);
  };
  const auto add_value = [&](const char* name, auto& value, const char* type, const char* text) {
    return command.add_option(name, value, text)->type_name(type)->group(kGroup);
  };
  add_flag("--accept-shear", input.read.accept_shear,
           "take the nearest orthogonal frame of an image whose axes are sheared by more than 1e-3");
  add_flag("--round", input.read.round_values,
           "take values within 1e-4 of an integer as that integer, of images of floats");
  add_value("--volume", input.read.volume, "N", "volume of a 4-D image, counted from 0 [a 3-D image]")
      ->check(whole_number_between(0, 1000000));
  add_value(
      "--layer", input.read.layer, "N",
      "layer of a segmentation whose segments overlap, counted from 0 [all layers; where segments overlap, "
      "the last one in the file has the voxel]")
      ->check(whole_number_between(0, 1000000));
  add_value("--background", input.choice.background, "V1,V2",
            "values that are background; without 0 among them, voxels of value 0 get the first one as their "
            "label [0]")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(label_value());
  add_value("--labels", input.choice.labels, "L1,L2",
            "labels that are taken; the rest becomes background [all]")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(label_value());
  add_flag("--keep-rest", input.choice.keep_rest,
           "with --labels: the other labels become one label, the largest plus one, instead of background");
  add_value(
      "--names", input.names_file, "FILE",
      "table of label names and colours: BIDS .tsv, ITK-SNAP, FreeSurfer, 3D Slicer .ctbl, .csv or .json "
      "[names in the image's file; a table beside it]");
}

void add_image_options(CLI::App& command, ImageInput& input) {
  add_reading_options(command, input);
  command
      .add_flag(
          "--many-labels", input.many_labels,
          "take an image that looks grey (more than 30 labels, and 5 % of the voxels without a neighbour of "
          "their label or half of the neighbours unlike) or like noise (half of the voxels without one, or a "
          "contact at an edge for every ten voxels)")
      ->group(kGroup);
}

LabelImage read_input_image(const std::string& path, ImageInput& input) {
  ImageNotes notes;
  LabelImage image = read_label_image(path, input.read, notes);
  input.names = std::move(notes.names);
  input.warnings.insert(input.warnings.end(), notes.warnings.begin(), notes.warnings.end());
  add_table(path, image, input);
  choose_labels(image, input.names, input.choice, "'" + path + "'", input.warnings);
  input.names = input.names.of(without_background(image));
  const std::string reason = input.many_labels ? "" : why_grey(image);
  if (!reason.empty()) {
    throw InputError("'" + path + "': " + reason +
                     "; segment it first (cbc3d segment), or many_labels takes it");
  }
  return image;
}

}  // namespace cbc3d
