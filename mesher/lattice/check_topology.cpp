#include "mesher/lattice/check_topology.hpp"

#include <algorithm>
#include <map>
#include <numeric>

#include "mesher/domain/size_rank.hpp"
#include "mesher/topology/vertex_star.hpp"

namespace cbc3d {
namespace {

/// Materials of one label form one class; class 0 is background.
struct Classes {
  std::vector<ClassId> of_material;
  std::vector<Label> label;  // of a class

  explicit Classes(const std::vector<Label>& label_of_material) {
    std::map<Label, ClassId> known;
    label.push_back(0);
    of_material.push_back(0);
    for (std::size_t m = 1; m < label_of_material.size(); ++m) {
      const auto [found, added] = known.try_emplace(label_of_material[m], static_cast<ClassId>(label.size()));
      if (added) {
        label.push_back(label_of_material[m]);
      }
      of_material.push_back(found->second);
    }
  }
};

std::vector<ClassId> classes_of_tets(const Classes& classes, const std::vector<MaterialId>& materials) {
  std::vector<ClassId> result(materials.size());
#pragma omp parallel for schedule(static)
  for (std::size_t t = 0; t < materials.size(); ++t) {
    result[t] = classes.of_material[materials[t]];
  }
  return result;
}

bool is_manifold_everywhere(VertexStar& star) {
  const auto& distinct = star.distinct();
  return distinct.size() < 2 || std::all_of(distinct.begin(), distinct.end(),
                                            [&star](ClassId c) { return c == 0 || star.is_manifold(c); });
}

/// True when tets of two classes or more meet at v; only there a surface can be.
bool is_mixed(const VertexCells& around, VertexId v, const std::vector<ClassId>& class_of_tet) {
  for (std::uint32_t i = around.first[v] + 1; i < around.first[v + 1]; ++i) {
    if (class_of_tet[around.cells[i]] != class_of_tet[around.cells[i - 1]]) {
      return true;
    }
  }
  return false;
}

/// Those of `candidates` (ascending) at which a surface is non-manifold.
std::vector<VertexId> find_non_manifold(const VertexCells& around, const CandidateMesh& mesh,
                                        const std::vector<ClassId>& class_of_tet,
                                        const std::vector<VertexId>& candidates) {
  std::vector<std::uint8_t> bad(candidates.size(), 0);
#pragma omp parallel
  {
    VertexStar star(around, mesh.tets.nodes, mesh.neighbours);
#pragma omp for schedule(dynamic, 1024)
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      if (is_mixed(around, candidates[i], class_of_tet)) {
        star.load(candidates[i], class_of_tet, 0);
        bad[i] = is_manifold_everywhere(star) ? 0 : 1;
      }
    }
  }
  std::vector<VertexId> vertices;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (bad[i] != 0) {
      vertices.push_back(candidates[i]);
    }
  }
  return vertices;
}

std::vector<VertexId> find_non_manifold(const VertexCells& around, const CandidateMesh& mesh,
                                        const std::vector<ClassId>& class_of_tet) {
  std::vector<VertexId> all(around.first.size() - 1);
  std::iota(all.begin(), all.end(), VertexId{0});
  return find_non_manifold(around, mesh, class_of_tet, all);
}

class Repair {
 public:
  Repair(CandidateMesh& mesh, const std::vector<Vec3>& points, const ImageDomain& domain,
         const TopologyOptions& options)
      : mesh_(mesh),
        points_(points),
        domain_(domain),
        image_(domain.image()),
        options_(options),
        classes_(image_.labels),
        voxels_(domain.voxels()),
        rank_(rank_by_size(voxels_, classes_.of_material, BackgroundRank::highest)),
        around_(tets_of_vertices(mesh.tets.nodes, points.size())),
        unsure_(mesh.unsure),
        class_of_tet_(classes_of_tets(classes_, mesh.materials)),
        star_(around_, mesh.tets.nodes, mesh.neighbours) {
    unsure_.resize(points.size(), 1);
    report_.labels.resize(classes_.label.size());
    for (std::size_t m = 1; m < voxels_.count.size(); ++m) {
      report_.labels[classes_.of_material[m]].image_regions += voxels_.count[m] > 0 ? 1 : 0;
    }
  }

  /// The repair, and after it the account of the components.
  TopologyReport run() {
    repair();
    count_components();
    report_.labels.erase(report_.labels.begin());
    return std::move(report_);
  }

