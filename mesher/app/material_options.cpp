#include "mesher/app/material_options.hpp"

#include "mesher/app/label_values.hpp"

namespace cbc3d {

void add_material_options(CLI::App& app, MaterialOptions& options) {
  app.add_option("--material-young", options.young, "LABEL=E: Young's modulus of one label, Pa (repeatable)")
      ->allow_extra_args(false);
  app.add_option("--material-poisson", options.poisson, "LABEL=NU: Poisson's ratio of one label (repeatable)")
      ->allow_extra_args(false);
}

void apply_material_options(const MaterialOptions& options, const LabelImage& image,
                            ElasticityOptions& elasticity) {
  const auto own = [&](Label label) -> ElasticMaterial& {
    return elasticity.by_label.try_emplace(label, elasticity.all).first->second;
  };
  const ValueRule positive = {[](double e) { return e > 0 && e < 1e12; },
                              "E with E > 0 Pa, for example 2=6900"};
  for (const auto& [label, young_pa] :
       parse_label_values("--material-young", options.young, image, positive)) {
    own(label).young_pa = young_pa;
  }
  const ValueRule ratio = {[](double nu) { return nu >= 0 && nu < 0.5; },
                           "NU with NU in [0, 0.5), for example 2=0.4"};
  for (const auto& [label, poisson] :
       parse_label_values("--material-poisson", options.poisson, image, ratio)) {
    own(label).poisson = poisson;
  }
}

}  // namespace cbc3d
