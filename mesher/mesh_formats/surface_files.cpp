#include "mesher/mesh_formats/surface_files.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"
#include "mesher/mesh_formats/file_mesh.hpp"
#include "mesher/mesh_formats/text_file.hpp"

namespace cbc3d {
namespace {

namespace fs = std::filesystem;
using Triangle = std::array<VertexId, 3>;

static_assert(std::endian::native == std::endian::little, "the binary files are little-endian");

/// Hues a golden angle apart differ for any number of labels.
std::array<std::uint8_t, 3> colour_of(std::size_t number) {
  constexpr double kGoldenAngle = 0.381966, kDarkest = 0.45;
  const double hue = 6 * std::fmod(0.05 + kGoldenAngle * static_cast<double>(number), 1.0);
  std::array<std::uint8_t, 3> colour{};
  for (std::size_t c = 0; c < 3; ++c) {
    const double k = std::fmod(5 - 2 * static_cast<double>(c) + hue, 6.0);
    const double value = 0.95 - (0.95 - kDarkest) * std::clamp(std::min(k, 4 - k), 0.0, 1.0);
    colour[c] = static_cast<std::uint8_t>(std::lround(255 * value));
  }
  return colour;
}

/// Fills the parts of a surface facet by facet.
class SurfaceBuilder {
 public:
  SurfaceBuilder(const FileMesh& mesh, const LabelNames& names) : mesh_(mesh), names_(names) {}

  SurfacePart part(const std::string& name, Label label) const {
    const auto& labels = mesh_.labels();
    const NamedLabel* const named = names_.find(label);
    const auto number =
        static_cast<std::size_t>(std::lower_bound(labels.begin(), labels.end(), label) - labels.begin());
    return {name, named != nullptr && named->colour ? *named->colour : colour_of(number), {}};
  }
  void add(SurfacePart& part, const std::vector<CellFacet>& facets) const {
    std::array<VertexId, 6> n;
    for (const CellFacet& facet : facets) {
      const std::size_t count = mesh_.nodes_of(facet, n);
      if (count == 4) {
        std::rotate(n.begin(), std::min_element(n.begin(), n.begin() + 4), n.begin() + 4);
        part.triangles.push_back({n[0], n[2], n[3]});
      }
      part.triangles.push_back({n[0], n[1], n[2]});
    }
  }

 private:
  const FileMesh& mesh_;
  const LabelNames& names_;
};

/// The vertices that a part uses, numbered anew in their order.
struct Compact {
  std::vector<VertexId> vertices;
  std::vector<std::uint32_t> number;  // of every vertex of the mesh

