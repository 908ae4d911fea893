// The kernels that the stages spend their time in, beside the machine's memory bandwidth. Bytes are what a
// kernel must at least move: its arrays, read and written once.
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "mesher/core/image_io.hpp"
#include "mesher/deform/elasticity.hpp"
#include "mesher/domain/image_domain.hpp"
#include "mesher/improve/local/mesh_patches.hpp"
#include "mesher/improve/local/vertex_moves.hpp"
#include "mesher/lattice/voxel_raster.hpp"
#include "mesher/pipeline/testing_prepared.hpp"
#include "mesher/preprocess/voxel_contacts.hpp"
#include "mesher/testing/bandwidth.hpp"

namespace cbc3d {
namespace {

using namespace bench;

double voxel_bytes(const LabelImage& image) {
  return static_cast<double>(image.voxels.bytes());
}

double voxel_count(const LabelImage& image) {
  return static_cast<double>(image.voxels.size());
}

/// The image as an uncompressed .nrrd file, removed in the end.
class RawFile {
 public:
  explicit RawFile(const LabelImage& image)
      : path_(std::filesystem::temp_directory_path() /
              ("cbc3d-bench-" + std::to_string(::getpid()) + ".nrrd")) {
    const Index3& size = image.frame.size;
    std::ofstream file(path_, std::ios::binary);
    file << "NRRD0004\ntype: uchar\ndimension: 3\nsizes: " << size[0] << ' ' << size[1] << ' ' << size[2]
         << "\nspacings: 1 1 1\nencoding: raw\n\n";
    image.voxels.visit([&](const auto* voxels) {
      for (std::size_t v = 0; v < image.voxels.size(); ++v) file.put(static_cast<char>(voxels[v]));
    });
  }
  RawFile(const RawFile&) = delete;
  RawFile& operator=(const RawFile&) = delete;
  ~RawFile() { std::filesystem::remove(path_); }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

void KernelReadLabels(benchmark::State& state) {
  const LabelImage& image = prepared(static_cast<int>(state.range(0))).image;
  const RawFile file(image);
  for ([[maybe_unused]] const auto _ : state) benchmark::DoNotOptimize(read_label_image(file.path()));
  count_work(state, voxel_count(image), voxel_bytes(image));
}

void KernelCleaningScan(benchmark::State& state) {
  const LabelImage& image = prepared(static_cast<int>(state.range(0))).image;
  for ([[maybe_unused]] const auto _ : state) benchmark::DoNotOptimize(count_voxel_contacts(image));
  count_work(state, voxel_count(image), voxel_bytes(image));
}

/// One sample at the face of every boundary voxel; 64 voxels, a point and a sample each.
void KernelBoundaryField(benchmark::State& state) {
  const LabelImage& image = prepared(static_cast<int>(state.range(0))).image;
  const ImageDomain boundary(image);
  const std::vector<BoundaryDistance> points = boundary_samples(image);
  std::vector<double> distance_mm(points.size());
  for ([[maybe_unused]] const auto _ : state) {
#pragma omp parallel for schedule(static)
    for (std::size_t p = 0; p < points.size(); ++p) {
      distance_mm[p] =
          boundary.boundary_distance(points[p].centre(), points[p].own, points[p].other).distance_mm;
    }
    benchmark::DoNotOptimize(distance_mm.data());
  }
  const auto count = static_cast<double>(points.size());
  count_work(state, count, count * (64 + sizeof(BoundaryDistance) + sizeof(double)));
}

void KernelTetNeighbours(benchmark::State& state) {
  const Prepared& p = prepared(static_cast<int>(state.range(0)));
  const TetNodes& tets = p.refined.mesh.tets.nodes;
  for ([[maybe_unused]] const auto _ : state) {
    benchmark::DoNotOptimize(tet_neighbours(tets, p.points.size()));
  }
  const auto count = static_cast<double>(tets.size());
  count_work(state, count, count * (sizeof(tets[0]) + 4 * sizeof(TetId)));
}

/// The labelled voxels in every red tet of the lattice.
void KernelVoxelRaster(benchmark::State& state) {
  const Prepared& p = prepared(static_cast<int>(state.range(0)));
  const VoxelRaster raster(p.image.frame, p.lattice.frame);
  const auto labelled_in = [&](const RedTet& red) {
    std::size_t found = 0;
    const std::array<LatticePoint, 4> corners{p.lattice.points[red.nodes[0]], p.lattice.points[red.nodes[1]],
                                              p.lattice.points[red.nodes[2]], p.lattice.points[red.nodes[3]]};
    raster.for_each_row(corners, [&](int j, int k, int begin, int end) {
      const std::size_t row = p.image.frame.offset(0, j, k);
      for (int i = begin; i < end; ++i) {
        found += p.image.voxels[row + static_cast<std::size_t>(i)] != kBackground ? 1 : 0;
      }
    });
    return found;
  };
  for ([[maybe_unused]] const auto _ : state) {
    std::size_t labelled = 0;
#pragma omp parallel for schedule(dynamic, 256) reduction(+ : labelled)
    for (std::size_t t = 0; t < p.lattice.reds.size(); ++t) {
      labelled += labelled_in(p.lattice.reds[t]);
    }
    benchmark::DoNotOptimize(labelled);
  }
  count_work(state, voxel_count(p.image),
             voxel_bytes(p.image) + static_cast<double>(p.lattice.reds.size() * sizeof(RedTet)));
}

void KernelBccLattice(benchmark::State& state) {
  const Prepared& p = prepared(static_cast<int>(state.range(0)));
  for ([[maybe_unused]] const auto _ : state) {
    benchmark::DoNotOptimize(build_bcc_lattice(p.image, {10, 1}));
  }
  count_work(state, voxel_count(p.image), voxel_bytes(p.image));
}

/// All vertices of a lattice put into a table, then each of them found; serial, as the lattice's is filled.
void KernelVertexTable(benchmark::State& state) {
  const std::vector<LatticePoint>& points = prepared(static_cast<int>(state.range(0))).lattice.points;
  for ([[maybe_unused]] const auto _ : state) {
    VertexTable table;
    VertexId next = 0;
    for (const LatticePoint& point : points) {
      next += table.find_or_insert(point, next) == next ? 1 : 0;
    }
    VertexId last = 0;
    for (const LatticePoint& point : points) {
      last = std::max(last, table.find(point));
    }
    benchmark::DoNotOptimize(last);
  }
  constexpr double kSlotBytes = 16;
  const auto count = static_cast<double>(points.size());
  count_work(state, 2 * count, 2 * count * (sizeof(LatticePoint) + kSlotBytes));
}

/// The solver's matrix of 3x3 blocks (nine floats and a column) times a vector.
void KernelMatrixVector(benchmark::State& state) {
  const Prepared& p = prepared(static_cast<int>(state.range(0)));
  const VertexCells around = cells_of_vertices(p.mesh);
  ElasticSystem system(p.mesh, around, std::vector<ElasticMaterial>(p.image.labels.size()), {});
  system.assemble(p.mesh, std::vector<std::uint8_t>(p.mesh.points.size(), 1));
  const BlockMatrix& matrix = system.matrix();
  const std::vector<Float4> x(p.mesh.points.begin(), p.mesh.points.end());
  std::vector<Float4> y(x.size());
  for ([[maybe_unused]] const auto _ : state) {
#pragma omp parallel for schedule(static, 1024)
    for (std::size_t v = 0; v < y.size(); ++v) {
      y[v] = matrix.row_times(static_cast<VertexId>(v), x);
    }
    benchmark::DoNotOptimize(y.data());
  }
  std::size_t blocks = 0;
  for (std::size_t v = 0; v < y.size(); ++v) blocks += matrix.columns(static_cast<VertexId>(v)).size();
  count_work(state, static_cast<double>(blocks),
             static_cast<double>(blocks * (9 * sizeof(float) + sizeof(VertexId)) +
                                 y.size() * (2 * sizeof(Float4) + sizeof(std::uint64_t))));
}

/// One sweep of the improvement's relaxation over all vertices, cutting the mesh in patches included.
void KernelRelaxation(benchmark::State& state) {
  const Prepared& p = prepared(static_cast<int>(state.range(0)));
  const double diagonal_mm = p.image.frame.voxel_diagonal_mm();
  const ImageDomain domain(p.image);
  const std::vector<BoundaryDistance> points;
  const PatchRules rules{.boundaries = {domain},
                         .guards = {.deviation_mm = 0.15 * diagonal_mm, .scale_mm = diagonal_mm},
                         .samples = samples,
                         .reach_mm = 0.9 * diagonal_mm};
  for ([[maybe_unused]] const auto _ : state) {
    MaterialMesh mesh = p.mesh;
    std::vector<VertexId> covering;
    improve_in_patches(mesh, covering, rules, 0, [](Patch& patch) {
      relax_vertices(patch, {.surface_weight = 1000, .max_step = 0.5, .skip_below_mm = 0});
    });
    benchmark::DoNotOptimize(mesh.points.data());
  }
  const auto vertices = static_cast<double>(p.mesh.points.size());
  count_work(state, vertices,
             2 * vertices * sizeof(Vec3) + static_cast<double>(p.mesh.tets.size() * sizeof(p.mesh.tets[0])));
}

BENCHMARK(stream_copy)->Name("KernelStreamCopy")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(stream_triad)->Name("KernelStreamTriad")->Unit(benchmark::kMillisecond)->UseRealTime();
BENCHMARK(KernelReadLabels)->Apply(all_sizes);
BENCHMARK(KernelCleaningScan)->Apply(all_sizes);
BENCHMARK(KernelBoundaryField)->Apply(all_sizes);
BENCHMARK(KernelTetNeighbours)->Apply(all_sizes);
BENCHMARK(KernelVoxelRaster)->Apply(all_sizes);
BENCHMARK(KernelBccLattice)->Apply(all_sizes);
BENCHMARK(KernelVertexTable)->Apply(all_sizes);
BENCHMARK(KernelMatrixVector)->Apply(all_sizes);
BENCHMARK(KernelRelaxation)->Apply(all_sizes);

}  // namespace
}  // namespace cbc3d
