// Small images of any voxels and spacings through the whole pipeline: a mesh whose elements have a positive
// volume and labels of the image, the same at one and at two threads, or an InputError or a JobError.
//
// The bytes: 3 for the size, 3 for the spacing, 1 for the preset, then one for each voxel.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <vector>

#include "mesher/core/error.hpp"
#include "mesher/core/runtime.hpp"
#include "mesher/pipeline/mesh_array.hpp"

namespace {

using cbc3d::Mesh;

constexpr std::size_t kHead = 7;

/// From 1/10 to 10 mm.
double spacing_of(std::uint8_t byte) {
  return std::pow(10.0, byte / 127.5 - 1);
}

struct Image {
  cbc3d::ImageFrame frame;
  std::vector<std::uint8_t> labels;
};

Image image_of(const std::uint8_t* bytes, std::size_t size) {
  Image image;
  for (int a = 0; a < 3; ++a) {
    image.frame.size[static_cast<std::size_t>(a)] = 1 + bytes[a] % 7;
    image.frame.spacing_mm[a] = spacing_of(bytes[3 + a]);
  }
  image.labels.resize(image.frame.voxel_count());
  for (std::size_t v = 0; v < image.labels.size() && kHead + v < size; ++v) {
    image.labels[v] = bytes[kHead + v] % 5;
  }
  return image;
}

std::optional<Mesh> mesh_of(const Image& image, bool paper, int threads) {
  cbc3d::set_thread_count(threads);
  try {
    const auto options = cbc3d::preset_options(paper ? "paper" : "quality", image.frame);
    return cbc3d::mesh_array(std::span<const std::uint8_t>(image.labels), image.frame, options).mesh;
  } catch (const cbc3d::InputError&) {
    return std::nullopt;
  } catch (const cbc3d::JobError&) {
    return std::nullopt;
  }
}

void require(bool holds) {
  if (!holds) std::abort();
}

bool same(const Mesh& a, const Mesh& b) {
  return std::ranges::equal(a.points, b.points) && std::ranges::equal(a.tets.nodes, b.tets.nodes) &&
         a.tets.labels == b.tets.labels;
}

void require_sound(const Mesh& mesh, const Image& image) {
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto& n = mesh.tets.nodes[t];
    require(std::ranges::all_of(n, [&](cbc3d::VertexId v) { return v < mesh.points.size(); }));
    require(cbc3d::six_volumes(mesh.points[n[0]], mesh.points[n[1]], mesh.points[n[2]], mesh.points[n[3]]) >
            0);
    require(std::ranges::find(image.labels, mesh.tets.labels[t]) != image.labels.end());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  if (size <= kHead) return 0;
  const Image image = image_of(bytes, size);
  const bool paper = bytes[6] % 2 == 1;
  const std::optional<Mesh> one = mesh_of(image, paper, 1), two = mesh_of(image, paper, 2);
  require(one.has_value() == two.has_value());
  if (one && two) {
    require_sound(*one, image);
    require(same(*one, *two));
  }
  return 0;
}
