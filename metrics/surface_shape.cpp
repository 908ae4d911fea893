#include "metrics/surface_shape.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <tuple>

#include "mesher/core/disjoint_sets.hpp"
#include "metrics/nearest_voxel.hpp"
#include "metrics/order_statistics.hpp"
#include "metrics/reduce.hpp"
#include "metrics/smoothness.hpp"
#include "metrics/thin_voxels.hpp"

namespace cbc3d::metrics {
namespace {

using nlohmann::json;

constexpr double kDegrees = 180 / std::numbers::pi;
// Lattices have angles of exactly 60 and 90 degrees, which rounding must not scatter over both sides of a
// limit.
constexpr double kToleranceDeg = 1e-6;
constexpr std::uint32_t kNone = ~std::uint32_t{0};

double angle_deg(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * kDegrees;
}

double facet_mean_ratio(const NumberedFacet& facet) {
  const auto& p = facet.at;
  if (corner_count(facet) == 3) {
    const double squares =
        (p[1] - p[0]).squared_norm() + (p[2] - p[1]).squared_norm() + (p[0] - p[2]).squared_norm();
    return squares > 0 ? 4 * std::numbers::sqrt3 * area_vector(facet).norm() / squares : 0;
  }
  double smallest = 1;
  for (std::size_t n = 0; n < 4; ++n) {
    const Vec3 e1 = p[(n + 1) % 4] - p[n], e2 = p[(n + 3) % 4] - p[n];
    const double squares = e1.squared_norm() + e2.squared_norm();
    smallest = std::min(smallest, squares > 0 ? 2 * e1.cross(e2).norm() / squares : 0);
  }
  return smallest;
}

// An edge with exactly two facets.
struct SharedEdge {
  std::uint32_t low, high;  // vertices, numbered within the surface
  std::uint32_t facet, other;
  double angle_deg;
};

struct FacetEdge {
  std::uint32_t low, high, facet;
};

// One surface with its vertices numbered from 0, its normals and its edges.
class Sheet {
 public:
  explicit Sheet(std::vector<NumberedFacet> facets) : facets_(std::move(facets)) {
    number_vertices();
    find_normals();
    find_edges();
  }

  [[nodiscard]] SurfaceShape figures() const;
  /// The places of the surface of `label`.
  [[nodiscard]] std::vector<SharpPlace> sharp_places(const MeshView& view, const LabelImage& image,
                                                     std::uint32_t label) const;

 private:
  // A sharp element: its sharpest edge, the most pointed of its vertices, and whether that is a tip.
  struct SharpElement {
    std::uint32_t edge, vertex;
    bool is_tip;
  };

  void number_vertices();
  void find_normals();
  void find_edges();
  [[nodiscard]] double off_normal_deg(std::size_t facet) const;
  [[nodiscard]] double most_off_corner_deg(std::size_t facet) const;
  [[nodiscard]] std::vector<bool> find_tips() const;
  [[nodiscard]] std::vector<SharpElement> find_sharp_elements(DisjointSets& sets) const;
  [[nodiscard]] std::uint32_t most_pointed(std::span<const std::uint32_t> vertices) const;
  [[nodiscard]] SharpPlace place_of(const SharpElement& element) const;
  [[nodiscard]] std::span<const std::uint32_t> corners(std::size_t facet) const {
    return {vertex_[facet].data(), corner_count(facets_[facet])};
  }