  Compact(const SurfaceMesh& surface, const SurfacePart& part) : number(surface.points.size(), 0) {
    for (const Triangle& triangle : part.triangles) {
      for (const VertexId v : triangle) number[v] = 1;
    }
    for (std::size_t v = 0; v < number.size(); ++v) {
      if (number[v] == 0) continue;
      number[v] = static_cast<std::uint32_t>(vertices.size());
      vertices.push_back(static_cast<VertexId>(v));
    }
  }
};

template <typename T>
void add_raw(TextFile& out, const T& value) {
  out.add_bytes(std::as_bytes(std::span(&value, 1)));
}

std::array<float, 3> floats_of(const Vec3& p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

/// Not "solid" at the beginning, which stands for text.
void write_stl(const SurfaceMesh& surface, const SurfacePart& part, const fs::path& path,
               const std::string& coordinates) {
  std::string header = "CBC3D " + coordinates + " " + part.name;
  header.resize(80, ' ');
  TextFile out(path);
  out.add(header);
  add_raw(out, static_cast<std::uint32_t>(part.triangles.size()));
  for (const Triangle& t : part.triangles) {
    const Vec3 a = surface.points[t[0]], b = surface.points[t[1]], c = surface.points[t[2]];
    for (const Vec3& p : {(b - a).cross(c - a).normalized(), a, b, c}) add_raw(out, floats_of(p));
    add_raw(out, std::uint16_t{0});
  }
  out.close();
}

void write_ply(const SurfaceMesh& surface, const SurfacePart& part, const fs::path& path,
               const std::string& coordinates) {
  const Compact used(surface, part);
  TextFile out(path);
  out.add(
      "ply\nformat binary_little_endian 1.0\ncomment CBC3D ", part.name, ", coordinates ", coordinates,
      "\nelement vertex ", used.vertices.size(),
      "\nproperty double x\nproperty double y\nproperty double z\nproperty uchar red\nproperty uchar green\n"
      "property uchar blue\nelement face ",
      part.triangles.size(), "\nproperty list uchar int vertex_indices\nend_header\n");
  for (const VertexId v : used.vertices) {
    add_raw(out, surface.points[v]);
    add_raw(out, part.colour);
  }
  for (const Triangle& t : part.triangles) {
    add_raw(out, std::uint8_t{3});
    for (const VertexId v : t) add_raw(out, used.number[v]);
  }
  out.close();
}

void write_obj(const SurfaceMesh& surface, const fs::path& path, const std::string& coordinates) {
  SurfacePart whole;
  for (const SurfacePart& part : surface.parts) {
    whole.triangles.insert(whole.triangles.end(), part.triangles.begin(), part.triangles.end());
  }
  const Compact used(surface, whole);
  TextFile out(path);
  out.add("# CBC3D, coordinates ", coordinates, '\n');
  for (const VertexId v : used.vertices) {
    out.add("v ");
    out.add_point(surface.points[v], " ");
    out.add('\n');
  }
  for (const SurfacePart& part : surface.parts) {
    out.add("g ", part.name, '\n');
    for (const Triangle& t : part.triangles) {
      out.add('f');
      for (const VertexId v : t) out.add(' ', used.number[v] + 1);
      out.add('\n');
    }
  }
  out.close();
}

/// glTF 2.0 (Khronos Group), binary container: a node, mesh and material for each part, all in one buffer.
/// Its unit is the metre, so that the nodes scale the millimetres; indices of voxels stay as they are.
class Gltf {
 public:
  Gltf(const SurfaceMesh& surface, const std::string& coordinates)
      : surface_(surface), scale_(coordinates == "voxel" ? 1.0 : kMetresPerMillimetre) {
    json_ = {
        {"asset", {{"version", "2.0"}, {"generator", "CBC3D"}, {"extras", {{"coordinates", coordinates}}}}},
        {"scene", 0}};
    for (const SurfacePart& part : surface.parts) {
      if (!part.triangles.empty()) add(part);
    }
    json_["buffers"] = {{{"byteLength", data_.size()}}};
  }

  void write(const fs::path& path) const {
    constexpr std::uint32_t kMagic = 0x46546C67, kVersion = 2, kJson = 0x4E4F534A, kBinary = 0x004E4942;
    std::string text = json_.dump();
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const std::size_t total = 12 + 8 + text.size() + 8 + data_.size();
    if (total > 0xFFFFFFFFU) throw InputError("the surface is too large for a .glb file; write .ply instead");
    TextFile out(path);
    for (const std::size_t word :
         {std::size_t{kMagic}, std::size_t{kVersion}, total, text.size(), std::size_t{kJson}}) {
      add_raw(out, static_cast<std::uint32_t>(word));
    }
    out.add(text);
    add_raw(out, static_cast<std::uint32_t>(data_.size()));
    add_raw(out, kBinary);
    out.add(data_);
    out.close();
  }

 private:
  template <typename T>
  void append(const T& value) {
    data_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  std::size_t add_accessor(std::size_t begin, int target, int component, std::size_t count,
                           const char* type) {
    json_["bufferViews"].push_back(
        {{"buffer", 0}, {"byteOffset", begin}, {"byteLength", data_.size() - begin}, {"target", target}});
    json_["accessors"].push_back({{"bufferView", json_["bufferViews"].size() - 1},
                                  {"componentType", component},
                                  {"count", count},
                                  {"type", type}});
    return json_["accessors"].size() - 1;
  }
  std::size_t add_positions(const Compact& used) {
    constexpr int kArrayBuffer = 34962, kFloat = 5126;
    const std::size_t begin = data_.size();
    std::array<float, 3> low = floats_of(surface_.points[used.vertices[0]]), high = low;
    for (const VertexId v : used.vertices) {
      const std::array<float, 3> p = floats_of(surface_.points[v]);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], p[axis]);
        high[axis] = std::max(high[axis], p[axis]);
      }
      append(p);
    }
    const std::size_t accessor = add_accessor(begin, kArrayBuffer, kFloat, used.vertices.size(), "VEC3");
    json_["accessors"][accessor]["min"] = low;
    json_["accessors"][accessor]["max"] = high;
    return accessor;
  }
  std::size_t add_indices(const Compact& used, const SurfacePart& part) {
    constexpr int kElementBuffer = 34963, kUnsigned = 5125;
    const std::size_t begin = data_.size();
    for (const Triangle& t : part.triangles) {
      for (const VertexId v : t) append(used.number[v]);
    }
    return add_accessor(begin, kElementBuffer, kUnsigned, 3 * part.triangles.size(), "SCALAR");
  }
  void add(const SurfacePart& part) {
    const Compact used(surface_, part);
    const std::size_t number = json_["nodes"].size();
    const auto linear = [](std::uint8_t c) { return std::pow(c / 255.0, 2.2); };  // from sRGB
    json_["materials"].push_back(
        {{"name", part.name},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {linear(part.colour[0]), linear(part.colour[1]), linear(part.colour[2]), 1.0}},
           {"metallicFactor", 0.0},
           {"roughnessFactor", 0.8}}}});
    const std::size_t positions = add_positions(used);
    json_["meshes"].push_back({{"name", part.name},
                               {"primitives",
                                {{{"attributes", {{"POSITION", positions}}},
                                  {"indices", add_indices(used, part)},
                                  {"material", number}}}}});
    json_["nodes"].push_back({{"name", part.name}, {"mesh", number}, {"scale", {scale_, scale_, scale_}}});
    json_["scenes"][0]["nodes"].push_back(number);
  }

  static constexpr double kMetresPerMillimetre = 0.001;

  const SurfaceMesh& surface_;
  double scale_;
  nlohmann::json json_;
  std::string data_;
};

