// The domain: what an image, or a given surface, asks of a mesh. Refinement, improvement and checks share one
// object of it. It is to this mesher what the concept MeshDomain_3 is to CGAL's Mesh_3, for a method that
// starts from a lattice: it answers where boundaries are and what they bound, and it never changes.
//
// Notation: material  a number that stands for a label, or for one face-connected region of it; 0 is
// background, and
//                     so is everything outside;
//           boundary  of materials a and b: the surface between them, smooth where an image has steps;
//           sample    a place on a boundary, with the two materials that meet there: of an image the centre
//           of a
//                     boundary voxel. A vertex of the mesh covers a sample when tets of both materials meet
//                     at it and it lies within the reach of the sample (boundary_samples.hpp);
//           scale     the length that tolerances are multiples of (tolerances.hpp): of an image its voxel
//           diagonal.
//
// Places and lengths are in local mm. There are three implementations: a label image (image_domain.hpp),
// functions of signed distance, one for each label (distance_domain.hpp), and the surfaces of a given mesh
// (mesh_domain.hpp).
#pragma once

#include <cmath>
#include <mutex>
#include <optional>
#include <vector>

#include "mesher/core/label_image.hpp"
#include "mesher/core/mesh.hpp"
#include "mesher/domain/boundary_samples.hpp"

namespace cbc3d {

/// How a place lies to the boundary of materials a and b.
struct BoundaryDistance {
  double distance_mm = 0;   ///< signed estimate, positive on the side of a
  Vec3 normal = {};         ///< unit, towards a; zero where nothing is known
  double deviation_mm = 0;  ///< unsigned, for guards; infinite where no such boundary is near
  bool is_close = false;    ///< the boundary passes so close that the estimate follows its shape

  /// The same for a boundary that is moved by `shift_mm` away from a. Only a close one follows; what is
  /// farther away keeps its direction, which is all that is asked of it.
  [[nodiscard]] BoundaryDistance shifted(double shift_mm) const {
    if (!is_close || shift_mm == 0) {
      return *this;
    }
    return {distance_mm + shift_mm, normal, std::fabs(distance_mm + shift_mm), true};
  }
};

/// All functions are thread-safe.
class Domain {
 public:
  Domain() = default;
  Domain(const Domain&) = delete;
  Domain& operator=(const Domain&) = delete;
  virtual ~Domain() = default;

  // ---- Materials and volumes

  /// The label's value for every material; [0] is background.
  [[nodiscard]] virtual const std::vector<Label>& labels() const = 0;
  /// The first material of each one's label. A label has several materials where its regions were told apart.
  [[nodiscard]] virtual const std::vector<MaterialId>& label_of() const = 0;
  /// The volume of every material; 0 for background.
  [[nodiscard]] virtual const std::vector<double>& volumes_mm3() const = 0;

  // ---- Lengths

  /// The unit of the tolerances.
  [[nodiscard]] virtual double scale_mm() const = 0;
  /// The volume of the smallest thing that the domain resolves: of an image its voxel.
  [[nodiscard]] virtual double cell_mm3() const = 0;
  /// The reach that samples in thin parts need, infinite where the domain knows no thin parts.
  [[nodiscard]] virtual double thin_reach_mm() const = 0;

  // ---- Boundaries between two materials

  /// How x lies to the boundary of a and b near it. This is the one call that is asked millions of times.
  [[nodiscard]] virtual BoundaryDistance boundary_distance(const Vec3& x, MaterialId a,
                                                           MaterialId b) const = 0;
  /// The samples to be covered, in an order that depends on the domain alone. They are found when first asked
  /// for.
  [[nodiscard]] const std::vector<BoundarySample>& samples() const {
    std::call_once(samples_once_, [this] { samples_ = find_samples(); });
    return samples_;
  }
  /// True when a sample lies in a part that wears away easily: its vertices must be within thin_reach_mm.
  [[nodiscard]] virtual bool is_thin(const BoundarySample& sample) const = 0;
  /// The vertices that cover the samples within the reach, kNoVertex for none, where the domain was made of
  /// the very mesh that is improved. Empty where it was not: the vertices have to be searched for.
  [[nodiscard]] virtual std::vector<VertexId> covering_vertices(double reach_mm) const;

  // ---- Places and labels

  /// The material that a place has.
  [[nodiscard]] virtual MaterialId material_at(const Vec3& x) const = 0;
  /// The place nearest to x on the boundary of a material's label (for background: of all labels together),
  /// if one is within tolerances::kNearestSearch.
  [[nodiscard]] virtual std::optional<Vec3> nearest_boundary(const Vec3& x, MaterialId material) const = 0;
  /// True when that place is within tolerances::kFarLimit; cheaper than the search for the nearest.
  [[nodiscard]] virtual bool is_near_boundary(const Vec3& x, MaterialId material) const = 0;

 protected:
  [[nodiscard]] virtual std::vector<BoundarySample> find_samples() const = 0;

 private:
  mutable std::once_flag samples_once_;
  mutable std::vector<BoundarySample> samples_;
};

inline std::vector<VertexId> Domain::covering_vertices(double /*reach_mm*/) const {
  return {};
}

}  // namespace cbc3d
