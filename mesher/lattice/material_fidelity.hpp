// The paper's fidelity (section "Adaptive Lattice Refinement") of each material, and words for where it is
// not met.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "mesher/core/label_image.hpp"

namespace cbc3d {

/// How well the sub-mesh of one material matches its voxels. S1: voxels in the sub-mesh, S2: voxels of the
/// material.
struct MaterialFidelity {
  MaterialId material = 0;
  Label label = 0;
  double wanted = 0;              ///< F
  std::size_t mesh_voxels = 0;    ///< |S1|
  std::size_t image_voxels = 0;   ///< |S2|
  std::size_t common_voxels = 0;  ///< |S1 n S2|

  [[nodiscard]] double f1() const { return mesh_voxels == 0 ? 0 : ratio(mesh_voxels); }
  [[nodiscard]] double f2() const { return image_voxels == 0 ? 1 : ratio(image_voxels); }
  [[nodiscard]] bool met() const { return wanted <= f1() && wanted <= f2(); }

 private:
  [[nodiscard]] double ratio(std::size_t of) const {
    return static_cast<double>(common_voxels) / static_cast<double>(of);
  }
};

/// What is wanted of each material, background first: `fidelity`, or the label's own in `of_label`.
std::vector<MaterialFidelity> wanted_fidelity(const std::vector<Label>& labels,
                                              const std::vector<std::size_t>& voxels, double fidelity,
                                              const std::map<Label, double>& of_label);

/// One line for each label that has a material (a region of it) whose fidelity is not met: the worst one's,
/// and that the lattice may not be finer than `finest_spacing_mm`.
std::vector<std::string> warnings_of_unmet_fidelity(const std::vector<MaterialFidelity>& fidelity,
                                                    double finest_spacing_mm);

/// That so many boundary voxels are farther than a distance from their interface, and how fine the lattice
/// is.
std::string warning_of_uncovered(std::size_t voxels, double distance_mm, double finest_spacing_mm);

}  // namespace cbc3d
