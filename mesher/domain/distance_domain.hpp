// The domain of functions of signed distance, one for each label: shapes known exactly, without voxels.
//
// Notation: d_m  the signed distance of label m, mm, positive inside. The background's is minus the largest
// of all.
//
// The boundary of a and b is where d_a = d_b; with f = (d_a - d_b) / 2 a place's distance from it is f /
// |grad f| to first order, exact for planes. The functions need not be exact distances, but they must be
// continuous and fall outwards near their zero.
#pragma once

#include <array>
#include <functional>
#include <limits>
#include <vector>

#include "mesher/domain/domain.hpp"

namespace cbc3d {

class DistanceDomain : public Domain {
 public:
  struct Region {
    Label label = 0;                                          ///< not 0, each once
    std::function<double(const Vec3& local_mm)> distance_mm;  ///< positive inside; thread-safe
  };
  /// The cells in which samples and volumes are found, as an image's voxels: `size` cells along each axis,
  /// with centres at multiples of `spacing_mm`. All regions must lie within.
  struct Grid {
    Index3 size{};
    double spacing_mm = 1;
  };

  DistanceDomain(std::vector<Region> regions, const Grid& grid);

  [[nodiscard]] const std::vector<Label>& labels() const override { return labels_; }
  [[nodiscard]] const std::vector<MaterialId>& label_of() const override { return label_of_; }
  /// By the cells' centres.
  [[nodiscard]] const std::vector<double>& volumes_mm3() const override { return volumes_mm3_; }
  /// The diagonal of a cell.
  [[nodiscard]] double scale_mm() const override;
  [[nodiscard]] double cell_mm3() const override;
  [[nodiscard]] double thin_reach_mm() const override { return std::numeric_limits<double>::infinity(); }

  /// Infinite deviation beyond kNearestSearch, and where a third label lies at the nearest place.
  [[nodiscard]] BoundaryDistance boundary_distance(const Vec3& x, MaterialId a, MaterialId b) const override;
  [[nodiscard]] bool is_thin(const BoundarySample& /*sample*/) const override { return false; }

  /// The material with the largest distance, if it is positive; the lower one of two equal.
  [[nodiscard]] MaterialId material_at(const Vec3& x) const override;
  [[nodiscard]] std::optional<Vec3> nearest_boundary(const Vec3& x, MaterialId material) const override;
  [[nodiscard]] bool is_near_boundary(const Vec3& x, MaterialId material) const override;

 protected:
  /// The centres of cells with a face neighbour of another material.
  [[nodiscard]] std::vector<BoundarySample> find_samples() const override;

 private:
  using Field = std::function<double(const Vec3&)>;

  [[nodiscard]] double distance_of(MaterialId material, const Vec3& x) const;
  /// The distance from the zero of a field, with its normal.
  [[nodiscard]] BoundaryDistance to_zero(const Field& field, const Vec3& x) const;

  std::vector<Region> regions_;  // of material m at m - 1
  LabelImage cells_;             // the material of every cell
  std::vector<Label> labels_{0};
  std::vector<MaterialId> label_of_{0};
  std::vector<double> volumes_mm3_;
};

}  // namespace cbc3d
