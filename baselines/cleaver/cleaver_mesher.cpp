#include "baselines/cleaver/cleaver_mesher.hpp"

#include <algorithm>
#include <cmath>

#include "baselines/cleaver/alphas.hpp"
#include "baselines/cleaver/sizing_field.hpp"
#include "baselines/cleaver/stencil.hpp"
#include "baselines/cleaver/triples.hpp"
#include "baselines/cleaver/warp_vertices.hpp"
#include "baselines/core/missing_labels.hpp"
#include "mesher/core/error.hpp"

namespace cbc3d::baselines::cleaver {
namespace {

// The edge of a cube as large as a voxel.
double voxel_edge_mm(const LabelImage& image) {
  const Vec3& s = image.frame.spacing_mm;
  return std::cbrt(s.x * s.y * s.z);
}

Vec3 blur_in_voxels(const LabelImage& image, double blur_mm) {
  if (blur_mm == 0) return {1, 1, 1};
  Vec3 blur;
  for (int axis = 0; axis < 3; ++axis) {
    blur[axis] = blur_mm / image.frame.spacing_mm[axis];
    if (blur[axis] > ImageIndicators::kMostBlur) {
      throw InputError("--blur " + std::to_string(blur_mm) + ": more than " +
                       std::to_string(static_cast<int>(ImageIndicators::kMostBlur)) + " voxels; give less");
    }
  }
  return blur;
}

// The lattice with the material of each vertex, without the tets of background alone.
struct LabelledLattice {
  Lattice lattice;
  std::vector<MaterialId> materials;
};

LabelledLattice labelled_lattice(const Octree& octree, const ImageIndicators& indicators) {
  LabelledLattice result;
  result.lattice = background_lattice(octree, octree.leaves_near_labels(indicators));
  std::vector<MaterialId> all(result.lattice.points.size());
#pragma omp parallel for schedule(dynamic, 1024)
  for (std::size_t v = 0; v < all.size(); ++v) all[v] = indicators.material_at(result.lattice.points[v]);
  std::vector<char> keep(result.lattice.tets.size());
#pragma omp parallel for schedule(static)
  for (std::size_t t = 0; t < keep.size(); ++t) {
    const auto& n = result.lattice.tets[t];
    keep[t] = std::any_of(n.begin(), n.end(), [&](VertexId v) { return all[v] != kBackground; }) ? 1 : 0;
  }
  for (const VertexId v : keep_tets(result.lattice, keep)) result.materials.push_back(all[v]);
  return result;
}

// The grid cells that hold the voxels of some labels.
std::vector<Index3> grid_cells_of(const LabelImage& image, const LatticeGrid& grid,
                                  const std::vector<MaterialId>& materials) {
  std::vector<char> wanted(image.material_count(), 0);
  for (const MaterialId m : materials) wanted[m] = 1;
  std::vector<Index3> cells;
  for (std::size_t v = 0; v < image.voxels.size(); ++v) {
    if (wanted[image.voxels[v]] == 0) continue;
    const Index3 at = image.frame.index_of(v);
    const Vec3 offset = image.frame.local_centre(at[0], at[1], at[2]) - grid.origin_mm;
    Index3 cell{};
    for (std::size_t a = 0; a < 3; ++a) {
      const int axis = static_cast<int>(a);
      cell[a] =
          std::clamp(static_cast<int>(std::floor(offset[axis] / grid.cell_mm[axis])), 0, grid.cells[a] - 1);
    }
    cells.push_back(cell);
  }
  return cells;
}

class Run {
 public:
  Run(const LabelImage& image, const CleaverOptions& options, StageClock& stages)
      : image_(image), options_(options), stages_(stages) {}

  CleaverResult run() {
    stages_.start("indicators");
    const ImageIndicators indicators(image_, blur_in_voxels(image_, options_.blur_mm));
    note_sharp_labels(indicators);
    stages_.start("sizing field");
    const LatticeGrid grid = grid_over_labels(image_, voxel_edge_mm(image_) / options_.sampling_rate);
    Octree octree = make_octree(grid, indicators);
    stages_.start("background lattice");
    LabelledLattice labelled = lattice_with_all_labels(octree, indicators);
    stages_.start("cuts");
    CutLattice cut = cut_edges(std::move(labelled.lattice), std::move(labelled.materials), indicators);
    set_alphas(cut);
    stages_.start("warp");
    warp_vertices(cut, indicators);
    stages_.start("triples");
    find_triples(cut, indicators);
    stages_.start("stencil");
    CleavedMesh cleaved = cleave_tets(cut, indicators);
    note_lost_labels(cleaved);
    finish(std::move(cleaved));
    stages_.stop();
    return std::move(result_);
  }

 private:
  [[nodiscard]] Octree make_octree(const LatticeGrid& grid, const ImageIndicators& indicators) const {
    if (!options_.graded) return Octree::uniform(grid);
    const CellArray<float> sizes =
        sizing_field(materials_of_cells(grid, indicators),
                     {.lipschitz = options_.lipschitz, .feature_scaling = options_.feature_scaling});
    return Octree::graded(grid, sizes, indicators);
  }

  // A label that no vertex has gets the smallest cells.
  LabelledLattice lattice_with_all_labels(Octree& octree, const ImageIndicators& indicators) {
    LabelledLattice labelled = labelled_lattice(octree, indicators);
    const std::vector<MaterialId> missing = missing_materials(image_, labelled.materials);
    if (missing.empty()) return labelled;
    result_.notes.push_back(names_of(image_, missing) + ": smaller than the cells there, which are refined");
    octree.divide_at(grid_cells_of(image_, octree.grid(), missing));
    octree.balance();
    labelled = {};
    return labelled_lattice(octree, indicators);
  }

  void note_sharp_labels(const ImageIndicators& indicators) {
    if (indicators.sharp_materials().empty()) return;
    result_.notes.push_back(names_of(image_, indicators.sharp_materials()) +
                            ": erased by the blur, so taken from the voxels as they are");
  }
  void note_lost_labels(const CleavedMesh& cleaved) {
    const std::vector<MaterialId> missing = missing_materials(image_, cleaved.materials);
    if (missing.empty()) return;
    result_.notes.push_back(names_of(image_, missing) +
                            ": not in the mesh, smaller than its smallest cells; raise the sampling rate");
  }

  void finish(CleavedMesh&& cleaved) {
    Mesh& mesh = result_.mesh;
    mesh.points = std::move(cleaved.points);
    mesh.tets.nodes = std::move(cleaved.tets);
    mesh.tets.labels.resize(cleaved.materials.size());
#pragma omp parallel for schedule(static)
    for (std::size_t t = 0; t < cleaved.materials.size(); ++t)
      mesh.tets.labels[t] = image_.labels[cleaved.materials[t]];
    map_to_physical(mesh, image_.frame);
  }

  const LabelImage& image_;
  const CleaverOptions& options_;
  StageClock& stages_;
  CleaverResult result_;
};

}  // namespace

CleaverResult mesh_with_cleaver(const LabelImage& image, const CleaverOptions& options, StageClock& stages) {
  return Run(image, options, stages).run();
}

}  // namespace cbc3d::baselines::cleaver
