#include "mesher/app/info_command.hpp"

#include <cstdio>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>

#include "mesher/app/flag_names.hpp"
#include "mesher/app/subcommand.hpp"
#include "mesher/core/json_text.hpp"
#include "mesher/core/read_image.hpp"
#include "mesher/input/image_input.hpp"
#include "mesher/input/input_options.hpp"
#include "mesher/input/names_json.hpp"
#include "mesher/preprocess/grey_check.hpp"

namespace cbc3d {
namespace {

struct InfoCommand {
  std::string image;
  bool json = false;
  ImageInput input;
  CommonOptions common;
};

nlohmann::json triple(const Vec3& v) {
  return {v.x, v.y, v.z};
}

nlohmann::json info_json(const InfoCommand& command, const LabelImage& image) {
  const ImageFrame& frame = image.frame;
  const auto voxels = image.voxels_per_material();
  const double voxel_mm3 = frame.spacing_mm.x * frame.spacing_mm.y * frame.spacing_mm.z;
  nlohmann::json labels = nlohmann::json::array();
  for (std::size_t m = 1; m < image.labels.size(); ++m) {
    labels.push_back({{"label", image.labels[m]},
                      {"voxels", voxels[m]},
                      {"volume_mm3", static_cast<double>(voxels[m]) * voxel_mm3}});
    const NamedLabel* const named = command.input.names.find(image.labels[m]);
    if (named != nullptr && named->colour) {
      labels.back()["colour"] = *named->colour;
    }
  }
  add_names(labels, command.input.names);
  return {{"format", format_of_image(command.image)},
          {"size", frame.size},
          {"spacing_mm", triple(frame.spacing_mm)},
          {"origin_mm", triple(frame.origin_mm)},
          {"axes",
           {triple(frame.direction.column(0)), triple(frame.direction.column(1)),
            triple(frame.direction.column(2))}},
          {"labels", labels},
          {"looks_grey", why_grey(image)},
          {"warnings", command.input.warnings}};
}

void print(const nlohmann::json& info) {
  std::cout << "format   " << info["format"].get<std::string>() << "\nsize     " << info["size"]
            << " voxels\nspacing  " << info["spacing_mm"] << " mm\norigin   " << info["origin_mm"]
            << " mm, LPS\naxes     " << info["axes"] << ", LPS\nlabels   " << info["labels"].size() << '\n';
  for (const auto& label : info["labels"]) {
    std::cout << "  " << label["label"]
              << (label.contains("name") ? " " + label["name"].get<std::string>() : "") << ": "
              << label["voxels"] << " voxels, " << label["volume_mm3"] << " mm3\n";
  }
  for (const auto& warning : info["warnings"]) {
    std::cout << "warning: " << with_flags(warning.get<std::string>()) << '\n';
  }
  if (const auto grey = info["looks_grey"].get<std::string>(); !grey.empty()) {
    std::cout << "warning: " << grey << '\n';
  }
}

void run(InfoCommand& command) {
  command.input.many_labels = true;
  const LabelImage image = read_input_image(command.image, command.input);
  const nlohmann::json info = info_json(command, image);
  if (command.json) {
    std::cout << json_text(info) << '\n';
  } else {
    print(info);
  }
}

}  // namespace

void add_info_command(CLI::App& app, int& exit_code) {
  auto command = std::make_shared<InfoCommand>();
  CLI::App* info =
      app.add_subcommand("info", "what is read of an image: format, size, frame in LPS mm, labels, warnings");
  info->add_option("image", command->image, kImageFormats)->required();
  info->add_flag("--json", command->json, "as JSON");
  add_input_options(*info, InputScope::image, command->input);
  complete_command(*info, command->common, exit_code, [command] { run(*command); });
}

}  // namespace cbc3d