bool has_parts(const std::string& extension) {
  return extension == ".obj" || extension == ".glb";
}

void write_part(const SurfaceMesh& surface, const SurfacePart& part, const fs::path& path,
                const std::string& coordinates) {
  AtomicFile file(path);
  file.fill([&](const fs::path& temporary) {
    (path.extension() == ".stl" ? write_stl : write_ply)(surface, part, temporary, coordinates);
  });
}

}  // namespace

SurfaceMesh surface_of(const Mesh& mesh, SurfaceParts parts, const LabelNames& names) {
  const FileMesh view(mesh, {});
  const SurfaceBuilder builder(view, names);
  SurfaceMesh surface{mesh.points, {}};
  if (parts == SurfaceParts::all) surface.parts.push_back({.name = "all", .triangles = {}});
  for (const Label label : view.labels()) {
    if (parts == SurfaceParts::label) surface.parts.push_back(builder.part(names.identifier(label), label));
  }
  const auto part_of = [&](Label label) -> SurfacePart& {
    const auto& labels = view.labels();
    return surface.parts[static_cast<std::size_t>(std::lower_bound(labels.begin(), labels.end(), label) -
                                                  labels.begin())];
  };
  for (const Interface& interface : view.interfaces()) {
    if (parts == SurfaceParts::all) {
      builder.add(surface.parts[0], interface.facets);
    } else if (parts == SurfaceParts::interface) {
      surface.parts.push_back(builder.part(interface_name(interface, names), interface.label));
      builder.add(surface.parts.back(), interface.facets);
    } else {
      builder.add(part_of(interface.label), interface.facets);
      if (interface.other) builder.add(part_of(*interface.other), interface.opposite);
    }
  }
  return surface;
}

void require_writable_surface_path(const fs::path& path) {
  const std::string extension = path.extension().string();
  if (extension != ".stl" && extension != ".ply" && !has_parts(extension)) {
    throw InputError("'" + path.string() + "': unknown surface format '" + extension +
                     "'; use .stl, .ply, .obj or .glb");
  }
  require_writable(path);
}

std::vector<fs::path> write_surface(const SurfaceMesh& surface, const fs::path& path,
                                    const std::string& coordinates) {
  require_writable_surface_path(path);
  const std::string extension = path.extension().string();
  if (has_parts(extension)) {
    AtomicFile file(path);
    file.fill([&](const fs::path& temporary) {
      if (extension == ".obj") {
        write_obj(surface, temporary, coordinates);
      } else {
        Gltf(surface, coordinates).write(temporary);
      }
    });
    return {path};
  }
  std::vector<fs::path> files;
  for (const SurfacePart& part : surface.parts) {
    const fs::path name = surface.parts.size() == 1
                              ? path.filename()
                              : fs::path(path.stem().string() + "-" + part.name + extension);
    files.push_back(path.parent_path() / name);
    write_part(surface, part, files.back(), coordinates);
  }
  return files;
}

}  // namespace cbc3d
