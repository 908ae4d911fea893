#include "mesher/improve/local/mesh_patches.hpp"

#include <omp.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mesher/improve/local/tet_shape.hpp"

namespace cbc3d {
namespace {

constexpr std::uint32_t kShared = 0xFFFFFFFEU;
constexpr VertexId kNew = 0x80000000U;
constexpr std::uint32_t kNowhere = 0xFFFFFFFFU;
constexpr std::size_t kFewTets = 2500;  // a mesh of this many tets or more has two patches, for two threads

/// Three orthogonal axes, turned in every round.
Mat3 axes_of_round(int round) {
  const double turn = 0.7 * round + 0.2;
  const double tilt = 0.5 * round + 0.1;
  const Mat3 about_z = {
      {Vec3{std::cos(turn), -std::sin(turn), 0}, Vec3{std::sin(turn), std::cos(turn), 0}, Vec3{0, 0, 1}}};
  const Mat3 about_x = {
      {Vec3{1, 0, 0}, Vec3{0, std::cos(tilt), -std::sin(tilt)}, Vec3{0, std::sin(tilt), std::cos(tilt)}}};
  return about_z * about_x;
}

/// Recursive bisection of the tets' centroids: parts of nearly equal size, each compact.
class Bisection {
 public:
  Bisection(const MaterialMesh& mesh, int round, std::size_t part_tets) {
    const std::size_t tets = mesh.tets.size();
    const Mat3 axes = axes_of_round(round);
    centroids_.resize(tets);
    order_.resize(tets);
#pragma omp parallel for schedule(static)
    for (std::size_t t = 0; t < tets; ++t) {
      Vec3 sum;
      for (const VertexId v : mesh.tets[t]) {
        sum += mesh.points[v];
      }
      centroids_[t] = axes * sum;
      order_[t] = static_cast<TetId>(t);
    }
    std::size_t parts = tets < kFewTets ? 1 : 2;
    while (parts * part_tets < tets) {
      parts *= 2;
    }
    first_ = {0, tets};
    while (first_.size() - 1 < parts) {
      split_all(round);
    }
  }

  [[nodiscard]] std::size_t parts() const {
    return first_.size() - 1;
  }
  /// The tets of a part, ascending.
  [[nodiscard]] std::vector<TetId> part(std::size_t p) const {
    std::vector<TetId> tets(order_.begin() + static_cast<std::ptrdiff_t>(first_[p]),
                            order_.begin() + static_cast<std::ptrdiff_t>(first_[p + 1]));
    std::sort(tets.begin(), tets.end());
    return tets;
  }

 private:
  void split_all(int round) {
    const std::size_t count = parts();
    std::vector<std::size_t> halves(2 * count + 1);
#pragma omp parallel for schedule(dynamic)
    for (std::size_t p = 0; p < count; ++p) {
      halves[2 * p] = first_[p];
      // Not exactly in the middle, and elsewhere in every round, so that cuts do not repeat.
      const double share = 0.5 + 0.06 * ((round + static_cast<int>(p)) % 3 - 1);
      halves[2 * p + 1] =
          first_[p] + static_cast<std::size_t>(share * static_cast<double>(first_[p + 1] - first_[p]));
      split(first_[p], halves[2 * p + 1], first_[p + 1]);
    }
    halves.back() = first_.back();
    first_ = std::move(halves);
  }

  void split(std::size_t begin, std::size_t middle, std::size_t end) {
    Vec3 low = {1e300, 1e300, 1e300};
    Vec3 high = {-1e300, -1e300, -1e300};
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3& c = centroids_[order_[i]];
      for (int axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], c[axis]);
        high[axis] = std::max(high[axis], c[axis]);
      }
    }
    const Vec3 size = high - low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto at = [&](std::size_t i) { return order_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(at(begin), at(middle), at(end), [&](TetId a, TetId b) {
      const double ca = centroids_[a][axis];
      const double cb = centroids_[b][axis];
      return ca != cb ? ca < cb : a < b;
    });
  }

