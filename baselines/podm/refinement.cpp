#include "baselines/podm/refinement.hpp"

#include "baselines/core/missing_labels.hpp"
#include "baselines/podm/crew.hpp"
#include "baselines/podm/refiner.hpp"

namespace cbc3d::baselines::podm {
namespace {

template <typename Concurrency>
class Refinement {
 public:
  using Worker = typename Refiner<Concurrency>::Worker;

  Refinement(const LabelImage& image, const SurfaceOracle& oracle, const RefinementOptions& options)
      : image_(image), refiner_(image, oracle, options), workers_(static_cast<std::size_t>(options.threads)) {
    for (std::size_t n = 0; n < workers_.size(); ++n) workers_[n].number = n + 1;
  }

  RefinementResult run() {
    refiner_.start(workers_.front());
    work();
    RefinementResult result;
    result.sampled = missing_materials(image_, refiner_.materials_present());
    if (!result.sampled.empty()) {
      refiner_.insert_samples(samples_of(result.sampled), workers_.front());
      work();
    }
    for (const Worker& worker : workers_) add(result.counts, worker.counts);
    result.complex = refiner_.exported();
    return result;
  }

 private:
  void work() { Crew<Concurrency>(refiner_, workers_).work(); }

  // The centres of voxels and of their faces to other materials: the tets between a centre and three faces
  // around a corner have their circumcentres within the voxel.
  [[nodiscard]] std::vector<Vec3> samples_of(const std::vector<MaterialId>& materials) const {
    std::vector<char> wanted(image_.material_count(), 0);
    for (const MaterialId m : materials) wanted[m] = 1;
    std::vector<Vec3> samples;
    for (std::size_t v = 0; v < image_.voxels.size(); ++v) {
      if (wanted[image_.voxels[v]] != 0) add_samples(image_.frame.index_of(v), samples);
    }
    return samples;
  }

  void add_samples(const Index3& at, std::vector<Vec3>& samples) const {
    const Vec3 centre = image_.frame.local_centre(at[0], at[1], at[2]);
    const Vec3& h = image_.frame.spacing_mm;
    const MaterialId own = image_.at(at[0], at[1], at[2]);
    samples.push_back(centre);
    for (const Index3& s : kFaceSteps) {
      if (image_.at_or_background(at[0] + s[0], at[1] + s[1], at[2] + s[2]) == own) continue;
      samples.push_back(centre + 0.5 * Vec3{s[0] * h.x, s[1] * h.y, s[2] * h.z});
    }
  }

  static void add(RefinementCounts& sum, const RefinementCounts& counts) {
    sum.surface_vertices += counts.surface_vertices;
    sum.free_vertices += counts.free_vertices;
    sum.removals += counts.removals;
    sum.rollbacks += counts.rollbacks;
    sum.removals_capped = sum.removals_capped || counts.removals_capped;
  }

  const LabelImage& image_;
  Refiner<Concurrency> refiner_;
  std::vector<Worker> workers_;
};

}  // namespace

RefinementResult refine(const LabelImage& image, const SurfaceOracle& oracle,
                        const RefinementOptions& options) {
  if (options.threads > 1) return Refinement<CGAL::Parallel_tag>(image, oracle, options).run();
  RefinementOptions sequential = options;
  sequential.threads = 1;
  return Refinement<CGAL::Sequential_tag>(image, oracle, sequential).run();
}

}  // namespace cbc3d::baselines::podm
