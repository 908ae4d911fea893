#include "baselines/cleaver/triples.hpp"

#include <algorithm>
#include <tuple>

#include "mesher/core/parallel.hpp"

namespace cbc3d::baselines::cleaver {
namespace {

struct FaceUse {
  std::array<VertexId, 3> corners;  // ascending
  std::uint32_t mixed;
  std::uint32_t face;

  bool operator<(const FaceUse& o) const { return std::tie(corners, mixed) < std::tie(o.corners, o.mixed); }
};

bool is_within(const CutLattice& cut, std::uint32_t c) {
  return c != kNone && cut.cuts[c].place == CutPlace::kWithin;
}

// Whether the corners of a face have three materials and two of its edges cuts within.
bool has_triple(const CutLattice& cut, const MixedTet& mixed, std::size_t face) {
  int within = 0;
  for (std::size_t n = 0; n < 3; ++n) {
    const std::uint32_t c = mixed.cuts[kEdgeBetween[kTetFace[face][n]][kTetFace[face][(n + 1) % 3]]];
    if (c == kNone) return false;
    within += is_within(cut, c) ? 1 : 0;
  }
  return within >= 2;
}

std::vector<FaceUse> faces_of_three(const CutLattice& cut) {
  std::vector<FaceUse> uses = collect<FaceUse>(cut.mixed.size(), 4, [&](std::size_t t, const auto& add) {
    const auto& nodes = cut.lattice.tets[cut.mixed[t].tet];
    for (std::uint32_t f = 0; f < 4; ++f) {
      if (!has_triple(cut, cut.mixed[t], f)) continue;
      FaceUse use{{nodes[kTetFace[f][0]], nodes[kTetFace[f][1]], nodes[kTetFace[f][2]]},
                  static_cast<std::uint32_t>(t),
                  f};
      std::sort(use.corners.begin(), use.corners.end());
      add(use);
    }
  });
  sort_distinct(uses);
  return uses;
}

// The cut opposite each corner of a triple, by the tet that the face was found in.
void take_cuts(const CutLattice& cut, const FaceUse& use, Triple& triple) {
  const MixedTet& mixed = cut.mixed[use.mixed];
  const auto& nodes = cut.lattice.tets[mixed.tet];
  const auto& face = kTetFace[use.face];
  for (std::size_t n = 0; n < 3; ++n) {
    const std::uint32_t opposite = mixed.cuts[kEdgeBetween[face[(n + 1) % 3]][face[(n + 2) % 3]]];
    for (std::size_t corner = 0; corner < 3; ++corner) {
      if (triple.corners[corner] == nodes[face[n]]) triple.cuts[corner] = opposite;
    }
  }
}

void number_triples(CutLattice& cut) {
  for (const FaceUse& use : faces_of_three(cut)) {
    if (cut.triples.empty() || cut.triples.back().corners != use.corners) {
      Triple triple;
      triple.corners = use.corners;
      take_cuts(cut, use, triple);
      cut.triples.push_back(triple);
    }
    cut.mixed[use.mixed].triples[use.face] = static_cast<std::uint32_t>(cut.triples.size() - 1);
  }
}

using Barycentric = std::array<double, 3>;

class Locator {
 public:
  Locator(CutLattice& cut, const Indicators& indicators) : cut_(cut), indicators_(indicators) {}

  void locate(Triple& triple) const {
    for (std::size_t n = 0; n < 3; ++n) {
      if (indicators_.is_outside(corner(triple, n))) return locate_on_box(triple, n);
    }
    // The line from a cut to the opposite corner leaves the two materials of the cut near the triple.
    Vec3 sum{};
    for (std::size_t n = 0; n < 3; ++n) {
      const Vec3 from = cut_.place_of(cut_.cuts[triple.cuts[n]]);
      const Vec3 to = corner(triple, n);
      sum += from +
             (to - from) * indicators_.crossing(from, to, material(triple, (n + 1) % 3), material(triple, n));
    }
    place(triple, sum / 3);
  }

 private:
  [[nodiscard]] const Vec3& corner(const Triple& triple, std::size_t n) const {
    return cut_.lattice.points[triple.corners[n]];
  }
  [[nodiscard]] MaterialId material(const Triple& triple, std::size_t n) const {
    return cut_.materials[triple.corners[n]];
  }

