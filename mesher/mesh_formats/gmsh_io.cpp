#include "mesher/mesh_formats/gmsh_io.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <string>
#include <unordered_map>
#include <utility>

#include "mesher/core/error.hpp"

namespace cbc3d {
namespace {

// Gmsh element types. Its wedge has the normal of its first triangle towards the second, as ours has.
constexpr int kTet = 4;
constexpr int kHex = 5;
constexpr int kWedge = 6;
constexpr int kPyramid = 7;

template <int Nodes>
void write_block(std::FILE* out, const CellBlock<Nodes>& block, int type, std::size_t& number) {
  for (std::size_t c = 0; c < block.size(); ++c) {
    std::fprintf(out, "%zu %d 2 %d %d", ++number, type, block.labels[c], block.labels[c]);
    for (const VertexId v : block.nodes[c]) {
      std::fprintf(out, " %u", v + 1);
    }
    std::fputc('\n', out);
  }
}

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what) {
  throw InputError("cannot read '" + path.string() + "': " + what);
}

/// Node numbers of a file are arbitrary; ours count from 0.
using NodeNumbers = std::unordered_map<long long, VertexId>;

/// Reads the words of a file; what fails names it.
class GmshReader {
 public:
  explicit GmshReader(const std::filesystem::path& path)
      : path_(path), in_(path), bytes_(std::filesystem::file_size(path)) {
    if (!in_) {
      fail(path_, "the file cannot be opened; check its permissions");
    }
  }

  Mesh read() {
    bool version_seen = false;
    for (std::string line; std::getline(in_, line);) {
      if (line.starts_with("$MeshFormat")) {
        require_version();
        version_seen = true;
      } else if (line.starts_with("$Nodes")) {
        read_nodes();
      } else if (line.starts_with("$Elements")) {
        read_elements();
      }
    }
    if (!version_seen || mesh_.cell_count() == 0) {
      fail(path_, "not a Gmsh file with volume elements");
    }
    return std::move(mesh_);
  }

 private:
  template <typename T>
  T next(const char* what) {
    T value{};
    if (!(in_ >> value)) {
      fail(path_, std::string("it ends, or has what is no number, within its ") + what +
                      " (truncated or damaged); export it again");
    }
    return value;
  }

  /// A number of entries, each of which has so many bytes at least.
  std::uint64_t next_count(const char* what, std::uint64_t least_bytes) {
    const auto count = next<long long>(what);
    if (count < 0 || static_cast<std::uint64_t>(count) > bytes_ / least_bytes) {
      fail(path_, "it promises " + std::to_string(count) + " " + what +
                      ", for which the file is too short (truncated or damaged); export it again");
    }
    return static_cast<std::uint64_t>(count);
  }

  void require_version() {
    double version = 0;
    int binary = 0;
    in_ >> version >> binary;
    if (!in_ || !(version >= 2 && version < 3) || binary != 0) {
      fail(path_, "only version 2.2 text files are known; export it with `gmsh -format msh22`");
    }
  }

  /// A coordinate, "nan" and "inf" among them: streams do not read these words.
  double next_coordinate(long long node) {
    const auto word = next<std::string>("nodes");
    const std::size_t plus = word.starts_with('+') ? 1 : 0;
    double value = 0;
    const char* const last = word.data() + word.size();
    const auto [end, error] = std::from_chars(word.data() + plus, last, value);
    if (error != std::errc() || end != last || !std::isfinite(value)) {
      fail(path_, "node " + std::to_string(node) + " has the coordinate '" + word.substr(0, 40) +
                      "', which is no finite number (truncated or damaged); export it again");
    }
    return value;
  }

  void read_nodes() {
    constexpr std::uint64_t kLeastBytes = 8;  // "1 0 0 0" and the end of the line
    const std::uint64_t count = next_count("nodes", kLeastBytes);
    for (std::uint64_t v = 0; v < count; ++v) {
      const auto number = next<long long>("nodes");
      const double x = next_coordinate(number), y = next_coordinate(number), z = next_coordinate(number);
      if (!numbers_.emplace(number, static_cast<VertexId>(mesh_.points.size())).second) {
        fail(path_, "it has the node " + std::to_string(number) + " twice; export it again");
      }
      mesh_.points.push_back({x, y, z});
    }
  }

