#include "mesher/improve/surface/defect_removal.hpp"

#include <limits>

#include "mesher/improve/local/mesh_star.hpp"
#include "mesher/improve/surface/tet_groups.hpp"
#include "mesher/improve/surface/topology_guard.hpp"

namespace cbc3d {
namespace {

/// One edit: a tet that is relabelled or, without tet, a vertex that moves.
struct Step {
  TetId tet = kNoTet;
  MaterialId to = kBackground;
  VertexId vertex = kNoVertex;
  Vec3 at;
};
using Steps = std::vector<Step>;

Step move(VertexId v, const Vec3& to) {
  return {.vertex = v, .at = to};
}

/// The directions to the 26 neighbours of a voxel.
const std::vector<Vec3>& search_directions() {
  static const std::vector<Vec3> kDirections = [] {
    std::vector<Vec3> directions;
    for (const double z : {-1.0, 0.0, 1.0}) {
      for (const double y : {-1.0, 0.0, 1.0}) {
        for (const double x : {-1.0, 0.0, 1.0}) {
          if (x != 0 || y != 0 || z != 0) {
            directions.push_back(Vec3{x, y, z}.normalized());
          }
        }
      }
    }
    return directions;
  }();
  return kDirections;
}

/// A mesh at which edits can be tried and undone.
class TrialEdits {
 public:
  TrialEdits(MaterialMesh& mesh, const Domain& domain, const DefectRemovalOptions& options)
      : mesh_(mesh),
        complex_(mesh, domain.label_of()),
        domain_(domain),
        options_(options),
        meter_(complex_, domain, options.limit_mm),
        background_counts_(std::find(mesh.materials.begin(), mesh.materials.end(), kBackground) !=
                           mesh.materials.end()) {
    tets_of_.resize(domain.label_of().size());
    for (const MaterialId material : mesh.materials) {
      ++tets_of_[material];
    }
  }

  /// The effect of some steps.
  struct Outcome {
    SurfaceDefects before, after;
    Steps repairs;  // these would bring within the limit what the steps took beyond it
    [[nodiscard]] double gain() const { return sum(before) - sum(after); }
    static double sum(const SurfaceDefects& defects) {
      return static_cast<double>(defects.topological()) + defects.far + defects.uncovered +
             1e-3 * static_cast<double>(defects.folds);
    }
  };

  [[nodiscard]] const LabelledComplex& complex() const { return complex_; }
  [[nodiscard]] const MaterialMesh& mesh() const { return mesh_; }
  DefectMeter& meter() { return meter_; }
  [[nodiscard]] std::size_t trials() const { return trials_; }

  /// Carries steps out. Afterwards they are those that undo them.
  void apply(Steps& steps) {
    for (Step& step : steps) {
      if (step.tet == kNoTet) {
        std::swap(mesh_.points[step.vertex], step.at);
      } else {
        const MaterialId was = complex_.material(step.tet);
        --tets_of_[was];
        ++tets_of_[step.to];
        complex_.relabel(step.tet, step.to);
        step.to = was;
      }
    }
    for (const Step& step : steps) {
      for (std::size_t n = 0; step.tet != kNoTet && n < 4; ++n) {
        complex_.renew_set(mesh_.tets[step.tet][n]);
      }
    }
    std::reverse(steps.begin(), steps.end());  // the same tet or vertex may occur twice
  }

  /// Undoes the steps of the last apply, which are as it left them. Afterwards they are those that were
  /// applied.
  void undo(Steps& steps) { apply(steps); }

  /// Tries steps and undoes them; none where an angle forbids them, or where a material would vanish.
  std::optional<Outcome> outcome_of(Steps steps) {
    ++trials_;
    const double floor = std::min(options_.goal_quality, worst_angle(steps));
    const bool ends = end_a_material(steps);
    const DefectMeter::Scope scope = meter_.scope_of(touched_by(steps));
    const TopologyGuard topology = guard_of(steps);
    apply(steps);
    const bool may = !ends && worst_angle(steps) >= floor && topology.holds();
    undo(steps);
    if (!may) {
      return std::nullopt;
    }
    Outcome outcome;
    outcome.before = meter_.measure(scope);
    apply(steps);
    outcome.after = meter_.measure(scope, outcome.before.topological() + 1);
    if (outcome.after.topological() < outcome.before.topological()) {
      outcome.repairs = repairs(scope);
    }
    undo(steps);
    return outcome;
  }