  // Two labels meet on the image's side, on the line between their cuts, which are on it.
  void locate_on_box(Triple& triple, std::size_t outside) const {
    const std::size_t a = (outside + 1) % 3, b = (outside + 2) % 3;
    const Vec3 from = cut_.place_of(cut_.cuts[triple.cuts[b]]);  // between `outside` and a
    const Vec3 to = cut_.place_of(cut_.cuts[triple.cuts[a]]);
    const double t = indicators_.crossing(from, to, material(triple, a), material(triple, b));
    const Vec3 at = from + (to - from) * t;
    if (least_ratio(triple, barycentric(triple, at)).second >= 1) {
      triple.place = at;
      return;
    }
    const std::uint32_t nearer = triple.cuts[t < 0.5 ? b : a], other = triple.cuts[t < 0.5 ? a : b];
    if (is_within(cut_, nearer)) {
      triple.snapped_to = nearer;
    } else if (is_within(cut_, other)) {
      triple.snapped_to = other;
    } else {
      place(triple, at);
    }
  }

  // Barycentric coordinates of a place in the face's plane.
  [[nodiscard]] Barycentric barycentric(const Triple& triple, const Vec3& at) const {
    const Vec3 &p = corner(triple, 0), &q = corner(triple, 1), &r = corner(triple, 2);
    const Vec3 normal = (q - p).cross(r - p);
    const double inverse = 1 / normal.squared_norm();
    const double u = (r - q).cross(at - q).dot(normal) * inverse;
    const double v = (p - r).cross(at - r).dot(normal) * inverse;
    return {u, v, 1 - u - v};
  }

  // The least share of corner n beside that of corner m for which the place does not violate the edge
  // opposite n.
  [[nodiscard]] double least_beside(const Triple& triple, std::size_t n, std::size_t m) const {
    const Cut& cut = cut_.cuts[triple.cuts[3 - n - m]];
    const double alpha = triple.corners[m] == cut.first ? cut.alpha_first : cut.alpha_second;
    return alpha / (1 - alpha);
  }

  // The corner whose opposite edge is violated the most, and its share as a multiple of the least that is
  // none.
  [[nodiscard]] std::pair<std::size_t, double> least_ratio(const Triple& triple,
                                                           const Barycentric& shares) const {
    std::pair<std::size_t, double> least{0, 1e300};
    for (std::size_t n = 0; n < 3; ++n) {
      for (std::size_t m = 0; m < 3; ++m) {
        if (m == n) continue;
        const double ratio = shares[n] / std::max(1e-12, least_beside(triple, n, m) * shares[m]);
        if (ratio < least.second) least = {n, ratio};
      }
    }
    return least;
  }

  void place(Triple& triple, const Vec3& at) const {
    Barycentric shares = barycentric(triple, at);
    for (double& share : shares) share = std::max(share, 0.0);
    const auto [corner_beside, ratio] = least_ratio(triple, shares);
    if (ratio < 1 && is_within(cut_, triple.cuts[corner_beside])) {
      triple.snapped_to = triple.cuts[corner_beside];
      return;
    }
    if (ratio < 1) make_safe(triple, shares);
    triple.place =
        corner(triple, 0) * shares[0] + corner(triple, 1) * shares[1] + corner(triple, 2) * shares[2];
  }

  // Moves a place to where it violates nothing.
  void make_safe(const Triple& triple, Barycentric& shares) const {
    for (int round = 0; round < 2; ++round) {
      for (std::size_t n = 0; n < 3; ++n) {
        for (std::size_t m = 0; m < 3; ++m) {
          if (m != n) shares[n] = std::max(shares[n], least_beside(triple, n, m) * shares[m]);
        }
      }
    }
    const double sum = shares[0] + shares[1] + shares[2];
    for (double& share : shares) share /= sum;
  }

  CutLattice& cut_;
  const Indicators& indicators_;
};

}  // namespace

void find_triples(CutLattice& cut, const Indicators& indicators) {
  number_triples(cut);
  const Locator locator(cut, indicators);
#pragma omp parallel for schedule(dynamic, 64)
  for (std::size_t t = 0; t < cut.triples.size(); ++t) locator.locate(cut.triples[t]);
}

}  // namespace cbc3d::baselines::cleaver
