#include "baselines/tetgen/tetgen_mesher.hpp"

#define TETLIBRARY
#include <tetgen.h>

#include <algorithm>
#include <cstring>
#include <new>
#include <sstream>

#include "baselines/tetgen/child_process.hpp"
#include "baselines/tetgen/surface_nets.hpp"
#include "mesher/core/error.hpp"

namespace cbc3d::baselines {
namespace {

// What TetGen hands back, as plain arrays.
struct TetgenOutput {
  std::vector<Vec3> points;
  std::vector<std::array<int, 4>> tets;
  std::vector<double> regions;  // of every tet
  std::vector<std::array<int, 3>> facets;
};

// The net as TetGen takes it, lending it the net's own arrays.
class NetInput {
 public:
  explicit NetInput(SurfaceNet& net) : polygons_(net.triangles.size()), facets_(net.triangles.size()) {
    static_assert(sizeof(Vec3) == 3 * sizeof(double) && sizeof(std::array<int, 3>) == 3 * sizeof(int));
    for (std::size_t t = 0; t < net.triangles.size(); ++t) {
      polygons_[t].vertexlist = net.triangles[t].data();
      polygons_[t].numberofvertices = 3;
      tetgenio::init(&facets_[t]);
      facets_[t].polygonlist = &polygons_[t];
      facets_[t].numberofpolygons = 1;
    }
    io_.numberofpoints = static_cast<int>(net.points.size());
    io_.pointlist = &net.points.front().x;
    io_.numberoffacets = static_cast<int>(facets_.size());
    io_.facetlist = facets_.data();
  }
  // tetgenio frees what its pointers point to unless they are reset.
  ~NetInput() { io_.initialize(); }
  NetInput(const NetInput&) = delete;
  NetInput& operator=(const NetInput&) = delete;

  tetgenio* io() { return &io_; }

 private:
  std::vector<tetgenio::polygon> polygons_;
  std::vector<tetgenio::facet> facets_;
  tetgenio io_;
};

template <typename Item>
void send_array(const Send& send, const void* data, int count) {
  send(&count, sizeof count);
  if (count > 0) send(data, static_cast<std::size_t>(count) * sizeof(Item));
}

class ByteReader {
 public:
  explicit ByteReader(const std::vector<std::byte>& bytes) : bytes_(bytes) {}
  template <typename Item>
  std::vector<Item> array() {
    int count = 0;
    take(&count, sizeof count);
    std::vector<Item> items(static_cast<std::size_t>(count));
    take(items.data(), items.size() * sizeof(Item));
    return items;
  }

