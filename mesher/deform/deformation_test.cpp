// The deformation: its points, its system, its quality control.
#include <gtest/gtest.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "mesher/deform/deform_mesh.hpp"
#include "mesher/pipeline/mesh_image.hpp"
#include "mesher/pipeline/presets.hpp"
#include "mesher/testing/test_images.hpp"
#include "mesher/topology/cell_quality.hpp"

namespace cbc3d {
namespace {

MaterialMesh mesh_of(const LabelImage& image, const MeshImageOptions& options) {
  Progress quiet;
  MeshImageReport report;
  return to_material_mesh(mesh_image(image, options, quiet, report), image);
}

MaterialMesh lattice_of(const LabelImage& image, double spacing_mm, bool mixed = false) {
  MeshImageOptions options = preset_options("paper", image.frame);
  options.lattice_spacing_mm = spacing_mm;
  options.mixed = mixed;
  options.deform.iterations = 0;
  return mesh_of(image, options);
}

// ---- points
// -------------------------------------------------------------------------------------------------------

/// What extract_target_points promises, voxel by voxel.
std::size_t count_by_rule(const LabelImage& image, Connectivity connectivity) {
  const int most = connectivity == Connectivity::vertex ? 3 : connectivity == Connectivity::edge ? 2 : 1;
  std::set<Index3> accepted;
  for (std::size_t v = 0; v < image.voxels.size(); ++v) {
    const Index3 at = image.frame.index_of(v);
    if (image.voxels[v] == 0 || !is_boundary_voxel(image, at[0], at[1], at[2])) {
      continue;
    }
    const bool barred = connectivity != Connectivity::no &&
                        std::any_of(accepted.begin(), accepted.end(), [&](const Index3& o) {
                          const std::array<int, 3> d = {std::abs(o[0] - at[0]), std::abs(o[1] - at[1]),
                                                        std::abs(o[2] - at[2])};
                          return std::max({d[0], d[1], d[2]}) == 1 && d[0] + d[1] + d[2] <= most;
                        });
    if (!barred) {
      accepted.insert(at);
    }
  }
  return accepted.size();
}

TEST(TargetPoints, FollowTheRuleAtAnyThreadCount) {
  for (const std::uint32_t seed : {1U, 2U}) {
    const LabelImage image = testing::noise_image(11, 0.6, seed);
    for (const Connectivity c :
         {Connectivity::vertex, Connectivity::edge, Connectivity::face, Connectivity::no}) {
      for (const int threads : {1, 2}) {
        omp_set_num_threads(threads);
        LabelSets sets;
        EXPECT_EQ(extract_target_points(image, c, sets).targets.size(), count_by_rule(image, c));
      }
    }
  }
}

TEST(TargetPoints, OfASolidBlock) {
  // A face of 4x4 voxels of an 8x4x4 block at the image's border: the shell has 8*4*4 - 6*2*2 voxels.
  const LabelImage image = testing::make_image({8, 4, 4}, {1, 1, 1}, 1, [](const Vec3&) { return 1; });
  LabelSets sets;
  const TargetPoints points = extract_target_points(image, Connectivity::no, sets);
  EXPECT_EQ(points.targets.size(), 8U * 16 - 6 * 4);
  for (const TargetPoint& t : points.targets) {
    EXPECT_EQ(sets[t.set].size(), 2U);
    EXPECT_FALSE(t.lower_side) << "the outside is the lower material";
  }
}

TEST(LabelSet, IsOrderedAndKeepsTheLowest) {
  LabelSet set;
  for (const MaterialId m : {7, 3, 7, 9, 1}) {
    set.insert(m);
  }
  ASSERT_EQ(set.size(), 4U);
  EXPECT_EQ(set[0], 1);
  EXPECT_EQ(set[3], 9);
  LabelSet pair;
  pair.insert(9);
  pair.insert(3);
  EXPECT_TRUE(pair.is_within(set));
  EXPECT_FALSE(set.is_within(pair));
  LabelSet down;
  LabelSet up;
  for (MaterialId m = 0; m < 12; ++m) {
    up.insert(m);
    down.insert(static_cast<MaterialId>(11 - m));
  }
  EXPECT_EQ(up.size(), LabelSet::kMost);
  EXPECT_EQ(up, down);
}

TEST(SourcePoints, KnowTheMaterialsThatMeet) {
  const LabelImage image = testing::make_image({30, 30, 20}, {1, 1, 1}, 2, [](const Vec3& p) {
    const bool inside = p.x > 4 && p.x < 25 && p.y > 4 && p.y < 25 && p.z > 4 && p.z < 15;
    return inside ? (p.x < 15 ? 1 : 2) : 0;
  });
  const MaterialMesh mesh = lattice_of(image, 5);
  const VertexCells around = cells_of_vertices(mesh);
  LabelSets sets;
  const SourcePoints points = extract_source_points(mesh, around, sets);
  std::set<std::size_t> sizes;
  for (const SourcePoint& s : points.sources) {
    std::set<MaterialId> materials;
    for (const CellId c : around.of(s.vertex)) {
      materials.insert(mesh.material_of(c));
    }
    const LabelSet& set = sets[s.set];
    sizes.insert(set.size());
    EXPECT_EQ(s.two_sided, set.size() == 2);
    for (std::size_t i = 0; i < set.size(); ++i) {
      EXPECT_TRUE(set[i] == kBackground || materials.count(set[i]) == 1);
    }
    EXPECT_EQ(set.size() - (set[0] == kBackground ? 1 : 0), materials.size());
  }
  EXPECT_EQ(sizes, (std::set<std::size_t>{2, 3})) << "faces, and the rim where both labels meet the outside";
}

// ---- displacements
// ------------------------------------------------------------------------------------------------

struct Prepared {
  Prepared(const LabelImage& picture, MaterialMesh given)
      : image(picture),
        mesh(std::move(given)),
        sources(extract_source_points(mesh, cells_of_vertices(mesh), sets)),
        targets(extract_target_points(image, Connectivity::no, sets)) {}
  [[nodiscard]] std::vector<SourceDisplacement> displacements(const DisplacementOptions& options) const {
    return SourceDisplacements({sources, targets, sets, image.frame}, options).at(mesh.points);
  }
  const LabelImage& image;
  MaterialMesh mesh;
  LabelSets sets;
  SourcePoints sources;
  TargetPoints targets;
};

/// Mean distance of the moved sources from a sphere.
double mean_miss(const Prepared& p, const DisplacementOptions& options, double radius) {
  const auto found = p.displacements(options);
  double sum = 0;
  for (std::size_t s = 0; s < found.size(); ++s) {
    const Vec3 at = p.mesh.points[p.sources.sources[s].vertex] + found[s].vector;
    sum += (at - testing::centre_of(p.image)).norm() - radius;
  }
  return sum / static_cast<double>(found.size());
}

TEST(SourceDisplacements, VoxelFacesHaveNoBiasAndCentresHalfAVoxel) {
  const LabelImage image = testing::ball_image(44, 1, 17);
  const Prepared p(image, lattice_of(image, 6));
  DisplacementOptions options;
  options.target_position = TargetPosition::voxel_faces;
  EXPECT_LT(std::abs(mean_miss(p, options, 17)), 0.15);
  options.target_position = TargetPosition::voxel_centre;
  const double bias = mean_miss(p, options, 17);
  EXPECT_LT(bias, -0.3);
  EXPECT_GT(bias, -0.7);
}

TEST(SourceDisplacements, ReachWhatTheRegionMisses) {
  // A mesh shifted by 3 mm: most sources have no target within an edge.
  const LabelImage image = testing::ball_image(44, 1, 15);
  MaterialMesh mesh = lattice_of(image, 3);
  for (Vec3& x : mesh.points) {
    x.x += 3;
  }
  const Prepared p(image, mesh);
  const auto matched = [&](double reach) {
    DisplacementOptions options;
    options.pair_distance = 0;
    options.reach = reach;
    const auto found = p.displacements(options);
    return std::count_if(found.begin(), found.end(), [](const SourceDisplacement& d) { return d.matched; });
  };
  EXPECT_LT(matched(1), matched(3));
  EXPECT_EQ(matched(5), static_cast<std::ptrdiff_t>(p.sources.sources.size()));
}

TEST(SourceDisplacements, LeaveNoPairTooFarApart) {
  const LabelImage image = testing::ball_image(30, 1, 10);
  const Prepared p(image, lattice_of(image, 3));
  for (const double most : {0.5, 0.8}) {
    DisplacementOptions options;
    options.pair_distance = most;
    const auto found = p.displacements(options);
    for (std::size_t s = 0; s < found.size(); ++s) {
      const Vec3 at = p.mesh.points[p.sources.sources[s].vertex] + found[s].vector;
      double nearest = 1e9;
      for (std::size_t v = 0; v < image.voxels.size(); ++v) {
        const Index3 i = image.frame.index_of(v);
        if (image.voxels[v] != 0 && is_boundary_voxel(image, i[0], i[1], i[2])) {
          nearest = std::min(nearest, (image.frame.local_centre(i[0], i[1], i[2]) - at).norm());
        }
      }
      // A source that a target pulls is at that distance from this target, and no other's.
      EXPECT_LE(nearest, most * image.frame.voxel_diagonal_mm() + 1e-6);
    }
  }
}

/// A plate of one layer of blocks, six tets each (Kuhn's), all of material 1.
MaterialMesh plate(int blocks, double edge_mm, double z_low, double z_high) {
  MaterialMesh mesh;
  const auto node = [&](int i, int j, int k) {
    return static_cast<VertexId>((k * (blocks + 1) + j) * (blocks + 1) + i);
  };
  for (int k = 0; k < 2; ++k) {
    for (int j = 0; j <= blocks; ++j) {
      for (int i = 0; i <= blocks; ++i) {
        mesh.points.push_back({4 + edge_mm * i, 4 + edge_mm * j, k == 0 ? z_low : z_high});
      }
    }
  }
  const std::array<std::array<int, 3>, 6> orders = {
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {1, 0, 2}, {2, 1, 0}}};
  for (int j = 0; j < blocks; ++j) {
    for (int i = 0; i < blocks; ++i) {
      for (std::size_t o = 0; o < orders.size(); ++o) {
        Index3 at = {i, j, 0};
        std::array<VertexId, 4> tet = {node(at[0], at[1], at[2])};
        for (std::size_t n = 0; n < 3; ++n) {
          ++at[static_cast<std::size_t>(orders[o][n])];
          tet[n + 1] = node(at[0], at[1], at[2]);
        }
        if (o >= 3) {
          std::swap(tet[2], tet[3]);
        }
        mesh.tets.push_back(tet);
        mesh.materials.push_back(1);
      }
    }
  }
  return mesh;
}

TEST(SourceDisplacements, TheFarSideOfAThinWallPullsOnlyWhenLetTo) {
  // Edges of 4 mm on a plate of 3 mm: the far side's voxels lie within every source's region.
  const LabelImage image = testing::make_image({40, 40, 16}, {1, 1, 1}, 1, [](const Vec3& p) {
    return p.x > 3 && p.x < 37 && p.y > 3 && p.y < 37 && p.z > 6.5 && p.z < 9.5 ? 1 : 0;
  });
  const Prepared p(image, plate(8, 4, 6.2, 9.8));
  const auto thickness = [&](bool reject) {
    DisplacementOptions options;
    options.reject_outliers = reject;
    options.pair_distance = 0;
    const auto found = p.displacements(options);
    double thick = 0;
    double count = 0;
    for (std::size_t s = 0; s < found.size(); ++s) {
      const Vec3 from = p.mesh.points[p.sources.sources[s].vertex];
      if (std::abs(from.x - 20) < 9 && std::abs(from.y - 20) < 9) {
        thick += (from.z > 8 ? 2 : -2) * (from + found[s].vector).z;
        count += 1;
      }
    }
    return thick / count;
  };
  EXPECT_NEAR(thickness(true), 2, 1e-9) << "between the centres of the outer layers of voxels";
  EXPECT_LT(thickness(false), 1.2);
}

TEST(SourceDisplacements, JunctionsHaveTargetsOfTheirOwn) {
  const LabelImage image = testing::make_image({36, 36, 24}, {1, 1, 1}, 2, [](const Vec3& p) {
    const bool inside = (p - Vec3{17.5, 17.5, 11.5}).norm() < 10;
    return inside ? (p.x < 17 ? 1 : 2) : 0;
  });
  const Prepared p(image, lattice_of(image, 4));
  const auto found = p.displacements({});
  std::size_t junctions = 0;
  for (std::size_t s = 0; s < found.size(); ++s) {
    if (!p.sources.sources[s].two_sided) {
      ++junctions;
      EXPECT_TRUE(found[s].matched);
      const Vec3 at = p.mesh.points[p.sources.sources[s].vertex] + found[s].vector;
      EXPECT_LT(std::abs(at.x - 16.5), 1.5) << "near the plane between the labels";
    }
  }
  EXPECT_GT(junctions, 10U);
}

// ---- the system
// ---------------------------------------------------------------------------------------------------

TEST(ElasticSystem, SolvesToTheToleranceItTells) {
  const LabelImage image = testing::ball_image(30, 1, 10);
  const MaterialMesh mesh = lattice_of(image, 4);
  const VertexCells around = cells_of_vertices(mesh);
  ElasticityOptions options;
  options.solver.tolerance = 1e-6;
  ElasticSystem system(mesh, around, {{}, {}}, options);
  std::vector<std::uint8_t> sources(mesh.points.size(), 0);
  std::vector<Vec3> load(mesh.points.size());
  for (std::size_t v = 0; v < sources.size(); v += 7) {
    sources[v] = 1;
    load[v] = {0.1 * std::sin(static_cast<double>(v)), 0.2, -0.1};
  }
  system.assemble(mesh, sources);
  std::vector<Vec3> u(mesh.points.size());
  const SolveReport report = system.solve(load, u);
  EXPECT_GT(report.iterations, 0);
  std::vector<Vec3> product(u.size());
  system.multiply(u, product);
  double residual = 0;
  double scale = 0;
  for (std::size_t v = 0; v < u.size(); ++v) {
    residual += (load[v] - product[v]).squared_norm();
    scale += load[v].squared_norm();
  }
  EXPECT_LE(std::sqrt(residual / scale), 2e-6);
  EXPECT_LE(report.relative_residual, 1e-6);
  EXPECT_LE(system.solve(load, u).iterations, 2) << "a warm start has little to do";
}

TEST(ElasticSystem, StiffnessOfALabelIsItsOwn) {
  const LabelImage image = testing::ball_image(30, 1, 12, 6);
  const MaterialMesh mesh = lattice_of(image, 4, true);
  const VertexCells around = cells_of_vertices(mesh);
  const std::vector<std::uint8_t> none(mesh.points.size(), 0);
  std::vector<Vec3> u(mesh.points.size());
  for (std::size_t v = 0; v < u.size(); ++v) {
    u[v] = {std::sin(mesh.points[v].x), std::cos(mesh.points[v].y), 0.1 * mesh.points[v].z};
  }
  const auto force = [&](const std::vector<ElasticMaterial>& materials) {
    ElasticSystem system(mesh, around, materials, {});
    system.assemble(mesh, none);
    std::vector<Vec3> f(u.size());
    system.multiply(u, f);
    return f;
  };
  const auto soft = force({{}, {2100, 0.45}, {2100, 0.45}});
  const auto hard = force({{}, {2100, 0.45}, {8400, 0.45}});  // a factor that floats scale by exactly
  for (std::size_t v = 0; v < u.size(); ++v) {
    const auto cells = around.of(static_cast<VertexId>(v));
    const auto of = [&](MaterialId m) {
      return std::all_of(cells.begin(), cells.end(), [&](CellId c) { return mesh.material_of(c) == m; });
    };
    if (of(1)) {
      EXPECT_EQ(hard[v], soft[v]);
    } else if (of(2)) {
      EXPECT_EQ(hard[v], 4 * soft[v]);
    }
  }
}

// ---- quality control
// ----------------------------------------------------------------------------------------------

/// The smallest dihedral angle of the tets, degrees, and the smallest scaled Jacobian of the other cells.
std::pair<double, double> worst(const MaterialMesh& mesh) {
  std::pair<double, double> smallest = {180, 1};
  for (CellId c = 0; c < mesh.cell_count(); ++c) {
    std::vector<Vec3> p;
    for (const VertexId v : mesh.nodes_of(c)) {
      p.push_back(mesh.points[v]);
    }
    if (p.size() == 4) {
      smallest.first = std::min(smallest.first, min_dihedral_deg(p[0], p[1], p[2], p[3]));
    } else {
      smallest.second =
          std::min(smallest.second, p.size() == 5 ? scaled_jacobian_pyramid(std::span<const Vec3, 5>(p))
                                                  : scaled_jacobian_hex(std::span<const Vec3, 8>(p)));
    }
  }
  return smallest;
}

TEST(QualityControl, HoldsBackWhatFailsAndNothingFar) {
  const LabelImage image = testing::ball_image(30, 1, 10);
  const MaterialMesh mesh = lattice_of(image, 4);
  const VertexCells around = cells_of_vertices(mesh);
  const QualityControl quality(mesh, around, {});
  std::vector<Vec3> displacement(mesh.points.size(), Vec3{0.1, 0, 0});
  displacement[100] = {30, 0, 0};  // through everything
  std::vector<Vec3> after = mesh.points;
  for (std::size_t v = 0; v < after.size(); ++v) {
    after[v] += displacement[v];
  }
  const auto failing = quality.failing(mesh.points, after);
  ASSERT_FALSE(failing.empty());
  const std::size_t held = quality.hold_back(mesh.points, failing, displacement, after);
  EXPECT_TRUE(quality.failing(mesh.points, after).empty());
  EXPECT_GE(held, 1U);
  EXPECT_LT(held, mesh.points.size() / 4);
  EXPECT_LT(displacement[100].norm(), 3);
  for (std::size_t v = 0; v < after.size(); ++v) {
    EXPECT_LT((after[v] - mesh.points[v] - displacement[v]).norm(), 1e-12);
  }
}

TEST(DeformMesh, NoCellFallsBelowTheMinimumWhateverTheImage) {
  for (const bool mixed : {false, true}) {
    for (const std::uint32_t seed : {3U, 4U}) {
      const LabelImage image = testing::noise_image(16, 0.3, seed);
      for (const OnFailure on_failure : {OnFailure::stop, OnFailure::recover}) {
        MeshImageOptions options = preset_options("paper", image.frame);
        options.lattice_spacing_mm = 4;
        options.mixed = mixed;
        options.deform.iterations = 20;
        options.deform.on_failure = on_failure;
        options.clean.manifold_voxels = false;
        const MaterialMesh mesh = mesh_of(image, options);
        ASSERT_GT(mesh.cell_count(), 0U);
        EXPECT_GE(worst(mesh).first, 5 - 1e-6);
        EXPECT_GE(worst(mesh).second, 0.2 - 1e-9);
        EXPECT_LT(worst(mesh).first, 29) << "the mesh has moved";
      }
    }
  }
}

TEST(DeformMesh, StopsAsThePaperDoesOrGoesOn) {
  const LabelImage image = testing::noise_image(16, 0.4, 9);
  const MaterialMesh start = lattice_of(image, 4);
  DeformOptions options;
  options.iterations = 6;
  options.displacement.along_normal = false;
  options.on_failure = OnFailure::stop;
  MaterialMesh stopped = start;
  const DeformReport first = deform_mesh(stopped, image, options, [](int) {});
  ASSERT_TRUE(first.stopped_early);
  EXPECT_LT(first.iterations.size(), 6U);
  EXPECT_EQ(first.iterations.back().attempts, 3);
  DeformOptions shorter = options;
  shorter.iterations = static_cast<int>(first.iterations.size()) - 1;
  MaterialMesh before = start;
  deform_mesh(before, image, shorter, [](int) {});
  EXPECT_EQ(stopped.points, before.points) << "the failed iteration is taken back";
  options.on_failure = OnFailure::recover;
  MaterialMesh recovered = start;
  const DeformReport second = deform_mesh(recovered, image, options, [](int) {});
  EXPECT_FALSE(second.stopped_early);
  EXPECT_EQ(second.iterations.size(), 6U);
  EXPECT_GT(second.iterations[0].held_vertices, 0U);
}

TEST(DeformMesh, SameBytesAtOneAndTwoThreads) {
  const LabelImage image = testing::ball_image(36, 1.1, 14, 7);
  const MaterialMesh start = lattice_of(image, 7, true);
  ASSERT_GT(start.hexes.size(), 0U);
  std::vector<MaterialMesh> results;
  for (const int threads : {1, 2}) {
    omp_set_num_threads(threads);
    results.push_back(start);
    DeformOptions options;
    options.iterations = 6;
    deform_mesh(results.back(), image, options, [](int) {});
  }
  EXPECT_EQ(results[0].points, results[1].points);
}

TEST(DeformMesh, TellsWhereItsTimeWent) {
  const LabelImage image = testing::ball_image(24, 1, 8);
  MaterialMesh mesh = lattice_of(image, 4);
  const DeformReport report = deform_mesh(mesh, image, {}, [](int) {});
  std::set<std::string> parts;
  for (const auto& [name, seconds] : report.part_seconds) {
    parts.insert(name);
    EXPECT_GE(seconds, 0);
  }
  EXPECT_EQ(parts,
            (std::set<std::string>{"extraction", "displacements", "assembly", "solve", "quality_control"}));
}

}  // namespace
}  // namespace cbc3d
