#include "mesher/lattice/material_fidelity.hpp"

#include <algorithm>
#include <cstdio>
#include <map>

namespace cbc3d {

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
    std::snprintf(
        text, sizeof(text),
        "label %d: fidelity %.3f not met%s (%sF1 = %.4f, F2 = %.4f): the lattice may not be finer "
        "than %.3g mm",
        label, worst.wanted, where.c_str(), unmet > 1 ? "worst: " : "", worst.f1(), worst.f2(),
        finest_spacing_mm);
    warnings.emplace_back(text);
  }
  return warnings;
}

}  // namespace cbc3d
