// Pictures of a mesh: its cut section and its surface.
#pragma once

#include <filesystem>
#include <string>

#include "mesher/core/label_image.hpp"
#include "mesher/core/mesh.hpp"

namespace cbc3d::reports {

struct PictureOptions {
  int size_px = 1200;   ///< width and height
  std::string caption;  ///< shown above the picture
};

/// Where to look from. It depends on the image alone, so that all meshes of an image are seen alike.
struct View {
  Vec3 centre_mm;               ///< middle of the labelled voxels, physical
  Vec3 extent_mm{1, 1, 1};      ///< of the labelled voxels along the image axes
  Mat3 axes{Mat3::identity()};  ///< columns: the image axes in physical space
};

View view_of(const LabelImage& image);

/// Draws the half of the mesh behind the plane through the middle of the labelled voxels, normal to the
/// image's third axis, as whole elements with their edges, coloured by label; seen as in radiology, from the
/// feet. Throws JobError when the picture cannot be written.
void draw_cut_section(const Mesh& mesh, const LabelImage& image, const PictureOptions& options,
                      const std::filesystem::path& png);

/// Draws the outer surface, coloured by label, seen obliquely from the front. Throws as above.
void draw_surface(const Mesh& mesh, const LabelImage& image, const PictureOptions& options,
                  const std::filesystem::path& png);

}  // namespace cbc3d::reports
