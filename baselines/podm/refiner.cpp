#include "baselines/podm/refiner.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mesher/topology/cell_quality.hpp"

namespace cbc3d::baselines::podm {
namespace {

// The circumcentre of a tet; not finite for a flat one.
Vec3 circumcentre(const std::array<Vec3, 4>& p) {
  const Vec3 a = p[1] - p[0], b = p[2] - p[0], c = p[3] - p[0];
  const Vec3 bc = b.cross(c);
  const double six_volumes = a.dot(bc);
  const Vec3 sum = a.squared_norm() * bc + b.squared_norm() * c.cross(a) + c.squared_norm() * a.cross(b);
  return p[0] + sum / (2 * six_volumes);
}

// The cosine of the smallest angle of a triangle, which is opposite its shortest edge.
double smallest_angle_cosine(const Vec3& p, const Vec3& q, const Vec3& r) {
  std::array<double, 3> squares{(q - r).squared_norm(), (r - p).squared_norm(), (p - q).squared_norm()};
  std::sort(squares.begin(), squares.end());
  return (squares[1] + squares[2] - squares[0]) / (2 * std::sqrt(squares[1] * squares[2]));
}

Vec3 clamped(const Vec3& p, const Vec3& low, const Vec3& high) {
  return {std::clamp(p.x, low.x, high.x), std::clamp(p.y, low.y, high.y), std::clamp(p.z, low.z, high.z)};
}

// The free space around the image. A circumcentre beyond the box is moved onto it; it stays as far from all
// vertices as the box is from the surface, so the box gets few vertices.
double margin_mm(const LabelImage& image, double delta_mm) {
  const ImageFrame& f = image.frame;
  const Vec3 extent{f.size[0] * f.spacing_mm.x, f.size[1] * f.spacing_mm.y, f.size[2] * f.spacing_mm.z};
  constexpr double kDeltas = 3, kShare = 0.1;
  return kDeltas * delta_mm + kShare * extent.norm();
}

// Lock cells of about four deltas; each worker has a bit for each of them.
int lock_cells_per_axis(const Vec3& extent, double delta_mm) {
  constexpr double kFewest = 8, kMost = 160;
  return static_cast<int>(std::clamp(extent.max_coeff() / (4 * delta_mm), kFewest, kMost));
}

}  // namespace

template <typename Concurrency>
Refiner<Concurrency>::Refiner(const LabelImage& image, const SurfaceOracle& oracle,
                              const RefinementOptions& options)
    : oracle_(oracle),
      options_(options),
      facet_cosine_(std::cos(options.facet_angle_deg * std::numbers::pi / 180)),
      least_gap_mm_(kLeastGap * options.delta_mm),
      sample_gap_mm_(0.2 * image.frame.spacing_mm.min_coeff()),
      dihedral_cosine_(std::cos(options.min_dihedral_deg * std::numbers::pi / 180)),
      surface_(2 * options.delta_mm),
      free_(4 * options.delta_mm) {
  const double margin = margin_mm(image, options.delta_mm);
  const Index3& n = image.frame.size;
  low_ = -Vec3{margin, margin, margin};
  high_ = image.frame.local_centre(n[0] - 1, n[1] - 1, n[2] - 1) - low_;
  if constexpr (kParallel) {
    const CGAL::Bbox_3 box(low_.x, low_.y, low_.z, high_.x, high_.y, high_.z);
    locks_ = std::make_unique<LockGrid>(box, lock_cells_per_axis(high_ - low_, options.delta_mm));
    dt_.set_lock_data_structure(locks_.get());
  }
}

template <typename Concurrency>
void Refiner<Concurrency>::start(Worker& worker) {
  for (int corner = 0; corner < 8; ++corner) {
    const Vertex v =
        dt_.insert(to_point({(corner & 1) != 0 ? high_.x : low_.x, (corner & 2) != 0 ? high_.y : low_.y,
                             (corner & 4) != 0 ? high_.z : low_.z}));
    v->data.stamp.set(worker.next_stamp());
  }
  worker.fresh.clear();
  for (auto c = dt_.all_cells_begin(); c != dt_.all_cells_end(); ++c) {
    c->data.stamp.set(worker.next_stamp());
    worker.fresh.push_back(c);
  }
  register_fresh(worker);
}

template <typename Concurrency>
void Refiner<Concurrency>::give_locks_back() {
  if constexpr (kParallel) dt_.unlock_all_elements();
}

template <typename Concurrency>
Attempt Refiner<Concurrency>::step(Worker& worker) {
  Attempt ended = Attempt::kDone;
  if (!worker.removals.empty()) {
    const Removal removal = worker.removals.front();
    worker.removals.pop_front();
    ended = attempt(removal, worker);
    if (ended == Attempt::kBlocked) worker.removals.push_back(removal);
  } else {
    const auto queue =
        std::find_if(worker.jobs.begin(), worker.jobs.end(), [](const auto& q) { return !q.empty(); });
    const Job job = queue->front();
    queue->pop_front();
    ended = attempt(job, static_cast<Rule>(queue - worker.jobs.begin()), worker);
    if (ended == Attempt::kBlocked) queue->push_back(job);
  }
  give_locks_back();
  if (ended == Attempt::kBlocked) ++worker.counts.rollbacks;
  return ended;
}

// A tet whose first vertex's place is locked, and whose stamp is the same, cannot change or go any more.
template <typename Concurrency>
Attempt Refiner<Concurrency>::attempt(const Job& job, Rule queue, Worker& worker) {
  if constexpr (kParallel) {
    if (!dt_.try_lock_point(to_point(job.key))) return Attempt::kBlocked;
  }
  if (job.cell->data.stamp.get() != job.stamp) return Attempt::kDone;
  if constexpr (kParallel) {
    if (!dt_.try_lock_cell(job.cell)) return Attempt::kBlocked;
  }
  const Decision decision = decide(job.cell);
  if (decision.rule == Rule::kNone) return Attempt::kDone;
  if (decision.rule > queue) {
    enqueue(job.cell, decision.rule, worker);
    return Attempt::kDone;
  }
  const Attempt ended = insert(decision, worker);
  // The point may have been in the neighbour's ball alone.
  if (ended == Attempt::kDone && job.cell->data.stamp.get() == job.stamp)
    enqueue(job.cell, decision.rule, worker);
  return ended;
}

template <typename Concurrency>
typename Refiner<Concurrency>::Decision Refiner<Concurrency>::decide(Cell cell) const {
  const Decision by_ball = decide_by_ball(cell);
  if (by_ball.rule != Rule::kNone && is_in_ball(cell, by_ball.place)) return by_ball;
  const Decision by_facet = decide_by_facet(cell);
  if (by_facet.rule != Rule::kNone) return by_facet;
  if (!is_large(cell) || !is_in_ball(cell, cell->data.centre)) return {};
  return {Rule::kVolume, cell->data.centre, VertexKind::kFree, cell};
}

// False of a point that rounding put out of the ball.
template <typename Concurrency>
bool Refiner<Concurrency>::is_in_ball(Cell cell, const Vec3& place) const {
  return !dt_.is_infinite(cell) && dt_.side_of_sphere(cell, to_point(place), true) == CGAL::ON_BOUNDED_SIDE;
}

// The nearest place of the surface to a tet's circumcentre if it is in its ball.
template <typename Concurrency>
std::optional<Vec3> Refiner<Concurrency>::met_surface(const CellData& cell) const {
  if (oracle_.distance_bound_mm(cell.centre) >= cell.radius_mm) return std::nullopt;
  const std::optional<Vec3> place = oracle_.nearest(cell.centre);
  if (!place || (*place - cell.centre).squared_norm() >= cell.radius_mm * cell.radius_mm) return std::nullopt;
  return place;
}

// Rules 1 and 2.
template <typename Concurrency>
typename Refiner<Concurrency>::Decision Refiner<Concurrency>::decide_by_ball(Cell cell) const {
  const CellData& data = cell->data;
  const std::optional<Vec3> place = met_surface(data);
  if (!place) return {};
  if (!is_sampled(cell, *place)) return {Rule::kSample, *place, VertexKind::kSurface, cell};
  if (data.radius_mm > 2 * options_.delta_mm) return split_at_centre(cell);
  return {};
}

// True where a surface vertex is within delta; the tet's own are the likely ones.
template <typename Concurrency>
bool Refiner<Concurrency>::is_sampled(Cell cell, const Vec3& place) const {
  for (int i = 0; i < 4; ++i) {
    const auto& vertex = *cell->vertex(i);
    if (vertex.data.kind == VertexKind::kSurface &&
        (to_vec3(vertex.point()) - place).squared_norm() < options_.delta_mm * options_.delta_mm)
      return true;
  }
  const std::lock_guard guard(grids_);
  return surface_.any_within(place, options_.delta_mm, [](const Vec3&, char) { return true; });
}

template <typename Concurrency>
typename Refiner<Concurrency>::Decision Refiner<Concurrency>::split_at_centre(Cell cell) const {
  const Vec3& centre = cell->data.centre;
  const Vec3 place = clamped(centre, low_, high_);
  return {Rule::kSplit, place, place == centre ? VertexKind::kFree : VertexKind::kBox, cell};
}

// A facet between two materials that rule 3 does not accept.
template <typename Concurrency>
bool Refiner<Concurrency>::is_bad_facet(Cell cell, int facet) const {
  const Cell other = cell->neighbor(facet);
  if (other->data.material == cell->data.material || dt_.is_infinite(other)) return false;
  std::array<Vec3, 3> p;
  for (int n = 0; n < 3; ++n) {
    const auto& vertex = *cell->vertex((facet + n + 1) & 3);
    if (vertex.data.kind != VertexKind::kSurface) return true;
    p[static_cast<std::size_t>(n)] = to_vec3(vertex.point());
  }
  return smallest_angle_cosine(p[0], p[1], p[2]) > facet_cosine_;
}

template <typename Concurrency>
typename Refiner<Concurrency>::Decision Refiner<Concurrency>::decide_by_facet(Cell cell) const {
  for (int facet = 0; facet < 4; ++facet) {
    if (!is_bad_facet(cell, facet)) continue;
    const Cell other = cell->neighbor(facet);
    const auto place = oracle_.crossing(cell->data.centre, other->data.centre);
    if (!place || (*place - point(cell, (facet + 1) & 3)).norm() < least_gap_mm_) continue;
    for (const Cell conflicting : {cell, other}) {
      if (is_in_ball(conflicting, *place)) return {Rule::kFacet, *place, VertexKind::kSurface, conflicting};
    }
  }
  return {};
}

// Rules 4 and 5.
template <typename Concurrency>
bool Refiner<Concurrency>::is_large(Cell cell) const {
  const CellData& data = cell->data;
  if (data.material == kBackground) return false;
  if (data.radius_mm < least_gap_mm_) return false;
  if (options_.size_mm > 0 && data.radius_mm > options_.size_mm) return true;
  const double least = data.radius_mm / options_.radius_edge_ratio;
  for (int i = 0; i < 3; ++i) {
    for (int j = i + 1; j < 4; ++j) {
      if ((point(cell, i) - point(cell, j)).squared_norm() < least * least) return true;
    }
  }
  return is_sliver(cell);
}

// The rule of this implementation's own.
template <typename Concurrency>
bool Refiner<Concurrency>::is_sliver(Cell cell) const {
  if (options_.min_dihedral_deg <= 0 || cell->data.radius_mm < kLeastSliver * options_.delta_mm) return false;
  const Vec3 a = point(cell, 0), b = point(cell, 1), c = point(cell, 2), d = point(cell, 3);
  return !surely_no_cosine_above(a, b, c, d, dihedral_cosine_) &&
         max_dihedral_cosine(a, b, c, d) > dihedral_cosine_;
}

// Notes a surface vertex before it is inserted, once all that it needs is locked; false for a sample that
// another worker's has come too near to in the meantime.
template <typename Concurrency>
bool Refiner<Concurrency>::reserve(const Decision& decision) {
  if (decision.kind != VertexKind::kSurface) return true;
  const std::lock_guard guard(grids_);
  const auto always = [](const Vec3&, char) { return true; };
  if (decision.rule == Rule::kSample && surface_.any_within(decision.place, options_.delta_mm, always))
    return false;
  surface_.add(decision.place, 0);
  return true;
}

template <typename Concurrency>
Attempt Refiner<Concurrency>::insert(const Decision& decision, Worker& worker) {
  worker.cells.clear();
  worker.facets.clear();
  bool locked = true;
  dt_.find_conflicts(to_point(decision.place), decision.conflicting, std::back_inserter(worker.facets),
                     std::back_inserter(worker.cells), kParallel ? &locked : nullptr);
  if (!locked || !reserve(decision)) return Attempt::kBlocked;
  fill_hole(decision, worker);
  return Attempt::kDone;
}

template <typename Concurrency>
void Refiner<Concurrency>::fill_hole(const Decision& decision, Worker& worker) {
  worker.outer.clear();
  for (const auto& [cell, facet] : worker.facets) {
    const Cell other = cell->neighbor(facet);
    worker.outer.emplace_back(other, other->index(cell));
  }
  for (const Cell cell : worker.cells) cell->data.stamp.set(0);
  const auto [begin, facet] = worker.facets.front();
  const Vertex vertex =
      dt_.insert_in_hole(to_point(decision.place), worker.cells.begin(), worker.cells.end(), begin, facet);
  note_vertex(vertex, decision, worker);
  collect_fresh(worker);
  register_fresh(worker);
}

template <typename Concurrency>
void Refiner<Concurrency>::note_vertex(Vertex vertex, const Decision& decision, Worker& worker) {
  const std::uint64_t stamp = worker.next_stamp();
  vertex->data.kind = decision.kind;
  vertex->data.stamp.set(stamp);
  if (decision.kind == VertexKind::kFree) {
    ++worker.counts.free_vertices;
    const std::lock_guard guard(grids_);
    free_.add(decision.place, {vertex, stamp});
  } else if (decision.kind == VertexKind::kSurface) {
    ++worker.counts.surface_vertices;
    if (!options_.remove_free) return;
    const std::lock_guard guard(grids_);
    free_.any_within(decision.place, 2 * options_.delta_mm, [&](const Vec3& key, const FreeVertex& free) {
      worker.removals.push_back({free.vertex, free.stamp, key});
      return false;
    });
  }
}

// The tets that fill a hole have no stamp yet, and hang together.
template <typename Concurrency>
void Refiner<Concurrency>::collect_fresh(Worker& worker) {
  auto& fresh = worker.fresh;
  fresh.clear();
  const auto take = [&](Cell cell) {
    if (cell->data.stamp.get() != 0) return;
    cell->data.stamp.set(worker.next_stamp());
    fresh.push_back(cell);
  };
  for (const auto& [cell, facet] : worker.outer) take(cell->neighbor(facet));
  for (std::size_t n = 0; n < fresh.size(); ++n) {
    for (int i = 0; i < 4; ++i) take(fresh[n]->neighbor(i));
  }
}

template <typename Concurrency>
void Refiner<Concurrency>::register_fresh(Worker& worker) {
  for (const Cell cell : worker.fresh) set_data(cell);
  for (const Cell cell : worker.fresh) {
    if (dt_.is_infinite(cell)) continue;
    Rule rule = decide_by_ball(cell).rule;
    for (int facet = 0; rule == Rule::kNone && facet < 4; ++facet) {
      if (is_bad_facet(cell, facet)) rule = Rule::kFacet;
    }
    if (rule == Rule::kNone && is_large(cell)) rule = Rule::kVolume;
    if (rule != Rule::kNone) enqueue(cell, rule, worker);
  }
}

template <typename Concurrency>
void Refiner<Concurrency>::set_data(Cell cell) {
  CellData& data = cell->data;
  data.material = kBackground;
  data.radius_mm = 0;
  if (dt_.is_infinite(cell)) return;
  const std::array<Vec3, 4> p{point(cell, 0), point(cell, 1), point(cell, 2), point(cell, 3)};
  data.centre = circumcentre(p);
  if (!data.centre.all_finite()) data.centre = 0.25 * (p[0] + p[1] + p[2] + p[3]);
  data.radius_mm = (p[0] - data.centre).norm();
  data.material = oracle_.material_at(data.centre);
}

template <typename Concurrency>
void Refiner<Concurrency>::enqueue(Cell cell, Rule rule, Worker& worker) {
  worker.jobs[static_cast<std::size_t>(rule)].push_back({cell, cell->data.stamp.get(), point(cell, 0)});
}

// The tets at a vertex into `cells`, those around them into `outer`; false where another worker holds some.
template <typename Concurrency>
bool Refiner<Concurrency>::take_cavity_around(Vertex vertex, Worker& worker) {
  worker.cells.clear();
  if (!dt_.try_lock_and_get_incident_cells(vertex, worker.cells)) return false;
  worker.outer.clear();
  for (const Cell cell : worker.cells) {
    const Cell other = cell->neighbor(cell->index(vertex));
    worker.outer.emplace_back(other, other->index(cell));
  }
  return true;
}

template <typename Concurrency>
Attempt Refiner<Concurrency>::attempt(const Removal& removal, Worker& worker) {
  if constexpr (kParallel) {
    if (!dt_.try_lock_point(to_point(removal.key))) return Attempt::kBlocked;
  }
  if (removal.vertex->data.stamp.get() != removal.stamp) return Attempt::kDone;
  {
    const std::lock_guard guard(grids_);
    if (static_cast<double>(removals_) >=
        options_.removals_per_surface_vertex * static_cast<double>(surface_.size())) {
      worker.counts.removals_capped = true;
      return Attempt::kDone;
    }
  }
  if (!take_cavity_around(removal.vertex, worker)) return Attempt::kBlocked;
  for (const Cell cell : worker.cells) cell->data.stamp.set(0);
  removal.vertex->data.stamp.set(0);
  bool locked = true;
  dt_.remove(removal.vertex, &locked);
  ++worker.counts.removals;
  {
    const std::lock_guard guard(grids_);
    ++removals_;
    free_.remove(removal.key, {removal.vertex, removal.stamp});
  }
  collect_fresh(worker);
  register_fresh(worker);
  return Attempt::kDone;
}

template <typename Concurrency>
void Refiner<Concurrency>::insert_samples(const std::vector<Vec3>& places, Worker& worker) {
  const auto always = [](const Vec3&, char) { return true; };
  for (const Vec3& place : places) {
    // A vertex that is nearly there already does as well, and two would ask for tiny tets between them.
    if (surface_.any_within(place, sample_gap_mm_, always)) continue;
    typename Dt::Locate_type type{};
    int i = 0, j = 0;
    const Cell cell = dt_.locate(to_point(place), type, i, j);
    // A free vertex that is there already must only stay.
    if (type == Dt::VERTEX) {
      cell->vertex(i)->data.kind = VertexKind::kSurface;
      cell->vertex(i)->data.stamp.set(worker.next_stamp());
    } else {
      insert({Rule::kFacet, place, VertexKind::kSurface, cell}, worker);
    }
    give_locks_back();
  }
}

template <typename Concurrency>
std::vector<MaterialId> Refiner<Concurrency>::materials_present() const {
  std::vector<MaterialId> present;
  for (auto c = dt_.finite_cells_begin(); c != dt_.finite_cells_end(); ++c) {
    // Tets beside each other in memory often have the same.
    if (present.empty() || present.back() != c->data.material) present.push_back(c->data.material);
  }
  std::sort(present.begin(), present.end());
  present.erase(std::unique(present.begin(), present.end()), present.end());
  return present;
}

template <typename Concurrency>
LabelledComplex Refiner<Concurrency>::exported() {
  LabelledComplex complex;
  complex.points.reserve(dt_.number_of_vertices());
  for (auto v = dt_.finite_vertices_begin(); v != dt_.finite_vertices_end(); ++v) {
    v->data.id = static_cast<std::uint32_t>(complex.points.size());
    complex.points.push_back(to_vec3(v->point()));
  }
  std::uint32_t tets = 0;
  for (auto c = dt_.all_cells_begin(); c != dt_.all_cells_end(); ++c)
    c->data.id = dt_.is_infinite(c) ? kNoTet : tets++;
  complex.tets.reserve(tets);
  complex.neighbours.reserve(tets);
  complex.materials.reserve(tets);
  for (auto c = dt_.finite_cells_begin(); c != dt_.finite_cells_end(); ++c) {
    std::array<VertexId, 4> nodes{};
    std::array<std::uint32_t, 4> neighbours{};
    for (int i = 0; i < 4; ++i) {
      nodes[static_cast<std::size_t>(i)] = c->vertex(i)->data.id;
      neighbours[static_cast<std::size_t>(i)] = c->neighbor(i)->data.id;
    }
    complex.tets.push_back(nodes);
    complex.neighbours.push_back(neighbours);
    complex.materials.push_back(c->data.material);
  }
  return complex;
}

template class Refiner<CGAL::Sequential_tag>;
template class Refiner<CGAL::Parallel_tag>;

}  // namespace cbc3d::baselines::podm