  void repair() {
    std::vector<VertexId> bad = find_bad();
    report_.non_manifold_vertices = bad.size();
    for (int pass = 0; pass < options_.image_passes && !bad.empty(); ++pass) {
      touched_.clear();
      for (const VertexId v : bad) {
        force_star(v);
      }
      bad = find_non_manifold(around_, mesh_, class_of_tet_, nodes_of_touched());
    }
    // Removing a component can touch a neighbour's surface; then the repair runs again. Components only
    // become fewer by removal, and what the bound would leave is counted below, so nothing is hidden.
    for (int pass = 0; pass < kMostPasses; ++pass) {
      repair_vertices(std::move(bad));
      if (remove_small_components() + remove_crumbs() == 0) {
        break;
      }
      bad = find_bad();
    }
    repair_vertices(find_bad());
    report_.non_manifold_vertices_left = find_bad().size();
  }

 private:
  static constexpr int kMostPasses = 10;

  /// All vertices at which a surface is non-manifold, ascending: only where that is not known to be otherwise
  /// has to be looked.
  std::vector<VertexId> find_bad() {
    std::vector<VertexId> candidates;
    for (VertexId v = 0; v < unsure_.size(); ++v) {
      if (unsure_[v] != 0) {
        candidates.push_back(v);
        unsure_[v] = 0;
      }
    }
    std::vector<VertexId> bad = find_non_manifold(around_, mesh_, class_of_tet_, candidates);
    for (const VertexId v : bad) {
      unsure_[v] = 1;
    }
    return bad;
  }

  /// The star of v becomes what the voxel at v is.
  void force_star(VertexId v) {
    const MaterialId material = image_.at_local(points_[v]);
    for (std::uint32_t i = around_.first[v]; i < around_.first[v + 1]; ++i) {
      if (mesh_.materials[around_.cells[i]] != material) {
        relabel(around_.cells[i], material);
      }
    }
  }

  void repair_vertices(std::vector<VertexId> queue) {
    while (!queue.empty()) {
      touched_.clear();
      for (const VertexId v : queue) {
        repair_vertex(v);
      }
      keep_one_face_rule();
      queue = nodes_of_touched();
    }
  }

  [[nodiscard]] std::vector<VertexId> nodes_of_touched() const {
    std::vector<VertexId> nodes;
    for (const TetId t : touched_) {
      nodes.insert(nodes.end(), mesh_.tets.nodes[t].begin(), mesh_.tets.nodes[t].end());
    }
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
  }

  void repair_vertex(VertexId v) {
    for (bool changed = is_mixed(around_, v, class_of_tet_); changed;) {
      changed = false;
      star_.load(v, class_of_tet_, 0);
      for (const ClassId c : star_.distinct()) {
        if (c != 0 && (join_or_drop_pieces(c) || close_or_leave_rest(c))) {
          changed = true;
          break;
        }
      }
    }
  }

  /// The highest-ranked class of the star.
  [[nodiscard]] ClassId highest() const {
    ClassId best = star_.distinct().front();
    for (const ClassId c : star_.distinct()) {
      best = rank_[c] > rank_[best] ? c : best;
    }
    return best;
  }

  /// Class c falls into pieces.
  bool join_or_drop_pieces(ClassId c) {
    const int pieces = star_.split(c, true);
    if (pieces <= 1) {
      return false;
    }
    const ClassId top = highest();
    if (top == c) {  // all others are lower
      for (std::size_t i = 0; i < star_.size(); ++i) {
        set(i, c);
      }
      return true;
    }
    std::vector<int> size(static_cast<std::size_t>(pieces), 0);
    for (std::size_t i = 0; i < star_.size(); ++i) {
      if (star_.piece(i) >= 0) {
        ++size[static_cast<std::size_t>(star_.piece(i))];
      }
    }
    const auto largest = static_cast<int>(std::max_element(size.begin(), size.end()) - size.begin());
    for (std::size_t i = 0; i < star_.size(); ++i) {
      if (star_.piece(i) >= 0 && star_.piece(i) != largest) {
        set(i, top);
      }
    }
    return true;
  }

  /// What is not of class c falls into pieces.
  bool close_or_leave_rest(ClassId c) {
    const int pieces = star_.split(c, false);
    if (pieces <= 1) {
      return false;
    }
    std::vector<std::uint8_t> has_higher(static_cast<std::size_t>(pieces), 0);
    for (std::size_t i = 0; i < star_.size(); ++i) {
      if (star_.piece(i) >= 0 && rank_[star_.class_of(i)] > rank_[c]) {
        has_higher[static_cast<std::size_t>(star_.piece(i))] = 1;
      }
    }
    const bool leave = std::count(has_higher.begin(), has_higher.end(), 1) > 1;
    const ClassId top = highest();
    for (std::size_t i = 0; i < star_.size(); ++i) {
      if (leave && star_.class_of(i) == c) {
        set(i, top);
      } else if (!leave && star_.piece(i) >= 0 && has_higher[static_cast<std::size_t>(star_.piece(i))] == 0) {
        set(i, c);
      }
    }
    return true;
  }

