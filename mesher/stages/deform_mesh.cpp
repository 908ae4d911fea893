#include "mesher/stages/deform_mesh.hpp"

#include <algorithm>
#include <cmath>

#include "mesher/stages/tet_quality.hpp"

namespace cbc3d {
namespace {

class Deformer {
 public:
  Deformer(MaterialMesh& mesh, const LabelImage& image, const DeformOptions& options)
      : mesh_(mesh),
        image_(image),
        options_(options),
        system_(mesh, options.elasticity),
        displacement_(mesh.points.size()),
        load_(mesh.points.size()),
        is_source_(mesh.points.size(), 0) {}

  DeformReport run(const std::function<void(int)>& on_iteration) {
    extract_points();
    for (int i = 0; i < options_.iterations && !report_.stopped_early; ++i) {
      on_iteration(i);
      report_.iterations.emplace_back();
      displacements_of_sources();
      system_.assemble(mesh_, is_source_);
      move_under_quality_control();
    }
    return std::move(report_);
  }

 private:
  DeformIteration& now() { return report_.iterations.back(); }

  void extract_points() {
    LabelSets sets;
    sources_ = extract_source_points(mesh_, sets);
    targets_ = extract_target_points(image_, options_.connectivity, sets);
    report_.sources = sources_.size();
    report_.targets = targets_.targets.size();
    around_ = tets_of_vertices(mesh_.tets, mesh_.points.size());
    if (options_.target_position == TargetPosition::voxel_faces) {
      faces_ = interface_faces(mesh_);
    }
  }

  /// D: for each source the mean of the vectors to the targets of its label set within the local element
  /// size.
  void displacements_of_sources() {
    std::fill(is_source_.begin(), is_source_.end(), 0);
    std::fill(load_.begin(), load_.end(), Vec3{});
    update_normals();
#pragma omp parallel for schedule(dynamic, 256)
    for (std::size_t s = 0; s < sources_.size(); ++s) {
      Vec3 mean;
      if (mean_target_vector(sources_[s], mean)) {
        is_source_[sources_[s].vertex] = 1;
        load_[sources_[s].vertex] = mean;
      }
    }
    for (const SourcePoint& s : sources_) {
      if (is_source_[s.vertex] != 0) {
        const double length = load_[s.vertex].norm();
        ++now().matched_sources;
        now().mean_displacement_mm += length;
        now().max_displacement_mm = std::max(now().max_displacement_mm, length);
      }
    }
    now().mean_displacement_mm /= std::max<double>(1, static_cast<double>(now().matched_sources));
  }

  /// Area-weighted normals of the interface at its vertices, from the lower material number to the higher.
  void update_normals() {
    normals_.assign(mesh_.points.size(), {});
    for (const InterfaceFace& f : faces_) {
      const Vec3& corner = mesh_.points[f[0]];
      const Vec3 area = (mesh_.points[f[1]] - corner).cross(mesh_.points[f[2]] - corner);
      for (const VertexId v : f) {
        normals_[v] += area;
      }
    }
    for (Vec3& n : normals_) {
      n = n.normalized();
    }
  }

  /// Weighted sum of the vectors to what the targets offer a source.
  struct Pull {
    Vec3 sum;
    double weight = 0;
    void add(const Vec3& vector, double w) {
      sum += w * vector;
      weight += w;
    }
  };

  void add_target(const SourcePoint& source, const TargetPoint& t, const Vec3& to_centre, double radius,
                  Pull& pull) const {
    if (options_.target_position == TargetPosition::voxel_centre) {
      if (to_centre.squared_norm() <= radius * radius) {
        pull.add(to_centre, 1);
      }
      return;
    }
    const Vec3 outward = t.lower_side ? normals_[source.vertex] : -normals_[source.vertex];
    for (unsigned f = 0; f < 6; ++f) {
      const int axis = static_cast<int>(f / 2);
      const double side = f % 2 == 0 ? -1 : 1;
      const double weight = source.two_sided ? side * outward[axis] : 1;
      Vec3 to_face = to_centre;
      to_face[axis] += 0.5 * side * image_.frame.spacing_mm[axis];
      if ((t.faces >> f & 1U) != 0 && weight > 0 && to_face.squared_norm() <= radius * radius) {
        pull.add(to_face, weight);
      }
    }
  }

  /// Mean length of the edges at a vertex, each counted once a tet.
  [[nodiscard]] double mean_edge_length(VertexId v) const {
    double sum = 0;
    for (std::uint32_t a = around_.first[v]; a < around_.first[v + 1]; ++a) {
      for (const VertexId n : mesh_.tets[around_.tets[a]]) {
        sum += (mesh_.points[n] - mesh_.points[v]).norm();
      }
    }
    return sum / (3.0 * (around_.first[v + 1] - around_.first[v]));
  }

