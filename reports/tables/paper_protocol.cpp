#include "reports/tables/paper_protocol.hpp"

namespace cbc3d::reports {

const std::vector<PaperImage>& paper_images() {
  static const std::vector<PaperImage> images{
      {"case 1", "isotropic", "aneurysm", "1.00 x 1.00 x 1.00", "512 x 512 x 508"},
      {"case 2", "anisotropic", "brain, tumor", "0.48 x 0.48 x 1.00", "384 x 512 x 176"},
      {"case 3", "anisotropic", "brain, AVM", "0.70 x 0.70 x 1.60", "320 x 320 x 100"},
      {"case 4", "anisotropic", "lumen, LVIS stent", "0.012 x 0.012 x 0.024", "1001 x 1001 x 4182"}};
  return images;
}

const std::vector<PaperParameter>& paper_parameters() {
  static const std::vector<PaperParameter> parameters{
      {"cbc3d", "lattice-spacing", "10 (cases 1-3), 0.15 (case 4)", "lattice spacing, mm"},
      {"cbc3d", "fidelity", "0.95", "fidelity"},
      {"cbc3d", "connectivity", "no", "pattern for target point extraction"},
      {"cbc3d", "iterations", "5 (cases 1-3), 7 (case 4)", "number of smoothing iterations"},
      {"cgal", "facet-angle", "30", "lower angle bound for surface facets, deg"},
      {"cgal", "facet-size", "2", "radii upper-bound for Delaunay balls, mm"},
      {"cgal", "facet-distance", "2", "face distance upper bound, mm"},
      {"cgal", "cell-radius-edge-ratio", "1.5", "radius-edge ratio upper bound"},
      {"cgal", "cell-size", "2.5 (cases 1-2), 1.5 (case 3), 0.2 (case 4)", "circumradii upper-bound, mm"},
      {"cleaver", "alpha-short", "0.357", "diagonal edge threshold for edge-cuts"},
      {"cleaver", "alpha-long", "0.203", "axis-aligned threshold for edge-cuts"},
      {"ld", "i2m", "0", "image-to-mesh distance"},
      {"ld", "m2i", "0", "mesh-to-image distance"},
      {"ld", "angle", "15", "minimum dihedral angle, deg"},
      {"podm", "delta", "1.2 (cases 1-2), 0.6 (case 3), 0.02 (case 4)", "element size, mm"}};
  return parameters;
}

const std::vector<PaperPattern>& paper_patterns() {
  static const std::vector<PaperPattern> patterns{{"vertex", 2770, 0.97, 21.01},
                                                  {"edge", 3498, 0.91, 22.57},
                                                  {"face", 6213, 0.88, 26.19},
                                                  {"no", 11755, 0.84, 35.27}};
  return patterns;
}

}  // namespace cbc3d::reports