  /// Steps of vertices that bring far vertices, or vertices next to uncovered samples, within the limit.
  [[nodiscard]] Steps repairs(const DefectMeter::Scope& scope) const {
    Steps steps;
    for (const VertexId v : scope.vertices) {
      if (const auto nearest = where_far_vertex_belongs(v)) {
        steps.push_back(move(v, within_limit(mesh_.points[v], *nearest)));
      }
    }
    for (const std::uint32_t s : meter_.uncovered_samples(scope)) {
      VertexId v = kNoVertex;
      const bool outer = meter_.is_covered(s, false);
      const bool known = std::isfinite(meter_.distance_mm(s, outer, v));
      if (known &&
          std::none_of(steps.begin(), steps.end(), [&](const Step& step) { return step.vertex == v; })) {
        steps.push_back(move(v, within_limit(mesh_.points[v], meter_.sample(s).centre())));
      }
    }
    return steps;
  }

  /// A step, and the steps of vertices around it, all among `free`, that its angles need.
  Steps with_room(const Step& step, const std::vector<VertexId>& free) {
    constexpr int kSweeps = 4;
    Steps steps = {step};
    Steps reverse = {step};
    apply(reverse);
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      for (const VertexId v : vertices_of_bad_tets(steps)) {
        if (v != step.vertex && std::binary_search(free.begin(), free.end(), v)) {
          const Vec3 from = mesh_.points[v];
          optimize_angle(v);
          steps.push_back(move(v, mesh_.points[v]));
          reverse.insert(reverse.begin(), move(v, from));
        }
      }
    }
    undo(reverse);
    return steps;
  }

 private:
  [[nodiscard]] bool counts(TetId t) const {
    return background_counts_ || complex_.material(t) != kBackground;
  }

  /// The worst angle of the tets around vertices that move and of those that are relabelled; background does
  /// not count where it is not meshed.
  [[nodiscard]] double worst_angle(const Steps& steps) const {
    double worst = 1;
    const auto look = [&](TetId t) {
      worst = counts(t) ? std::min(worst, worst_quality(mesh_, {&t, 1})) : worst;
    };
    for (const Step& step : steps) {
      if (step.tet != kNoTet) {
        look(step.tet);
        continue;
      }
      for (const TetId t : complex_.star(step.vertex)) {
        look(t);
      }
    }
    return worst;
  }

  [[nodiscard]] std::vector<VertexId> touched_by(const Steps& steps) const {
    std::vector<VertexId> vertices;
    for (const Step& step : steps) {
      if (step.tet == kNoTet) {
        vertices.push_back(step.vertex);
      } else {
        vertices.insert(vertices.end(), mesh_.tets[step.tet].begin(), mesh_.tets[step.tet].end());
      }
    }
    return vertices;
  }

  [[nodiscard]] TopologyGuard guard_of(const Steps& steps) const {
    std::vector<TetId> tets;
    std::vector<MaterialId> materials;
    for (const Step& step : steps) {
      if (options_.keep_topology && step.tet != kNoTet) {
        tets.push_back(step.tet);
        materials.push_back(complex_.material(step.tet));
        materials.push_back(step.to);
      }
    }
    return {complex_, tets, materials};
  }

  /// True when the steps would relabel a material's last tet.
  [[nodiscard]] bool end_a_material(const Steps& steps) const {
    return std::any_of(steps.begin(), steps.end(), [&](const Step& step) {
      if (step.tet == kNoTet || complex_.material(step.tet) == kBackground) {
        return false;
      }
      const MaterialId material = complex_.material(step.tet);
      const auto taken = std::count_if(steps.begin(), steps.end(), [&](const Step& other) {
        return other.tet != kNoTet && complex_.material(other.tet) == material;
      });
      return static_cast<std::size_t>(taken) >= tets_of_[material];
    });
  }

