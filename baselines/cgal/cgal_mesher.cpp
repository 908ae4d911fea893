// Compiled twice: with Sequential_tag, and with Parallel_tag (TBB) when CBC3D_CGAL_PARALLEL is defined.
#include "baselines/cgal/cgal_mesher.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Image_3.h>
#include <CGAL/Labeled_mesh_domain_3.h>
#include <CGAL/Mesh_3/initialize_triangulation_from_labeled_image.h>
#include <CGAL/Mesh_complex_3_in_triangulation_3.h>
#include <CGAL/Mesh_criteria_3.h>
#include <CGAL/Mesh_triangulation_3.h>
#include <CGAL/Random.h>
#include <CGAL/exude_mesh_3.h>
#include <CGAL/lloyd_optimize_mesh_3.h>
#include <CGAL/odt_optimize_mesh_3.h>
#include <CGAL/perturb_mesh_3.h>
#include <CGAL/refine_mesh_3.h>
#ifdef CBC3D_CGAL_PARALLEL
#include <tbb/global_control.h>
#endif

#include <cstdint>
#include <iostream>
#include <limits>
#include <streambuf>
#include <unordered_map>

#include "baselines/cgal/label_weights.hpp"
#include "mesher/core/error.hpp"

namespace cbc3d::baselines {
namespace {

#ifdef CBC3D_CGAL_PARALLEL
using Concurrency = CGAL::Parallel_tag;
#else
using Concurrency = CGAL::Sequential_tag;
#endif
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Domain = CGAL::Labeled_mesh_domain_3<Kernel>;
using Triangulation = CGAL::Mesh_triangulation_3<Domain, CGAL::Default, Concurrency>::type;
using Complex = CGAL::Mesh_complex_3_in_triangulation_3<Triangulation>;
using Criteria = CGAL::Mesh_criteria_3<Triangulation>;

// CGAL's image functions print to standard output, which belongs to the caller's results.
class SilencedStandardOutput {
 public:
  SilencedStandardOutput() : previous_(std::cout.rdbuf(&sink_)) {}
  ~SilencedStandardOutput() { std::cout.rdbuf(previous_); }
  SilencedStandardOutput(const SilencedStandardOutput&) = delete;
  SilencedStandardOutput& operator=(const SilencedStandardOutput&) = delete;

