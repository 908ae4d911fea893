#include "mesher/app/segment_command.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <memory>

#include "mesher/app/subcommand.hpp"
#include "mesher/command_line/number_range.hpp"
#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"
#include "mesher/core/image_io.hpp"
#include "mesher/core/one_line.hpp"
#include "mesher/core/terminal_progress.hpp"
#include "mesher/segment/segment_image.hpp"

namespace cbc3d {
namespace {

struct SegmentCommand {
  std::string image, out, merge, stop = "first";
  std::vector<std::string> seeds, targets;
  SegmentOptions options;
  Label label = 1;
  bool overwrite = false;
  CommonOptions common;
};

Vec3 position(const std::string& text, const char* option) {
  std::array<double, 3> p{};
  const char* next = text.c_str();
  constexpr double kFarthest = 1e9;  // mm, beyond every image
  bool is_good = true;
  for (std::size_t axis = 0; axis < 3 && is_good; ++axis) {
    char* end = nullptr;
    p[axis] = std::strtod(next, &end);
    is_good = end != next && *end == (axis < 2 ? ',' : '\0') && std::abs(p[axis]) <= kFarthest;
    next = end + 1;
  }
  if (!is_good) {
    throw InputError(std::string(option) + " '" + shortened(text) + "' is not X,Y,Z; give three numbers, mm");
  }
  return {p[0], p[1], p[2]};
}

std::vector<Vec3> positions(const std::vector<std::string>& texts, const char* option) {
  std::vector<Vec3> result;
  result.reserve(texts.size());
  for (const std::string& text : texts) {
    result.push_back(position(text, option));
  }
  return result;
}

void require_same_frame(const ImageFrame& frame, const ImageFrame& other, const std::string& file) {
  const double far = (frame.to_physical(frame.local_centre(frame.size[0], frame.size[1], frame.size[2])) -
                      other.to_physical(other.local_centre(frame.size[0], frame.size[1], frame.size[2])))
                         .norm();
  if (frame.size != other.size || far > 0.01 * frame.spacing_mm.min_coeff() ||
      (frame.origin_mm - other.origin_mm).norm() > 0.01 * frame.spacing_mm.min_coeff()) {
    throw InputError("--merge '" + file + "' lies on another grid than the image; give labels of the same");
  }
}

/// Puts the segmented voxels into `labels` as `label`, where it is background or, with `overwrite`, anywhere.
void merge_into(LabelImage& labels, const LabelImage& segmented, Label label, bool overwrite) {
  const auto known = std::find(labels.labels.begin(), labels.labels.end(), label);
  const auto material = static_cast<MaterialId>(known - labels.labels.begin());
  if (known == labels.labels.end()) {
    labels.labels.push_back(label);
  }
  for (std::size_t v = 0; v < labels.voxels.size(); ++v) {
    if (segmented.voxels[v] != kBackground && (overwrite || labels.voxels[v] == kBackground)) {
      labels.voxels[v] = material;
    }
  }
}

void run(SegmentCommand command) {
  require_writable(command.out);
  if (command.label == 0) {
    throw InputError("--label 0 is the background; give another number");
  }
  command.options.seeds_mm = positions(command.seeds, "--seeds");
  command.options.targets_mm = positions(command.targets, "--targets");
  command.options.stop = command.stop == "all" ? FrontStop::all_targets : FrontStop::first_target;
  TerminalProgress progress(command.common.quiet);
  SegmentReport report;
  LabelImage segmented = segment_image(command.image, command.options, progress, report);
  progress.step("writing " + command.out, 0.9);
  if (command.merge.empty()) {
    segmented.labels[1] = command.label;
    write_label_image(segmented, command.out);
  } else {
    LabelImage labels = read_label_image(command.merge);
    require_same_frame(segmented.frame, labels.frame, command.merge);
    merge_into(labels, segmented, command.label, command.overwrite);
    write_label_image(labels, command.out);
  }
  progress.done();
  progress.line("wrote " + command.out + ": label " + std::to_string(command.label) + " with " +
                std::to_string(report.voxels) + " voxels; wall gradient " +
                std::to_string(report.edge_gradient) + " a mm, grey value " +
                std::to_string(report.inside_level) + " inside, " + std::to_string(report.outside_level) +
                " around; " + std::to_string(report.iterations) + " iterations");
}

void add_tuning(CLI::App& segment, SegmentOptions& options) {
  segment
      .add_option("--sigma", options.sigma_mm,
                  "smoothing under gradients, mm [3/4 of the mean voxel spacing]")
      ->check(number_between(1e-6, 1e6));
  segment
      .add_option("--edge-gradient", options.edge_gradient,
                  "gradient at the wall, grey values a mm [measured around the seeds]")
      ->check(number_between(1e-30, 1e30));
  segment
      .add_option("--contrast", options.contrast,
                  "grey value inside less that outside [measured around the seeds]")
      ->check(number_between(-1e30, 1e30));
  segment.add_option("--propagation", options.propagation, "outward push of the level set [0.6]")
      ->check(number_between(-1e6, 1e6));
  segment.add_option("--curvature", options.curvature, "surface tension of the level set [0.1]")
      ->check(number_between(0, 1e6));
  segment.add_option("--iterations", options.iterations, "of the level set, at most [200]")
      ->check(whole_number_between(0, 1000000));
}

}  // namespace

void add_segment_command(CLI::App& app, int& exit_code) {
  auto command = std::make_shared<SegmentCommand>();
  CLI::App* segment = app.add_subcommand(
      "segment",
      "labels one structure of a grey image: fast marching from seeds to targets, then a level set");
  segment->add_option("image", command->image, "grey image: NIfTI, NRRD or MHA/MHD")->required();
  segment->add_option("--seeds", command->seeds, "X,Y,Z... within the structure, physical (LPS) mm")
      ->required();
  segment
      ->add_option("--targets", command->targets,
                   "X,Y,Z... where the front is to come, mm: far ends, or a point of the wall")
      ->required();
  segment->add_option("--stop", command->stop, "the front stops at the first or at all targets [first]")
      ->check(CLI::IsMember({"first", "all"}));
  segment->add_option("-o,--out", command->out, "label image: .nii, .nii.gz, .nrrd or .mha")->required();
  segment
      ->add_option("--volume", command->options.volume, "volume of a 4-D image, counted from 0 [a 3-D image]")
      ->check(whole_number_between(0, 1000000));
  segment->add_option("--label", command->label, "of the structure [1]")->check(label_value());
  segment->add_option("--merge", command->merge, "label image that the structure is put into");
  segment->add_flag("--overwrite", command->overwrite,
                    "with --merge: also where that image has a label [only its background]");
  add_tuning(*segment, command->options);
  complete_command(*segment, command->common, exit_code, [command] { run(*command); });
}

}  // namespace cbc3d
