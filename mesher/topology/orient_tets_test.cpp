// Tets of random orientation, made one.
#include <gtest/gtest.h>

#include <array>
#include <random>
#include <utility>
#include <vector>

#include "mesher/core/error.hpp"
#include "mesher/testing/kuhn_box.hpp"
#include "mesher/topology/orient_tets.hpp"

namespace cbc3d {
namespace {

MaterialMesh box() {
  const testing::KuhnBox from(3);
  return {from.points, from.tets, std::vector<MaterialId>(from.tets.size(), 1), {}, {}};
}

TEST(OrientTets, MirroredOnesAreTurnedBack) {
  std::mt19937 random(4);
  for (const unsigned one_in : {2U, 9U, 1U}) {
    MaterialMesh mesh = box();
    std::size_t mirrored = 0;
    for (auto& tet : mesh.tets) {
      if (random() % one_in == 0) {
        std::swap(tet[1], tet[3]);
        ++mirrored;
      }
    }
    EXPECT_EQ(count_not_positive(mesh), mirrored);
    const OrientReport report = orient_tets(mesh);
    EXPECT_EQ(report.turned, mirrored);
    EXPECT_EQ(report.not_positive, 0U);
    EXPECT_EQ(report.degenerate, 0U);
    EXPECT_EQ(count_not_positive(mesh), 0U);
  }
}

TEST(OrientTets, TangledOnesAreLeftAndDegenerateOnesTakenOut) {
  MaterialMesh mesh = box();
  const std::size_t tets = mesh.tets.size();
  mesh.tets.push_back({0, 1, 1, 5});
  mesh.materials.push_back(1);
  mesh.points[21] = {2.5, 2.5, 2.5};  // the vertex (1, 1, 1), drawn through its neighbours
  const OrientReport report = orient_tets(mesh);
  EXPECT_EQ(report.degenerate, 1U);
  EXPECT_EQ(mesh.tets.size(), tets);
  EXPECT_EQ(report.turned, 0U);
  EXPECT_GT(report.not_positive, 0U);
  EXPECT_EQ(report.not_positive, count_not_positive(mesh));
}

TEST(OrientTets, AFaceOfThreeTetsIsRefused) {
  MaterialMesh mesh = box();
  mesh.points.push_back({1, 2, 7});
  std::array<VertexId, 4> third = mesh.tets[0];
  third[0] = static_cast<VertexId>(mesh.points.size() - 1);
  mesh.tets.push_back(third);
  mesh.tets.push_back(third);
  mesh.materials.insert(mesh.materials.end(), 2, 1);
  EXPECT_THROW(orient_tets(mesh), InputError);
}

}  // namespace
}  // namespace cbc3d
