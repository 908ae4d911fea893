#include "mesher/deform/deform_mesh.hpp"

#include <algorithm>

#include "mesher/core/stage_clock.hpp"

namespace cbc3d {
namespace {

/// One a material, from those of the labels.
std::vector<ElasticMaterial> elastic_materials(const LabelImage& image, const ElasticityOptions& options) {
  std::vector<ElasticMaterial> materials;
  for (const Label label : image.labels) {
    const auto own = options.by_label.find(label);
    materials.push_back(own == options.by_label.end() ? options.all : own->second);
  }
  return materials;
}

class Deformer {
 public:
  Deformer(MaterialMesh& mesh, const LabelImage& image, const DeformOptions& options)
      : mesh_(mesh), image_(image), options_(options) {}

  DeformReport run(const std::function<void(int)>& on_iteration) {
    clock_.time("extraction", [&] { extract_points(); });
    ElasticSystem system = clock_.time("assembly", [&] {
      return ElasticSystem(mesh_, around_, elastic_materials(image_, options_.elasticity),
                           options_.elasticity);
    });
    SourceDisplacements asked = clock_.time("displacements", [&] {
      return SourceDisplacements({sources_, targets_, sets_, image_.frame}, options_.displacement);
    });
    for (int i = 0; i < options_.iterations && !report_.stopped_early; ++i) {
      on_iteration(i);
      report_.iterations.emplace_back();
      clock_.time("displacements", [&] { take_displacements(asked.at(mesh_.points)); });
      clock_.time("assembly", [&] { system.assemble(mesh_, is_source_); });
      move_under_quality_control(system);
    }
    report_.part_seconds = clock_.seconds();
    return std::move(report_);
  }

 private:
  DeformIteration& now() { return report_.iterations.back(); }

  void extract_points() {
    around_ = cells_of_vertices(mesh_);
    sources_ = extract_source_points(mesh_, around_, sets_);
    targets_ = extract_target_points(image_, options_.connectivity, sets_);
    image_.voxels.page_out();
    report_.sources = sources_.sources.size();
    report_.targets = targets_.targets.size();
  }

  /// H and H^T D.
  void take_displacements(const std::vector<SourceDisplacement>& found) {
    is_source_.assign(mesh_.points.size(), 0);
    load_.assign(mesh_.points.size(), {});
    for (std::size_t s = 0; s < found.size(); ++s) {
      if (found[s].matched) {
        const VertexId v = sources_.sources[s].vertex;
        is_source_[v] = 1;
        load_[v] = found[s].vector;
        const double length = load_[v].norm();
        ++now().matched_sources;
        now().mean_displacement_mm += length;
        now().max_displacement_mm = std::max(now().max_displacement_mm, length);
      }
    }
    now().mean_displacement_mm /= std::max<double>(1, static_cast<double>(now().matched_sources));
  }

  /// Solves and checks every cell. Where one fails, the paper scales the displacements around it and solves
  /// again, and at last takes the whole iteration back; the local step control holds back the vertices there
  /// without a solve.
  void move_under_quality_control(const ElasticSystem& system) {
    const QualityControl quality(mesh_, around_, options_.quality);
    const std::vector<Vec3> before = mesh_.points;
    std::vector<CellId> failing;
    // What the last iteration asked for is mostly reached: its displacements would be a poor start.
    displacement_.assign(before.size(), {});
    for (now().attempts = 0;; ++now().attempts) {
      clock_.time("solve", [&] { now().solver = system.solve(load_, displacement_); });
      failing = clock_.time("quality_control", [&] {
        apply(before);
        return quality.failing(before, mesh_.points);
      });
      if (failing.empty()) {
        return;
      }
      if (options_.on_failure == OnFailure::recover || now().attempts == options_.attempts) {
        break;
      }
      scale_around(failing);
    }
    if (options_.on_failure == OnFailure::stop) {
      mesh_.points = before;
      report_.stopped_early = true;
    } else {
      clock_.time("quality_control", [&] {
        now().held_vertices = quality.hold_back(before, std::move(failing), displacement_, mesh_.points);
      });
    }
  }

  void apply(const std::vector<Vec3>& before) {
#pragma omp parallel for schedule(static)
    for (std::size_t v = 0; v < before.size(); ++v) {
      mesh_.points[v] = before[v] + displacement_[v];
    }
  }

  void scale_around(const std::vector<CellId>& failing) {
    std::vector<VertexId> vertices;
    for (const CellId c : failing) {
      const auto nodes = mesh_.nodes_of(c);
      vertices.insert(vertices.end(), nodes.begin(), nodes.end());
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    for (const VertexId v : vertices) {
      load_[v] *= options_.scale_at_failure;
    }
  }

  MaterialMesh& mesh_;
  const LabelImage& image_;
  const DeformOptions& options_;
  VertexCells around_;
  MaterialSets sets_;
  SourcePoints sources_;
  TargetPoints targets_;
  std::vector<Vec3> displacement_;  // U
  std::vector<Vec3> load_;          // H^T D
  std::vector<std::uint8_t> is_source_;
  DeformReport report_;
  StageClock clock_;
};

}  // namespace

DeformReport deform_mesh(MaterialMesh& mesh, const LabelImage& image, const DeformOptions& options,
                         const std::function<void(int iteration)>& on_iteration) {
  return Deformer(mesh, image, options).run(on_iteration);
}

}  // namespace cbc3d
