// The catalog of metrics: one row for every figure that is shown, gated or looked up by name.
//
// Result lines, tables, the gate, charts, the HTML report and `cbc3d-bench list metrics` are made from these
// rows, in their order. A figure that evaluate() gives and that has no row is in the result lines all the
// same.
#pragma once

#include <array>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>

namespace cbc3d::metrics {

/// In which direction a figure is worse; `other`: any change is.
enum class Worse { neither, higher, lower, other };

/// How far the gate lets a figure fall: by the larger of both. Figures of one class share a tolerance, which
/// a baseline may set by the class's name.
struct Tolerance {
  std::string_view name;
  double relative = 0;
  double absolute = 0;  ///< in the unit of the result line
};
inline constexpr Tolerance kExact{"exact"};
inline constexpr Tolerance kCounts{"counts", 0.05,
                                   10};  ///< of meshers that are not deterministic; else exact
inline constexpr Tolerance kAngle{"angle", 0.01, 0.5};
inline constexpr Tolerance kJacobian{"jacobian", 0.02, 0.005};
inline constexpr Tolerance kShape{"shape", 0.02, 0.005};  ///< of measures of which 1 is best
inline constexpr Tolerance kRatio{"ratio", 0.05, 0.1};    ///< of two lengths or sizes, at least 1
inline constexpr Tolerance kDistance{"distance", 0.05, 0.01};
inline constexpr Tolerance kDice{"dice", 0.002, 0.002};
inline constexpr Tolerance kVolume{"volume", 0.05, 0.1};
inline constexpr Tolerance kMemory{"memory", 0.5, 16777216};
inline constexpr Tolerance kTime{"time", 0.4, 0.25};

/// What a figure of the table `targets` is about. Hard faults should be 0; all others are compared with the
/// best mesher's.
enum class Purpose { none, distance, smooth, shape, solver, topology, labels, count, time, hard_fault };

/// Where a figure comes from.
enum class Source {
  line,    ///< from its key in a result line: a number, a flag as 0 or 1, or the length of a list
  labels,  ///< the largest magnitude at `per_label` over the labels
  derived  ///< from other figures by `derive`
};

/// How the gate joins the repeats of a job.
enum class Repeats { median, least };

class Figures;
using Derivation = std::optional<double> (*)(const Figures& figures);

struct Metric {
  std::string_view key;   ///< path in a result line, and name in the gate's baseline
  std::string_view name;  ///< of a row of a table, without the unit
  std::string_view long_name =
      {};                      ///< for texts and charts, where `name` is too short for them; empty: `name`
  std::string_view unit = {};  ///< after `scale`; empty: none
  int decimals = 0;
  Worse worse = Worse::neither;
  const Tolerance* gate = nullptr;  ///< null: not gated
  std::string_view tables = {};     ///< names of the tables that show it, separated by blanks
  std::string_view chart = {};      ///< file name of a chart over all cases; empty: none
  Purpose purpose = Purpose::none;  ///< none: not in the table `targets`
  bool logarithmic = false;         ///< axis of that chart
  std::string_view per_label = {};  ///< path of the same figure in the lists of labels; empty: none
  std::string_view worst_label =
      {};                           ///< path of the label, or labels, where it is the worst; empty: not known
  std::string_view published = {};  ///< key among the published figures of a case's manifest; empty: none
  double scale = 1;                 ///< shown value over that of the result line
  Repeats repeats = Repeats::median;
  Source source = Source::line;
  Derivation derive = nullptr;
};

std::optional<double> element_count(const Figures& figures);
std::optional<double> elements_per_second(const Figures& figures);
/// By how much the lowest Dice of a label falls short of 1.
std::optional<double> dice_shortfall(const Figures& figures);
/// CPU time over that of the reference work done beside the job, so that a slower or busier machine does not
/// count. The system's CPU time is left out: it is the price of memory pages, which the reference work does
/// not ask for, and peak memory is gated by itself.
std::optional<double> time_ratio(const Figures& figures);

// clang-format off
inline constexpr Metric kCatalog[] = {
    // The mesh
    {.key = "counts.vertices", .name = "vertices", .worse = Worse::other, .gate = &kCounts,
     .tables = "vertices targets", .purpose = Purpose::count, .published = "vertices"},
    {.key = "counts.tets", .name = "tetrahedra", .worse = Worse::other, .gate = &kCounts,
     .tables = "element_count vertices", .published = "tets"},
    {.key = "counts.pyramids", .name = "pyramids", .worse = Worse::other, .gate = &kCounts, .tables = "vertices",
     .published = "pyramids"},
    {.key = "counts.wedges", .name = "wedges", .worse = Worse::other, .gate = &kCounts, .tables = "vertices",
     .published = "wedges"},
    {.key = "counts.hexes", .name = "hexahedra", .worse = Worse::other, .gate = &kCounts, .tables = "vertices",
     .published = "hexes"},
    {.key = "elements", .name = "elements", .tables = "speed", .source = Source::derived, .derive = element_count},

    {.key = "quality.min_dihedral_deg", .name = "min dihedral angle", .long_name = "smallest dihedral angle",
     .unit = "deg", .decimals = 2, .worse = Worse::lower, .gate = &kAngle, .tables = "element_quality",
     .per_label = "quality.per_label.min_dihedral_deg", .published = "min_dihedral_deg"},
    {.key = "quality.max_dihedral_deg", .name = "max dihedral angle", .long_name = "largest dihedral angle",
     .unit = "deg", .decimals = 2, .worse = Worse::higher, .gate = &kAngle, .tables = "element_quality",
     .per_label = "quality.per_label.max_dihedral_deg", .published = "max_dihedral_deg"},
    {.key = "quality.min_scaled_jacobian", .name = "min scaled Jacobian", .long_name = "smallest scaled Jacobian",
     .decimals = 4, .worse = Worse::lower, .gate = &kJacobian, .tables = "element_quality",
     .per_label = "quality.per_label.min_scaled_jacobian"},
    {.key = "quality.inverted", .name = "inverted elements", .worse = Worse::higher, .gate = &kExact,
     .tables = "element_quality", .per_label = "quality.per_label.inverted"},

    // Shape of the elements as an interpolation error sees it, and gradation (element_shape.hpp, gradation.hpp)
    {.key = "quality.mean_ratio.min", .name = "mean ratio, smallest", .decimals = 3, .worse = Worse::lower,
     .gate = &kShape, .tables = "shape", .per_label = "quality.per_label.mean_ratio.min"},
    {.key = "quality.mean_ratio.p0_1", .name = "mean ratio, .1 %", .decimals = 3, .worse = Worse::lower,
     .per_label = "quality.per_label.mean_ratio.p0_1"},
    {.key = "quality.mean_ratio.p1", .name = "mean ratio, 1 %", .decimals = 3,
     .worse = Worse::lower, .gate = &kShape, .tables = "shape targets", .purpose = Purpose::shape,
     .per_label = "quality.per_label.mean_ratio.p1"},
    {.key = "quality.mean_ratio.p5", .name = "mean ratio, 5 %", .decimals = 3, .worse = Worse::lower,
     .per_label = "quality.per_label.mean_ratio.p5"},
    {.key = "quality.mean_ratio.median", .name = "mean ratio, median", .decimals = 3,
     .worse = Worse::lower, .gate = &kShape, .tables = "shape targets", .purpose = Purpose::shape,
     .per_label = "quality.per_label.mean_ratio.median"},
    {.key = "quality.mean_ratio.below_0_3_percent",
     .name = "mean ratio below .3", .long_name = "share of elements whose mean ratio is below .3", .unit = "%",
     .decimals = 2, .worse = Worse::higher, .tables = "shape targets", .purpose = Purpose::shape,
     .per_label = "quality.per_label.mean_ratio.below_0_3_percent"},
    {.key = "quality.radius_ratio.min", .name = "radius ratio, smallest", .decimals = 3, .worse = Worse::lower,
     .per_label = "quality.per_label.radius_ratio.min"},
    {.key = "quality.radius_ratio.p0_1", .name = "radius ratio, .1 %", .decimals = 3, .worse = Worse::lower,
     .per_label = "quality.per_label.radius_ratio.p0_1"},
    {.key = "quality.radius_ratio.p1", .name = "radius ratio, 1 %", .decimals = 3, .worse = Worse::lower,
     .per_label = "quality.per_label.radius_ratio.p1"},
    {.key = "quality.radius_ratio.p5", .name = "radius ratio, 5 %", .decimals = 3, .worse = Worse::lower,
     .per_label = "quality.per_label.radius_ratio.p5"},
    {.key = "quality.radius_ratio.median", .name = "radius ratio, median", .decimals = 3, .worse = Worse::lower,
     .per_label = "quality.per_label.radius_ratio.median"},
    {.key = "quality.radius_ratio.below_0_3_percent", .name = "radius ratio below .3",
     .long_name = "share of elements whose radius ratio is below .3", .unit = "%", .decimals = 2,
     .worse = Worse::higher, .per_label = "quality.per_label.radius_ratio.below_0_3_percent"},
    {.key = "quality.height_ratio.min", .name = "height ratio, smallest", .decimals = 3, .worse = Worse::lower,
     .per_label = "quality.per_label.height_ratio.min"},
    {.key = "quality.height_ratio.p0_1", .name = "height ratio, .1 %", .decimals = 3, .worse = Worse::lower,
     .per_label = "quality.per_label.height_ratio.p0_1"},
    {.key = "quality.height_ratio.p1", .name = "height ratio, 1 %", .decimals = 3, .worse = Worse::lower,
     .per_label = "quality.per_label.height_ratio.p1"},
    {.key = "quality.height_ratio.p5", .name = "height ratio, 5 %", .decimals = 3, .worse = Worse::lower,
     .per_label = "quality.per_label.height_ratio.p5"},
    {.key = "quality.height_ratio.median", .name = "height ratio, median", .decimals = 3, .worse = Worse::lower,
     .per_label = "quality.per_label.height_ratio.median"},
    {.key = "quality.height_ratio.below_0_3_percent", .name = "height ratio below .3",
     .long_name = "share of elements whose height ratio is below .3", .unit = "%", .decimals = 2,
     .worse = Worse::higher, .per_label = "quality.per_label.height_ratio.below_0_3_percent"},
    {.key = "quality.edge_ratio.median", .name = "edge ratio, median",
     .long_name = "longest over shortest edge of an element, median", .decimals = 2, .worse = Worse::higher,
     .tables = "shape", .per_label = "quality.per_label.edge_ratio.median"},
    {.key = "quality.edge_ratio.p99",
     .name = "edge ratio, 99 %", .long_name = "longest over shortest edge of an element, 99 %", .decimals = 2,
     .worse = Worse::higher, .gate = &kRatio, .tables = "shape targets", .purpose = Purpose::shape,
     .per_label = "quality.per_label.edge_ratio.p99"},
    {.key = "quality.edge_ratio.max", .name = "edge ratio, largest",
     .long_name = "longest over shortest edge of an element, largest", .decimals = 2, .worse = Worse::higher,
     .gate = &kRatio, .tables = "shape", .per_label = "quality.per_label.edge_ratio.max"},
    {.key = "quality.neighbour_size_ratio.p99", .name = "size ratio of neighbours, 99 %",
     .decimals = 2, .worse = Worse::higher, .gate = &kRatio, .tables = "shape targets", .purpose = Purpose::shape},
    {.key = "quality.neighbour_size_ratio.max", .name = "size ratio of neighbours, largest", .decimals = 2,
     .worse = Worse::higher, .tables = "shape"},
    {.key = "quality.vertex_edge_ratio.p99", .name = "edge ratio at a vertex, 99 %",
     .long_name = "longest over shortest edge at a vertex, 99 %", .decimals = 2, .worse = Worse::higher,
     .tables = "shape"},
    {.key = "quality.vertex_edge_ratio.max", .name = "edge ratio at a vertex, largest",
     .long_name = "longest over shortest edge at a vertex, largest", .decimals = 2, .worse = Worse::higher},
    {.key = "quality.valence_median", .name = "edges at a vertex, median", .worse = Worse::higher,
     .tables = "shape"},
    {.key = "quality.valence_p99", .name = "edges at a vertex, 99 %", .worse = Worse::higher, .tables = "shape"},
    {.key = "quality.valence_max", .name = "edges at a vertex, largest", .worse = Worse::higher,
     .gate = &kCounts, .tables = "shape targets", .purpose = Purpose::shape},
    {.key = "quality.inner_vertices_percent", .name = "vertices inside",
     .long_name = "share of vertices that are not on the outer surface", .unit = "%", .decimals = 1,
     .tables = "shape", .per_label = "quality.per_label.inner_vertices_percent"},

    // Whether it is a mesh, and of the topology of the image
    {.key = "topology.conforming", .name = "conforming", .worse = Worse::lower, .gate = &kExact},
    {.key = "topology.non_manifold_edges", .name = "non-manifold edges", .worse = Worse::higher, .gate = &kExact,
     .per_label = "topology.per_label.non_manifold_edges"},
    {.key = "topology.non_manifold_vertices", .name = "non-manifold vertices", .worse = Worse::higher,
     .gate = &kExact, .per_label = "topology.per_label.non_manifold_vertices"},
    {.key = "topology.self_intersections", .name = "self-intersections", .worse = Worse::higher, .gate = &kExact,
     .tables = "element_quality", .per_label = "topology.per_label.self_intersections"},
    {.key = "topology.differences", .name = "topology differences",
     .long_name = "parts, tunnels and cavities that the mesh has more or fewer than the image, over all labels",
     .worse = Worse::higher, .gate = &kExact, .tables = "element_quality",
     .per_label = "topology.per_label.differences"},
    {.key = "topology.components", .name = "components", .worse = Worse::other, .gate = &kCounts,
     .per_label = "topology.per_label.components"},

    // How the surface looks: of all labels as one (surface_shape.hpp)
    {.key = "surface.facet_angle_rms_deg",
     .name = "angle between facets, rms", .long_name = "angle between neighbouring facets, rms", .unit = "deg",
     .decimals = 1, .worse = Worse::higher, .gate = &kAngle, .tables = "surface targets",
     .purpose = Purpose::smooth, .per_label = "surface.per_label.facet_angle_rms_deg"},
    {.key = "surface.facet_angle_p95_deg", .name = "angle between facets, 95 %",
     .long_name = "angle between neighbouring facets, 95 %", .unit = "deg", .decimals = 1, .worse = Worse::higher,
     .tables = "surface", .per_label = "surface.per_label.facet_angle_p95_deg"},
    {.key = "surface.facet_angle_p99_deg", .name = "angle between facets, 99 %",
     .long_name = "angle between neighbouring facets, 99 %", .unit = "deg", .decimals = 1, .worse = Worse::higher,
     .tables = "surface", .per_label = "surface.per_label.facet_angle_p99_deg"},
    {.key = "surface.facet_angle_max_deg", .name = "angle between facets, largest",
     .long_name = "angle between neighbouring facets, largest", .unit = "deg", .decimals = 1,
     .worse = Worse::higher, .per_label = "surface.per_label.facet_angle_max_deg"},
    {.key = "surface.facets_over_60_deg", .name = "pairs of facets over 60 deg",
     .long_name = "pairs of neighbouring facets at more than 60 degrees", .worse = Worse::higher,
     .per_label = "surface.per_label.facets_over_60_deg"},
    {.key = "surface.facets_over_90_deg",
     .name = "pairs of facets over 90 deg", .long_name = "pairs of neighbouring facets at more than 90 degrees",
     .worse = Worse::higher, .gate = &kCounts, .tables = "surface targets", .purpose = Purpose::smooth,
     .per_label = "surface.per_label.facets_over_90_deg"},
    {.key = "surface.facets_over_120_deg", .name = "pairs of facets over 120 deg",
     .long_name = "pairs of neighbouring facets at more than 120 degrees", .worse = Worse::higher,
     .tables = "surface", .per_label = "surface.per_label.facets_over_120_deg"},
    {.key = "surface.facets_off_normal_60_percent",
     .name = "facets off their vertices' normals",
     .long_name = "share of facets over 60 degrees off the mean of their vertices' normals",
     .unit = "%", .decimals = 2, .worse = Worse::higher, .tables = "surface targets",
     .purpose = Purpose::smooth, .per_label = "surface.per_label.facets_off_normal_60_percent"},
    {.key = "surface.facets_off_corner_60_percent", .name = "facets off a vertex's normal",
     .long_name = "share of facets over 60 degrees off the normal of one of their vertices", .unit = "%",
     .decimals = 2, .worse = Worse::higher, .per_label = "surface.per_label.facets_off_corner_60_percent"},
    {.key = "surface.facet_mean_ratio.min", .name = "facet mean ratio, smallest", .decimals = 3,
     .worse = Worse::lower, .per_label = "surface.per_label.facet_mean_ratio.min"},
    {.key = "surface.facet_mean_ratio.p1", .name = "facet mean ratio, 1 %", .decimals = 3, .worse = Worse::lower,
     .tables = "surface", .per_label = "surface.per_label.facet_mean_ratio.p1"},
    {.key = "surface.facet_mean_ratio.median", .name = "facet mean ratio, median", .decimals = 3,
     .worse = Worse::lower, .tables = "surface", .per_label = "surface.per_label.facet_mean_ratio.median"},
    {.key = "surface.places.not_asked",
     .name = "sharp places not asked for", .long_name = "spikes and pits, which nothing in the image asks for",
     .worse = Worse::higher, .gate = &kCounts, .tables = "surface targets", .purpose = Purpose::smooth,
     .per_label = "surface.per_label.places_not_asked"},
    {.key = "surface.places.spikes", .name = "spikes", .worse = Worse::higher, .tables = "surface"},
    {.key = "surface.places.pits", .name = "pits", .worse = Worse::higher, .tables = "surface"},

    // What a finite-element solver makes of it (solver/README.md): of evaluations with --solve alone
    {.key = "solver.poisson_p1.h1_relative",
     .name = "P1 H1 error", .long_name = "Poisson, order 1: relative error of the gradient (H1)", .decimals = 5,
     .worse = Worse::higher, .tables = "solver targets", .purpose = Purpose::solver},
    {.key = "solver.poisson_p1.l2_relative", .name = "P1 L2 error",
     .long_name = "Poisson, order 1: relative error of the field (L2)", .decimals = 6, .worse = Worse::higher,
     .tables = "solver"},
    {.key = "solver.poisson_p1.unknowns", .name = "P1 unknowns", .long_name = "Poisson, order 1: unknowns",
     .tables = "solver"},
    {.key = "solver.poisson_p1.cg_iterations",
     .name = "P1 CG iterations",
     .long_name = "Poisson, order 1: iterations of conjugate gradients with Jacobi's preconditioner, to 1e-8",
     .worse = Worse::higher,
     .tables = "solver targets", .purpose = Purpose::solver},
    {.key = "solver.poisson_p1.lambda_max", .name = "P1 lambda max",
     .long_name = "Poisson, order 1: largest eigenvalue of the scaled stiffness matrix", .decimals = 3,
     .worse = Worse::higher, .tables = "solver"},
    {.key = "solver.poisson_p2.h1_relative",
     .name = "P2 H1 error", .long_name = "Poisson, order 2: relative error of the gradient (H1)", .decimals = 5,
     .worse = Worse::higher, .tables = "solver targets", .purpose = Purpose::solver},
    {.key = "solver.poisson_p2.l2_relative", .name = "P2 L2 error",
     .long_name = "Poisson, order 2: relative error of the field (L2)", .decimals = 6, .worse = Worse::higher,
     .tables = "solver"},
    {.key = "solver.poisson_p2.unknowns", .name = "P2 unknowns", .long_name = "Poisson, order 2: unknowns",
     .tables = "solver"},
    {.key = "solver.poisson_p2.cg_iterations", .name = "P2 CG iterations",
     .long_name = "Poisson, order 2: iterations of conjugate gradients with Jacobi's preconditioner, to 1e-8",
     .worse = Worse::higher, .tables = "solver"},
    {.key = "solver.poisson_p2.lambda_max", .name = "P2 lambda max",
     .long_name = "Poisson, order 2: largest eigenvalue of the scaled stiffness matrix", .decimals = 3,
     .worse = Worse::higher, .tables = "solver"},

    // What making it cost
    {.key = "time_s.mesh", .name = "time",
     .long_name = "meshing time, end to end without reading and writing files", .unit = "s", .decimals = 2,
     .worse = Worse::higher, .tables = "time speed targets", .chart = "time",
     .purpose = Purpose::time, .logarithmic = true, .published = "time_s"},
    {.key = "time_s.process_wall", .name = "time with files", .unit = "s", .decimals = 2, .worse = Worse::higher,
     .tables = "speed"},
    {.key = "time_s.cpu", .name = "CPU time", .unit = "s", .decimals = 2,
     .worse = Worse::higher, .tables = "time speed targets", .purpose = Purpose::time, .repeats = Repeats::least},
    {.key = "time_s.system_cpu", .name = "system's CPU time", .unit = "s", .decimals = 2,
     .worse = Worse::higher, .tables = "speed"},
    {.key = "time_s.reference_cpu", .name = "CPU time of the reference work", .unit = "s", .decimals = 3,
     .repeats = Repeats::least},
    {.key = "threads", .name = "threads", .tables = "time speed", .published = "threads"},
    {.key = "elements_per_second", .name = "elements per second", .worse = Worse::lower, .tables = "speed",
     .source = Source::derived, .derive = elements_per_second},
    {.key = "time_ratio", .name = "CPU time over the reference work's", .decimals = 2, .worse = Worse::higher,
     .gate = &kTime, .source = Source::derived, .derive = time_ratio},

    // How near it comes to the image. HD is the paper's Hausdorff distance.
    {.key = "fidelity.hausdorff_mm", .name = "HD", .long_name = "Hausdorff distance (the paper's)", .unit = "mm",
     .decimals = 2, .worse = Worse::higher, .gate = &kDistance, .tables = "fidelity speed", .chart = "hausdorff",
     .per_label = "fidelity.per_label.hausdorff_mm", .published = "hausdorff_mm"},
    {.key = "fidelity.image_to_mesh_mm", .name = "image to mesh", .unit = "mm", .decimals = 2,
     .worse = Worse::higher, .tables = "deformation_patterns", .per_label = "fidelity.per_label.image_to_mesh_mm"},
    {.key = "fidelity.mesh_to_image_mm", .name = "mesh to image", .unit = "mm", .decimals = 2,
     .worse = Worse::higher, .tables = "deformation_patterns", .per_label = "fidelity.per_label.mesh_to_image_mm"},
    {.key = "fidelity.surface_hausdorff_mm", .name = "surface Hausdorff distance", .unit = "mm", .decimals = 2,
     .worse = Worse::higher, .gate = &kDistance, .tables = "fidelity deformation_patterns",
     .chart = "surface-distance", .per_label = "fidelity.per_label.surface_hausdorff_mm"},
    {.key = "fidelity.mean_distance_mm", .name = "mean surface distance", .unit = "mm",
     .decimals = 3, .worse = Worse::higher, .gate = &kDistance, .tables = "targets", .purpose = Purpose::distance,
     .per_label = "fidelity.per_label.mean_distance_mm"},
    {.key = "fidelity.hd95_mm", .name = "95 % surface distance", .unit = "mm",
     .decimals = 2, .worse = Worse::higher, .gate = &kDistance, .tables = "fidelity deformation_patterns targets",
     .purpose = Purpose::distance, .per_label = "fidelity.per_label.hd95_mm"},
    {.key = "volume_error_percent", .name = "largest volume error of a label", .unit = "%", .decimals = 2,
     .worse = Worse::higher, .gate = &kVolume, .tables = "fidelity deformation_patterns",
     .per_label = "fidelity.per_label.volume_error_percent", .source = Source::labels},
    {.key = "fidelity.dice_min", .name = "lowest Dice of a label", .decimals = 4, .worse = Worse::lower,
     .gate = &kDice, .tables = "fidelity", .per_label = "fidelity.per_label.dice"},
    {.key = "fidelity.missing_labels", .name = "labels missing", .worse = Worse::higher, .tables = "fidelity"},

    // The figures to look at first
    {.key = "summary.min_dihedral_deg", .name = "min dihedral angle", .unit = "deg", .decimals = 2,
     .worse = Worse::lower, .tables = "targets", .purpose = Purpose::shape,
     .worst_label = "summary.min_dihedral_label"},
    {.key = "summary.elements", .name = "elements", .worse = Worse::higher, .tables = "targets",
     .purpose = Purpose::count},
    {.key = "summary.hausdorff_mm", .name = "HD", .long_name = "Hausdorff distance (the paper's), worst label",
     .unit = "mm", .decimals = 2, .worse = Worse::higher, .tables = "targets", .purpose = Purpose::distance,
     .worst_label = "summary.hausdorff_label"},
    {.key = "summary.hausdorff_diagonals", .name = "HD",
     .long_name = "Hausdorff distance (the paper's), worst label", .unit = "voxel diagonals", .decimals = 2,
     .worse = Worse::higher, .worst_label = "summary.hausdorff_label"},
    {.key = "summary.image_to_mesh_diagonals", .name = "HD image to mesh", .unit = "voxel diagonals", .decimals = 2,
     .worse = Worse::higher, .worst_label = "summary.image_to_mesh_label"},
    {.key = "summary.mesh_to_image_diagonals", .name = "HD mesh to image", .unit = "voxel diagonals", .decimals = 2,
     .worse = Worse::higher, .worst_label = "summary.mesh_to_image_label"},
    {.key = "summary.union_hausdorff_mm", .name = "HD of the union", .unit = "mm", .decimals = 2,
     .worse = Worse::higher, .tables = "targets", .purpose = Purpose::distance},
    {.key = "summary.union_hausdorff_diagonals", .name = "HD of the union", .unit = "voxel diagonals",
     .decimals = 2, .worse = Worse::higher},
    {.key = "summary.union_image_to_mesh_diagonals", .name = "HD of the union, image to mesh",
     .unit = "voxel diagonals", .decimals = 2, .worse = Worse::higher},
    {.key = "summary.union_mesh_to_image_diagonals", .name = "HD of the union, mesh to image",
     .unit = "voxel diagonals", .decimals = 2, .worse = Worse::higher},
    {.key = "dice_shortfall", .name = "1 - lowest Dice of a label", .decimals = 4, .worse = Worse::higher,
     .tables = "targets", .purpose = Purpose::labels, .worst_label = "summary.dice_label",
     .source = Source::derived, .derive = dice_shortfall},
    {.key = "summary.volume_error_percent", .name = "volume error, labels above 500 voxels", .unit = "%",
     .decimals = 2, .worse = Worse::higher, .tables = "targets", .purpose = Purpose::labels,
     .worst_label = "summary.volume_error_label"},
    {.key = "summary.topology_differences", .name = "parts, tunnels and cavities too many or few",
     .worse = Worse::higher, .tables = "targets", .purpose = Purpose::topology,
     .worst_label = "summary.topology_difference_labels"},
    {.key = "summary.inverted", .name = "inverted elements", .worse = Worse::higher,
     .tables = "targets", .purpose = Purpose::hard_fault, .worst_label = "summary.inverted_labels"},
    {.key = "summary.non_manifold_edges", .name = "non-manifold edges", .worse = Worse::higher,
     .tables = "targets", .purpose = Purpose::hard_fault, .worst_label = "summary.non_manifold_labels"},
    {.key = "summary.non_manifold_vertices", .name = "non-manifold vertices", .worse = Worse::higher,
     .tables = "targets", .purpose = Purpose::hard_fault, .worst_label = "summary.non_manifold_labels"},
    {.key = "summary.self_intersections", .name = "self-intersections", .worse = Worse::higher,
     .tables = "targets", .purpose = Purpose::hard_fault, .worst_label = "summary.self_intersection_labels"},
    {.key = "summary.missing_labels", .name = "labels above 50 voxels lost", .worse = Worse::higher,
     .tables = "targets", .purpose = Purpose::hard_fault, .worst_label = "summary.missing_labels"},
    {.key = "summary.topology_difference_labels", .name = "labels of another topology", .worse = Worse::higher,
     .tables = "targets", .purpose = Purpose::hard_fault, .worst_label = "summary.topology_difference_labels"},

    // Against the true shape, where it is known
    {.key = "shape.normal_deviation_deg", .name = "normal deviation, mean", .unit = "deg", .decimals = 2,
     .worse = Worse::higher, .tables = "smoothness", .per_label = "shape.per_label.normal_deviation_deg"},
    {.key = "shape.area_excess_percent", .name = "area excess", .unit = "%", .decimals = 2, .worse = Worse::other,
     .tables = "smoothness", .per_label = "shape.per_label.area_excess_percent"},
    {.key = "shape.mean_distance_mm", .name = "distance to the shape, mean", .unit = "mm", .decimals = 3,
     .worse = Worse::higher, .tables = "smoothness", .per_label = "shape.per_label.mean_distance_mm"},
    {.key = "shape.max_distance_mm", .name = "distance to the shape, largest", .unit = "mm", .decimals = 2,
     .worse = Worse::higher, .tables = "smoothness", .per_label = "shape.per_label.max_distance_mm"},

    {.key = "quality.inner_vertices", .name = "vertices inside"},

    {.key = "peak_rss_bytes", .name = "peak memory", .unit = "MB", .worse = Worse::higher, .gate = &kMemory,
     .tables = "time speed", .scale = 1e-6, .repeats = Repeats::least},
};
// clang-format on

inline constexpr std::size_t kMetricCount = std::size(kCatalog);

/// A row's number in the catalog.
enum class MetricId : std::size_t {};

constexpr const Metric& metric(MetricId id) {
  return kCatalog[static_cast<std::size_t>(id)];
}

/// The number of the row with a key. A key without a row does not compile.
consteval MetricId metric_id(std::string_view key) {
  for (std::size_t n = 0; n < kMetricCount; ++n) {
    if (kCatalog[n].key == key) {
      return MetricId{n};
    }
  }
  throw "the catalog has no such key";
}

/// All numbers, in the catalog's order.
constexpr std::array<MetricId, kMetricCount> all_metrics() {
  std::array<MetricId, kMetricCount> ids{};
  for (std::size_t n = 0; n < kMetricCount; ++n) {
    ids[n] = MetricId{n};
  }
  return ids;
}

/// A value, or none, for every row of the catalog, in the unit of the result line.
class Figures {
 public:
  [[nodiscard]] const std::optional<double>& operator[](MetricId id) const {
    return values_[static_cast<std::size_t>(id)];
  }
  std::optional<double>& operator[](MetricId id) { return values_[static_cast<std::size_t>(id)]; }

  /// Computes the rows of Source::derived from the others.
  void derive();

 private:
  std::array<std::optional<double>, kMetricCount> values_{};
};

/// "HD (mm)".
std::string title(const Metric& metric);

/// The long name, or the name where there is none.
std::string_view words(const Metric& metric);

/// True when the metric is a row, or a column, of the table of that name.
bool is_shown_in(const Metric& metric, std::string_view table);

/// "distance", "hard fault"; empty for none.
const char* words(Purpose purpose);

/// The catalog as a Markdown table.
std::string catalog_text();

}  // namespace cbc3d::metrics
