// The paper's Hausdorff distance under the choices that its description leaves open, of a mesh or, without
// one, of the voxels' own surface: what a mesh that is exactly the segmentation scores.
#include <algorithm>
#include <iomanip>
#include <iostream>
#include <string>

#include "mesher/core/error.hpp"
#include "mesher/core/image_io.hpp"
#include "mesher/mesh_formats/mesh_io.hpp"
#include "metrics/image_boundary.hpp"
#include "metrics/point_set_hausdorff.hpp"
#include "metrics/surface.hpp"

namespace {

using namespace cbc3d;
using namespace cbc3d::metrics;

using PointsOfLabel = std::vector<std::vector<Vec3>>;  // by material

PointsOfLabel voxel_centres(const LabelImage& image) {
  PointsOfLabel points;
  for (const MaterialBoundary& boundary : image_boundaries(image)) points.push_back(boundary.voxel_centres);
  return points;
}

PointsOfLabel face_centres(const LabelImage& image) {
  PointsOfLabel points;
  for (const MaterialBoundary& boundary : image_boundaries(image)) {
    points.emplace_back();
    for (const VoxelFace& face : boundary.faces) points.back().push_back(centre_of(face, image.frame));
  }
  return points;
}

// Voxels with one of 26 neighbours in another material: ITK's signed distance map is zero there.
PointsOfLabel centres_by_26_neighbours(const LabelImage& image) {
  PointsOfLabel points(image.material_count());
  for (std::size_t v = 0; v < image.voxels.size(); ++v) {
    const Index3 at = image.frame.index_of(v);
    const MaterialId own = image.voxels[v];
    bool boundary = false;
    for (int n = 0; n < 27 && !boundary; ++n)
      boundary = image.at_or_background(at[0] + n % 3 - 1, at[1] + n / 3 % 3 - 1, at[2] + n / 9 - 1) != own;
    if (own != kBackground && boundary) points[own].push_back(image.frame.local_centre(at[0], at[1], at[2]));
  }
  return points;
}

// Corners of the exposed faces: the surface vertices of a mesh whose cells are the voxels.
PointsOfLabel face_corners(const LabelImage& image) {
  PointsOfLabel points;
  for (const MaterialBoundary& boundary : image_boundaries(image)) {
    std::vector<Index3> corners;  // in half voxels
    for (const VoxelFace& face : boundary.faces) {
      for (int corner = 0; corner < 4; ++corner) {
        Index3 at{2 * face.voxel[0], 2 * face.voxel[1], 2 * face.voxel[2]};
        at[face.axis] += face.side;
        at[(face.axis + 1) % 3U] += corner % 2 == 0 ? -1 : 1;
        at[(face.axis + 2) % 3U] += corner / 2 == 0 ? -1 : 1;
        corners.push_back(at);
      }
    }
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    points.emplace_back();
    for (const Index3& c : corners) points.back().push_back(.5 * image.frame.local_centre(c[0], c[1], c[2]));
  }
  return points;
}

PointsOfLabel mesh_vertices(const Mesh& mesh, const LabelImage& image) {
  const MeshView view(mesh, image);
  const Surface surface = extract_surface(view, sorted_facets(view));
  PointsOfLabel points(image.material_count());
  for (std::size_t m = 1; m < image.material_count(); ++m) {
    if (const auto index = view.find_label(image.labels[m])) {
      for (const VertexId v : surface.vertices_of[*index]) points[m].push_back(view.local_points()[v]);
    }
  }
  return points;
}

// Background that does not reach the border through faces becomes the label before it in memory.
LabelImage with_holes_filled(LabelImage image) {
  const ImageFrame& frame = image.frame;
  std::vector<bool> reached(image.voxels.size(), false);
  std::vector<std::size_t> stack;
  const auto reach = [&](int i, int j, int k) {
    if (!frame.contains(i, j, k)) return;
    const std::size_t v = frame.offset(i, j, k);
    if (image.voxels[v] == kBackground && !reached[v]) {
      reached[v] = true;
      stack.push_back(v);
    }
  };
  for (std::size_t v = 0; v < image.voxels.size(); ++v) {
    const Index3 at = frame.index_of(v);
    bool border = false;
    for (std::size_t a = 0; a < 3; ++a) border = border || at[a] == 0 || at[a] == frame.size[a] - 1;
    if (border) reach(at[0], at[1], at[2]);
  }
  while (!stack.empty()) {
    const Index3 at = frame.index_of(stack.back());
    stack.pop_back();
    for (std::size_t a = 0; a < 3; ++a) {
      for (const int side : {-1, 1}) {
        Index3 to = at;
        to[a] += side;
        reach(to[0], to[1], to[2]);
      }
    }
  }
  for (std::size_t v = 1; v < image.voxels.size(); ++v) {
    if (image.voxels[v] == kBackground && !reached[v]) image.voxels[v] = image.voxels[v - 1];
  }
  return image;
}

void print(const std::string& what, const PointsOfLabel& image_points, const PointsOfLabel& mesh_points) {
  double to_mesh = 0, to_image = 0;
  for (std::size_t m = 1; m < image_points.size(); ++m) {
    if (const auto found = point_set_distance(image_points[m], mesh_points[m])) {
      to_mesh = std::max(to_mesh, found->image_to_mesh_mm);
      to_image = std::max(to_image, found->mesh_to_image_mm);
    }
  }
  std::cout << std::left << std::setw(52) << what << std::fixed << std::setprecision(3)
            << std::max(to_mesh, to_image) << " mm (image to mesh " << to_mesh << ", mesh to image "
            << to_image << ")\n";
}

int run(int argc, char** argv) {
  const LabelImage image = read_label_image(argv[1]);
  const LabelImage filled = with_holes_filled(image);
  const PointsOfLabel mesh = argc > 2 ? mesh_vertices(read_mesh(argv[2]), image) : face_corners(image);
  std::cout << "voxel diagonal " << image.frame.voxel_diagonal_mm() << " mm\n";
  print("centres of voxels with another face neighbour", voxel_centres(image), mesh);
  print("centres of voxels with another of 26 neighbours", centres_by_26_neighbours(image), mesh);
  print("centres of exposed voxel faces", face_centres(image), mesh);
  print("as the first, holes in the image filled", voxel_centres(filled),
        argc > 2 ? mesh : face_corners(filled));
  return kExitSuccess;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2 || argc > 3) {
    std::cerr << "usage: metrics_protocol_variants IMAGE [MESH]\n";
    return kExitBadInput;
  }
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "metrics_protocol_variants: " << error.what() << '\n';
    return kExitBadInput;
  }
}
