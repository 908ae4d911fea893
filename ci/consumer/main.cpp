// Meshes an array in memory, cancels once, evaluates the mesh and checks the figures: all that a user of the
// library needs, with its public headers alone. Exits 0 when everything holds.
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

#include "mesher/core/image_io.hpp"
#include "mesher/core/runtime.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"
#include "mesher/pipeline/mesh_array.hpp"
#include "metrics/evaluate_mesh.hpp"

namespace {

int failures = 0;

void check(bool holds, const char* what) {
  if (!holds) {
    std::printf("does not hold: %s\n", what);
    ++failures;
  }
}

/// Two balls of labels 3 and 8 that share a flat interface, in 40 x 32 x 32 voxels of 1 x 1 x 1.5 mm.
std::vector<std::uint8_t> two_balls(const cbc3d::ImageFrame& frame) {
  std::vector<std::uint8_t> labels(frame.voxel_count(), 0);
  for (std::size_t v = 0; v < labels.size(); ++v) {
    const cbc3d::Index3 at = frame.index_of(v);
    const cbc3d::Vec3 place = frame.local_centre(at[0], at[1], at[2]);
    if ((place - cbc3d::Vec3{14, 16, 24}).norm() < 9) {
      labels[v] = 3;
    } else if ((place - cbc3d::Vec3{25, 16, 24}).norm() < 9) {
      labels[v] = 8;
    }
  }
  return labels;
}

void cancel_once(const std::vector<std::uint8_t>& labels, const cbc3d::ImageFrame& frame) {
  try {
    cbc3d::mesh_array(labels, frame, cbc3d::preset_options("quality", frame),
                      [](std::string_view, double fraction) { return fraction < 0.3; });
    check(false, "an observer that returns false cancels");
  } catch (const cbc3d::Cancelled& cancelled) {
    std::printf("%s\n", cancelled.what());
  }
}

void refuse_once(const std::vector<std::uint8_t>& labels, const cbc3d::ImageFrame& frame) {
  cbc3d::MeshImageOptions options = cbc3d::preset_options("paper", frame);
  options.lattice_spacing_mm = 1e-9;
  try {
    cbc3d::mesh_array(labels, frame, options);
    check(false, "a lattice of a picometre is refused");
  } catch (const cbc3d::InputError& error) {
    std::printf("refused: %s\n", error.what());
    check(error.parameter() == "lattice_spacing_mm", "the refusal names the parameter");
  }
}

cbc3d::Mesh mesh_them(const std::vector<std::uint8_t>& labels, const cbc3d::ImageFrame& frame) {
  int steps = 0;
  const cbc3d::MeshedArray meshed =
      cbc3d::mesh_array(labels, frame, cbc3d::preset_options("quality", frame),
                        [&steps](std::string_view stage, double fraction) {
                          std::printf("%3.0f %% %s\n", 100 * fraction, std::string(stage).c_str());
                          ++steps;
                          return true;
                        });
  check(steps > 3, "the observer sees the stages");
  for (const std::string& warning : meshed.report.warnings) {
    std::printf("warning: %s\n", warning.c_str());
  }
  return meshed.mesh;
}

void evaluate(const cbc3d::Mesh& mesh, const cbc3d::LabelImage& image) {
  const cbc3d::metrics::MeshEvaluation found = cbc3d::metrics::evaluate_mesh(mesh, image);
  std::printf("%zu vertices, %zu tets, smallest dihedral angle %.2f degrees, Hausdorff distance %.3f mm\n",
              found.vertices, found.tets, found.min_dihedral_deg.value_or(0),
              found.hausdorff_mm.value_or(-1));
  check(found.tets == mesh.tets.size() && found.tets > 100, "the mesh has tets");
  check(found.min_dihedral_deg.value_or(0) >= 19.99, "no dihedral angle is below the preset's goal");
  check(found.hausdorff_mm.value_or(1e9) < 1.1 * image.frame.voxel_diagonal_mm(),
        "the surfaces are within 1.1 voxel diagonals");
  check(found.volume_error_percent_max.value_or(1e9) < 2, "the volumes are within 2 %");
  check(found.inverted == 0 && found.conforming && found.self_intersections == 0, "the mesh is valid");
  check(found.components == 2 && found.missing_labels.empty(), "both balls are there");
  check(found.json.find("\"surface_hausdorff_mm\"") != std::string::npos, "the text has all figures");
}

}  // namespace

int main(int argc, char** argv) {
  std::printf("%d threads\n", cbc3d::set_thread_count(2));
  cbc3d::ImageFrame frame;
  frame.size = {40, 32, 32};
  frame.spacing_mm = {1, 1, 1.5};
  frame.origin_mm = {-20, 5, 7};
  const std::vector<std::uint8_t> labels = two_balls(frame);
  cancel_once(labels, frame);
  refuse_once(labels, frame);
  const cbc3d::Mesh mesh = mesh_them(labels, frame);
  check(cbc3d::labels_of(mesh) == std::vector<cbc3d::Label>{3, 8}, "the cells carry the array's own labels");
  const cbc3d::LabelImage image = cbc3d::to_label_image(labels, frame);
  evaluate(mesh, image);
  if (argc > 1) {  // a folder to write to
    const std::string folder = argv[1];
    cbc3d::write_mesh(mesh, folder + "/balls.vtu");
    cbc3d::write_label_image(image, folder + "/balls.nrrd");
    check(cbc3d::read_mesh(folder + "/balls.vtu").cell_count() == mesh.cell_count(),
          "a written mesh is read back");
  }
  std::printf("%d checks failed\n", failures);
  return failures == 0 ? 0 : 1;
}