  /// Gives member i of the star the class; its material is that of a member which has it.
  void set(std::size_t i, ClassId to) {
    const TetId t = star_.tet(i);
    if (t == kNoTet || class_of_tet_[t] == to) {
      return;
    }
    MaterialId material = kBackground;
    for (std::size_t m = 0; to != 0 && m < star_.size(); ++m) {
      if (star_.class_of(m) == to && star_.tet(m) != kNoTet) {
        material = mesh_.materials[star_.tet(m)];
        break;
      }
    }
    relabel(t, material);
  }

  void relabel(TetId t, MaterialId material) {
    mesh_.materials[t] = material;
    class_of_tet_[t] = classes_.of_material[material];
    touched_.push_back(t);
    for (const VertexId v : mesh_.tets.nodes[t]) {
      unsure_[v] = 1;
    }
    ++report_.tets_relabelled;
  }

  /// Labelled tets near a change with two or more faces towards background become background.
  void keep_one_face_rule() {
    if (!options_.one_face_rule) {
      return;
    }
    for (std::size_t next = 0; next < touched_.size(); ++next) {
      const TetId changed = touched_[next];
      check_faces(changed);
      for (const TetId n : mesh_.neighbours[changed]) {
        if (n != kNoTet) {
          check_faces(n);
        }
      }
    }
  }

  void check_faces(TetId t) {
    const auto& around = mesh_.neighbours[t];
    const auto background = std::count_if(around.begin(), around.end(),
                                          [&](TetId n) { return n == kNoTet || class_of_tet_[n] == 0; });
    if (class_of_tet_[t] != 0 && background >= 2) {
      relabel(t, kBackground);
    }
  }

  static constexpr std::uint32_t kNone = 0xFFFFFFFFU;
  /// Face-connected components of labelled tets: the component of every tet, and for each its class and
  /// volume.
  struct Components {
    std::vector<std::uint32_t> of_tet;  // kNone where it is of none
    std::vector<ClassId> class_of;
    std::vector<double> volume;
    std::vector<Vec3> centroid;  // local mm
  };

  /// Those of background too, if it is asked for.
  [[nodiscard]] Components find_components(bool with_background = false) const {
    Components found;
    found.of_tet.assign(mesh_.tets.size(), kNone);
    std::vector<TetId> stack;
    for (std::size_t start = 0; start < found.of_tet.size(); ++start) {
      if ((class_of_tet_[start] == 0 && !with_background) || found.of_tet[start] != kNone) {
        continue;
      }
      const auto number = static_cast<std::uint32_t>(found.class_of.size());
      found.class_of.push_back(class_of_tet_[start]);
      found.volume.push_back(0);
      found.centroid.emplace_back();
      found.of_tet[start] = number;
      stack.push_back(static_cast<TetId>(start));
      while (!stack.empty()) {
        const TetId t = stack.back();
        stack.pop_back();
        const auto& n = mesh_.tets.nodes[t];
        const double volume = six_volumes(points_[n[0]], points_[n[1]], points_[n[2]], points_[n[3]]) / 6;
        found.volume[number] += volume;
        found.centroid[number] +=
            0.25 * volume * (points_[n[0]] + points_[n[1]] + points_[n[2]] + points_[n[3]]);
        for (const TetId next : mesh_.neighbours[t]) {
          if (next != kNoTet && class_of_tet_[next] == class_of_tet_[t] && found.of_tet[next] == kNone) {
            found.of_tet[next] = number;
            stack.push_back(next);
          }
        }
      }
    }
    return found;
  }

  /// Relabels components that are neither their label's share of small_component nor needed for a region of
  /// the image: a label keeps as many components as its image has regions, the largest first.
  std::size_t remove_small_components() {
    if (options_.small_component <= 0) {  // no volume is smaller
      return 0;
    }
    const Components components = find_components();
    std::vector<double> total(classes_.label.size(), 0);
    std::vector<std::vector<std::uint32_t>> of_class(classes_.label.size());
    for (std::uint32_t c = 0; c < components.class_of.size(); ++c) {
      total[components.class_of[c]] += components.volume[c];
      of_class[components.class_of[c]].push_back(c);
    }
    std::vector<std::uint8_t> remove(components.class_of.size(), 0);
    for (std::size_t k = 1; k < of_class.size(); ++k) {
      auto& list = of_class[k];
      std::stable_sort(list.begin(), list.end(), [&](std::uint32_t a, std::uint32_t b) {
        return components.volume[a] > components.volume[b];
      });
      for (std::size_t place = report_.labels[k].image_regions; place < list.size(); ++place) {
        if (components.volume[list[place]] < options_.small_component * total[k]) {
          remove[list[place]] = 1;
        }
      }
    }
    return remove_components(components, remove);
  }

