// Segmented images from files and to files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "mesher/core/label_image.hpp"
#include "mesher/core/label_names.hpp"

namespace cbc3d {

/// How far a value may be from an integer and still be rounded to it where that is asked for.
inline constexpr double kRoundingTolerance = 1e-4;

/// What is refused without being asked for, and what is taken of a file that holds more than one image.
struct ReadImageOptions {
  bool accept_shear = false;    ///< axes that are sheared become the nearest orthogonal ones
  bool round_values = false;    ///< values within kRoundingTolerance of an integer are that integer
  std::optional<int> volume{};  ///< of a 4-D image, counted from 0; without it one is refused
  std::optional<int> layer{};   ///< of a segmentation in layers, counted from 0; without it all are laid over
                                ///< each other, see combine_layers()
};

/// What an image file says beside its voxels.
struct ImageNotes {
  std::vector<std::string> warnings{};  ///< one line, which names the file, for everything taken for granted
  LabelNames names{};                   ///< of labels that the image has, where the file names them
};

/// Reads a label image with its physical frame: NIfTI-1 and -2, Analyze, NRRD, MetaImage, INRIMAGE, GIPL, MGH
/// and MIF, recognised by their first bytes. A 4-D header whose last dimension is 1 counts as 3-D, layers of
/// segments (3D Slicer) become one image; float pixels are accepted when every value is integral. `warnings`
/// (or null) gains a line, which names the file, for everything that was taken for granted. Throws InputError
/// (one line naming file, finding and remedy) for a missing file, one that has fewer or more bytes than its
/// header promises or fails a check sum, a frame that is none, a 2-D, colour or fractional image, a
/// probability map, a 4-D image without a choice of its volume, or one without any labelled voxel.
LabelImage read_label_image(const std::filesystem::path& path, const ReadImageOptions& options = {},
                            std::vector<std::string>* warnings = nullptr);

/// The same; `notes` gains the warnings and becomes the names.
LabelImage read_label_image(const std::filesystem::path& path, const ReadImageOptions& options,
                            ImageNotes& notes);

/// Checks, before any long work, that an image could be written to `path`: a known extension and a folder
/// that can be written to. Throws InputError.
void require_writable_image_path(const std::filesystem::path& path);

/// Writes a label image as NIfTI, NRRD or MHA by the extension, in the smallest integer type that holds its
/// labels. Atomic. Throws InputError for an unknown extension, JobError when writing fails.
void write_label_image(const LabelImage& image, const std::filesystem::path& path);

}  // namespace cbc3d
