#include "mesher/pipeline/mesh_array.hpp"

#include <utility>

#include "mesher/core/error.hpp"

namespace cbc3d {

MeshedArray mesh_array(const LabelArray& labels, const ImageFrame& frame, const MeshImageOptions& options,
                       const ProgressObserver& observer) {
  MeshedArray result;
  result.mesh = mesh_image(to_label_image(labels, frame), options, Progress(observer), result.report);
  if (result.mesh.cell_count() == 0) {
    throw JobError(
        "the mesh is empty: no label is larger than the lattice; give a smaller lattice_spacing_mm");
  }
  return result;
}

}  // namespace cbc3d
