#include "mesher/segment/segment_image.hpp"

#include <itkFastMarchingUpwindGradientImageFilter.h>
#include <itkGeodesicActiveContourLevelSetImageFilter.h>
#include <itkGradientMagnitudeRecursiveGaussianImageFilter.h>
#include <itkImageRegionIterator.h>
#include <itkImageRegionIteratorWithIndex.h>
#include <itkRegionOfInterestImageFilter.h>
#include <itkSignedMaurerDistanceMapImageFilter.h>
#include <itkSmoothingRecursiveGaussianImageFilter.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "mesher/core/error.hpp"
#include "mesher/core/read_image.hpp"

namespace cbc3d {
namespace {

namespace fs = std::filesystem;
using Grey = itk::Image<float, 3>;
using Mask = itk::Image<unsigned char, 3>;
using Marching = itk::FastMarchingUpwindGradientImageFilter<Grey, Grey>;

std::string text_of(const Vec3& p) {
  return std::to_string(p.x) + "," + std::to_string(p.y) + "," + std::to_string(p.z);
}

/// The image of a file as ITK's filters take it.
Grey::Pointer read_grey(const fs::path& path, const SegmentOptions& options) {
  const GreyImage image = read_grey_image(path, {.volume = options.volume});
  auto grey = Grey::New();
  Grey::SizeType size;
  Grey::SpacingType spacing;
  Grey::PointType origin;
  Grey::DirectionType direction;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<unsigned>(axis);
    size[a] = static_cast<itk::SizeValueType>(image.frame.size[a]);
    spacing[a] = image.frame.spacing_mm[axis];
    origin[a] = image.frame.origin_mm[axis];
    for (int row = 0; row < 3; ++row) {
      direction(static_cast<unsigned>(row), a) = image.frame.direction(row, axis);
    }
  }
  grey->SetRegions(size);
  grey->SetSpacing(spacing);
  grey->SetOrigin(origin);
  grey->SetDirection(direction);
  grey->Allocate();
  std::copy(image.values.begin(), image.values.end(), grey->GetBufferPointer());
  return grey;
}

Grey::IndexType index_at(const Grey& image, const Vec3& p, const char* what) {
  Grey::PointType point;
  for (int axis = 0; axis < 3; ++axis) {
    point[static_cast<unsigned>(axis)] = p[axis];
  }
  Grey::IndexType index;
  if (!image.TransformPhysicalPointToIndex(point, index)) {
    throw InputError(std::string(what) + " " + text_of(p) +
                     " lies outside the image; give a physical (LPS) position in mm");
  }
  return index;
}

double quantile(std::vector<double> values, double share) {
  const auto at = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

/// What the image looks like in and around the structure.
struct Levels {
  double edge_gradient, noise_gradient, inside, outside;
};

/// The image under the Gaussian, and the size of its gradient.
struct Smoothed {
  Grey::Pointer level, gradient;
};

Smoothed smooth(const Grey::Pointer& image, double sigma_mm) {
  auto level = itk::SmoothingRecursiveGaussianImageFilter<Grey, Grey>::New();
  level->SetInput(image);
  level->SetSigma(sigma_mm);
  level->Update();
  auto gradient = itk::GradientMagnitudeRecursiveGaussianImageFilter<Grey, Grey>::New();
  gradient->SetInput(image);
  gradient->SetSigma(sigma_mm);
  gradient->Update();
  return {level->GetOutput(), gradient->GetOutput()};
}

/// Along a ray from a seed: the gradient at the first wall, and the level a little behind it.
struct Wall {
  double gradient = 0, level_behind = 0;
};

/// The first wall is the first peak of the gradient that half of the highest on the ray is not above.
Wall wall_on_ray(const Smoothed& smoothed, const Grey::IndexType& seed, const std::array<int, 3>& direction,
                 double sigma_voxels) {
  std::vector<double> gradient, level;
  Grey::IndexType at = seed;
  const auto region = smoothed.level->GetLargestPossibleRegion();
  while (region.IsInside(at)) {
    gradient.push_back(smoothed.gradient->GetPixel(at));
    level.push_back(smoothed.level->GetPixel(at));
    for (unsigned axis = 0; axis < 3; ++axis) {
      at[axis] += direction[axis];
    }
  }
  const double highest = *std::max_element(gradient.begin(), gradient.end());
  for (std::size_t n = 1; n + 1 < gradient.size(); ++n) {
    if (gradient[n] >= highest / 2 && gradient[n] >= gradient[n - 1] && gradient[n] >= gradient[n + 1]) {
      const std::size_t behind = n + static_cast<std::size_t>(std::ceil(2.5 * sigma_voxels));
      return {gradient[n], level[std::min(behind, level.size() - 1)]};
    }
  }
  return {highest, level.back()};
}

/// The median of the walls that rays in 26 directions from every seed meet.
Levels measure(const Smoothed& smoothed, const std::vector<Grey::IndexType>& seeds, double sigma_voxels) {
  std::vector<double> walls, behind, inside;
  for (const auto& seed : seeds) {
    inside.push_back(smoothed.level->GetPixel(seed));
    for (int code = 0; code < 27; ++code) {
      const std::array<int, 3> direction{code % 3 - 1, code / 3 % 3 - 1, code / 9 - 1};
      if (code != 13) {
        const Wall wall = wall_on_ray(smoothed, seed, direction, sigma_voxels);
        walls.push_back(wall.gradient);
        behind.push_back(wall.level_behind);
      }
    }
  }
  const float* gradient = smoothed.gradient->GetBufferPointer();
  std::vector<double> everywhere(
      gradient, gradient + smoothed.gradient->GetLargestPossibleRegion().GetNumberOfPixels());
  return {quantile(walls, 0.5), quantile(everywhere, 0.5), quantile(inside, 0.5), quantile(behind, 0.5)};
}

double sigmoid(double x) {
  return 1 / (1 + std::exp(-x));
}

/// Near 1 where the gradient is that of noise, near 0 where it is that of a wall.
double edge_stop(double gradient, const Levels& levels) {
  const double width = (levels.edge_gradient - levels.noise_gradient) / 6;
  return sigmoid((0.5 * (levels.edge_gradient + levels.noise_gradient) - gradient) / width);
}

/// Near 1 where the level is that of the structure, near 0 where it is that around it.
double alike(double level, const Levels& levels) {
  const double width = (levels.inside - levels.outside) / 8;
  return sigmoid((level - 0.5 * (levels.inside + levels.outside)) / width);
}

Grey::Pointer new_like(const Grey& image) {
  auto made = Grey::New();
  made->CopyInformation(&image);
  made->SetRegions(image.GetLargestPossibleRegion());
  made->Allocate();
  return made;
}

template <class Value>
Grey::Pointer mapped(const Smoothed& smoothed, const Value& value) {
  auto result = new_like(*smoothed.level);
  const float* level = smoothed.level->GetBufferPointer();
  const float* gradient = smoothed.gradient->GetBufferPointer();
  float* out = result->GetBufferPointer();
  const auto count = static_cast<std::size_t>(result->GetLargestPossibleRegion().GetNumberOfPixels());
#pragma omp parallel for
  for (std::size_t v = 0; v < count; ++v) {
    out[v] = static_cast<float>(value(level[v], gradient[v]));
  }
  return result;
}

Marching::NodeContainerPointer nodes_at(const std::vector<Grey::IndexType>& indices) {
  auto nodes = Marching::NodeContainer::New();
  for (std::size_t n = 0; n < indices.size(); ++n) {
    Marching::NodeType node;
    node.SetIndex(indices[n]);
    node.SetValue(0);
    nodes->InsertElement(static_cast<unsigned>(n), node);
  }
  return nodes;
}

/// What the front has covered when it meets the targets; at least the seeds.
Mask::Pointer march(const Grey::Pointer& speed, const std::vector<Grey::IndexType>& seeds,
                    const std::vector<Grey::IndexType>& targets, FrontStop stop, std::size_t& covered) {
  auto marching = Marching::New();
  marching->SetInput(speed);
  marching->SetTrialPoints(nodes_at(seeds));
  marching->SetTargetPoints(nodes_at(targets));
  if (stop == FrontStop::all_targets) {
    marching->SetTargetReachedModeToAllTargets();
  } else {
    marching->SetTargetReachedModeToOneTarget();
  }
  marching->SetGenerateGradientImage(false);
  marching->Update();
  const double end = marching->GetTargetValue();
  auto mask = Mask::New();
  mask->CopyInformation(speed);
  mask->SetRegions(speed->GetLargestPossibleRegion());
  mask->Allocate();
  const float* time = marching->GetOutput()->GetBufferPointer();
  unsigned char* inside = mask->GetBufferPointer();
  const auto count = static_cast<std::size_t>(mask->GetLargestPossibleRegion().GetNumberOfPixels());
  covered = 0;
  for (std::size_t v = 0; v < count; ++v) {
    inside[v] = time[v] <= end ? 1 : 0;
    covered += inside[v];
  }
  return mask;
}

/// Box of the covered voxels, with room for the level set to move.
Mask::RegionType box_of(const Mask& mask) {
  constexpr unsigned kRoom = 12;
  Mask::IndexType low = mask.GetLargestPossibleRegion().GetUpperIndex(), high{{0, 0, 0}};
  itk::ImageRegionConstIteratorWithIndex<Mask> voxel(&mask, mask.GetLargestPossibleRegion());
  for (; !voxel.IsAtEnd(); ++voxel) {
    if (voxel.Get() != 0) {
      for (unsigned axis = 0; axis < 3; ++axis) {
        low[axis] = std::min(low[axis], voxel.GetIndex()[axis]);
        high[axis] = std::max(high[axis], voxel.GetIndex()[axis]);
      }
    }
  }
  Mask::RegionType box;
  box.SetIndex(low);
  box.SetUpperIndex(high);
  box.PadByRadius(kRoom);
  box.Crop(mask.GetLargestPossibleRegion());
  return box;
}

/// The level set's filter mixes gradients in physical space with steps along the image's axes, which only
/// images with axes along the patient's forgive.
template <class Image>
typename Image::Pointer cropped(const typename Image::Pointer& image, const typename Image::RegionType& box) {
  auto crop = itk::RegionOfInterestImageFilter<Image, Image>::New();
  crop->SetInput(image);
  crop->SetRegionOfInterest(box);
  crop->Update();
  const typename Image::Pointer result = crop->GetOutput();
  typename Image::DirectionType straight;
  straight.SetIdentity();
  result->SetDirection(straight);
  return result;
}

/// The level set that starts at the border of `start`; negative inside.
Grey::Pointer evolve(const Mask::Pointer& start, const Grey::Pointer& edge_stops,
                     const SegmentOptions& options, int& iterations) {
  auto distance = itk::SignedMaurerDistanceMapImageFilter<Mask, Grey>::New();
  distance->SetInput(start);
  distance->SetUseImageSpacing(true);
  distance->SetSquaredDistance(false);
  distance->SetInsideIsPositive(false);
  auto contour = itk::GeodesicActiveContourLevelSetImageFilter<Grey, Grey>::New();
  contour->SetInput(distance->GetOutput());
  contour->SetFeatureImage(edge_stops);
  contour->SetPropagationScaling(static_cast<float>(options.propagation));
  contour->SetCurvatureScaling(static_cast<float>(options.curvature));
  contour->SetAdvectionScaling(1);
  contour->SetMaximumRMSError(options.least_change);
  contour->SetNumberOfIterations(static_cast<unsigned>(options.iterations));
  contour->Update();
  iterations = static_cast<int>(contour->GetElapsedIterations());
  return contour->GetOutput();
}

ImageFrame frame_of(const Grey& image) {
  ImageFrame frame;
  const auto size = image.GetLargestPossibleRegion().GetSize();
  for (unsigned axis = 0; axis < 3; ++axis) {
    frame.size[axis] = static_cast<int>(size[axis]);
    frame.spacing_mm[static_cast<int>(axis)] = image.GetSpacing()[axis];
    frame.origin_mm[static_cast<int>(axis)] = image.GetOrigin()[axis];
    for (unsigned row = 0; row < 3; ++row) {
      frame.direction(static_cast<int>(row), static_cast<int>(axis)) = image.GetDirection()[row][axis];
    }
  }
  return frame;
}

/// The inside of the level set on a box, as label 1 of the whole image.
LabelImage label_of(const Grey& level_set, const Mask::RegionType& box, const ImageFrame& frame) {
  LabelImage result;
  result.frame = frame;
  result.labels = {0, 1};
  result.voxels.assign(frame.voxel_count(), kBackground);
  itk::ImageRegionConstIteratorWithIndex<Grey> voxel(&level_set, level_set.GetLargestPossibleRegion());
  for (; !voxel.IsAtEnd(); ++voxel) {
    if (voxel.Get() <= 0) {
      Index3 at{};
      for (unsigned axis = 0; axis < 3; ++axis) {
        at[axis] = static_cast<int>(voxel.GetIndex()[axis] -
                                    level_set.GetLargestPossibleRegion().GetIndex(axis) + box.GetIndex(axis));
      }
      result.voxels[frame.offset(at[0], at[1], at[2])] = 1;
    }
  }
  return result;
}

void require_usable(const Levels& levels) {
  if (!(levels.edge_gradient > levels.noise_gradient) || levels.inside == levels.outside) {
    throw InputError("no wall is found around the seeds (gradient " + std::to_string(levels.edge_gradient) +
                         " a mm there, " + std::to_string(levels.noise_gradient) +
                         " elsewhere); move them, or give edge_gradient and contrast",
                     "edge_gradient");
  }
}

std::vector<Grey::IndexType> indices_at(const Grey& image, const std::vector<Vec3>& positions,
                                        const char* what) {
  if (positions.empty()) {
    throw InputError(std::string("no ") + what + " is given; give at least one");
  }
  std::vector<Grey::IndexType> indices;
  indices.reserve(positions.size());
  for (const Vec3& p : positions) {
    indices.push_back(index_at(image, p, what));
  }
  return indices;
}

Levels levels_of(const Smoothed& smoothed, const std::vector<Grey::IndexType>& seeds, double sigma_voxels,
                 const SegmentOptions& options) {
  Levels levels = measure(smoothed, seeds, sigma_voxels);
  if (options.edge_gradient > 0) {
    levels.edge_gradient = options.edge_gradient;
  }
  if (options.contrast != 0) {
    levels.outside = levels.inside - options.contrast;
  }
  require_usable(levels);
  return levels;
}

}  // namespace

LabelImage segment_image(const fs::path& grey_image, const SegmentOptions& options, const Progress& progress,
                         SegmentReport& report) {
  progress.step("reading " + grey_image.string(), 0);
  const auto image = read_grey(grey_image, options);
  const auto seeds = indices_at(*image, options.seeds_mm, "seed");
  const auto targets = indices_at(*image, options.targets_mm, "target");
  const auto spacing = image->GetSpacing();
  const double mean_spacing = (spacing[0] + spacing[1] + spacing[2]) / 3;
  report.sigma_mm = options.sigma_mm > 0 ? options.sigma_mm : 0.75 * mean_spacing;
  progress.step("smoothing", 0.1);
  const Smoothed smoothed = smooth(image, report.sigma_mm);
  const Levels levels = levels_of(smoothed, seeds, report.sigma_mm / mean_spacing, options);
  report.edge_gradient = levels.edge_gradient;
  report.noise_gradient = levels.noise_gradient;
  report.inside_level = levels.inside;
  report.outside_level = levels.outside;
  const auto stops = mapped(smoothed, [&](double, double g) { return edge_stop(g, levels); });
  const auto speed =
      mapped(smoothed, [&](double level, double g) { return edge_stop(g, levels) * alike(level, levels); });
  progress.step("fast marching", 0.3);
  const auto start = march(speed, seeds, targets, options.stop, report.front_voxels);
  progress.step("level set", 0.5);
  const auto box = box_of(*start);
  const auto level_set =
      evolve(cropped<Mask>(start, box), cropped<Grey>(stops, box), options, report.iterations);
  LabelImage result = label_of(*level_set, box, frame_of(*image));
  report.voxels = result.voxels_per_material()[1];
  return result;
}

}  // namespace cbc3d