  std::vector<Vec3> centroids_;
  std::vector<TetId> order_;
  std::vector<std::size_t> first_;
};

/// The part that has all tets of a vertex, kShared where there are several.
std::vector<std::uint32_t> owners(const MaterialMesh& mesh, const std::vector<std::vector<TetId>>& parts) {
  std::vector<std::uint32_t> owner(mesh.points.size(), kNowhere);
  for (std::uint32_t p = 0; p < parts.size(); ++p) {
    for (const TetId t : parts[p]) {
      for (const VertexId v : mesh.tets[t]) {
        owner[v] = owner[v] == kNowhere || owner[v] == p ? p : kShared;
      }
    }
  }
  return owner;
}

/// The samples that each vertex covers, in compressed rows.
struct SamplesOfVertices {
  std::vector<std::uint32_t> first;
  std::vector<SampleId> samples;

  SamplesOfVertices(const std::vector<VertexId>& covering, std::size_t vertices) : first(vertices + 1, 0) {
    for (const VertexId v : covering) {
      first[v == kNoVertex ? 0 : v + 1] += v == kNoVertex ? 0 : 1;
    }
    for (std::size_t v = 0; v < vertices; ++v) {
      first[v + 1] += first[v];
    }
    samples.resize(first.back());
    std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
    for (SampleId s = 0; s < covering.size(); ++s) {
      if (covering[s] != kNoVertex) {
        samples[next[covering[s]]++] = s;
      }
    }
  }
};

/// One part as a separate mesh: its vertices in ascending order of the whole mesh's.
struct LocalMesh {
  std::vector<VertexId> vertices;
  std::vector<Vec3> points;
  TetNodes tets;
  std::vector<MaterialId> materials;
  std::vector<std::uint8_t> hold;      // TetComplex::Hold
  std::vector<std::uint32_t> tets_at;  // number of tets around each vertex

  LocalMesh(const MaterialMesh& mesh, const std::vector<TetId>& part, const std::vector<std::uint32_t>& owner,
            std::span<const std::uint8_t> fixed) {
    for (const TetId t : part) {
      vertices.insert(vertices.end(), mesh.tets[t].begin(), mesh.tets[t].end());
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    tets_at.assign(vertices.size(), 0);
    for (const VertexId v : vertices) {
      points.push_back(mesh.points[v]);
      const bool stays = v < fixed.size() && fixed[v] != 0;
      hold.push_back(owner[v] == kShared ? TetComplex::kLocked
                     : stays             ? TetComplex::kFixed
                                         : TetComplex::kFree);
    }
    for (const TetId t : part) {
      std::array<VertexId, 4> nodes{};
      for (std::size_t n = 0; n < 4; ++n) {
        nodes[n] = static_cast<VertexId>(std::lower_bound(vertices.begin(), vertices.end(), mesh.tets[t][n]) -
                                         vertices.begin());
        ++tets_at[nodes[n]];
      }
      tets.push_back(nodes);
      materials.push_back(mesh.materials[t]);
    }
  }
};

/// Finds the materials of the stars; vertices whose star is not connected by faces are locked.
void set_up_vertices(Patch& patch, const std::vector<std::uint32_t>& tets_at) {
  for (VertexId v = 0; v < patch.mesh.vertex_count(); ++v) {
    if (patch.mesh.locked(v)) {
      continue;
    }
    patch.mesh.star(v, patch.star);
    const MaterialSet set = patch.mesh.materials(v, patch.star);
    if (patch.star.size() != tets_at[v] || set.overflow) {
      patch.mesh.lock(v);
    } else {
      patch.sets[v] = set;
    }
  }
}

struct PatchResult {
  TetNodes tets;            // new vertices as kNew and their number
  std::vector<Vec3> added;  // where those are
  std::vector<MaterialId> materials;
};

/// The tets of each part, and for every vertex the part that may move it.
struct Cut {
  std::vector<std::vector<TetId>> parts;
  std::vector<std::uint32_t> owner;

