#include "mesher/pipeline/work_estimate.hpp"

#include <algorithm>
#include <array>
#include <cstdio>

#include "mesher/lattice/bcc_lattice.hpp"
#include "mesher/preprocess/voxel_contacts.hpp"

namespace cbc3d {
namespace {

constexpr std::array<Index3, 3> kAxes = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

/// Microseconds for one of a kind, where faces are as large as the finest lattice cubes'.
constexpr double kFace = 90, kSheet = 1150, kWire = 1350, kPoint = 400, kJunction = 2100, kEdgeContact = 3500;

/// Adds the voxel's faces towards smaller indices and its open axes; voxels just outside the image count as
/// background.
void add_voxel(const LabelImage& image, int i, int j, int k, BoundaryKinds& sum) {
  const MaterialId material = image.at_or_background(i, j, k);
  int open = 0;
  for (const Index3& step : kAxes) {
    const bool before = image.at_or_background(i - step[0], j - step[1], k - step[2]) != material;
    const bool after = image.at_or_background(i + step[0], j + step[1], k + step[2]) != material;
    sum.faces += before ? 1 : 0;
    open += before && after ? 1 : 0;
  }
  if (material == kBackground) return;
  sum.sheets += open == 1 ? 1 : 0;
  sum.wires += open == 2 ? 1 : 0;
  sum.points += open == 3 ? 1 : 0;
}

/// Whether the 2x2x2 cell whose last voxel this is has voxels of three labels.
bool is_junction(const LabelImage& image, int i, int j, int k) {
  std::array<MaterialId, 8> found{};
  auto end = found.begin();
  for (int corner = 0; corner < 8; ++corner) {
    const MaterialId material =
        image.at_or_background(i - (corner & 1), j - (corner >> 1 & 1), k - (corner >> 2));
    if (std::find(found.begin(), end, material) == end) *end++ = material;
  }
  return end - found.begin() == 3;
}

BoundaryKinds kinds_of_slice(const LabelImage& image, int k) {
  BoundaryKinds sum;
  for (int j = 0; j <= image.frame.size[1]; ++j) {
    for (int i = 0; i <= image.frame.size[0]; ++i) {
      add_voxel(image, i, j, k, sum);
      sum.junctions += is_junction(image, i, j, k) ? 1 : 0;
    }
  }
  return sum;
}

/// How many faces of the finest lattice cubes a voxel's face has, in the mean over the three directions.
double cube_faces_per_voxel_face(const ImageFrame& frame) {
  const Vec3& s = frame.spacing_mm;
  const double finest_mm = default_finest_spacing_mm(frame);
  return (s.x * s.y + s.y * s.z + s.z * s.x) / (3 * finest_mm * finest_mm);
}

}  // namespace

BoundaryKinds boundary_kinds_of(const LabelImage& image) {
  std::size_t faces = 0, sheets = 0, wires = 0, points = 0, junctions = 0;
#pragma omp parallel for schedule(static) reduction(+ : faces, sheets, wires, points, junctions)
  for (int k = 0; k <= image.frame.size[2]; ++k) {
    const BoundaryKinds slice = kinds_of_slice(image, k);
    faces += slice.faces;
    sheets += slice.sheets;
    wires += slice.wires;
    points += slice.points;
    junctions += slice.junctions;
  }
  return {faces, sheets, wires, points, junctions, count_voxel_contacts(image).edge_contacts};
}

double estimated_cpu_seconds(const BoundaryKinds& kinds, const ImageFrame& frame) {
  const auto count = [](std::size_t number) { return static_cast<double>(number); };
  const double microseconds = kFace * count(kinds.faces) + kSheet * count(kinds.sheets) +
                              kWire * count(kinds.wires) + kPoint * count(kinds.points) +
                              kJunction * count(kinds.junctions) + kEdgeContact * count(kinds.edge_contacts);
  return 1e-6 * microseconds * cube_faces_per_voxel_face(frame);
}

double work_limit_s(std::uintmax_t file_bytes, const OptionSettings& settings) {
  const bool asks_for_sizes = std::any_of(settings.begin(), settings.end(), [](const auto& setting) {
    const OptionGroup group = find_option(setting.first).group;
    return group == OptionGroup::lattice || group == OptionGroup::improvement;
  });
  return file_bytes < kSmallFileBytes && !asks_for_sizes ? kSmallFileWorkLimit : 0;
}

double work_of_lattice_s(std::size_t tets_of_rounds, std::size_t tets) {
  constexpr double kRoundSeconds = 2e-6, kImproveSeconds = 25e-6;
  return kRoundSeconds * static_cast<double>(tets_of_rounds) + kImproveSeconds * static_cast<double>(tets);
}

std::string why_long_work(const LabelImage& image, std::uintmax_t file_bytes) {
  if (file_bytes >= kSmallFileBytes) return "";
  const double seconds = estimated_cpu_seconds(boundary_kinds_of(image), image.frame);
  if (seconds <= kSmallFileCpuSeconds) return "";
  char text[200];
  std::snprintf(text, sizeof text,
                "a file of %.1f KB alone, but its thin parts and boundaries may take minutes of CPU (about "
                "%.0f s, give or take "
                "a factor of three)",
                static_cast<double>(file_bytes) / 1024, seconds);
  return text;
}

}  // namespace cbc3d
