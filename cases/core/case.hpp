// One case of the benchmark: an image and what the meshers are to do with it.
#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "mesher/core/vec3.hpp"

namespace cbc3d::cases {

/// A generated image: which generator (see phantoms/registry.hpp) and its arguments.
struct Phantom {
  std::string name;      ///< of the generator
  Index3 size{0, 0, 0};  ///< voxels along each axis
  Vec3 spacing_mm{1, 1, 1};
  std::uint64_t seed = 0;
  std::string sha256;  ///< of the labels, one byte per voxel, i fastest; empty: not checked
};

/// What is done to the image before any mesher sees it, in this order; see derive.hpp.
struct Derivation {
  bool fill_holes = false;
  Index3 repeat{1, 1, 1};  ///< copies side by side along each axis

  [[nodiscard]] bool repeats() const { return repeat != Index3{1, 1, 1}; }
  [[nodiscard]] bool any() const { return fill_holes || repeats(); }
};

/// Mesher name -> option -> value.
using MesherParameters = std::map<std::string, std::map<std::string, std::string>>;

/// Which row of the table of deformation patterns a case's job stands in.
struct DeformationPattern {
  std::string pattern;  ///< the thinning of the target points: vertex, edge, face or no
  std::string image;    ///< what was done to the image, as the table says it: "as it is"
  std::string before;   ///< the case whose job has no iterations: the mesh before the deformation
};

struct Case {
  std::string name, title;
  std::vector<std::string> suites;
  std::optional<std::string> image_file;  ///< name of the file in a data folder; absent for a phantom
  std::string image_sha256;               ///< of that file, lower-case hexadecimal
  std::string image_source;               ///< where to get it, and its licence
  std::optional<Phantom> phantom;         ///< absent for a file
  Derivation derive;
  MesherParameters parameters;
  /// By the set's name: laid over `parameters` when a run asks for the set.
  std::map<std::string, MesherParameters> parameter_sets;
  std::optional<DeformationPattern> deformation_pattern;  ///< for the table of that name
  nlohmann::json paper = nlohmann::json::object();  ///< the paper's figures for this image, where it has any
};

}  // namespace cbc3d::cases