  Cut(const MaterialMesh& mesh, const PatchRules& rules, int round) {
    const Bisection bisection(mesh, round, rules.patch_tets);
    parts.resize(bisection.parts());
#pragma omp parallel for schedule(dynamic)
    for (std::size_t p = 0; p < parts.size(); ++p) {
      parts[p] = bisection.part(p);
    }
    owner = owners(mesh, parts);
    for (std::size_t v = 0; v < rules.locked.size(); ++v) {
      owner[v] = rules.locked[v] != 0 ? kShared : owner[v];
    }
  }
};

/// The order in which threads take the parts: the largest first, so that no large one is left for the end.
std::vector<std::size_t> largest_first(const std::vector<std::vector<TetId>>& parts) {
  std::vector<std::size_t> order(parts.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return parts[a].size() > parts[b].size(); });
  return order;
}

Patch make_patch(LocalMesh& local, const PatchRules& rules, const SamplesOfVertices& covered) {
  Patch patch{.mesh = TetComplex(std::move(local.points), std::move(local.tets), std::move(local.materials),
                                 std::move(local.hold)),
              .cover = SurfaceCover(rules.samples, rules.reach_mm, rules.own_reach_mm),
              .sets = {},
              .boundaries = rules.boundaries,
              .guards = rules.guards};
  patch.smoothness_cap_mm = rules.smoothness_cap_mm;
  for (std::size_t v = 0; !rules.longest_mm.empty() && v < local.vertices.size(); ++v) {
    patch.longest_mm.push_back(rules.longest_mm[local.vertices[v]]);
  }
  for (std::size_t v = 0; !rules.longest_on_interface_mm.empty() && v < local.vertices.size(); ++v) {
    patch.longest_on_interface_mm.push_back(rules.longest_on_interface_mm[local.vertices[v]]);
  }
  patch.sets.resize(local.vertices.size());
  patch.cover.resize(local.vertices.size());
  set_up_vertices(patch, local.tets_at);
  for (VertexId v = 0; v < local.vertices.size(); ++v) {
    const VertexId global = local.vertices[v];
    for (std::uint32_t i = covered.first[global]; !patch.mesh.locked(v) && i < covered.first[global + 1];
         ++i) {
      patch.cover.add(v, covered.samples[i]);
    }
  }
  return patch;
}

/// Copies the places of the patch's own vertices, and which samples they cover, back to the whole.
void give_back(const Patch& patch, const LocalMesh& local, MaterialMesh& mesh,
               std::vector<VertexId>& covering) {
  for (VertexId v = 0; v < local.vertices.size(); ++v) {
    if (!patch.mesh.locked(v)) {
      mesh.points[local.vertices[v]] = patch.mesh.point(v);
      patch.cover.for_each(v, [&](SampleId s) { covering[s] = local.vertices[v]; });
    }
  }
}

PatchResult result_of(const Patch& patch, const LocalMesh& local) {
  PatchResult result;
  const auto known = static_cast<VertexId>(local.vertices.size());
  for (VertexId v = known; v < patch.mesh.vertex_count(); ++v) {
    result.added.push_back(patch.mesh.point(v));
  }
  for (TetId t = 0; t < patch.mesh.tet_slots(); ++t) {
    if (patch.mesh.alive(t)) {
      std::array<VertexId, 4> nodes = patch.mesh.nodes(t);
      for (VertexId& v : nodes) {
        v = v < known ? local.vertices[v] : kNew + (v - known);
      }
      result.tets.push_back(nodes);
      result.materials.push_back(patch.mesh.material(t));
    }
  }
  return result;
}

/// The mesh of all patches' tets; new vertices are numbered in the patches' order.
void join(std::vector<PatchResult>& results, MaterialMesh& mesh) {
  mesh.tets.clear();
  mesh.materials.clear();
  for (PatchResult& result : results) {
    const auto first = static_cast<VertexId>(mesh.points.size());
    for (auto& tet : result.tets) {
      for (VertexId& v : tet) {
        v = v >= kNew ? first + (v - kNew) : v;
      }
    }
    mesh.points.insert(mesh.points.end(), result.added.begin(), result.added.end());
    mesh.tets.insert(mesh.tets.end(), result.tets.begin(), result.tets.end());
    mesh.materials.insert(mesh.materials.end(), result.materials.begin(), result.materials.end());
  }
}

}  // namespace