  std::vector<NumberedFacet> facets_;
  std::vector<std::array<std::uint32_t, 4>> vertex_;  // of each corner of each facet
  std::vector<Vec3> points_;                          // of each vertex
  std::vector<Vec3> normals_, vertex_normals_;        // unit, or zero where there is none
  // The mean cosine between a vertex's normal and the directions to the middles of its facets: -1 the tip of
  // a needle that points outwards, 0 flat, 1 the bottom of a deep pit.
  std::vector<double> pointedness_;
  std::vector<SharedEdge> edges_;
  std::vector<std::uint32_t> sharpest_edge_;  // of each facet, or kNone
};

void Sheet::number_vertices() {
  std::vector<std::uint64_t> ids;
  ids.reserve(4 * facets_.size());
  for (const NumberedFacet& facet : facets_) {
    ids.insert(ids.end(), facet.corner.begin(),
               facet.corner.begin() + static_cast<std::ptrdiff_t>(corner_count(facet)));
  }
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  points_.resize(ids.size());
  vertex_.resize(facets_.size());
  for (std::size_t f = 0; f < facets_.size(); ++f) {
    for (std::size_t n = 0; n < corner_count(facets_[f]); ++n) {
      const auto found = std::lower_bound(ids.begin(), ids.end(), facets_[f].corner[n]);
      vertex_[f][n] = static_cast<std::uint32_t>(found - ids.begin());
      points_[vertex_[f][n]] = facets_[f].at[n];
    }
  }
}

void Sheet::find_normals() {
  normals_.resize(facets_.size());
  vertex_normals_.resize(points_.size());
  for (std::size_t f = 0; f < facets_.size(); ++f) {
    const Vec3 area = area_vector(facets_[f]);
    normals_[f] = area.normalized();
    for (const std::uint32_t v : corners(f)) {
      vertex_normals_[v] += area;
    }
  }
  for (Vec3& normal : vertex_normals_) {
    normal = normal.normalized();
  }
  pointedness_.assign(points_.size(), 0);
  std::vector<std::uint32_t> count(points_.size(), 0);
  for (std::size_t f = 0; f < facets_.size(); ++f) {
    Vec3 middle{};
    for (const std::uint32_t v : corners(f)) {
      middle += points_[v] / static_cast<double>(corners(f).size());
    }
    for (const std::uint32_t v : corners(f)) {
      pointedness_[v] += (middle - points_[v]).normalized().dot(vertex_normals_[v]);
      ++count[v];
    }
  }
  for (std::size_t v = 0; v < points_.size(); ++v) {
    pointedness_[v] /= count[v];
  }
}

std::uint32_t Sheet::most_pointed(std::span<const std::uint32_t> vertices) const {
  return *std::max_element(vertices.begin(), vertices.end(), [this](std::uint32_t a, std::uint32_t b) {
    return std::fabs(pointedness_[a]) < std::fabs(pointedness_[b]);
  });
}

void Sheet::find_edges() {
  std::vector<FacetEdge> sides;
  sides.reserve(4 * facets_.size());
  for (std::size_t f = 0; f < facets_.size(); ++f) {
    const auto nodes = corners(f);
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const auto [low, high] = std::minmax(nodes[n], nodes[(n + 1) % nodes.size()]);
      sides.push_back({low, high, static_cast<std::uint32_t>(f)});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const FacetEdge& a, const FacetEdge& b) {
    return std::tie(a.low, a.high, a.facet) < std::tie(b.low, b.high, b.facet);
  });
  sharpest_edge_.assign(facets_.size(), kNone);
  for (std::size_t first = 0; first < sides.size();) {
    std::size_t last = first + 1;
    while (last < sides.size() && sides[last].low == sides[first].low &&
           sides[last].high == sides[first].high) {
      ++last;
    }
    if (last - first == 2) {
      const std::uint32_t f = sides[first].facet, g = sides[first + 1].facet;
      const auto number = static_cast<std::uint32_t>(edges_.size());
      edges_.push_back({sides[first].low, sides[first].high, f, g, angle_deg(normals_[f], normals_[g])});
      for (const std::uint32_t facet : {f, g}) {
        std::uint32_t& sharpest = sharpest_edge_[facet];
        if (sharpest == kNone || edges_[sharpest].angle_deg < edges_[number].angle_deg) {
          sharpest = number;
        }
      }
    }
    first = last;
  }
}

double Sheet::off_normal_deg(std::size_t facet) const {
  Vec3 mean{};
  for (const std::uint32_t v : corners(facet)) {
    mean += vertex_normals_[v];
  }
  return angle_deg(normals_[facet], mean);
}

double Sheet::most_off_corner_deg(std::size_t facet) const {
  double most = 0;
  for (const std::uint32_t v : corners(facet)) {
    most = std::max(most, angle_deg(normals_[facet], vertex_normals_[v]));
  }
  return most;
}

SurfaceShape Sheet::figures() const {
  SurfaceShape result;
  result.facets = static_cast<std::int64_t>(facets_.size());
  result.edges = static_cast<std::int64_t>(edges_.size());
  std::vector<double> angles, ratios;
  double squares = 0;
  for (const SharedEdge& edge : edges_) {
    angles.push_back(edge.angle_deg);
    squares += edge.angle_deg * edge.angle_deg;
    for (std::size_t n = 0; n < kSharpAnglesDeg.size(); ++n) {
      result.edges_over[n] += edge.angle_deg > kSharpAnglesDeg[n] + kToleranceDeg ? 1 : 0;
    }
  }
  for (std::size_t f = 0; f < facets_.size(); ++f) {
    ratios.push_back(facet_mean_ratio(facets_[f]));
    result.off_normal += off_normal_deg(f) > kOffNormalDeg + kToleranceDeg ? 1 : 0;
    result.off_corner += most_off_corner_deg(f) > kOffNormalDeg + kToleranceDeg ? 1 : 0;
  }
  if (const auto found = order_statistics(std::span(angles), std::array<std::size_t, 3>{950, 990, 1000})) {
    result.angle_rms_deg = std::sqrt(squares / static_cast<double>(angles.size()));
    result.angle_p95_deg = (*found)[0];
    result.angle_p99_deg = (*found)[1];
    result.angle_max_deg = (*found)[2];
  }
  if (const auto found = order_statistics(std::span(ratios), std::array<std::size_t, 3>{0, 10, 500})) {
    result.mean_ratio_min = (*found)[0];
    result.mean_ratio_p1 = (*found)[1];
    result.mean_ratio_median = (*found)[2];
  }
  return result;
}

// Vertices from whose normal every facet there stands off.
std::vector<bool> Sheet::find_tips() const {
  std::vector<bool> is_tip(points_.size(), true);
  for (std::size_t f = 0; f < facets_.size(); ++f) {
    for (const std::uint32_t v : corners(f)) {
      if (angle_deg(normals_[f], vertex_normals_[v]) <= kOffNormalDeg + kToleranceDeg) {
        is_tip[v] = false;
      }
    }
  }
  return is_tip;
}

// Joins the vertices of each.
std::vector<Sheet::SharpElement> Sheet::find_sharp_elements(DisjointSets& sets) const {
  std::vector<SharpElement> elements;
  for (std::uint32_t e = 0; e < edges_.size(); ++e) {
    const SharedEdge& edge = edges_[e];
    if (edge.angle_deg > kSharpAnglesDeg.back() + kToleranceDeg) {
      const std::array<std::uint32_t, 2> ends{edge.low, edge.high};
      elements.push_back({e, most_pointed(ends), false});
      sets.join(edge.low, edge.high);
    }
  }
  const std::vector<bool> is_tip = find_tips();
  std::vector<std::uint32_t> sharpest_at(points_.size(), kNone);
  for (std::size_t f = 0; f < facets_.size(); ++f) {
    const std::uint32_t sharpest = sharpest_edge_[f];
    const bool off = off_normal_deg(f) > kOffNormalDeg + kToleranceDeg;
    if (off) {
      elements.push_back({sharpest, most_pointed(corners(f)), false});
    }
    for (const std::uint32_t v : corners(f)) {
      if (off || is_tip[v]) {
        sets.join(corners(f)[0], v);
      }
      std::uint32_t& at = sharpest_at[v];
      if (sharpest != kNone && (at == kNone || edges_[at].angle_deg < edges_[sharpest].angle_deg)) {
        at = sharpest;
      }
    }
  }
  for (std::uint32_t v = 0; v < points_.size(); ++v) {
    if (is_tip[v]) {
      elements.push_back({sharpest_at[v], v, true});
    }
  }
  return elements;
}

SharpPlace Sheet::place_of(const SharpElement& element) const {
  SharpPlace place;
  place.at_mm = points_[element.vertex];
  if (element.edge != kNone) {
    const SharedEdge& edge = edges_[element.edge];
    place.angle_deg = edge.angle_deg;
    if (!element.is_tip) {
      place.at_mm = 0.5 * (points_[edge.low] + points_[edge.high]);
    }
  }
  return place;
}

// The material of a label; empty where the image does not have the label.
std::optional<MaterialId> find_material(const LabelImage& image, Label label) {
  const auto found = std::find(image.labels.begin() + 1, image.labels.end(), label);
  return found == image.labels.end() ? std::nullopt
                                     : std::optional(static_cast<MaterialId>(found - image.labels.begin()));
}

PlaceKind kind_in_image(const LabelImage& image, std::optional<MaterialId> material,
                        const SharpPlace& place) {
  if (!material) {
    return place.kind;
  }
  const Index3 voxel = nearest_voxel(image.frame, image.frame.to_local(place.at_mm));
  return is_thin_near(image, voxel, *material, false)  ? PlaceKind::kThinLabel
         : is_thin_near(image, voxel, *material, true) ? PlaceKind::kThinOutside
                                                       : place.kind;
}

std::vector<SharpPlace> Sheet::sharp_places(const MeshView& view, const LabelImage& image,
                                            std::uint32_t label) const {
  DisjointSets sets(points_.size());
  const std::vector<SharpElement> elements = find_sharp_elements(sets);
  std::vector<std::uint32_t> number(points_.size(), kNone);  // of the place of each root
  std::vector<SharpPlace> places;
  std::vector<std::pair<bool, double>> rank;  // tips first, then by angle
  std::vector<double> pointed;                // the most pointed vertex of each place
  for (const SharpElement& element : elements) {
    std::uint32_t& n = number[sets.root(element.vertex)];
    if (n == kNone) {
      n = static_cast<std::uint32_t>(places.size());
      places.emplace_back();
      rank.emplace_back(false, -1);
      pointed.push_back(0);
    }
    const SharpPlace candidate = place_of(element);
    const std::int64_t size = places[n].size + 1;
    if (std::pair(element.is_tip, candidate.angle_deg) > rank[n]) {
      rank[n] = {element.is_tip, candidate.angle_deg};
      places[n] = candidate;
    }
    places[n].size = size;
    if (std::fabs(pointedness_[element.vertex]) > std::fabs(pointed[n])) {
      pointed[n] = pointedness_[element.vertex];
    }
  }
  for (std::size_t n = 0; n < places.size(); ++n) {
    places[n].kind = pointed[n] > 0 ? PlaceKind::kPit : PlaceKind::kSpike;
  }
  const std::optional<MaterialId> material = find_material(image, view.labels()[label]);
  for (SharpPlace& place : places) {
    place.label = label;
    place.kind = kind_in_image(image, material, place);
  }
  return places;
}

bool is_asked_by_image(const SharpPlace& place) {
  return place.kind == PlaceKind::kThinLabel || place.kind == PlaceKind::kThinOutside;
}

std::vector<NumberedFacet> outer_facets(const Surface& surface, const std::vector<Vec3>& points) {
  std::vector<NumberedFacet> facets;
  for (const SurfaceFacet& facet : surface.facets) {
    if (facet.outside != kOutside) {
      continue;
    }
    NumberedFacet& numbered = facets.emplace_back();
    numbered.corner[3] = NumberedFacet::kNoCorner;
    for (std::size_t n = 0; n < facet.corners(); ++n) {
      numbered.corner[n] = facet.nodes[n];
      numbered.at[n] = points[facet.nodes[n]];
    }
  }
  return facets;
}

void sort_places(std::vector<SharpPlace>& places) {
  std::stable_sort(places.begin(), places.end(), [](const SharpPlace& a, const SharpPlace& b) {
    return std::pair(is_asked_by_image(a), -a.angle_deg) < std::pair(is_asked_by_image(b), -b.angle_deg);
  });
}

std::optional<double> percent(std::int64_t part, std::int64_t of) {
  return of > 0 ? std::optional(100 * static_cast<double>(part) / static_cast<double>(of)) : std::nullopt;
}

json figures_json(const SurfaceShape& shape) {
  return {{"facets", shape.facets},
          {"facet_angle_rms_deg", number_or_null(shape.angle_rms_deg)},
          {"facet_angle_p95_deg", number_or_null(shape.angle_p95_deg)},
          {"facet_angle_p99_deg", number_or_null(shape.angle_p99_deg)},
          {"facet_angle_max_deg", number_or_null(shape.angle_max_deg)},
          {"facets_over_60_deg", shape.edges_over[0]},
          {"facets_over_90_deg", shape.edges_over[1]},
          {"facets_over_120_deg", shape.edges_over[2]},
          {"facets_off_normal_60_percent", number_or_null(percent(shape.off_normal, shape.facets))},
          {"facets_off_corner_60_percent", number_or_null(percent(shape.off_corner, shape.facets))},
          {"facet_mean_ratio",
           {{"min", number_or_null(shape.mean_ratio_min)},
            {"p1", number_or_null(shape.mean_ratio_p1)},
            {"median", number_or_null(shape.mean_ratio_median)}}}};
}

constexpr std::array<const char*, 4> kKindNames{"spike", "pit", "thin_label", "thin_outside"};

json places_json(const std::vector<SharpPlace>& places, const MeshView& view) {
  std::array<std::int64_t, 4> of_kind{};
  auto list = json::array();
  for (const SharpPlace& place : places) {
    const auto kind = static_cast<std::size_t>(place.kind);
    ++of_kind[kind];
    if (list.size() < kMostPlaces) {
      list.push_back({{"label", view.labels()[place.label]},
                      {"kind", kKindNames[kind]},
                      {"at_mm", {place.at_mm.x, place.at_mm.y, place.at_mm.z}},
                      {"angle_deg", place.angle_deg},
                      {"elements", place.size}});
    }
  }
  return {{"count", places.size()},
          {"not_asked", of_kind[0] + of_kind[1]},
          {"asked_by_image", of_kind[2] + of_kind[3]},
          {"spikes", of_kind[0]},
          {"pits", of_kind[1]},
          {"thin_label", of_kind[2]},
          {"thin_outside", of_kind[3]},
          {"list", std::move(list)}};
}

}  // namespace