  [[nodiscard]] std::optional<Vec3> where_far_vertex_belongs(VertexId v) const {
    const MaterialSet& set = complex_.set(v);
    for (std::uint8_t i = 0; set.size > 1 && i < set.size; ++i) {
      if (!domain_.is_near_boundary(mesh_.points[v], set.ids[i])) {
        return domain_.nearest_boundary(mesh_.points[v], set.ids[i]);
      }
    }
    return std::nullopt;
  }

  /// The place on the way from one place to another that is just within the limit of the other.
  [[nodiscard]] Vec3 within_limit(const Vec3& from, const Vec3& to) const {
    const double way = (to - from).norm();
    const double left = std::min(way, 0.97 * options_.limit_mm);
    return way > 0 ? to + (left / way) * (from - to) : from;
  }

  /// The vertices of tets below the goal around vertices that move.
  [[nodiscard]] std::vector<VertexId> vertices_of_bad_tets(const Steps& steps) const {
    std::vector<VertexId> vertices;
    for (const Step& step : steps) {
      for (const TetId t : complex_.star(step.vertex)) {
        if (counts(t) && worst_quality(mesh_, {&t, 1}) < options_.goal_quality) {
          vertices.insert(vertices.end(), mesh_.tets[t].begin(), mesh_.tets[t].end());
        }
      }
    }
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    return vertices;
  }

  /// Moves a vertex to where the worst angle around it is better, in ever smaller steps.
  void optimize_angle(VertexId v) {
    double best = worst_angle({move(v, {})});
    for (const double share : {0.1, 0.06, 0.03, 0.015}) {
      for (const Vec3& direction : search_directions()) {
        const Vec3 from = mesh_.points[v];
        mesh_.points[v] = from + share * options_.step_mm * direction;
        const double now = worst_angle({move(v, {})});
        if (now > best) {
          best = now;
        } else {
          mesh_.points[v] = from;
        }
      }
    }
  }

  MaterialMesh& mesh_;
  LabelledComplex complex_;
  const Domain& domain_;
  const DefectRemovalOptions& options_;
  DefectMeter meter_;
  bool background_counts_;            // background is meshed
  std::vector<std::size_t> tets_of_;  // number of each material's tets
  std::size_t trials_ = 0;
};

class DefectRemover {
 public:
  DefectRemover(MaterialMesh& mesh, const Domain& domain, const DefectRemovalOptions& options)
      : edits_(mesh, domain, options), domain_(domain), options_(options) {
    most_trials_ = options.most_trials > 0 ? options.most_trials : 10000 + mesh.tets.size() / 8;
  }

  DefectRemovalReport run() {
    DefectList defects = find_surface_defects(edits_.complex(), domain_, options_.limit_mm);
    report_.defects = defects.seeds.size();
    report_.folds = defects.folds.size();
    const bool too_many_defects = defects.seeds.size() > most_trials_ / kFewestTrials;
    for (int round = 0; round < options_.rounds && !defects.seeds.empty() && !too_many_defects; ++round) {
      std::size_t removed = 0;
      for (const auto& seeds : defects.seeds) {
        removed += remove(seeds) ? 1 : 0;
      }
      if (removed == 0) {
        break;
      }
      defects = find_surface_defects(edits_.complex(), domain_, options_.limit_mm);
    }
    report_.defects_left = defects.seeds.size();
    report_.self_intersections_left = defects.self_intersections;
    for (const auto& seeds : defects.folds) {
      unfold(seeds);
    }
    report_.folds_left = find_folds_after(defects);
    return report_;
  }

 private:
  static constexpr std::size_t kFewestTrials = 8;  // for each defect, or the first ones would take all

  /// Improves the neighbourhood of some vertices until no change helps; true when anything was done.
  bool remove(const std::vector<VertexId>& seeds) {
    constexpr int kMostChanges = 20;
    region_ = free_region_at(seeds);
    end_of_trials_ = std::min(most_trials_, edits_.trials() + options_.place_trials);
    int changes = 0;
    for (bool going = true; going && changes < kMostChanges && !budget_exhausted();) {
      if (!edits_.meter().look_at(region_)) {
        break;
      }
      const DefectMeter::Scope scope = edits_.meter().scope_of(seeds);
      going = !edits_.meter().measure(scope).none_but_folds() && improve_once(seeds, scope);
      changes += going ? 1 : 0;
    }
    return changes > 0;
  }