void improve_in_patches(MaterialMesh& mesh, std::vector<VertexId>& covering, const PatchRules& rules,
                        int round, const std::function<void(Patch&)>& improve) {
  const Cut cut(mesh, rules, round);
  const SamplesOfVertices covered(covering, mesh.points.size());
  std::vector<PatchResult> results(cut.parts.size());
  const std::vector<std::size_t> order = largest_first(cut.parts);
#pragma omp parallel for schedule(dynamic)
  for (std::size_t i = 0; i < order.size(); ++i) {
    const std::size_t p = order[i];
    LocalMesh local(mesh, cut.parts[p], cut.owner, rules.fixed);
    Patch patch = make_patch(local, rules, covered);
    improve(patch);
    give_back(patch, local, mesh, covering);
    results[p] = result_of(patch, local);
  }
  join(results, mesh);
}

namespace {

/// Marks the tets below the goal; returns their number.
std::size_t mark_bad(const MaterialMesh& mesh, double goal, std::vector<std::uint8_t>& chosen) {
  std::size_t bad = 0;
#pragma omp parallel for schedule(static) reduction(+ : bad)
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto& n = mesh.tets[t];
    chosen[t] =
        tet_quality(mesh.points[n[0]], mesh.points[n[1]], mesh.points[n[2]], mesh.points[n[3]]) < goal;
    bad += chosen[t];
  }
  return bad;
}

/// Adds the tets that have a vertex with the chosen ones in common.
void grow(const MaterialMesh& mesh, std::vector<std::uint8_t>& chosen) {
  std::vector<std::uint8_t> touched(mesh.points.size(), 0);
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    if (chosen[t] != 0) {
      for (const VertexId v : mesh.tets[t]) {
        touched[v] = 1;
      }
    }
  }
#pragma omp parallel for schedule(static)
  for (std::size_t t = 0; t < mesh.tets.size(); ++t) {
    const auto& n = mesh.tets[t];
    chosen[t] |= touched[n[0]] | touched[n[1]] | touched[n[2]] | touched[n[3]];
  }
}

}  // namespace

std::size_t improve_near_bad_tets(MaterialMesh& mesh, std::vector<VertexId>& covering,
                                  const PatchRules& rules, int round, double goal_quality, int rings,
                                  const std::function<void(Patch&)>& improve) {
  std::vector<std::uint8_t> chosen(mesh.tets.size(), 0);
  const std::size_t bad = mark_bad(mesh, goal_quality, chosen);
  if (bad == 0) {
    return 0;
  }
  for (int ring = 0; ring < rings; ++ring) {
    grow(mesh, chosen);
  }
  MaterialMesh near;
  near.points = std::move(mesh.points);
  std::vector<std::uint8_t> locked(near.points.size(), 0);
  std::size_t kept = 0;
  for (std::size_t t = 0; t < chosen.size(); ++t) {
    if (chosen[t] != 0) {
      near.tets.push_back(mesh.tets[t]);
      near.materials.push_back(mesh.materials[t]);
      continue;
    }
    for (const VertexId v : mesh.tets[t]) {
      locked[v] = 1;
    }
    mesh.tets[kept] = mesh.tets[t];
    mesh.materials[kept++] = mesh.materials[t];
  }
  PatchRules near_rules = rules;
  near_rules.locked = locked;
  improve_in_patches(near, covering, near_rules, round, improve);
  mesh.points = std::move(near.points);
  mesh.tets.resize(kept);
  mesh.materials.resize(kept);
  mesh.tets.insert(mesh.tets.end(), near.tets.begin(), near.tets.end());
  mesh.materials.insert(mesh.materials.end(), near.materials.begin(), near.materials.end());
  return bad;
}

}  // namespace cbc3d
