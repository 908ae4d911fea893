#include "mesher/input/image_input.hpp"

#include <algorithm>

#include "mesher/core/error.hpp"
#include "mesher/input/label_table.hpp"
#include "mesher/input/table_beside.hpp"
#include "mesher/preprocess/grey_check.hpp"

namespace cbc3d {
namespace {

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
