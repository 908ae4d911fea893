#include "mesher/improve/surface/surface_repair.hpp"

#include <limits>

#include "mesher/improve/surface/tet_groups.hpp"

namespace cbc3d {
namespace {

/// A tet that changes hands or, without tet, a vertex that moves.
struct Step {
  TetId tet = kNoTet;
  MaterialId to = kBackground;
  VertexId vertex = kNoVertex;
  Vec3 at;
};
using Steps = std::vector<Step>;

Step move(VertexId v, const Vec3& to) {
  return {kNoTet, kBackground, v, to};
}

/// Directions to all 26 neighbours of a voxel.
const std::vector<Vec3>& compass() {
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

/// A mesh at which steps can be tried.
class TrialEdits {
 public:
  TrialEdits(MaterialMesh& mesh, const SurfaceGuide& guide, const MendOptions& options)
      : mesh_(mesh),
        complex_(mesh, guide.places.label_of),
        guide_(guide),
        options_(options),
        meter_(complex_, guide),
        background_counts_(std::find(mesh.materials.begin(), mesh.materials.end(), kBackground) !=
                           mesh.materials.end()) {
    tets_of_.resize(guide.places.label_of.size());
    for (const MaterialId material : mesh.materials) {
      ++tets_of_[material];
    }
  }

  /// What steps do.
  struct Outcome {
    SurfaceDefects before, after;
    Steps repairs;  // that would bring back within the limit what they took beyond it
    [[nodiscard]] double gain() const { return sum(before) - sum(after); }
    static double sum(const SurfaceDefects& faults) {
      return static_cast<double>(faults.shape()) + faults.far + faults.lonely +
             1e-3 * static_cast<double>(faults.folds);
    }
  };

  [[nodiscard]] const LabelledComplex& complex() const { return complex_; }
  [[nodiscard]] const MaterialMesh& mesh() const { return mesh_; }
  FaultMeter& meter() { return meter_; }
  [[nodiscard]] std::size_t trials() const { return trials_; }

  /// Carries steps out; afterwards they are those that undo them.
  void swap(Steps& steps) {
    for (Step& step : steps) {
      if (step.tet == kNoTet) {
        std::swap(mesh_.points[step.vertex], step.at);
      } else {
        const MaterialId was = complex_.material(step.tet);
        --tets_of_[was];
        ++tets_of_[step.to];
        complex_.give(step.tet, step.to);
        step.to = was;
      }
    }
    for (const Step& step : steps) {
      for (std::size_t n = 0; step.tet != kNoTet && n < 4; ++n) {
        complex_.renew_set(mesh_.tets[step.tet][n]);
      }
    }
    std::reverse(steps.begin(), steps.end());  // the same tet or vertex may be there twice
  }

  /// Tries steps and undoes them; nothing where an angle forbids them, or a material would vanish.
  std::optional<Outcome> outcome_of(Steps steps) {
    ++trials_;
    const double floor = std::min(options_.goal_sine_squared, worst_angle(steps));
    const bool ends = end_a_material(steps);
    const FaultMeter::Scope scope = meter_.scope_of(touched_by(steps));
    swap(steps);
    const bool may = !ends && worst_angle(steps) >= floor;
    swap(steps);
    if (!may) {
      return std::nullopt;
    }
    Outcome outcome;
    outcome.before = meter_.measure(scope);
    swap(steps);
    outcome.after = meter_.measure(scope, outcome.before.shape() + 1);
    if (outcome.after.shape() < outcome.before.shape()) {
      outcome.repairs = repairs(scope);
    }
    swap(steps);
    return outcome;
  }

  /// Steps of vertices that bring what is far or lonely within the limit.
  [[nodiscard]] Steps repairs(const FaultMeter::Scope& scope) const {
    Steps steps;
    for (const VertexId v : scope.vertices) {
      if (const auto nearest = where_far_vertex_belongs(v)) {
        steps.push_back(move(v, within_limit(mesh_.points[v], *nearest)));
      }
    }
    for (const std::uint32_t p : meter_.lonely_points(scope)) {
      VertexId v = kNoVertex;
      const bool outer = meter_.is_reached(p, false);
      const bool known = std::isfinite(meter_.distance_mm(p, outer, v));
      if (known && std::none_of(steps.begin(), steps.end(), [&](const Step& s) { return s.vertex == v; })) {
        steps.push_back(move(v, within_limit(mesh_.points[v], meter_.point(p).centre())));
      }
    }
    return steps;
  }

  /// A step, and those that its angles need of the vertices round it, which all are among `free`.
  Steps with_room(const Step& step, const std::vector<VertexId>& free) {
    constexpr int kSweeps = 4;
    Steps steps = {step};
    Steps undo = {step};
    swap(undo);
    for (int sweep = 0; sweep < kSweeps; ++sweep) {
      for (const VertexId v : vertices_of_bad_tets(steps)) {
        if (v != step.vertex && std::binary_search(free.begin(), free.end(), v)) {
          const Vec3 from = mesh_.points[v];
          climb(v);
          steps.push_back(move(v, mesh_.points[v]));
          undo.insert(undo.begin(), move(v, from));
        }
      }
    }
    swap(undo);
    return steps;
  }

 private:
  [[nodiscard]] bool counts(TetId t) const {
    return background_counts_ || complex_.material(t) != kBackground;
  }

  /// The worst angle of the tets that count, round vertices that move and among those that change hands.
  [[nodiscard]] double worst_angle(const Steps& steps) const {
    double worst = 1;
    const auto look = [&](TetId t) {
      worst = counts(t) ? std::min(worst, worst_sine_squared(mesh_, {&t, 1})) : worst;
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

  /// True when steps would take a material's last tet.
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
      if (!guide_.places.is_near(mesh_.points[v], set.ids[i])) {
        return guide_.places.nearest(mesh_.points[v], set.ids[i]);
      }
    }
    return std::nullopt;
  }

  /// The place on the way to another from where that is within the limit, and a little more.
  [[nodiscard]] Vec3 within_limit(const Vec3& from, const Vec3& to) const {
    const double way = (to - from).norm();
    const double left = std::min(way, 0.97 * options_.limit_mm);
    return way > 0 ? to + (left / way) * (from - to) : from;
  }

  /// The vertices of tets below the goal round vertices that move.
  [[nodiscard]] std::vector<VertexId> vertices_of_bad_tets(const Steps& steps) const {
    std::vector<VertexId> cramped;
    for (const Step& step : steps) {
      for (const TetId t : complex_.star(step.vertex)) {
        if (counts(t) && worst_sine_squared(mesh_, {&t, 1}) < options_.goal_sine_squared) {
          cramped.insert(cramped.end(), mesh_.tets[t].begin(), mesh_.tets[t].end());
        }
      }
    }
    std::sort(cramped.begin(), cramped.end());
    cramped.erase(std::unique(cramped.begin(), cramped.end()), cramped.end());
    return cramped;
  }

  /// Moves a vertex to where the worst angle round it is better, in ever smaller steps.
  void climb(VertexId v) {
    double best = worst_angle({move(v, {})});
    for (const double share : {0.1, 0.06, 0.03, 0.015}) {
      for (const Vec3& direction : compass()) {
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
  const SurfaceGuide& guide_;
  const MendOptions& options_;
  FaultMeter meter_;
  bool background_counts_;            // it is meshed
  std::vector<std::size_t> tets_of_;  // each material
  std::size_t trials_ = 0;
};

class Mender {
 public:
  Mender(MaterialMesh& mesh, const SurfaceGuide& guide, const MendOptions& options)
      : bench_(mesh, guide, options), guide_(guide), options_(options) {
    most_trials_ = options.most_trials > 0 ? options.most_trials : 10000 + mesh.tets.size() / 8;
  }

  MendReport run() {
    FaultList faults = find_surface_defects(bench_.complex(), guide_);
    report_.faults = faults.seeds.size();
    report_.folds = faults.folds.size();
    const bool too_many_defects = faults.seeds.size() > most_trials_ / kFewestTrials;
    for (int round = 0; round < options_.rounds && !faults.seeds.empty() && !too_many_defects; ++round) {
      std::size_t mended = 0;
      for (const auto& seeds : faults.seeds) {
        mended += mend(seeds) ? 1 : 0;
      }
      if (mended == 0) {
        break;
      }
      faults = find_surface_defects(bench_.complex(), guide_);
    }
    report_.faults_left = faults.seeds.size();
    report_.cuts_left = faults.cuts;
    for (const auto& seeds : faults.folds) {
      unfold(seeds);
    }
    report_.folds_left = find_folds_after(faults);
    return report_;
  }

 private:
  static constexpr std::size_t kFewestTrials = 8;  // for each fault, else all would go into the first of them

  /// Betters what is round some vertices as far as it goes; true when anything was done.
  bool mend(const std::vector<VertexId>& seeds) {
    constexpr int kMostChanges = 20;
    region_ = ring_of(bench_.complex(), ring_of(bench_.complex(), seeds));
    end_of_trials_ = std::min(most_trials_, bench_.trials() + options_.place_trials);
    int changes = 0;
    for (bool going = true; going && changes < kMostChanges && !budget_exhausted();) {
      bench_.meter().look_at(region_);
      const FaultMeter::Scope scope = bench_.meter().scope_of(seeds);
      going = !bench_.meter().measure(scope).none_but_folds() && better(seeds, scope);
      changes += going ? 1 : 0;
    }
    return changes > 0;
  }

  /// Steps and relabellings that make folds fewer, and nothing worse.
  void unfold(const std::vector<VertexId>& seeds) {
    constexpr int kMostChanges = 6;
    constexpr std::size_t kTrials = 2000;
    may_trade_ = false;
    region_ = ring_of(bench_.complex(), ring_of(bench_.complex(), seeds));
    end_of_trials_ = std::min(most_trials_, bench_.trials() + kTrials);
    for (int change = 0; change < kMostChanges && !budget_exhausted(); ++change) {
      bench_.meter().look_at(region_);
      if (bench_.meter().measure(bench_.meter().scope_of(seeds)).folds == 0 || !step_one_vertex(seeds)) {
        return;
      }
    }
  }

  [[nodiscard]] std::size_t find_folds_after(const FaultList& before) const {
    return before.folds.empty() ? 0 : find_surface_defects(bench_.complex(), guide_).folds.size();
  }

  [[nodiscard]] bool budget_exhausted() const { return bench_.trials() >= end_of_trials_; }

  /// One change for the better: first such that no kind of fault grows.
  bool better(const std::vector<VertexId>& seeds, const FaultMeter::Scope& scope) {
    const Steps straight = bench_.repairs(scope);
    const std::vector<TetGroup> groups = tet_groups_at(bench_.complex(), seeds, 4);
    for (const bool may_trade : {false, true}) {
      may_trade_ = may_trade;
      if (attempt(straight) || step_one_vertex(seeds) ||
          std::any_of(groups.begin(), groups.end(), [this](const TetGroup& g) { return hand_over(g); })) {
        return true;
      }
    }
    return step_with_room(straight) || relabel_in_two_goes(groups);
  }

  /// Carries steps out, and if need be the repairs they call for, when that is for the better.
  bool attempt(Steps steps) {
    if (steps.empty() || budget_exhausted()) {
      return false;
    }
    const auto outcome = bench_.outcome_of(steps);
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
    const auto repaired = bench_.outcome_of(steps);
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
    bench_.swap(steps);
  }

  /// Of all steps of one vertex the best.
  bool step_one_vertex(const std::vector<VertexId>& seeds) {
    double most = 0;
    Steps best;
    for (const double share : {0.03, 0.06, 0.1, 0.2, 0.3, 0.45}) {
      for (const VertexId v : seeds) {
        for (const Vec3& direction : compass()) {
          const Steps steps = {move(v, bench_.mesh().points[v] + share * options_.step_mm * direction)};
          const auto outcome = budget_exhausted() ? std::nullopt : bench_.outcome_of(steps);
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

  /// Steps towards where the faults end, for which the vertices round them make room.
  bool step_with_room(const Steps& straight) {
    for (const double share : {1.0, 0.6, 0.3, 0.1}) {
      for (const Step& step : straight) {
        const Vec3 from = bench_.mesh().points[step.vertex];
        const Step part = move(step.vertex, from + share * (step.at - from));
        if (attempt(bench_.with_room(part, region_))) {
          return true;
        }
      }
    }
    return false;
  }

  bool hand_over(const TetGroup& group) {
    const std::vector<Steps> ways = ways_to_hand_over(group);
    return std::any_of(ways.begin(), ways.end(), [this](const Steps& steps) { return attempt(steps); });
  }

  /// To whoever is round it.
  [[nodiscard]] std::vector<Steps> ways_to_hand_over(const TetGroup& group) const {
    std::vector<Steps> ways;
    if (volume_mm3(bench_.mesh(), group) > options_.largest_mm3) {
      return ways;
    }
    MaterialSet takers;
    for (const TetId t : group) {
      for (std::size_t n = 0; n < 4; ++n) {
        takers.add(bench_.complex().across(t, n));
      }
    }
    for (std::uint8_t i = 0; i < takers.size; ++i) {
      if (takers.ids[i] != bench_.complex().material(group.front())) {
        ways.emplace_back();
        for (const TetId t : group) {
          ways.back().push_back({t, takers.ids[i], kNoVertex, {}});
        }
      }
    }
    return ways;
  }

  /// Where no change is for the better by itself: those that cost least, each followed by one at the vertices
  /// that are faulty then.
  bool relabel_in_two_goes(const std::vector<TetGroup>& groups) {
    constexpr std::size_t kMostFirst = 40;
    std::vector<std::pair<double, Steps>> firsts;
    for (const TetGroup& group : groups) {
      for (const Steps& steps : ways_to_hand_over(group)) {
        const auto outcome = budget_exhausted() ? std::nullopt : bench_.outcome_of(steps);
        if (outcome && outcome->after.shape() <= outcome->before.shape() + 1) {
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
      const auto& nodes = bench_.mesh().tets[step.tet];
      touched.insert(touched.end(), nodes.begin(), nodes.end());
    }
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    bench_.swap(first);
    std::erase_if(touched, [this](VertexId v) {
      return bench_.meter().pinches({v}) == 0 && bench_.meter().far({v}) == 0;
    });
    std::vector<Steps> seconds;
    for (const TetGroup& group : tet_groups_at(bench_.complex(), touched, 2)) {
      const std::vector<Steps> ways = ways_to_hand_over(group);
      seconds.insert(seconds.end(), ways.begin(), ways.end());
    }
    bench_.swap(first);
    return seconds;
  }

  TrialEdits bench_;
  const SurfaceGuide& guide_;
  const MendOptions& options_;
  std::size_t most_trials_ = 0;
  std::size_t end_of_trials_ = 0;  // at this place
  bool may_trade_ = false;
  std::vector<VertexId> region_;  // round the place, ascending
  MendReport report_;
};

}  // namespace

MendReport mend_surfaces(MaterialMesh& mesh, const std::vector<InterfacePoint>& points,
                         const ImagePlaces& places, const MendOptions& options) {
  const bool meshes_background =
      std::find(mesh.materials.begin(), mesh.materials.end(), kBackground) != mesh.materials.end();
  const SurfaceGuide guide{points, places, options.limit_mm};
  const MendReport report = Mender(mesh, guide, options).run();
  if (report.tets_relabelled > 0 && !meshes_background) {
    remove_background(mesh);
  }
  return report;
}

}  // namespace cbc3d