  bool mean_target_vector(const SourcePoint& source, Vec3& mean) const {
    const Vec3& s = mesh_.points[source.vertex];
    const double radius = mean_edge_length(source.vertex);
    const ImageFrame& frame = image_.frame;
    const auto first_index = [&](int d) {
      return std::max(0, static_cast<int>(std::floor((s[d] - radius) / frame.spacing_mm[d])));
    };
    const auto last_index = [&](int d) {
      return std::min(frame.size[static_cast<std::size_t>(d)] - 1,
                      static_cast<int>(std::ceil((s[d] + radius) / frame.spacing_mm[d])));
    };
    Pull pull;
    for (int k = first_index(2); k <= last_index(2); ++k) {
      for (int j = first_index(1); j <= last_index(1); ++j) {
        const std::size_t row = static_cast<std::size_t>(k) * static_cast<std::size_t>(frame.size[1]) +
                                static_cast<std::size_t>(j);
        const auto* const row_end = targets_.targets.data() + targets_.first[row + 1];
        const auto* t = std::lower_bound(targets_.targets.data() + targets_.first[row], row_end,
                                         first_index(0), [](const TargetPoint& a, int i) { return a.i < i; });
        for (; t != row_end && t->i <= last_index(0); ++t) {
          if (t->set == source.set) {
            add_target(source, *t, frame.local_centre(t->i, j, k) - s, radius, pull);
          }
        }
      }
    }
    mean = pull.weight > 0 ? pull.sum / pull.weight : Vec3{};
    return pull.weight > 0;
  }

  /// Solves, checks every tet, scales the displacements around failing ones and solves again; then recovers.
  void move_under_quality_control() {
    const std::vector<Vec3> before = mesh_.points;
    std::vector<std::uint8_t> failing;
    for (now().attempts = 0;; ++now().attempts) {
      now().solver = system_.solve(load_, displacement_);
      apply(before);
      if (find_failing(before, failing) == 0) {
        return;
      }
      if (now().attempts == options_.attempts) {
        break;
      }
      scale_around(failing);
    }
    if (options_.on_failure == OnFailure::stop) {
      mesh_.points = before;
      report_.stopped_early = true;
    } else {
      recover(before, failing);
    }
  }

  void apply(const std::vector<Vec3>& before) {
#pragma omp parallel for schedule(static)
    for (std::size_t v = 0; v < before.size(); ++v) {
      mesh_.points[v] = before[v] + displacement_[v];
    }
  }

  [[nodiscard]] double quality_at(const std::vector<Vec3>& points, std::size_t t) const {
    const auto& n = mesh_.tets[t];
    return min_dihedral_deg(points[n[0]], points[n[1]], points[n[2]], points[n[3]]);
  }

  /// A tet fails below the minimum quality; one that was below it before fails when it got worse.
  std::size_t find_failing(const std::vector<Vec3>& before, std::vector<std::uint8_t>& failing) const {
    failing.assign(mesh_.tets.size(), 0);
    std::size_t count = 0;
#pragma omp parallel for schedule(static, 1024) reduction(+ : count)
    for (std::size_t t = 0; t < mesh_.tets.size(); ++t) {
      const double quality = quality_at(mesh_.points, t);
      if (quality < options_.min_dihedral_deg && quality < quality_at(before, t)) {
        failing[t] = 1;
        ++count;
      }
    }
    return count;
  }

  void scale_around(const std::vector<std::uint8_t>& failing) {
    std::vector<std::uint8_t> scaled(mesh_.points.size(), 0);
    for (std::size_t t = 0; t < failing.size(); ++t) {
      if (failing[t] != 0) {
        for (const VertexId v : mesh_.tets[t]) {
          if (scaled[v] == 0) {
            load_[v] *= options_.scale_at_failure;
            scaled[v] = 1;
          }
        }
      }
    }
  }

  /// Puts the vertices of failing tets back, and again around those that this makes fail. It ends, at the
  /// latest with every vertex back where no tet fails.
  void recover(const std::vector<Vec3>& before, std::vector<std::uint8_t>& failing) {
    std::vector<std::uint8_t> put_back(mesh_.points.size(), 0);
    do {
      for (std::size_t t = 0; t < failing.size(); ++t) {
        if (failing[t] != 0) {
          for (const VertexId v : mesh_.tets[t]) {
            now().recovered_vertices += static_cast<std::size_t>(put_back[v] == 0);
            put_back[v] = 1;
            mesh_.points[v] = before[v];
            displacement_[v] = {};
          }
        }
      }
    } while (find_failing(before, failing) != 0);
  }

  MaterialMesh& mesh_;
  const LabelImage& image_;
  const DeformOptions& options_;
  ElasticSystem system_;
  std::vector<SourcePoint> sources_;
  TargetPoints targets_;
  VertexTets around_;
  std::vector<InterfaceFace> faces_;  // only where normals are needed
  std::vector<Vec3> normals_;
  std::vector<Vec3> displacement_;  // U
  std::vector<Vec3> load_;          // H^T D
  std::vector<std::uint8_t> is_source_;
  DeformReport report_;
};

}  // namespace

DeformReport deform_mesh(MaterialMesh& mesh, const LabelImage& image, const DeformOptions& options,
                         const std::function<void(int iteration)>& on_iteration) {
  return Deformer(mesh, image, options).run(on_iteration);
}

}  // namespace cbc3d