 private:
  struct Sink : std::streambuf {
    int overflow(int c) override { return traits_type::not_eof(c); }
  };
  Sink sink_;
  std::streambuf* previous_;
};

// One voxel of background on every side closes materials that touch the image's border.
constexpr int kPadding = 1;

template <typename Word>
void copy_padded(const LabelImage& image, Word* words) {
  const Index3& n = image.frame.size;
  const std::size_t row = static_cast<std::size_t>(n[0]) + 2 * kPadding;
  const std::size_t slice = row * (static_cast<std::size_t>(n[1]) + 2 * kPadding);
  std::fill(words, words + slice * (static_cast<std::size_t>(n[2]) + 2 * kPadding), Word{0});
  image.voxels.visit([&](const auto* voxels) {
    for (int k = 0; k < n[2]; ++k) {
      for (int j = 0; j < n[1]; ++j) {
        const auto* from = voxels + image.frame.offset(0, j, k);
        Word* to = words + static_cast<std::size_t>(k + kPadding) * slice +
                   static_cast<std::size_t>(j + kPadding) * row + kPadding;
        std::transform(from, from + n[0], to, [](MaterialId m) { return static_cast<Word>(m); });
      }
    }
  });
}

// The image in CGAL's own form: padded, material indices as words of `word_bytes`, no translation.
CGAL::Image_3 to_cgal_image(const LabelImage& image, std::size_t word_bytes) {
  const auto padded = [&](int axis) {
    return static_cast<std::size_t>(image.frame.size[axis]) + 2 * kPadding;
  };
  const Vec3& h = image.frame.spacing_mm;
  _image* raw =
      _createImage(padded(0), padded(1), padded(2), 1, h.x, h.y, h.z, word_bytes, WK_FIXED, SGN_UNSIGNED);
  if (raw == nullptr || raw->data == nullptr) throw std::bad_alloc();
  if (word_bytes == 1) {
    copy_padded(image, static_cast<std::uint8_t*>(raw->data));
  } else {
    copy_padded(image, static_cast<std::uint16_t*>(raw->data));
  }
  return CGAL::Image_3(raw, CGAL::Image_3::OWN_THE_DATA);
}

// An image of 8-bit weights in the frame of `padded`; invalid, which stands for no weights, without any.
CGAL::Image_3 to_weight_image(const std::vector<std::uint8_t>& weights, const CGAL::Image_3& padded) {
  if (weights.empty()) return {};
  _image* raw = _createImage(padded.xdim(), padded.ydim(), padded.zdim(), 1, padded.vx(), padded.vy(),
                             padded.vz(), 1, WK_FIXED, SGN_UNSIGNED);
  if (raw == nullptr || raw->data == nullptr) throw std::bad_alloc();
  std::copy(weights.begin(), weights.end(), static_cast<std::uint8_t*>(raw->data));
  return CGAL::Image_3(raw, CGAL::Image_3::OWN_THE_DATA);
}

std::vector<std::uint8_t> weights_of(const LabelImage& image, const CgalOptions& options) {
  if (options.label_weights <= 0) return {};
  return label_weights(image, kPadding, options.label_weights * image.frame.spacing_mm.max_coeff());
}

// Gives first points on the surface of every connected component, so that none is missed.
void seed_components(Complex& complex, const Domain& domain, const CGAL::Image_3& image,
                     const Criteria& criteria, std::size_t word_bytes) {
  const SilencedStandardOutput silence;
  if (word_bytes == 1) {
    initialize_triangulation_from_labeled_image(complex, domain, image, criteria, std::uint8_t{});
  } else {
    initialize_triangulation_from_labeled_image(complex, domain, image, criteria, std::uint16_t{});
  }
}

// The number of iterations ends both, not a time, so that they repeat.
void relax(Complex& complex, const Domain& domain, const CgalOptions& options, StageClock& stages) {
  namespace p = CGAL::parameters;
  constexpr double kNoTimeLimit = 0;
  if (options.odt_iterations > 0) {
    stages.start("odt");
    CGAL::odt_optimize_mesh_3(complex, domain, p::time_limit = kNoTimeLimit,
                              p::max_iteration_number = static_cast<std::size_t>(options.odt_iterations));
  }
  if (options.lloyd_iterations > 0) {
    stages.start("lloyd");
    CGAL::lloyd_optimize_mesh_3(complex, domain, p::time_limit = kNoTimeLimit,
                                p::max_iteration_number = static_cast<std::size_t>(options.lloyd_iterations));
  }
}

void improve(Complex& complex, const Domain& domain, const CgalOptions& options, StageClock& stages) {
  namespace p = CGAL::parameters;
  if (options.perturb) {
    stages.start("perturb");
    CGAL::perturb_mesh_3(complex, domain, p::time_limit = options.time_limit_s,
                         p::sliver_bound = options.perturb_sliver_bound_deg);
  }
  if (options.exude) {
    stages.start("exude");
    CGAL::exude_mesh_3(complex, p::time_limit = options.time_limit_s,
                       p::sliver_bound = options.exude_sliver_bound_deg);
  }
}

Mesh to_mesh(const Complex& complex, const LabelImage& image) {
  Mesh mesh;
  const Vec3 shift = static_cast<double>(kPadding) * image.frame.spacing_mm;
  std::unordered_map<const void*, VertexId> ids;
  ids.reserve(complex.triangulation().number_of_vertices());
  mesh.tets.nodes.reserve(complex.number_of_cells_in_complex());
  mesh.tets.labels.reserve(complex.number_of_cells_in_complex());
  for (auto cell = complex.cells_in_complex_begin(); cell != complex.cells_in_complex_end(); ++cell) {
    std::array<VertexId, 4> nodes{};
    for (int i = 0; i < 4; ++i) {
      const auto vertex = cell->vertex(i);
      const auto [entry, is_new] = ids.try_emplace(&*vertex, static_cast<VertexId>(mesh.points.size()));
      if (is_new) {
        const auto& q = vertex->point();
        mesh.points.push_back(Vec3{q.x(), q.y(), q.z()} - shift);
      }
      nodes[static_cast<std::size_t>(i)] = entry->second;
    }
    mesh.tets.add(nodes, image.labels[static_cast<std::size_t>(complex.subdomain_index(cell))]);
  }
  return mesh;
}

}  // namespace

Mesh mesh_with_cgal(const LabelImage& image, const CgalOptions& options, StageClock& stages) {
  namespace p = CGAL::parameters;
#ifdef CBC3D_CGAL_PARALLEL
  const tbb::global_control pool(tbb::global_control::max_allowed_parallelism,
                                 static_cast<std::size_t>(options.threads));
#endif
  CGAL::get_default_random() = CGAL::Random(options.seed);
  CGAL::Random random(options.seed);

  stages.start("image");
  const std::size_t word_bytes = image.material_count() > std::numeric_limits<std::uint8_t>::max() ? 2 : 1;
  const CGAL::Image_3 cgal_image = to_cgal_image(image, word_bytes);
  // The domain refers to both images.
  const CGAL::Image_3 weight_image = to_weight_image(weights_of(image, options), cgal_image);
  const Domain domain =
      Domain::create_labeled_image_mesh_domain(cgal_image, p::weights = weight_image, p::p_rng = &random);
  const Criteria criteria(p::facet_angle = options.facet_angle_deg, p::facet_size = options.facet_size_mm,
                          p::facet_distance = options.facet_distance_mm,
                          p::cell_radius_edge_ratio = options.cell_radius_edge_ratio,
                          p::cell_size = options.cell_size_mm);
  stages.start("seed");
  Complex complex;
  seed_components(complex, domain, cgal_image, criteria, word_bytes);
  stages.start("refine");
  CGAL::refine_mesh_3(complex, domain, criteria, p::no_lloyd(), p::no_odt(), p::no_perturb(), p::no_exude());
  relax(complex, domain, options, stages);
  improve(complex, domain, options, stages);

  stages.start("export");
  Mesh mesh = to_mesh(complex, image);
  if (mesh.tets.size() == 0) {
    throw JobError(
        "CGAL made no cell: the labelled regions are smaller than the criteria; lower --facet-size and "
        "--cell-size");
  }
  map_to_physical(mesh, image.frame);
  return mesh;
}

}  // namespace cbc3d::baselines
