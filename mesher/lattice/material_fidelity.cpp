#include "mesher/lattice/material_fidelity.hpp"

#include <algorithm>
#include <cstdio>
#include <map>

namespace cbc3d {

std::vector<MaterialFidelity> wanted_fidelity(const std::vector<Label>& labels,
                                              const std::vector<std::size_t>& voxels, double fidelity,
                                              const std::map<Label, double>& of_label) {
  std::vector<MaterialFidelity> wanted;
  for (std::size_t m = 0; m < labels.size(); ++m) {
    const auto own = of_label.find(labels[m]);
    wanted.push_back({.material = static_cast<MaterialId>(m),
                      .label = labels[m],
                      .wanted = own != of_label.end() ? own->second : fidelity,
                      .image_voxels = voxels[m]});
  }
  return wanted;
}

std::vector<std::string> warnings_of_unmet_fidelity(const std::vector<MaterialFidelity>& fidelity,
                                                    double finest_spacing_mm) {
  std::vector<std::string> warnings;
  std::map<Label, std::vector<MaterialFidelity>> of_label;
  for (const MaterialFidelity& f : fidelity) {
    of_label[f.label].push_back(f);
  }
  const auto worst_of = [](const MaterialFidelity& f) { return std::min(f.f1(), f.f2()); };
  for (const auto& [label, regions] : of_label) {
    const auto unmet =
        std::count_if(regions.begin(), regions.end(), [](const MaterialFidelity& f) { return !f.met(); });
    const MaterialFidelity& worst =
        *std::min_element(regions.begin(), regions.end(), [&](const auto& a, const auto& b) {
          return a.met() != b.met() ? b.met() : worst_of(a) < worst_of(b);
        });
    if (unmet == 0) {
      continue;
    }
    std::string where;
    if (regions.size() > 1) {
      where = " in " + std::to_string(unmet) + " of its " + std::to_string(regions.size()) + " regions";
    }
    char text[256];
    std::snprintf(text, sizeof(text),
                  "label %d: fidelity %.3f not met%s (%sF1 = %.4f, F2 = %.4f): the lattice may not be finer "
                  "than %.3g mm",
                  label, worst.wanted, where.c_str(), unmet > 1 ? "worst: " : "", worst.f1(), worst.f2(),
                  finest_spacing_mm);
    warnings.emplace_back(text);
  }
  return warnings;
}

std::string warning_of_uncovered(std::size_t voxels, double distance_mm, double finest_spacing_mm) {
  char text[256];
  std::snprintf(
      text, sizeof(text),
      "%zu boundary voxels lie farther than %.3g mm from the interface at the finest spacing %.3g mm", voxels,
      distance_mm, finest_spacing_mm);
  return text;
}

}  // namespace cbc3d
