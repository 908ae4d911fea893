#include "baselines/ld/lattice_decimation.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <utility>

#include "baselines/ld/initial_mesh.hpp"
#include "baselines/ld/leaf_templates.hpp"
#include "baselines/ld/mesh_parts.hpp"
#include "mesher/core/error.hpp"
#include "mesher/preprocess/clean_image.hpp"

namespace cbc3d::baselines::ld {
namespace {

/// The meshes that make(0), make(1), ... return, made in parallel. The first exception ends the work.
template <typename Make>
std::vector<LatticeMesh> made_in_parallel(std::size_t count, const Make& make) {
  std::vector<LatticeMesh> parts(count);
  std::exception_ptr failure;
  std::mutex mutex;
  std::atomic<bool> has_failed = false;
#pragma omp parallel for schedule(dynamic, 1)
  for (std::size_t n = 0; n < count; ++n) {
    if (has_failed) continue;
    try {
      parts[n] = make(n);
    } catch (...) {
      const std::lock_guard lock(mutex);
      failure = failure ? failure : std::current_exception();
      has_failed = true;
    }
  }
  if (failure) std::rethrow_exception(failure);
  return parts;
}

CellGridOptions grid_options(const LabelImage& image, const LatticeDecimationOptions& options) {
  const bool with_background = !options.decimation.keeps_surfaces();
  return {.pieces = pieces_for(image.frame.spacing_mm, options.decimation.min_dihedral_deg),
          .margin = with_background ? 2 : 0,
          .block = options.block};
}

/// All blocks, each built and decimated by itself, so that few of them stand undecimated at any time.
LatticeMesh decimated_blocks(const CellGrid& grid, const LabelOctree& octree,
                             const DecimationOptions& options) {
  const bool moves_surfaces = !options.keeps_surfaces();
  const InitialMeshOptions initial{.with_background = moves_surfaces, .with_pieces = moves_surfaces};
  Index3 blocks = grid.size();
  for (int& count : blocks) count /= grid.block();
  const auto count = static_cast<std::size_t>(blocks[0]) * static_cast<std::size_t>(blocks[1]) *
                     static_cast<std::size_t>(blocks[2]);
  auto parts = made_in_parallel(count, [&](std::size_t n) {
    const auto i = static_cast<int>(n);
    const Index3 block{i % blocks[0], i / blocks[0] % blocks[1], i / blocks[0] / blocks[1]};
    return decimated(initial_mesh(grid, octree, block, initial), grid, options);
  });
  return joined(parts);
}

/// The same mesh, cut half a block off the seams of the blocks and decimated there.
LatticeMesh decimated_seams(const LatticeMesh& mesh, const CellGrid& grid, const DecimationOptions& options) {
  const MeshParts cut(mesh, grid.block(), grid.block() / 2);
  auto parts = made_in_parallel(cut.size(), [&](std::size_t n) {
    LatticeMesh part = cut.part(n);
    return cut.has_work(n) ? decimated(std::move(part), grid, options) : part;
  });
  return joined(parts, cut.loose_pieces());
}

/// The labelled tets in physical space.
Mesh labelled_mesh(const LatticeMesh& lattice, const CellGrid& grid) {
  const LabelImage& image = grid.image();
  std::vector<VertexId> ids(lattice.points.size(), kNoVertex);
  Mesh mesh;
  for (std::size_t t = 0; t < lattice.tets.size(); ++t) {
    if (lattice.materials[t] == kBackground) continue;
    auto nodes = lattice.tets[t];
    for (VertexId& v : nodes) {
      if (ids[v] == kNoVertex) {
        ids[v] = static_cast<VertexId>(mesh.points.size());
        mesh.points.push_back(grid.local_mm(lattice.points[v]));
      }
      v = ids[v];
    }
    mesh.tets.add(nodes, image.labels[lattice.materials[t]]);
  }
  map_to_physical(mesh, image.frame);
  return mesh;
}

LabelImage cleaned(const LabelImage& image) {
  LabelImage clean = image;
  clean_image(clean, {.region_tolerance = 0, .well_composed = true}, false);
  return clean;
}

/// The mesh within the bounds of the angles and distances, as the method has it.
Mesh decimated_lattice(const LabelImage& image, const LatticeDecimationOptions& options, StageClock& stages) {
  stages.start("octree");
  const CellGrid grid(image, grid_options(image, options));
  const LabelOctree octree(grid);
  stages.start("blocks");
  LatticeMesh mesh = decimated_blocks(grid, octree, options.decimation);
  stages.start("seams");
  mesh = decimated_seams(mesh, grid, options.decimation);
  stages.start("whole");
  mesh = decimated(std::move(mesh), grid, options.decimation);
  stages.start("labels");
  return labelled_mesh(mesh, grid);
}

/// Distances below a voxel's edge may gain less than the background, which then has to stay valid too, costs.
bool may_gain_nothing(const LabelImage& image, const DecimationOptions& options) {
  const double smaller = std::min(options.distances.image_to_mesh_mm, options.distances.mesh_to_image_mm);
  return !options.keeps_surfaces() && smaller < image.frame.spacing_mm.max_coeff();
}

/// The exact surfaces are within any distances: where they need no more tets they are what is wanted.
Mesh mesh_clean_image(const LabelImage& image, const LatticeDecimationOptions& options, StageClock& stages) {
  Mesh mesh = decimated_lattice(image, options, stages);
  if (may_gain_nothing(image, options.decimation)) {
    LatticeDecimationOptions exact = options;
    exact.decimation.distances = {};
    Mesh other = decimated_lattice(image, exact, stages);
    if (other.tets.size() <= mesh.tets.size()) mesh = std::move(other);
  }
  if (mesh.tets.size() == 0) throw InputError("the image has no labelled voxel; give one with labels");
  return mesh;
}

}  // namespace

Mesh mesh_by_lattice_decimation(const LabelImage& image, const LatticeDecimationOptions& options,
                                StageClock& stages) {
  if (!options.clean) return mesh_clean_image(image, options, stages);
  stages.start("clean");
  const LabelImage clean = cleaned(image);
  return mesh_clean_image(clean, options, stages);
}

}  // namespace cbc3d::baselines::ld