 private:
  void take(void* to, std::size_t bytes) {
    if (bytes > bytes_.size() - next_)
      throw JobError("TetGen's process ended before its result was complete");
    if (bytes > 0) std::memcpy(to, bytes_.data() + next_, bytes);
    next_ += bytes;
  }
  const std::vector<std::byte>& bytes_;
  std::size_t next_ = 0;
};

std::string reason_of(int tetgen_code) {
  switch (tetgen_code) {
    case 2:
      return "TetGen met an internal error";
    case 3:
      return "TetGen found a self-intersection in the surface net";
    case 4:
      return "TetGen found a feature too small for its arithmetic";
    case 5:
      return "TetGen found two facets too close for its arithmetic";
    default:
      return "TetGen refused its input (code " + std::to_string(tetgen_code) + ")";
  }
}

// TetGen's code 1 says that memory ran out.
void require_success(const ChildResult& child, const std::string& switches) {
  if (child.signal != 0) {
    throw JobError("TetGen died of signal " + std::to_string(child.signal) + " (" +
                   ::strsignal(child.signal) + ") with the switches " + switches);
  }
  if (child.exit_code == 0) return;
  if (child.exit_code == kChildOutOfMemory || child.exit_code == kChildThrewNumber + 1)
    throw std::bad_alloc();
  if (child.exit_code >= kChildThrewNumber)
    throw JobError(reason_of(child.exit_code - kChildThrewNumber) + "; switches " + switches);
  throw JobError("TetGen ended with code " + std::to_string(child.exit_code) + "; switches " + switches);
}

// TetGen 1.5 frees twice when its own exceptions unwind and may call exit(): it gets a process of its own.
TetgenOutput run_tetgen(SurfaceNet& net, const std::string& switches) {
  const ChildResult child = run_in_child([&](const Send& send) {
    NetInput input(net);
    tetgenio output;
    std::string text = switches;
    ::tetrahedralize(text.data(), input.io(), &output);
    send_array<Vec3>(send, output.pointlist, output.numberofpoints);
    send_array<std::array<int, 4>>(send, output.tetrahedronlist, output.numberoftetrahedra);
    const bool has_regions = output.numberoftetrahedronattributes == 1;
    send_array<double>(send, output.tetrahedronattributelist, has_regions ? output.numberoftetrahedra : 0);
    send_array<std::array<int, 3>>(send, output.trifacelist, output.numberoftrifaces);
  });
  require_success(child, switches);
  ByteReader reader(child.output);
  TetgenOutput result;
  result.points = reader.array<Vec3>();
  result.tets = reader.array<std::array<int, 4>>();
  result.regions = reader.array<double>();
  result.facets = reader.array<std::array<int, 3>>();
  return result;
}

// Moves the vertices of intersecting facets, as TetGen's own check (-d) lists them, towards the voxels'
// boundary. False when there are none.
bool repair(SurfaceNet& net) {
  const TetgenOutput check = run_tetgen(net, "pdQ");
  std::vector<std::uint8_t> flagged(net.points.size(), 0);
  for (const auto& facet : check.facets)
    for (const int v : facet) flagged[static_cast<std::size_t>(v)] = 1;
  retract(net, flagged);
  return !check.facets.empty();
}

// The material of every region: the one that most of its volume has in the image.
std::vector<MaterialId> vote(const TetgenOutput& output, const LabelImage& image) {
  const double last =
      output.regions.empty() ? 0 : *std::max_element(output.regions.begin(), output.regions.end());
  const std::size_t regions = static_cast<std::size_t>(std::max(0.0, last)) + 1;
  const std::size_t materials = image.material_count();
  std::vector<double> volumes(regions * materials, 0.0);
  for (std::size_t t = 0; t < output.tets.size(); ++t) {
    std::array<Vec3, 4> p;
    for (std::size_t i = 0; i < 4; ++i) p[i] = output.points[static_cast<std::size_t>(output.tets[t][i])];
    const MaterialId seen = image.at_local((p[0] + p[1] + p[2] + p[3]) / 4);
    const auto region = static_cast<std::size_t>(std::max(0.0, output.regions[t]));
    volumes[region * materials + seen] += std::fabs(six_volumes(p[0], p[1], p[2], p[3]));
  }
  std::vector<MaterialId> winners(regions);
  for (std::size_t r = 0; r < regions; ++r) {
    const auto first = volumes.begin() + static_cast<std::ptrdiff_t>(r * materials);
    winners[r] = static_cast<MaterialId>(
        std::max_element(first, first + static_cast<std::ptrdiff_t>(materials)) - first);
  }
  return winners;
}

// The labelled tets alone, positively oriented, with the points they use.
Mesh to_mesh(const TetgenOutput& output, const LabelImage& image) {
  const std::vector<MaterialId> material_of = vote(output, image);
  constexpr VertexId kUnused = ~VertexId{0};
  std::vector<VertexId> ids(output.points.size(), kUnused);
  Mesh mesh;
  for (std::size_t t = 0; t < output.tets.size(); ++t) {
    const MaterialId material = material_of[static_cast<std::size_t>(std::max(0.0, output.regions[t]))];
    if (material == kBackground) continue;
    std::array<VertexId, 4> nodes{};
    for (std::size_t i = 0; i < 4; ++i) {
      VertexId& id = ids[static_cast<std::size_t>(output.tets[t][i])];
      if (id == kUnused) {
        id = static_cast<VertexId>(mesh.points.size());
        mesh.points.push_back(output.points[static_cast<std::size_t>(output.tets[t][i])]);
      }
      nodes[i] = id;
    }
    const auto p = [&](std::size_t i) { return mesh.points[nodes[i]]; };
    if (six_volumes(p(0), p(1), p(2), p(3)) < 0) std::swap(nodes[0], nodes[1]);
    mesh.tets.add(nodes, image.labels[material]);
  }
  return mesh;
}

std::string mesh_switches(const TetgenOptions& options) {
  std::ostringstream text;
  // -Y keeps the interfaces as they are; without it TetGen splits them and needs ten times as long.
  text << std::fixed << "pYq" << options.radius_edge_ratio;
  if (options.min_dihedral_deg > 0) text << "/" << options.min_dihedral_deg;
  text << "a" << options.max_volume_mm3 << "AQO" << options.optimization_level;
  return text.str();
}

// The check takes longer than the meshing and the nets hardly ever need it: mesh first, check and repair only
// after a failure.
TetgenOutput tetrahedralize_with_repair(SurfaceNet& net, const TetgenOptions& options, StageClock& stages) {
  for (int round = 0;; ++round) {
    stages.start("tetrahedra");
    try {
      return run_tetgen(net, mesh_switches(options));
    } catch (const JobError& failure) {
      stages.start("repair");
      if (round == options.repair_rounds || !repair(net))
        throw JobError(std::string(failure.what()) + ", after " + std::to_string(round) + " repair rounds");
    }
  }
}

}  // namespace

Mesh mesh_with_tetgen(const LabelImage& image, const TetgenOptions& options, StageClock& stages) {
  stages.start("surface");
  SurfaceNetOptions net_options;
  net_options.smoothing_steps = options.smoothing_steps;
  net_options.reach = options.reach;
  SurfaceNet net = surface_net(image, net_options);
  const TetgenOutput output = tetrahedralize_with_repair(net, options, stages);
  if (output.regions.size() != output.tets.size()) throw JobError("TetGen gave its tets no regions");
  stages.start("label");
  Mesh mesh = to_mesh(output, image);
  if (mesh.tets.size() == 0) throw JobError("TetGen made no labelled tet");
  map_to_physical(mesh, image.frame);
  return mesh;
}

}  // namespace cbc3d::baselines
