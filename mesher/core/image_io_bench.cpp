// How fast labels are read from an uncompressed file.
#include <benchmark/benchmark.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "mesher/core/image_io.hpp"
#include "mesher/testing/bandwidth.hpp"
#include "mesher/testing/benchmarks.hpp"

namespace cbc3d {
namespace {

using namespace bench;

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
  const LabelImage& image = image_of(state);
  const RawFile file(image);
  for ([[maybe_unused]] const auto _ : state) benchmark::DoNotOptimize(read_label_image(file.path()));
  count_work(state, voxel_count(image), voxel_bytes(image));
}

BENCHMARK(KernelReadLabels)->Apply(all_sizes);

}  // namespace
}  // namespace cbc3d