  /// Two rings of vertices around some, those that are fixed left out, ascending.
  [[nodiscard]] std::vector<VertexId> free_region_at(const std::vector<VertexId>& seeds) const {
    std::vector<VertexId> region = ring_of(edits_.complex(), ring_of(edits_.complex(), seeds));
    std::erase_if(region, [this](VertexId v) { return v < options_.fixed.size() && options_.fixed[v] != 0; });
    return region;
  }

  /// Carries out steps that reduce the number of folds and make nothing worse.
  void unfold(const std::vector<VertexId>& seeds) {
    constexpr int kMostChanges = 6;
    constexpr std::size_t kTrials = 2000;
    may_trade_ = false;
    region_ = free_region_at(seeds);
    end_of_trials_ = std::min(most_trials_, edits_.trials() + kTrials);
    for (int change = 0; change < kMostChanges && !budget_exhausted(); ++change) {
      if (!edits_.meter().look_at(region_)) {
        return;
      }
      if (edits_.meter().measure(edits_.meter().scope_of(seeds)).folds == 0 || !step_one_vertex(seeds)) {
        return;
      }
    }
  }

  [[nodiscard]] std::size_t find_folds_after(const DefectList& before) const {
    return before.folds.empty()
               ? 0
               : find_surface_defects(edits_.complex(), domain_, options_.limit_mm).folds.size();
  }

  [[nodiscard]] bool budget_exhausted() const { return edits_.trials() >= end_of_trials_; }

  /// Makes one change for the better: first one is searched for that lets no kind of defect grow.
  bool improve_once(const std::vector<VertexId>& seeds, const DefectMeter::Scope& scope) {
    const Steps straight = edits_.repairs(scope);
    const std::vector<TetGroup> groups = tet_groups_at(edits_.complex(), seeds, 4);
    for (const bool may_trade : {false, true}) {
      may_trade_ = may_trade;
      if (attempt(straight) || step_one_vertex(seeds) ||
          std::any_of(groups.begin(), groups.end(), [this](const TetGroup& g) { return relabel_group(g); })) {
        return true;
      }
    }
    return step_with_room(straight) || relabel_in_two_steps(groups);
  }

  /// Carries steps out where that is for the better, together with the repairs they need.
  bool attempt(Steps steps) {
    if (steps.empty() || budget_exhausted()) {
      return false;
    }
    const auto outcome = edits_.outcome_of(steps);
    if (!outcome) {
      return false;
    }
    if (outcome->after.is_better_than(outcome->before, may_trade_)) {
      carry_out(steps);
      return true;
    }
    if (outcome->repairs.empty()) {
      return false;
    }
    steps.insert(steps.end(), outcome->repairs.begin(), outcome->repairs.end());
    const auto repaired = edits_.outcome_of(steps);
    if (repaired && repaired->after.is_better_than(repaired->before, may_trade_)) {
      carry_out(steps);
      return true;
    }
    return false;
  }

  void carry_out(Steps& steps) {
    for (const Step& step : steps) {
      ++(step.tet == kNoTet ? report_.vertices_moved : report_.tets_relabelled);
    }
    edits_.apply(steps);
  }

  /// Carries out the best step of one vertex.
  bool step_one_vertex(const std::vector<VertexId>& seeds) {
    double most = 0;
    Steps best;
    for (const double share : {0.03, 0.06, 0.1, 0.2, 0.3, 0.45}) {
      for (const VertexId v : seeds) {
        for (const Vec3& direction : search_directions()) {
          const Steps steps = {move(v, edits_.mesh().points[v] + share * options_.step_mm * direction)};
          const auto outcome = budget_exhausted() ? std::nullopt : edits_.outcome_of(steps);
          if (outcome && outcome->after.is_better_than(outcome->before, may_trade_) &&
              outcome->gain() > most) {
            most = outcome->gain();
            best = steps;
          }
        }
      }
    }
    return attempt(best);
  }