SurfaceShapes surface_shapes(const MeshView& view, const LabelImage& image, const Surface& surface) {
  const std::size_t labels = view.labels().size();
  const std::vector<Vec3>& points = view.mesh().points;
  SurfaceShapes result;
  result.per_label.resize(labels);
  std::vector<std::vector<SharpPlace>> places(labels);
#pragma omp parallel for schedule(dynamic) if (surface.facets.size() > kWorthThreads)
  for (std::size_t n = 0; n <= labels; ++n) {
    if (n == 0) {
      result.outer = Sheet(outer_facets(surface, points)).figures();
      continue;
    }
    const auto label = static_cast<std::uint32_t>(n - 1);
    const Sheet sheet(numbered_facets(surface, label, points));
    result.per_label[label] = sheet.figures();
    places[label] = sheet.sharp_places(view, image, label);
  }
  for (const std::vector<SharpPlace>& of_label : places) {
    result.places.insert(result.places.end(), of_label.begin(), of_label.end());
  }
  sort_places(result.places);
  return result;
}

json to_json(const SurfaceShapes& shapes, const MeshView& view) {
  json object = figures_json(shapes.outer);
  std::vector<std::array<std::int64_t, 2>> asked(shapes.per_label.size());
  for (const SharpPlace& place : shapes.places) {
    ++asked[place.label][is_asked_by_image(place) ? 1 : 0];
  }
  auto per_label = json::array();
  for (std::size_t l = 0; l < shapes.per_label.size(); ++l) {
    json row = figures_json(shapes.per_label[l]);
    row["label"] = view.labels()[l];
    row["places_not_asked"] = asked[l][0];
    row["places_asked_by_image"] = asked[l][1];
    per_label.push_back(std::move(row));
  }
  object["per_label"] = std::move(per_label);
  object["places"] = places_json(shapes.places, view);
  return object;
}

}  // namespace cbc3d::metrics
