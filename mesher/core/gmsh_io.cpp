#include "mesher/core/gmsh_io.hpp"

#include <cstdio>
#include <fstream>
#include <string>
#include <unordered_map>

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

void read_nodes(std::istream& in, Mesh& mesh, NodeNumbers& numbers, const std::filesystem::path& path) {
  std::size_t count = 0;
  in >> count;
  for (std::size_t v = 0; v < count; ++v) {
    long long number = 0;
    Vec3 p;
    if (!(in >> number >> p[0] >> p[1] >> p[2])) {
      fail(path, "it ends within its nodes (truncated); export it again");
    }
    numbers[number] = static_cast<VertexId>(mesh.points.size());
    mesh.points.push_back(p);
  }
}

template <int Nodes>
void read_cell(std::istream& in, CellBlock<Nodes>& block, Label label, const NodeNumbers& numbers,
               const std::filesystem::path& path) {
  std::array<VertexId, Nodes> cell{};
  for (VertexId& v : cell) {
    long long number = 0;
    in >> number;
    const auto found = numbers.find(number);
    if (!in || found == numbers.end()) {
      fail(path, "an element names the node " + std::to_string(number) + ", which is not there");
    }
    v = found->second;
  }
  block.add(cell, label);
}

void read_element(std::istream& in, Mesh& mesh, const NodeNumbers& numbers,
                  const std::filesystem::path& path) {
  long long number = 0;
  int type = 0;
  int tags = 0;
  if (!(in >> number >> type >> tags)) {
    fail(path, "it ends within its elements (truncated); export it again");
  }
  Label label = 0;
  for (int t = 0; t < tags; ++t) {
    Label tag = 0;
    in >> tag;
    label = t == 0 ? tag : label;
  }
  switch (type) {
    case kTet:
      return read_cell(in, mesh.tets, label, numbers, path);
    case kHex:
      return read_cell(in, mesh.hexes, label, numbers, path);
    case kWedge:
      return read_cell(in, mesh.wedges, label, numbers, path);
    case kPyramid:
      return read_cell(in, mesh.pyramids, label, numbers, path);
    case 1:
    case 2:
    case 3:
    case 15: {  // lines, triangles, quads, points: boundary markers of other tools
      std::string rest;
      std::getline(in, rest);
      return;
    }
    default:
      fail(path,
           "it has elements of Gmsh type " + std::to_string(type) + "; known are linear volume elements");
  }
}

}  // namespace

void write_gmsh(const Mesh& mesh, const std::filesystem::path& path) {
  const std::vector<Label> labels = labels_of(mesh);
  if (!labels.empty() && labels.front() <= 0) {
    throw InputError("cannot write '" + path.string() +
                     "': Gmsh's physical groups must be positive and the mesh has label " +
                     std::to_string(labels.front()) + "; write .vtu instead");
  }
  std::FILE* out = std::fopen(path.c_str(), "wb");
  if (out == nullptr) {
    throw JobError("cannot write '" + path.string() + "': the file cannot be created");
  }
  std::fprintf(out, "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n%zu\n", labels.size());
  for (const Label label : labels) {
    std::fprintf(out, "3 %d \"label_%d\"\n", label, label);
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
  std::ifstream in(path);
  Mesh mesh;
  NodeNumbers numbers;
  bool version_seen = false;
  for (std::string line; std::getline(in, line);) {
    if (line.rfind("$MeshFormat", 0) == 0) {
      double version = 0;
      int binary = 0;
      in >> version >> binary;
      if (!in || version < 2 || version >= 3 || binary != 0) {
        fail(path, "only version 2.2 text files are known; export it with `gmsh -format msh22`");
      }
      version_seen = true;
    } else if (line.rfind("$Nodes", 0) == 0) {
      read_nodes(in, mesh, numbers, path);
    } else if (line.rfind("$Elements", 0) == 0) {
      std::size_t count = 0;
      in >> count;
      for (std::size_t e = 0; e < count; ++e) {
        read_element(in, mesh, numbers, path);
      }
    }
  }
  if (!version_seen || mesh.cell_count() == 0) {
    fail(path, "not a Gmsh file with volume elements");
  }
  return mesh;
}

}  // namespace cbc3d
