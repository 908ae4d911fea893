// Pictures of a mesh: its cut section and its surface.
#pragma once

#include <filesystem>
#include <string>

#include "mesher/core/label_image.hpp"
#include "mesher/core/label_names.hpp"
#include "mesher/core/mesh.hpp"

namespace cbc3d::reports {

struct PictureOptions {
  int size_px = 1200;               ///< width and height
  std::string caption;              ///< shown above the picture
  LabelNames names{};               ///< of the labels, for the legend
  std::filesystem::path small_dir;  ///< where a small copy as JPEG goes, for pages; empty: none
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

/// Draws the outer surface with the elements' edges, six times as near as draw_surface, around the labelled
/// voxel that is nearest to the eye. Throws as above.
void draw_close_up(const Mesh& mesh, const LabelImage& image, const PictureOptions& options,
                   const std::filesystem::path& png);

/// Draws where the interfaces and the surface of the mesh cross the plane of draw_cut_section, as lines over
/// the image's voxels in that plane. Throws as above.
void draw_overlay(const Mesh& mesh, const LabelImage& image, const PictureOptions& options,
                  const std::filesystem::path& png);

/// Draws the cut sections of two meshes side by side. Throws as above.
void draw_beside(const Mesh& left, const Mesh& right, const LabelImage& image,
                 const PictureOptions& left_options, const PictureOptions& right_options,
                 const std::filesystem::path& png);

/// Draws the outer surface, coloured by label, seen obliquely from the front. Throws as above.
void draw_surface(const Mesh& mesh, const LabelImage& image, const PictureOptions& options,
                  const std::filesystem::path& png);

}  // namespace cbc3d::reports
