#include "reports/interfaces/slicer/module_description.hpp"

#include <algorithm>

#include "mesher/input/image_input.hpp"
#include "mesher/mesh_formats/output_texts.hpp"
#include "mesher/pipeline/presets.hpp"

namespace cbc3d::slicer {
namespace {

/// A text as XML has it.
std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  }
  return out;
}

std::string element(const std::string& name, const std::string& text) {
  return "      <" + name + ">" + escaped(text) + "</" + name + ">\n";
}

/// "max-distance" as "Max distance".
std::string label_of(std::string name, const std::string& unit) {
  std::replace(name.begin(), name.end(), '-', ' ');
  name[0] = static_cast<char>(name[0] - 'a' + 'A');
  return name + (unit.empty() ? "" : " (" + unit + ")");
}

/// Names of parameters are identifiers.
std::string identifier_of(const std::string& option) {
  std::string name;
  for (const char c : option) {
    const bool begins = !name.empty() && name.back() == '-';
    if (begins) name.pop_back();
    name += begins ? static_cast<char>(c - 'a' + 'A') : c;
  }
  return name;
}

/// The defaults of all presets that have the option.
std::vector<std::string> defaults_of(const OptionRow& row) {
  const ImageFrame frame;
  std::vector<std::string> defaults;
  for (const std::string& preset : preset_names()) {
    const MeshImageOptions options = preset_options(preset, frame);
    if (has_option(options, row)) {
      defaults.push_back(default_text(row, options, frame.voxel_diagonal_mm()));
    }
  }
  return defaults;
}

bool has_one_default(const OptionRow& row) {
  const std::vector<std::string> defaults = defaults_of(row);
  const MeshImageOptions options = preset_options(preset_names().front(), ImageFrame());
  const bool same = std::all_of(defaults.begin(), defaults.end(),
                                [&](const std::string& text) { return text == defaults.front(); });
  return same && !is_unset(row, options) && !row.scales_with_voxels;
}

std::string description_of(const OptionRow& row) {
  std::string text = row.text;
  if (row.kind == OptionKind::number || row.kind == OptionKind::count) {
    text += "; " + range_text(row) + (row.unit.empty() ? "" : " " + row.unit);
  }
  if (row.kind == OptionKind::label_numbers) {
    text += "; " + row.symbol + " for each label, separated by commas";
  }
  if (widget_of(row) == Widget::text && row.kind != OptionKind::label_numbers) {
    text += "; empty:";
    for (const std::string& preset : preset_names()) {
      const MeshImageOptions options = preset_options(preset, ImageFrame());
      if (has_option(options, row)) {
        text += " " + default_text(row, options, ImageFrame().voxel_diagonal_mm()) + " (" + preset + ")";
      }
    }
  }
  return text;
}

/// Slicer's spin boxes need an upper end and a step.
std::string constraints_of(const OptionRow& row) {
  const double highest = std::min(row.range.highest, 1e9);  // what an integer of Slicer holds
  const double step = row.kind == OptionKind::count ? 1 : highest <= 1 ? 0.01 : 0.1;
  return "      <constraints>\n        <minimum>" + value_text(row.range.lowest) +
         "</minimum>\n        <maximum>" + value_text(highest) + "</maximum>\n        <step>" +
         value_text(step) + "</step>\n      </constraints>\n";
}

std::vector<std::string> choices_of(const OptionRow& row) {
  return row.kind == OptionKind::on_off ? std::vector<std::string>{"true", "false"} : row.choices;
}

std::string choices_of(const std::vector<std::string>& choices) {
  std::string text;
  for (const std::string& choice : choices) {
    text += element("element", choice);
  }
  return text;
}

std::string parameter(const std::string& type, const std::string& content) {
  return "    <" + type + ">\n" + content + "    </" + type + ">\n";
}

/// What every parameter begins with.
std::string head_of(const std::string& name, const std::string& description, const std::string& unit = {}) {
  return element("name", identifier_of(name)) + element("longflag", "--" + name) +
         element("description", description) + element("label", label_of(name, unit));
}

std::string parameter_of(const OptionRow& row) {
  const std::string head = head_of(row.name, description_of(row), row.unit);
  switch (widget_of(row)) {
    case Widget::boolean:
      return parameter("boolean", head + element("default", "false"));
    case Widget::integer:
      return parameter("integer", head + element("default", defaults_of(row).front()) + constraints_of(row));
    case Widget::real:
      return parameter("double", head + element("default", defaults_of(row).front()) + constraints_of(row));
    case Widget::enumeration:
      return parameter("string-enumeration", head + element("default", kPresetChoice) +
                                                 element("element", kPresetChoice) +
                                                 choices_of(choices_of(row)));
    case Widget::text:
      break;
  }
  return parameter("string", head + element("default", ""));
}

