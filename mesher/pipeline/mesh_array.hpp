// CBC3D for an array of labels in memory: the entrance for programs that link the library.
#pragma once

#include "mesher/core/label_array.hpp"
#include "mesher/pipeline/mesh_image.hpp"
#include "mesher/pipeline/presets.hpp"

namespace cbc3d {

/// A mesh and what happened on the way to it.
struct MeshedArray {
  Mesh mesh;               ///< in physical space, with the array's own label values
  MeshImageReport report;  ///< its warnings say what of the image the mesh lacks
};

/// Meshes an array of labels. `options` are those of a preset, preset_options("quality", frame), with what
/// differs from it. Throws InputError for an array or options that cannot be meshed, JobError when the mesh
/// would be empty, Cancelled when `observer` returns false. The same bytes come out at any thread count; that
/// is set by set_thread_count (runtime.hpp) for the whole process.
MeshedArray mesh_array(const LabelArray& labels, const ImageFrame& frame, const MeshImageOptions& options,
                       const ProgressObserver& observer = {});

}  // namespace cbc3d
