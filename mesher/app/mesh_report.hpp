// The JSON report of a run of the mesher.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "mesher/core/label_names.hpp"
#include "mesher/pipeline/mesh_image.hpp"

namespace cbc3d {

struct RunDescription {
  std::string preset;
  int threads = 0;           ///< in force
  MeshImageOptions options;  ///< the preset's, with the user's settings in place of its own
  int order = 1;             ///< of the tets
  ImageFrame frame;          ///< of the image
  LabelNames names{};        ///< of its labels
  nlohmann::json input;      ///< what was chosen of it, see chosen_json()
  std::string coordinates;   ///< of the mesh's points in its file
  double reading_seconds = 0;
  double writing_seconds = 0;
};

/// What the cleaning changed: counts, and for each label the voxels before and after and the change of
/// volume.
nlohmann::json cleaning_json(const CleanReport& clean, const ImageFrame& frame);

/// Points, seconds by part and figures of each iteration of a deformation.
nlohmann::json deformation_json(const DeformReport& deform);

/// Hexes and pyramids made, vertices before and after.
nlohmann::json mix_json(const MixReport& mix);

/// Vertices and cells by kind.
nlohmann::json counts_json(const Mesh& mesh);

/// "812 vertices, 3900 tets, 12 hexes": kinds without cells are left out, except tets.
std::string counts_text(const Mesh& mesh);

/// Options used, counts, per-material F1 and F2, per-iteration deformation figures, seconds per stage, peak
/// memory, warnings, names of labels and coordinates (the contract's keys).
nlohmann::json report_json(const RunDescription& run, const MeshImageReport& report, const Mesh& mesh);

}  // namespace cbc3d
