// The parts, tunnels and cavities of every label, of an image and of a candidate mesh, from their surfaces.
//
// For a body whose surface is a manifold they follow from the surface alone: each closed surface that bounds
// a positive volume is that of a part, each that bounds a negative one that of a cavity, and Euler's number
// of the body, parts - tunnels + cavities, is half that of its surface. The voxels of a label have such a
// surface where the image is well-composed, the tets of one after the repair (check_topology.hpp).
#pragma once

#include <map>
#include <vector>

#include "mesher/core/label_image.hpp"
#include "mesher/lattice/candidate_mesh.hpp"

namespace cbc3d {

/// The Betti numbers of a body.
struct Betti {
  std::ptrdiff_t parts = 0;
  std::ptrdiff_t tunnels = 0;
  std::ptrdiff_t cavities = 0;

  bool operator==(const Betti&) const = default;
};

/// Of every label but background that has a voxel. Regions of one label must not touch.
std::map<Label, Betti> betti_of_labels(const LabelImage& image);

/// Of every label but background that has a tet. `points` of the mesh's nodes; `labels` of the materials.
std::map<Label, Betti> betti_of_labels(const CandidateMesh& mesh, const std::vector<Vec3>& points,
                                       const std::vector<Label>& labels);

/// A label whose topology in a mesh is not the image's.
struct LabelDifference {
  Label label = 0;
  Betti in_image;
  Betti in_mesh;
};

/// The labels whose numbers differ; one that is missing on a side has none of anything there.
std::vector<LabelDifference> label_differences(const std::map<Label, Betti>& in_image,
                                               const std::map<Label, Betti>& in_mesh);

/// Those labels.
std::vector<Label> labels_of(const std::vector<LabelDifference>& differences);

/// What each label and each material of an image has. A label whose regions are materials of their own can
/// have as many parts as in the image though one region is cut in two and another gone, so both are held.
class ImageBetti {
 public:
  explicit ImageBetti(const LabelImage& image);

  /// The labels of the candidate mesh that have other numbers, or a material that has, in ascending order.
  [[nodiscard]] std::vector<Label> unlike_labels(const CandidateMesh& mesh,
                                                 const std::vector<Vec3>& points) const;

 private:
  std::vector<Label> labels_;
  std::map<Label, Betti> of_labels_;
  bool has_regions_;                     // some label has several materials; without, of_labels_ says all
  std::map<Label, Betti> of_materials_;  // by the material's number
};

}  // namespace cbc3d