  template <int Nodes>
  void read_cell(CellBlock<Nodes>& block, Label label) {
    std::array<VertexId, Nodes> cell{};
    for (VertexId& v : cell) {
      const auto number = next<long long>("elements");
      const auto found = numbers_.find(number);
      if (found == numbers_.end()) {
        fail(path_, "an element names the node " + std::to_string(number) + ", which is not there");
      }
      v = found->second;
    }
    block.add(cell, label);
  }

  /// The first tag is the label.
  Label read_tags() {
    constexpr int kMostTags = 1000;
    const int tags = next<int>("elements");
    if (tags < 0 || tags > kMostTags) {
      fail(path_, "an element has " + std::to_string(tags) + " tags; the file is damaged, export it again");
    }
    Label label = 0;
    for (int t = 0; t < tags; ++t) {
      const Label tag = next<Label>("elements");
      label = t == 0 ? tag : label;
    }
    return label;
  }

  void read_elements() {
    constexpr std::uint64_t kLeastBytes = 6;  // "1 15 0" and the end of the line
    const std::uint64_t count = next_count("elements", kLeastBytes);
    for (std::uint64_t e = 0; e < count; ++e) {
      next<long long>("elements");
      const int type = next<int>("elements");
      read_nodes_of_element(type, read_tags());
    }
  }

  void read_nodes_of_element(int type, Label label) {
    switch (type) {
      case kTet:
        return read_cell(mesh_.tets, label);
      case kHex:
        return read_cell(mesh_.hexes, label);
      case kWedge:
        return read_cell(mesh_.wedges, label);
      case kPyramid:
        return read_cell(mesh_.pyramids, label);
      case 1:
      case 2:
      case 3:
      case 15: {  // lines, triangles, quads, points: boundary markers of other tools
        std::string rest;
        std::getline(in_, rest);
        return;
      }
      default:
        fail(path_,
             "it has elements of Gmsh type " + std::to_string(type) + "; known are linear volume elements");
    }
  }

  const std::filesystem::path& path_;
  std::ifstream in_;
  std::uint64_t bytes_;
  Mesh mesh_;
  NodeNumbers numbers_;
};

}  // namespace

void require_gmsh_labels(const std::vector<Label>& labels, const std::filesystem::path& path) {
  const auto lowest = std::min_element(labels.begin(), labels.end());
  if (lowest != labels.end() && *lowest <= 0) {
    throw InputError("cannot write '" + path.string() +
                     "': Gmsh's physical groups must be positive and there is the label " +
                     std::to_string(*lowest) + "; write .vtu instead");
  }
}

void write_gmsh(const Mesh& mesh, const std::filesystem::path& path, const LabelNames& names) {
  const std::vector<Label> labels = labels_of(mesh);
  require_gmsh_labels(labels, path);
  std::FILE* out = std::fopen(path.c_str(), "wb");
  if (out == nullptr) {
    throw JobError("cannot write '" + path.string() + "': the file cannot be created");
  }
  std::fprintf(out, "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n%zu\n", labels.size());
  for (const Label label : labels) {
    std::fprintf(out, "3 %d \"%s\"\n", label, names.identifier(label).c_str());
  }
  std::fprintf(out, "$EndPhysicalNames\n$Nodes\n%zu\n", mesh.points.size());
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    std::fprintf(out, "%zu %.17g %.17g %.17g\n", v + 1, mesh.points[v][0], mesh.points[v][1],
                 mesh.points[v][2]);
  }
  std::fprintf(out, "$EndNodes\n$Elements\n%zu\n", mesh.cell_count());
  std::size_t number = 0;
  write_block(out, mesh.tets, kTet, number);
  write_block(out, mesh.pyramids, kPyramid, number);
  write_block(out, mesh.wedges, kWedge, number);
  write_block(out, mesh.hexes, kHex, number);
  std::fputs("$EndElements\n", out);
  const bool failed = std::ferror(out) != 0;
  if (std::fclose(out) != 0 || failed) {
    throw JobError("cannot write '" + path.string() + "': the disk is full or the file cannot be written");
  }
}

Mesh read_gmsh(const std::filesystem::path& path) {
  return GmshReader(path).read();
}

}  // namespace cbc3d
