// What the paper's own tables say of its experiment: Drakopoulos et al., Image-To-Mesh Conversion for
// Biomedical Simulations, tables on imaging data, input parameters and the deformation's connectivity
// patterns.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace cbc3d::reports {

struct PaperImage {
  const char *name, *type, *materials, *spacing_mm, *size;
};
const std::vector<PaperImage>& paper_images();

struct PaperParameter {
  const char *method, *parameter, *value, *description;
};
/// Methods and parameters by this project's names where it has them.
const std::vector<PaperParameter>& paper_parameters();

struct PaperPattern {
  const char* pattern;
  double target_points, hausdorff_mm, seconds;
};
/// Ten iterations of the deformation of a nidus.
const std::vector<PaperPattern>& paper_patterns();
/// The Hausdorff distance of that nidus before the deformation, mm.
inline constexpr double kPaperHausdorffBeforeMm = 1.79;

}  // namespace cbc3d::reports
