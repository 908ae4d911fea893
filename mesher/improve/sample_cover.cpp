#include "mesher/improve/sample_cover.hpp"

#include <algorithm>

#include "mesher/domain/tolerances.hpp"

namespace cbc3d {
namespace {

std::vector<MaterialSet> materials_at_vertices(const MaterialMesh& mesh) {
  const auto neighbours = tet_neighbours(mesh.tets, mesh.points.size());
  return vertex_materials(mesh.tets, mesh.materials, neighbours, mesh.points.size());
}

double distance_mm(const MaterialMesh& mesh, const SampleCover& cover, std::size_t s) {
  return (mesh.points[cover.covering[s]] - cover.samples[s].centre()).norm();
}

std::vector<std::size_t> uncovered_ones(const SampleCover& cover) {
  std::vector<std::size_t> uncovered;
  for (std::size_t s = 0; s < cover.samples.size(); ++s) {
    if (cover.covering[s] == kNoVertex) {
      uncovered.push_back(s);
    }
  }
  return uncovered;
}

std::vector<BoundarySample> samples_at(const SampleCover& cover, const std::vector<std::size_t>& indices) {
  std::vector<BoundarySample> samples;
  samples.reserve(indices.size());
  for (const std::size_t s : indices) {
    samples.push_back(cover.samples[s]);
  }
  return samples;
}

/// Covers what is beyond the reach, each sample by the nearest surface vertex of its own material.
void cover_far_samples(const MaterialMesh& mesh, const std::vector<MaterialSet>& sets, double slack_mm,
                       SampleCover& cover) {
  constexpr int kMostDoublings = 12;  // of the search radius
  cover.own_reach_mm.assign(cover.samples.size(), 0);
  std::vector<std::size_t> uncovered = uncovered_ones(cover);
  for (const std::size_t s : uncovered) {
    cover.samples[s].other = cover.samples[s].own;
  }
  double search_mm = cover.reach_mm;
  for (int doubling = 0; doubling < kMostDoublings && !uncovered.empty(); ++doubling, search_mm *= 2) {
    const std::vector<VertexId> found =
        nearest_covering_vertices(samples_at(cover, uncovered), mesh.points, sets, search_mm);
    std::vector<std::size_t> still_uncovered;
    for (std::size_t i = 0; i < uncovered.size(); ++i) {
      const std::size_t s = uncovered[i];
      if (found[i] == kNoVertex) {
        still_uncovered.push_back(s);
        continue;
      }
      cover.covering[s] = found[i];
      cover.own_reach_mm[s] = static_cast<float>(distance_mm(mesh, cover, s) + slack_mm);
    }
    uncovered = std::move(still_uncovered);
  }
}

}  // namespace

SampleCover cover_samples(const MaterialMesh& mesh, const Domain& domain, double reach_mm,
                          bool keep_distances) {
  SampleCover cover{domain.samples(), domain.covering_vertices(reach_mm), {}, reach_mm};
  if (!cover.covering.empty()) {
    return cover;
  }
  const std::vector<MaterialSet> sets = materials_at_vertices(mesh);
  cover.covering = nearest_covering_vertices(cover.samples, mesh.points, sets, reach_mm);
  if (keep_distances) {
    const double slack_mm = tolerances::kKeepSlack * domain.scale_mm();
    double farthest_mm = 0;
    for (std::size_t s = 0; s < cover.samples.size(); ++s) {
      if (cover.covering[s] != kNoVertex) {
        farthest_mm = std::max(farthest_mm, distance_mm(mesh, cover, s));
      }
    }
    cover_far_samples(mesh, sets, slack_mm, cover);
    cover.reach_mm = std::min(cover.reach_mm, farthest_mm + slack_mm);
  }
  return cover;
}

void cover_thin_samples(const MaterialMesh& mesh, const Domain& domain, double reach_mm, SampleCover& cover) {
  const double thin_reach_mm = std::min(reach_mm, domain.thin_reach_mm());
  cover.own_reach_mm.assign(cover.samples.size(), 0);
#pragma omp parallel for schedule(static)
  for (std::size_t s = 0; s < cover.samples.size(); ++s) {
    if (cover.covering[s] != kNoVertex && domain.is_thin(cover.samples[s])) {
      cover.own_reach_mm[s] =
          static_cast<float>(std::max(thin_reach_mm, tolerances::kThinSlack * distance_mm(mesh, cover, s)));
    }
  }
}

void cover_uncovered_samples(const MaterialMesh& mesh, SampleCover& cover) {
  const std::vector<std::size_t> uncovered = uncovered_ones(cover);
  if (uncovered.empty()) {
    return;
  }
  const std::vector<VertexId> found = nearest_covering_vertices(samples_at(cover, uncovered), mesh.points,
                                                                materials_at_vertices(mesh), cover.reach_mm);
  for (std::size_t i = 0; i < found.size(); ++i) {
    cover.covering[uncovered[i]] = found[i];
  }
}

bool has_far_samples(const MaterialMesh& mesh, const SampleCover& cover, double limit_mm) {
  bool any = false;
#pragma omp parallel for schedule(static) reduction(|| : any)
  for (std::size_t s = 0; s < cover.samples.size(); ++s) {
    const VertexId v = cover.covering[s];
    any = any || v == kNoVertex ||
          (mesh.points[v] - cover.samples[s].centre()).squared_norm() > limit_mm * limit_mm;
  }
  return any;
}

}  // namespace cbc3d