std::string files_group() {
  return "  <parameters>\n    <label>Files</label>\n    <description>A label map in, a mesh "
         "out</description>\n"
         "    <image type=\"label\">\n" +
         element("name", "labelMap") + element("label", "Label map") + element("channel", "input") +
         element("index", "0") +
         element("description", "The segmentation: every value but 0 is a label to be meshed") +
         "    </image>\n    <geometry type=\"model\" fileExtensions=\".vtk\">\n" + element("name", "mesh") +
         element("label", "Mesh") + element("channel", "output") + element("index", "1") +
         element("description",
                 "The mesh as an unstructured grid with the cell data \"label\", in physical LPS mm") +
         "    </geometry>\n  </parameters>\n";
}

/// What of the label map is meshed.
std::string input_group() {
  std::string text = "  <parameters>\n    <label>" + escaped(input_heading()) +
                     "</label>\n    <description>What of the label map is meshed</description>\n";
  ImageInput input;
  for (const InputOption* const option : module_input_options()) {
    const bool is_switch = std::holds_alternative<bool*>(option->field(input));
    text +=
        is_switch
            ? parameter("boolean", head_of(option->name, option->text) + element("default", "false"))
            : parameter("string", head_of(option->name, option->text + "; empty: " + option->default_text) +
                                      element("default", ""));
  }
  return text + "  </parameters>\n";
}

std::string first_group() {
  std::string text =
      "  <parameters>\n    <label>Mesh</label>\n    <description>What most users set</description>\n" +
      parameter("string-enumeration",
                element("name", "preset") + element("longflag", "--preset") +
                    element("description", "quality: our best; paper: the published method") +
                    element("label", "Preset") + element("default", preset_names().front()) +
                    choices_of(preset_names()));
  for (const std::string& name : first_options()) {
    text += parameter_of(find_option(name));
  }
  text += parameter("string-enumeration", head_of("order", kOrderText) + element("default", "1") +
                                              choices_of(std::vector<std::string>{"1", "2"}));
  text +=
      parameter("boolean", head_of("split-interfaces", kSplitInterfacesText) + element("default", "false"));
  return text +
         parameter("integer", element("name", "threads") + element("longflag", "--threads") +
                                  element("description", "0: all cores") + element("label", "Threads") +
                                  element("default", "0") +
                                  "      <constraints>\n        <minimum>0</minimum>\n        "
                                  "<maximum>1024</maximum>\n        <step>1</step>\n      </constraints>\n") +
         "  </parameters>\n";
}

constexpr OptionGroup kFolded[] = {OptionGroup::cleaning, OptionGroup::lattice, OptionGroup::improvement,
                                   OptionGroup::deformation};

std::string folded_group(OptionGroup folded) {
  std::string text = "  <parameters advanced=\"true\">\n    <label>" + escaped(heading(folded)) +
                     "</label>\n    <description>Options of this part of the method</description>\n";
  const auto& first = first_options();
  for (const OptionRow& row : option_table()) {
    if (row.group == folded && std::find(first.begin(), first.end(), row.name) == first.end()) {
      text += parameter_of(row);
    }
  }
  return text + "  </parameters>\n";
}

}  // namespace

Widget widget_of(const OptionRow& row) {
  switch (row.kind) {
    case OptionKind::on_off:  // a box without a tick says nothing, which must be what every preset has
      return has_one_default(row) && defaults_of(row).front() == "false" ? Widget::boolean
                                                                         : Widget::enumeration;
    case OptionKind::choice:
      return Widget::enumeration;
    case OptionKind::label_numbers:
      return Widget::text;
    default:
      break;
  }
  if (!has_one_default(row)) {
    return Widget::text;
  }
  return row.kind == OptionKind::count ? Widget::integer : Widget::real;
}

std::vector<const InputOption*> module_input_options() {
  return input_options_of(InputSource::volume, InputScope::image);
}

const std::vector<std::string>& first_options() {
  static const std::vector<std::string> kFirst = {"elements", "edge-length",  "max-distance",
                                                  "size",     "min-dihedral", "mixed"};
  return kFirst;
}

std::string module_description(const std::string& version) {
  std::string text =
      "<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<executable>\n"
      "  <category>Surface Models</category>\n  <title>CBC3D tetrahedral mesh</title>\n"
      "  <description>Meshes every label of a segmentation: one conforming volume mesh with smooth "
      "boundaries "
      "between the labels, for finite elements.</description>\n  <version>" +
      version +
      "</version>\n  <documentation-url></documentation-url>\n  <license>Apache-2.0</license>\n"
      "  <contributor>The CBC3D developers</contributor>\n  <acknowledgements>The method is that of "
      "Drakopoulos "
      "et al., Image-To-Mesh Conversion for Biomedical Simulations.</acknowledgements>\n" +
      files_group() + input_group() + first_group();
  for (const OptionGroup folded : kFolded) {
    text += folded_group(folded);
  }
  return text + "</executable>\n";
}

}  // namespace cbc3d::slicer
