#include "reports/viewer/mesh_payload.hpp"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace cbc3d::reports {
namespace {

constexpr double kPositions = 65535;
constexpr double kAngleSteps = 3.5, kRatioSteps = 250;  // a regular tet has 70.53 degrees, and 1

/// The box around all points, in steps that 16 bits count.
struct Grid {
  Vec3 origin, step;

  explicit Grid(const std::vector<Vec3>& points) {
    for (int axis = 0; axis < 3; ++axis) {
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (const Vec3& p : points) {
        low = std::min(low, p[axis]);
        high = std::max(high, p[axis]);
      }
      origin[axis] = points.empty() ? 0 : low;
      step[axis] = high > low ? (high - low) / kPositions : 1;
    }
  }

  [[nodiscard]] std::uint32_t place(const Vec3& p, int axis) const {
    return static_cast<std::uint32_t>(std::lround((p[axis] - origin[axis]) / step[axis]));
  }
};

/// The bits of a number with two empty ones after each.
std::uint64_t spread(std::uint64_t bits) {
  bits &= 0xFFFFU;
  bits = (bits | bits << 16U) & 0x0000FF0000FFULL;
  bits = (bits | bits << 8U) & 0x00F00F00F00FULL;
  bits = (bits | bits << 4U) & 0x0C30C30C30C3ULL;
  return (bits | bits << 2U) & 0x249249249249ULL;
}

/// The tets of a label together, along a curve that fills space (Morton 1966), so that neighbours are near.
std::vector<std::uint32_t> order_of(const ShownMesh& mesh, const Grid& grid) {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys;
  keys.reserve(mesh.tets.size());
  for (std::uint32_t t = 0; t < mesh.tets.size(); ++t) {
    Vec3 centre;
    for (const VertexId corner : mesh.tets[t]) {
      centre += mesh.points[corner] / 4;
    }
    std::uint64_t key = 0;
    for (int axis = 0; axis < 3; ++axis) {
      key |= spread(grid.place(centre, axis)) << static_cast<unsigned>(axis);
    }
    keys.emplace_back(std::uint64_t{mesh.label_index[t]} << 48U | key, t);
  }
  std::sort(keys.begin(), keys.end());
  std::vector<std::uint32_t> order;
  order.reserve(keys.size());
  for (const auto& key : keys) {
    order.push_back(key.second);
  }
  return order;
}

/// Bytes in planes.
class Planes {
 public:
  /// The lowest `count` bytes of all numbers.
  void add(const std::vector<std::uint32_t>& numbers, unsigned count) {
    for (unsigned plane = 0; plane < count; ++plane) {
      for (const std::uint32_t number : numbers) {
        bytes_ += static_cast<char>(number >> 8 * plane & 0xFFU);
      }
    }
  }

  [[nodiscard]] std::string deflated() const {
    uLongf size = compressBound(bytes_.size());
    std::string packed(size, '\0');
    if (compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
                  reinterpret_cast<const Bytef*>(bytes_.data()), bytes_.size(), Z_BEST_COMPRESSION) != Z_OK) {
      throw std::runtime_error("zlib failed");
    }
    packed.resize(size);
    return packed;
  }

 private:
  std::string bytes_;
};

/// The corners of the tets in the new numbers, descending, with their numbers within the tet.
struct Numbering {
  std::vector<VertexId> vertices;  ///< the mesh's, in the new order
  std::array<std::vector<std::uint32_t>, 4> codes;
  std::vector<std::uint32_t> boundary;
};