  /// Relabels components, background's too, that are smaller than an eighth of a voxel or of which no tet has
  /// its centroid in a voxel of its own label: what they are in has no such part and no such cavity.
  std::size_t remove_crumbs() {
    if (!options_.drop_crumbs) {
      return 0;
    }
    const double smallest_mm3 = domain_.cell_mm3() / 8;
    const Components components = find_components(true);
    std::vector<std::uint8_t> remove(components.class_of.size(), 1);
    for (std::size_t t = 0; t < mesh_.tets.size(); ++t) {
      std::uint8_t& is_crumb = remove[components.of_tet[t]];
      if (is_crumb != 0 && components.volume[components.of_tet[t]] >= smallest_mm3) {
        const auto& n = mesh_.tets.nodes[t];
        const Vec3 centroid = 0.25 * (points_[n[0]] + points_[n[1]] + points_[n[2]] + points_[n[3]]);
        is_crumb = classes_.of_material[image_.at_local(centroid)] == class_of_tet_[t] ? 0 : 1;
      }
    }
    return remove_components(components, remove);
  }

  /// Relabels the marked components; returns how many there are.
  std::size_t remove_components(const Components& components, const std::vector<std::uint8_t>& remove) {
    const auto removed = static_cast<std::size_t>(std::count(remove.begin(), remove.end(), 1));
    if (removed > 0) {
      touched_.clear();
      relabel_components(components, remove);
      keep_one_face_rule();
      report_.components_removed += removed;
    }
    return removed;
  }

  /// Each removed component goes to the material across most of its outer faces; ties to background, then the
  /// lower number.
  void relabel_components(const Components& components, const std::vector<std::uint8_t>& remove) {
    std::map<std::pair<std::uint32_t, MaterialId>, std::size_t> faces;
    for (std::size_t t = 0; t < mesh_.tets.size(); ++t) {
      const std::uint32_t c = components.of_tet[t];
      if (c == kNone || remove[c] == 0) {
        continue;
      }
      for (const TetId n : mesh_.neighbours[t]) {
        if (n == kNoTet || components.of_tet[n] != c) {
          ++faces[{c, n == kNoTet ? kBackground : mesh_.materials[n]}];
        }
      }
    }
    std::map<std::uint32_t, std::pair<std::size_t, MaterialId>> winner;
    for (const auto& [key, count] : faces) {
      auto& best = winner[key.first];
      if (count > best.first) {
        best = {count, key.second};
      }
    }
    for (std::size_t t = 0; t < mesh_.tets.size(); ++t) {
      const std::uint32_t c = components.of_tet[t];
      if (c != kNone && remove[c] != 0) {
        relabel(static_cast<TetId>(t), winner[c].second);
      }
    }
  }

  /// How many components each label has, and where those are that the image has no region for.
  void count_components() {
    const Components components = find_components();
    for (std::size_t k = 1; k < classes_.label.size(); ++k) {
      LabelTopology& label = report_.labels[k];
      label.label = classes_.label[k];
      std::vector<ExtraComponent> all;
      for (std::size_t c = 0; c < components.class_of.size(); ++c) {
        if (components.class_of[c] == k) {
          all.push_back({image_.frame.to_physical(components.centroid[c] / components.volume[c]),
                         components.volume[c]});
        }
      }
      std::stable_sort(all.begin(), all.end(),
                       [](const auto& a, const auto& b) { return a.volume_mm3 > b.volume_mm3; });
      label.components = all.size();
      all.erase(all.begin(),
                all.begin() + static_cast<std::ptrdiff_t>(std::min(all.size(), label.image_regions)));
      label.extra = std::move(all);
    }
  }

  CandidateMesh& mesh_;
  const std::vector<Vec3>& points_;
  const ImageDomain& domain_;
  const LabelImage& image_;  // of the domain
  const TopologyOptions& options_;
  Classes classes_;
  const MaterialVoxels& voxels_;
  std::vector<std::uint32_t> rank_;
  VertexCells around_;
  std::vector<std::uint8_t>& unsure_;  // of the mesh
  std::vector<ClassId> class_of_tet_;
  VertexStar star_;
  std::vector<TetId> touched_;
  TopologyReport report_;
};

}  // namespace

std::vector<VertexId> non_manifold_vertices(const CandidateMesh& mesh, std::size_t vertex_count,
                                            const std::vector<Label>& label_of_material) {
  const VertexCells around = tets_of_vertices(mesh.tets.nodes, vertex_count);
  return find_non_manifold(around, mesh, classes_of_tets(Classes(label_of_material), mesh.materials));
}

TopologyReport check_topology(CandidateMesh& mesh, const std::vector<Vec3>& points, const ImageDomain& domain,
                              const TopologyOptions& options) {
  return Repair(mesh, points, domain, options).run();
}

void repair_topology(CandidateMesh& mesh, const std::vector<Vec3>& points, const ImageDomain& domain,
                     const TopologyOptions& options) {
  Repair(mesh, points, domain, options).repair();
}

}  // namespace cbc3d
