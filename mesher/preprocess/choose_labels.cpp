#include "mesher/preprocess/choose_labels.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <type_traits>
#include <utility>

#include "mesher/core/error.hpp"

namespace cbc3d {
namespace {

bool contains(const std::vector<Label>& labels, Label label) {
  return std::find(labels.begin(), labels.end(), label) != labels.end();
}

std::vector<Label> foreground(const std::vector<Label>& of_material) {
  std::vector<Label> labels(of_material);
  std::sort(labels.begin(), labels.end());
  labels.erase(std::unique(labels.begin(), labels.end()), labels.end());
  std::erase(labels, 0);
  return labels;
}

void require_labels(const std::vector<Label>& wanted, const std::vector<Label>& there,
                    const std::string& option, const std::string& subject) {
  std::vector<Label> missing;
  std::copy_if(wanted.begin(), wanted.end(), std::back_inserter(missing),
               [&](Label label) { return !contains(there, label); });
  if (!missing.empty()) {
    throw InputError(subject + " has no label " + labels_text(missing) + ", which " + option +
                     " names; it has " + labels_text(there));
  }
}

/// The new label of every material.
class NewLabels {
 public:
  NewLabels(const LabelImage& image, LabelNames& names, std::string subject,
            std::vector<std::string>& warnings)
      : of_material_(image.labels), names_(names), subject_(std::move(subject)), warnings_(warnings) {}

  void set_background(const LabelImage& image, const std::vector<Label>& background) {
    std::vector<Label> others = background;
    std::erase(others, 0);
    require_labels(others, foreground(of_material_), "--background", subject_);
    for (Label& label : of_material_) {
      label = contains(background, label) ? 0 : label;
    }
    if (others.size() == background.size() && !background.empty() && image.voxels_per_material()[0] > 0) {
      of_material_[0] = background.front();
      const NamedLabel* const zero = names_.find(0);
      names_.set(
          {.label = background.front(), .name = zero == nullptr ? std::string() : zero->name, .colour = {}});
      warnings_.push_back(subject_ + ": its voxels of value 0 have the label " +
                          std::to_string(background.front()) +
                          ", for 0 stands for background; --background 0," +
                          std::to_string(background.front()) + " makes both background");
    }
  }

  void keep(const std::vector<Label>& chosen, bool keep_rest) {
    const std::vector<Label> there = foreground(of_material_);
    if (contains(chosen, 0)) {
      throw InputError(subject_ +
                       ": --labels names 0, which is the background; leave it out (--background "
                       "chooses another one)");
    }
    require_labels(chosen, there, "--labels", subject_);
    const Label rest = keep_rest ? label_of_rest(there, chosen) : 0;
    for (Label& label : of_material_) {
      label = label == 0 || contains(chosen, label) ? label : rest;
    }
  }

  /// Gives the image these labels, numbered anew.
  void apply(LabelImage& image) const {
    std::vector<Label> labels = foreground(of_material_);
    labels.insert(labels.begin(), 0);
    std::vector<MaterialId> material(of_material_.size());
    for (std::size_t m = 0; m < material.size(); ++m) {
      const auto place = of_material_[m] == 0
                             ? labels.begin()
                             : std::lower_bound(labels.begin() + 1, labels.end(), of_material_[m]);
      material[m] = static_cast<MaterialId>(place - labels.begin());
    }
    image.voxels.hold(labels.size());
    image.voxels.visit([&](auto* voxels) {
#pragma omp parallel for schedule(static)
      for (std::size_t v = 0; v < image.voxels.size(); ++v) {
        voxels[v] = static_cast<std::remove_reference_t<decltype(*voxels)>>(material[voxels[v]]);
      }
    });
    image.labels = std::move(labels);
  }

 private:
  Label label_of_rest(const std::vector<Label>& there, const std::vector<Label>& chosen) {
    if (there.size() == chosen.size()) {
      return 0;
    }
    if (there.back() == std::numeric_limits<Label>::max()) {
      throw InputError(subject_ +
                       ": --keep-rest finds no number above its largest label; renumber the labels");
    }
    const Label rest = std::max(there.back(), Label{0}) + 1;
    names_.set({.label = rest, .name = "rest", .colour = {}});
    warnings_.push_back(subject_ + ": its other labels are together label " + std::to_string(rest));
    return rest;
  }

  std::vector<Label> of_material_;
  LabelNames& names_;
  std::string subject_;
  std::vector<std::string>& warnings_;
};

}  // namespace

std::string labels_text(const std::vector<Label>& labels) {
  constexpr std::size_t kMost = 20;
  std::string text;
  for (std::size_t n = 0; n < std::min(kMost, labels.size()); ++n) {
    text += (n > 0 ? ", " : "") + std::to_string(labels[n]);
  }
  return labels.size() > kMost ? text + " and " + std::to_string(labels.size() - kMost) + " others" : text;
}

void choose_labels(LabelImage& image, LabelNames& names, const LabelChoice& choice,
                   const std::string& subject, std::vector<std::string>& warnings) {
  if (choice.labels.empty() && choice.keep_rest) {
    throw InputError("--keep-rest without --labels: name the labels that are not the rest");
  }
  if (choice.labels.empty() && choice.background.empty()) {
    return;
  }
  NewLabels labels(image, names, subject, warnings);
  labels.set_background(image, choice.background);
  if (!choice.labels.empty()) {
    labels.keep(choice.labels, choice.keep_rest);
  }
  labels.apply(image);
  if (image.labels.size() < 2) {
    throw InputError(subject + ": the choice of labels leaves nothing but background; choose others");
  }
}

}  // namespace cbc3d