Numbering numbered(const ShownMesh& mesh, const std::vector<std::uint32_t>& order) {
  Numbering result;
  std::vector<VertexId> number(mesh.points.size(), kNoVertex);
  for (const std::uint32_t t : order) {
    std::array<std::pair<std::uint32_t, unsigned>, 4> corners;
    const std::size_t used = result.vertices.size();
    for (unsigned n = 0; n < 4; ++n) {
      VertexId& mine = number[mesh.tets[t][n]];
      if (mine == kNoVertex) {
        mine = static_cast<VertexId>(result.vertices.size());
        result.vertices.push_back(mesh.tets[t][n]);
      }
      corners[n] = {mine, n};
    }
    std::sort(corners.rbegin(), corners.rend());
    unsigned boundary = 0;
    for (unsigned n = 0; n < 4; ++n) {
      boundary |= (mesh.boundary[t] >> corners[n].second & 1U) << n;
    }
    result.boundary.push_back(boundary);
    // Up to four vertices are new, of which the first corner is the last.
    result.codes[0].push_back(static_cast<std::uint32_t>(used + 3 - corners[0].first));
    for (std::size_t n = 1; n < 4; ++n) {
      result.codes[n].push_back(corners[n - 1].first - corners[n].first);
    }
  }
  return result;
}

std::vector<std::uint32_t> position_codes(const ShownMesh& mesh, const Numbering& numbering, const Grid& grid,
                                          int axis) {
  std::vector<std::uint32_t> codes;
  std::uint32_t before = 0;
  for (const VertexId vertex : numbering.vertices) {
    const std::uint32_t place = grid.place(mesh.points[vertex], axis);
    codes.push_back((place - before) & 0xFFFFU);
    before = place;
  }
  return codes;
}

std::vector<std::uint32_t> label_codes(const ShownMesh& mesh, const std::vector<std::uint32_t>& order) {
  std::vector<std::uint32_t> codes;
  std::uint32_t before = 0;
  for (const std::uint32_t t : order) {
    codes.push_back((mesh.label_index[t] - before) & 0xFFFFU);
    before = mesh.label_index[t];
  }
  return codes;
}

std::vector<std::uint32_t> in_steps(const std::vector<float>& values, const std::vector<std::uint32_t>& order,
                                    double steps) {
  std::vector<std::uint32_t> bytes;
  for (const std::uint32_t t : order) {
    const double value = steps * static_cast<double>(values[t]);
    bytes.push_back(static_cast<std::uint32_t>(std::lround(std::clamp(value, 0.0, 255.0))));
  }
  return bytes;
}

double rounded(double value, double digits) {
  return std::round(value * digits) / digits;
}

nlohmann::json worst_json(const ShownMesh& mesh, const Grid& grid) {
  nlohmann::json list = nlohmann::json::array();
  for (const WorstTet& tet : mesh.worst) {
    nlohmann::json points = nlohmann::json::array();
    for (const Vec3& p : tet.points) {
      for (int axis = 0; axis < 3; ++axis) {
        points.push_back(rounded(p[axis] - grid.origin[axis], 1e4));
      }
    }
    list.push_back({{"angle", rounded(tet.min_dihedral_deg, 1e2)},
                    {"ratio", rounded(tet.mean_ratio, 1e3)},
                    {"label", tet.label},
                    {"points", std::move(points)}});
  }
  return list;
}

}  // namespace

MeshPayload mesh_payload(const ShownMesh& mesh) {
  const Grid grid(mesh.points);
  const std::vector<std::uint32_t> order = order_of(mesh, grid);
  const Numbering numbering = numbered(mesh, order);
  Planes planes;
  for (int axis = 0; axis < 3; ++axis) {
    planes.add(position_codes(mesh, numbering, grid, axis), 2);
  }
  for (const auto& codes : numbering.codes) {
    planes.add(codes, 3);
  }
  planes.add(label_codes(mesh, order), 2);
  planes.add(in_steps(mesh.min_dihedral_deg, order, kAngleSteps), 1);
  planes.add(in_steps(mesh.mean_ratio, order, kRatioSteps), 1);
  planes.add(numbering.boundary, 1);
  return {{{"vertices", numbering.vertices.size()},
           {"tets", order.size()},
           {"origin", {grid.origin.x, grid.origin.y, grid.origin.z}},
           {"step", {grid.step.x, grid.step.y, grid.step.z}},
           {"worst", worst_json(mesh, grid)}},
          planes.deflated()};
}

}  // namespace cbc3d::reports
