// Elastic properties by label on the command line: --material-young, --material-poisson.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "mesher/deform/elasticity.hpp"

namespace cbc3d {

struct MaterialOptions {
  std::vector<std::string> young, poisson;  ///< LABEL=VALUE
};

void add_material_options(CLI::App& app, MaterialOptions& options);

/// Sets what `options` say of single labels; the other property of such a label is that of all. Throws
/// InputError.
void apply_material_options(const MaterialOptions& options, const LabelImage& image,
                            ElasticityOptions& elasticity);

}  // namespace cbc3d
