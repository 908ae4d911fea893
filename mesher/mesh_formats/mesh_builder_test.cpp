#include "mesher/mesh_formats/mesh_builder.hpp"

#include <gtest/gtest.h>

#include "mesher/core/error.hpp"

namespace cbc3d {
namespace {

MeshBuilder builder() {
  return MeshBuilder([](const std::string& what) { throw InputError(what); });
}

TEST(MeshBuilder, NumbersOfNodesMayBeAny) {
  for (const std::vector<std::int64_t>& numbers :
       {std::vector<std::int64_t>{1, 2, 3, 4}, {-5, -4, -3, -2}, {10, 7, 300, 8}, {1, 2, 9000000000, 4}}) {
    MeshBuilder nodes = builder();
    for (std::size_t n = 0; n < 4; ++n) nodes.add_node(numbers[n], {static_cast<double>(n), 0, 0});
    nodes.add_cell(CellKind::tet, std::vector<std::int64_t>{numbers[3], numbers[0], numbers[1], numbers[2]},
                   7);
    const Mesh mesh = nodes.take();
    EXPECT_EQ(mesh.tets.nodes[0], (std::array<VertexId, 4>{3, 0, 1, 2}));
    EXPECT_EQ(mesh.tets.labels[0], 7);
  }
}

TEST(MeshBuilder, RefusesWhatDoesNotGoTogether) {
  MeshBuilder nodes = builder();
  for (int n = 0; n < 4; ++n) nodes.add_node(n, {});
  EXPECT_THROW(nodes.add_cell(CellKind::tet, std::vector<std::int64_t>{0, 1, 2, 4}, 1), InputError);
  EXPECT_THROW(nodes.add_cell(CellKind::tet, std::vector<std::int64_t>{0, 1, 2, -1}, 1), InputError);
  EXPECT_THROW(nodes.add_cell(CellKind::hex, std::vector<std::int64_t>{0, 1, 2, 3}, 1), InputError);
  EXPECT_THROW(nodes.add_node(2, {}), InputError);
  EXPECT_THROW(nodes.take(), InputError);
}

}  // namespace
}  // namespace cbc3d