  /// Carries out a step that ends a defect, for which the vertices around it make room.
  bool step_with_room(const Steps& straight) {
    for (const double share : {1.0, 0.6, 0.3, 0.1}) {
      for (const Step& step : straight) {
        const Vec3 from = edits_.mesh().points[step.vertex];
        const Step part = move(step.vertex, from + share * (step.at - from));
        if (attempt(edits_.with_room(part, region_))) {
          return true;
        }
      }
    }
    return false;
  }

  bool relabel_group(const TetGroup& group) {
    const std::vector<Steps> ways = ways_to_relabel(group);
    return std::any_of(ways.begin(), ways.end(), [this](const Steps& steps) { return attempt(steps); });
  }

  /// A group of tets can take each material next to it.
  [[nodiscard]] std::vector<Steps> ways_to_relabel(const TetGroup& group) const {
    std::vector<Steps> ways;
    if (volume_mm3(edits_.mesh(), group) > options_.largest_mm3) {
      return ways;
    }
    MaterialSet neighbours;
    for (const TetId t : group) {
      for (std::size_t n = 0; n < 4; ++n) {
        neighbours.add(edits_.complex().across(t, n));
      }
    }
    for (std::uint8_t i = 0; i < neighbours.size; ++i) {
      if (neighbours.ids[i] != edits_.complex().material(group.front())) {
        ways.emplace_back();
        for (const TetId t : group) {
          ways.back().push_back({t, neighbours.ids[i], kNoVertex, {}});
        }
      }
    }
    return ways;
  }

  /// Where no single change is for the better: the cheapest changes, each followed by one at the vertices
  /// that are defective then.
  bool relabel_in_two_steps(const std::vector<TetGroup>& groups) {
    constexpr std::size_t kMostFirst = 40;
    std::vector<std::pair<double, Steps>> firsts;
    for (const TetGroup& group : groups) {
      for (const Steps& steps : ways_to_relabel(group)) {
        const auto outcome = budget_exhausted() ? std::nullopt : edits_.outcome_of(steps);
        if (outcome && outcome->after.topological() <= outcome->before.topological() + 1) {
          firsts.emplace_back(-outcome->gain(), steps);
        }
      }
    }
    std::stable_sort(firsts.begin(), firsts.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    firsts.resize(std::min(kMostFirst, firsts.size()));
    return std::any_of(firsts.begin(), firsts.end(), [this](const auto& f) { return follow(f.second); });
  }

  bool follow(const Steps& first) {
    for (const Steps& second : seconds_after(first)) {
      Steps both = first;
      both.insert(both.end(), second.begin(), second.end());
      if (attempt(both)) {
        return true;
      }
    }
    return false;
  }

  std::vector<Steps> seconds_after(Steps first) {
    std::vector<VertexId> touched;
    for (const Step& step : first) {
      const auto& nodes = edits_.mesh().tets[step.tet];
      touched.insert(touched.end(), nodes.begin(), nodes.end());
    }
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    edits_.apply(first);
    std::erase_if(touched, [this](VertexId v) {
      return edits_.meter().pinches({v}) == 0 && edits_.meter().far({v}) == 0;
    });
    std::vector<Steps> seconds;
    for (const TetGroup& group : tet_groups_at(edits_.complex(), touched, 2)) {
      const std::vector<Steps> ways = ways_to_relabel(group);
      seconds.insert(seconds.end(), ways.begin(), ways.end());
    }
    edits_.undo(first);
    return seconds;
  }

  TrialEdits edits_;
  const Domain& domain_;
  const DefectRemovalOptions& options_;
  std::size_t most_trials_ = 0;
  std::size_t end_of_trials_ = 0;  // at this place
  bool may_trade_ = false;
  std::vector<VertexId> region_;  // around the place, ascending
  DefectRemovalReport report_;
};

}  // namespace

DefectRemovalReport remove_surface_defects(MaterialMesh& mesh, const Domain& domain,
                                           const DefectRemovalOptions& options) {
  const bool meshes_background =
      std::find(mesh.materials.begin(), mesh.materials.end(), kBackground) != mesh.materials.end();
  const DefectRemovalReport report = DefectRemover(mesh, domain, options).run();
  if (report.tets_relabelled > 0 && !meshes_background) {
    remove_background(mesh);
  }
  return report;
}

}  // namespace cbc3d
