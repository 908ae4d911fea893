#include "mesher/pipeline/option_table.hpp"

#include <algorithm>
#include <limits>

namespace cbc3d {
namespace {

/// Beyond every length of an image, whose origin is within 1e9 mm.
constexpr double kMost = 1e9;
constexpr NumberRange kPositive{.lowest = 0, .highest = kMost, .excludes_lowest = true};
constexpr NumberRange kStiffness{
    .lowest = 0, .highest = 1e12, .excludes_lowest = true, .excludes_highest = true};
constexpr NumberRange kNotNegative{.lowest = 0, .highest = kMost};
constexpr NumberRange kShare{.lowest = 0, .highest = 1};

/// Names of an enumeration's values.
template <typename Enum>
using ChoiceNames = std::vector<std::pair<std::string, Enum>>;

const ChoiceNames<Connectivity> kConnectivities = {{"vertex", Connectivity::vertex},
                                                   {"edge", Connectivity::edge},
                                                   {"face", Connectivity::face},
                                                   {"no", Connectivity::no}};
const ChoiceNames<TargetPosition> kTargetPositions = {{"voxel-centre", TargetPosition::voxel_centre},
                                                      {"voxel-faces", TargetPosition::voxel_faces}};
const ChoiceNames<NoisyVoxels> kNoisyVoxels = {{"none", NoisyVoxels::none},
                                               {"holes", NoisyVoxels::holes},
                                               {"specks", NoisyVoxels::specks},
                                               {"both", NoisyVoxels::both}};
const ChoiceNames<bool> kAlongNormal = {{"normal", true}, {"full", false}};
const ChoiceNames<OnFailure> kOnFailure = {{"stop", OnFailure::stop}, {"recover", OnFailure::recover}};

/// What setting an option changes beside its own field.
using Consequence = std::function<void(MeshImageOptions&)>;

// The functions below complete a row. `field` gives the option's field in options that are const or not:
// [](auto& o) -> auto& { return o.clean.seed; }.

template <typename Field>
OptionRow number(OptionRow row, Field field, NumberRange range, const Consequence& then = {}) {
  row.kind = OptionKind::number;
  row.range = range;
  row.get = [field](const MeshImageOptions& o) { return OptionValue(field(o)); };
  row.set = [field, then](MeshImageOptions& o, const OptionValue& value) {
    field(o) = std::get<double>(value);
    if (then) then(o);
  };
  return row;
}

template <typename Field>
OptionRow count(OptionRow row, Field field, NumberRange range) {
  row.kind = OptionKind::count;
  row.range = range;
  row.get = [field](const MeshImageOptions& o) { return OptionValue(static_cast<std::int64_t>(field(o))); };
  row.set = [field](MeshImageOptions& o, const OptionValue& value) {
    auto& place = field(o);
    place = static_cast<std::remove_reference_t<decltype(place)>>(std::get<std::int64_t>(value));
  };
  return row;
}

template <typename Field>
OptionRow on_off(OptionRow row, Field field) {
  row.kind = OptionKind::on_off;
  row.get = [field, negates = row.negates_field](const MeshImageOptions& o) {
    return OptionValue(field(o) != negates);
  };
  row.set = [field, negates = row.negates_field](MeshImageOptions& o, const OptionValue& value) {
    field(o) = std::get<bool>(value) != negates;
  };
  return row;
}

template <typename Enum, typename Field>
OptionRow choice(OptionRow row, Field field, const ChoiceNames<Enum>& names) {
  row.kind = OptionKind::choice;
  std::transform(names.begin(), names.end(), std::back_inserter(row.choices),
                 [](const auto& n) { return n.first; });
  row.get = [field, &names](const MeshImageOptions& o) {
    const auto is_chosen = [&](const auto& n) { return n.second == field(o); };
    return OptionValue(std::find_if(names.begin(), names.end(), is_chosen)->first);
  };
  row.set = [field, &names](MeshImageOptions& o, const OptionValue& value) {
    const auto is_named = [&](const auto& n) { return n.first == std::get<std::string>(value); };
    field(o) = std::find_if(names.begin(), names.end(), is_named)->second;
  };
  return row;
}

template <typename Field>
OptionRow label_numbers(OptionRow row, Field field, NumberRange range, const Consequence& then = {}) {
  row.kind = OptionKind::label_numbers;
  row.range = range;
  row.get = [field](const MeshImageOptions& o) { return OptionValue(field(o)); };
  row.set = [field, then](MeshImageOptions& o, const OptionValue& value) {
    for (const auto& [label, number] : std::get<LabelNumbers>(value)) field(o)[label] = number;
    if (then) then(o);
  };
  return row;
}

/// A property of the elastic materials of single labels; a label takes the other one from all.
OptionRow elastic_property(OptionRow row, double ElasticMaterial::*property, NumberRange range) {
  row.kind = OptionKind::label_numbers;
  row.range = range;
  row.get = [property](const MeshImageOptions& o) {
    LabelNumbers numbers;
    for (const auto& [label, material] : o.deform.elasticity.by_label) numbers[label] = material.*property;
    return OptionValue(numbers);
  };
  row.set = [property](MeshImageOptions& o, const OptionValue& value) {
    ElasticityOptions& elasticity = o.deform.elasticity;
    for (const auto& [label, number] : std::get<LabelNumbers>(value)) {
      elasticity.by_label.try_emplace(label, elasticity.all).first->second.*property = number;
    }
  };
  return row;
}

std::vector<OptionRow> cleaning_rows() {
  constexpr OptionGroup kGroup = OptionGroup::cleaning;
  return {
      choice(
          {.name = "relabel-noise",
           .group = kGroup,
           .text = "which isolated voxels are given their neighbours' label"},
          [](auto& o) -> auto& { return o.clean.relabel_noise; }, kNoisyVoxels),
      number(
          {.name = "region-tolerance",
           .group = kGroup,
           .symbol = "SHARE",
           .text = "regions below this share of their label's voxels become background"},
          [](auto& o) -> auto& { return o.clean.region_tolerance; }, kShare),
      on_off(
          {.name = "no-manifold-voxels",
           .group = kGroup,
           .key = "manifold_voxels",
           .text = "leave voxels of a label that touch only by an edge or a vertex as they are",
           .negates_field = true},
          [](auto& o) -> auto& { return o.clean.manifold_voxels; }),
      count({.name = "seed",
             .group = kGroup,
             .symbol = "N",
             .text = "seed of the choice among cleaning templates"},
            [](auto& o) -> auto& { return o.clean.seed; }, {.lowest = 0, .highest = 9e18}),
  };
}

std::vector<OptionRow> lattice_rows() {
  constexpr OptionGroup kGroup = OptionGroup::lattice;
  return {
      number(
          {.name = "lattice-spacing",
           .group = kGroup,
           .symbol = "MM",
           .unit = "mm",
           .key = "lattice_spacing_mm",
           .text = "edge of the coarsest lattice cubes",
           .unset_text = "ten times the mean voxel spacing"},
          [](auto& o) -> auto& { return o.lattice_spacing_mm; }, kPositive),
      number(
          {.name = "fidelity",
           .group = kGroup,
           .symbol = "F",
           .text =
               "a material is refined while its F1 or F2 is below F; where the default is low, the distance "
               "decides"},
          [](auto& o) -> auto& { return o.refine.fidelity; }, {.lowest = 1e-6, .highest = 1}),
      label_numbers({.name = "material-fidelity",
                     .group = kGroup,
                     .symbol = "LABEL=F",
                     .text = "the fidelity of one label",
                     .unset_text = "that of all"},
                    [](auto& o) -> auto& { return o.refine.material_fidelity; },
                    {.lowest = 0, .highest = 1, .excludes_lowest = true}),
      number(
          {.name = "finest-spacing",
           .group = kGroup,
           .symbol = "MM",
           .unit = "mm",
           .key = "finest_spacing_mm",
           .text =
               "the fidelity makes the lattice no finer than this; the distance may go to a quarter of it",
           .unset_text = "the smallest voxel spacing, but at least half the geometric mean"},
          [](auto& o) -> auto& { return o.refine.finest_spacing_mm; }, kPositive),
      number(
          {.name = "max-distance",
           .group = kGroup,
           .symbol = "MM",
           .unit = "mm",
           .key = "max_distance_mm",
           .text = "every boundary voxel has an interface vertex within this distance: the lattice is "
                   "refined for "
                   "it and the improvement keeps it; 0: the lattice is not, and the improvement keeps its "
                   "default",
           .scales_with_voxels = true},
          [](auto& o) -> auto& { return o.refine.max_distance_mm; }, kNotNegative,
          [](MeshImageOptions& o) { o.improve.reach_mm = o.refine.max_distance_mm; }),
      label_numbers(
          {.name = "size",
           .group = kGroup,
           .symbol = "LABEL=MM",
           .unit = "mm",
           .key = "size_mm",
           .text = "the edges of one label's elements are about this long at most",
           .unset_text = "no limit"},
          [](auto& o) -> auto& { return o.refine.size_mm; }, kPositive,
          [](MeshImageOptions& o) { o.improve.size_mm = o.refine.size_mm; }),
      on_off(
          {.name = "topology-checks",
           .group = kGroup,
           .text =
               "make every label's sub-mesh a manifold without small components: refine there, then relabel"},
          [](auto& o) -> auto& { return o.topology.enabled; }),
  };
}

std::vector<OptionRow> mixed_rows() {
  return {on_off(
      {.name = "mixed",
       .group = OptionGroup::mixed,
       .text =
           "hexes in uniform regions and pyramids between them and the tets; with the improvement where the "
           "inside is coarse"},
      [](auto& o) -> auto& { return o.mixed; })};
}

std::vector<OptionRow> improvement_rows() {
  constexpr OptionGroup kGroup = OptionGroup::improvement;
  return {
      on_off(
          {.name = "no-improve",
           .group = kGroup,
           .key = "improve",
           .text = "stop before the improvement",
           .negates_field = true},
          [](auto& o) -> auto& { return o.improve.enabled; }),
      count({.name = "elements",
             .group = kGroup,
             .symbol = "N",
             .text = "about this many elements: all lengths of the preset shrink or grow together until "
                     "there are as many; 0: as many as they give"},
            [](auto& o) -> auto& { return o.elements; }, {.lowest = 0, .highest = 1e9}),
      number(
          {.name = "edge-length",
           .group = kGroup,
           .symbol = "MM",
           .unit = "mm",
           .key = "edge_length_mm",
           .text = "edges of surfaces are about this long: the same by a length",
           .unset_text = "as long as max-distance and deviation let them be"},
          [](auto& o) -> auto& { return o.edge_length_mm; }, kPositive),
      count(
          {.name = "decimation-rounds",
           .group = kGroup,
           .symbol = "N",
           .text =
               "rounds of decimation at most; they end when one removes less than 3 % of the tets; 0: none"},
          [](auto& o) -> auto& { return o.improve.decimation_rounds; }, {.lowest = 0, .highest = 20}),
      number({.name = "deviation",
              .group = kGroup,
              .symbol = "DIAGONALS",
              .unit = "voxel diagonals",
              .key = "deviation_diagonals",
              .text = "facets stay within this distance of the boundary"},
             [](auto& o) -> auto& { return o.improve.deviation_diagonals; }, {.lowest = 0.01, .highest = 2}),
      number(
          {.name = "smoothness",
           .group = kGroup,
           .symbol = "S",
           .text = "share of the pull to the boundary that goes to smooth surfaces"},
          [](auto& o) -> auto& { return o.improve.smoothness; }, kShare),
      number(
          {.name = "smoothness-cap",
           .group = kGroup,
           .symbol = "MM",
           .unit = "mm",
           .key = "smoothness_cap_mm",
           .text = "smoothness moves no vertex farther from the boundary than this",
           .unset_text = "half a voxel, less in thin parts, and no more than the deviation"},
          [](auto& o) -> auto& { return o.improve.smoothness_cap_mm; }, kPositive),
      number(
          {.name = "gradation",
           .group = kGroup,
           .symbol = "G",
           .text = "decimation makes no inner edge longer than about the edges of the nearest surface plus G "
                   "times "
                   "the distance to it"},
          [](auto& o) -> auto& { return o.improve.gradation; }, kNotNegative),
      number(
          {.name = "edges-per-thickness",
           .group = kGroup,
           .symbol = "C",
           .text =
               "in thin parts the decimation makes edges of surfaces about C times as long as the part is "
               "thick; 0: as long as elsewhere"},
          [](auto& o) -> auto& { return o.improve.edges_per_thickness; }, kNotNegative),
  };
}

/// The smallest dihedral angle that the preset's last stage works for.
constexpr auto kMinDihedral = [](auto& o) -> auto& {
  return o.improve.enabled ? o.improve.min_dihedral_deg : o.deform.quality.min_dihedral_deg;
};

std::vector<OptionRow> target_rows() {
  constexpr OptionGroup kGroup = OptionGroup::deformation;
  return {
      count({.name = "iterations", .group = kGroup, .symbol = "N", .text = "iterations of the deformation"},
            [](auto& o) -> auto& { return o.deform.iterations; }, {.lowest = 0, .highest = 1000}),
      choice(
          {.name = "connectivity", .group = kGroup, .text = "pattern that thins the target points"},
          [](auto& o) -> auto& { return o.deform.connectivity; }, kConnectivities),
      choice(
          {.name = "target-position",
           .group = kGroup,
           .text = "where the targets lie: at the centres of boundary voxels, which is half a voxel inside, "
                   "or on "
                   "their faces"},
          [](auto& o) -> auto& { return o.deform.displacement.target_position; }, kTargetPositions),
      choice(
          {.name = "displacement",
           .group = kGroup,
           .text = "a source moves along the surface's normal alone, or by the full mean of its targets"},
          [](auto& o) -> auto& { return o.deform.displacement.along_normal; }, kAlongNormal),
      on_off(
          {.name = "keep-outliers",
           .group = kGroup,
           .key = "reject_outliers",
           .text = "keep targets whose boundary faces the other way, such as the far side of a thin wall",
           .negates_field = true},
          [](auto& o) -> auto& { return o.deform.displacement.reject_outliers; }),
      number(
          {.name = "reach",
           .group = kGroup,
           .symbol = "RADII",
           .unit = "region radii",
           .text =
               "a source without target in its region, whose radius is the mean length of its surface edges, "
               "takes the nearest within this distance; 1: it follows the elastic field"},
          [](auto& o) -> auto& { return o.deform.displacement.reach; }, {.lowest = 1, .highest = 100}),
      number(
          {.name = "pair-distance",
           .group = kGroup,
           .symbol = "DIAGONALS",
           .unit = "voxel diagonals",
           .text =
               "a source or a target farther than this from its nearest partner is pulled within it; 0: off"},
          [](auto& o) -> auto& { return o.deform.displacement.pair_distance; }, kNotNegative),
  };
}

std::vector<OptionRow> solid_rows() {
  constexpr OptionGroup kGroup = OptionGroup::deformation;
  return {
      count({.name = "attempts",
             .group = kGroup,
             .symbol = "N",
             .text = "with on-failure stop: solutions with scaled displacements before it stops"},
            [](auto& o) -> auto& { return o.deform.attempts; }, {.lowest = 0, .highest = 100}),
      choice(
          {.name = "on-failure",
           .group = kGroup,
           .text = "where elements fall below the minimum quality: stop the whole deformation, as the paper "
                   "does, "
                   "or hold back only their vertices and go on"},
          [](auto& o) -> auto& { return o.deform.on_failure; }, kOnFailure),
      number(
          {.name = "young-pa", .group = kGroup, .symbol = "E", .unit = "Pa", .text = "Young's modulus"},
          [](auto& o) -> auto& { return o.deform.elasticity.all.young_pa; }, kStiffness),
      number({.name = "poisson", .group = kGroup, .symbol = "NU", .text = "Poisson's ratio"},
             [](auto& o) -> auto& { return o.deform.elasticity.all.poisson; },
             {.lowest = 0, .highest = 0.499}),
      elastic_property({.name = "material-young",
                        .group = kGroup,
                        .symbol = "LABEL=E",
                        .unit = "Pa",
                        .key = "material_elasticity",
                        .label_key = "young_pa",
                        .text = "Young's modulus of one label",
                        .unset_text = "that of all"},
                       &ElasticMaterial::young_pa, kStiffness),
      elastic_property({.name = "material-poisson",
                        .group = kGroup,
                        .symbol = "LABEL=NU",
                        .key = "material_elasticity",
                        .label_key = "poisson",
                        .text = "Poisson's ratio of one label",
                        .unset_text = "that of all"},
                       &ElasticMaterial::poisson, {.lowest = 0, .highest = 0.5, .excludes_highest = true}),
      number({.name = "min-dihedral",
              .group = kGroup,
              .symbol = "DEG",
              .unit = "deg",
              .key = "min_dihedral_deg",
              .text = "smallest dihedral angle: the goal of the improvement, or what the deformation keeps"},
             kMinDihedral, {.lowest = 0, .highest = 60},
             [](MeshImageOptions& o) {
               const double angle_deg = kMinDihedral(o);
               o.improve.min_dihedral_deg = angle_deg;
               o.deform.quality.min_dihedral_deg = angle_deg;
             }),
      number(
          {.name = "min-scaled-jacobian",
           .group = kGroup,
           .symbol = "J",
           .text = "smallest scaled Jacobian of hexes and pyramids that the deformation keeps, in a norm in "
                   "which "
                   "the lattice's pyramids have 1"},
          [](auto& o) -> auto& { return o.deform.quality.min_scaled_jacobian; }, kShare),
  };
}

}  // namespace

const std::vector<OptionRow>& option_table() {
  static const std::vector<OptionRow> table = [] {
    std::vector<OptionRow> all;
    for (const auto& rows :
         {cleaning_rows(), lattice_rows(), mixed_rows(), improvement_rows(), target_rows(), solid_rows()}) {
      all.insert(all.end(), rows.begin(), rows.end());
    }
    return all;
  }();
  return table;
}

}  // namespace cbc3d
