#include "mesher/formats/dicom_segmentation.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include "mesher/formats/byte_stream.hpp"
#include "mesher/formats/dicom_data_set.hpp"
#include "mesher/formats/header_text.hpp"

namespace cbc3d::formats {
namespace {

namespace tag {
constexpr std::uint32_t kClass = 0x00080016, kModality = 0x00080060;
constexpr std::uint32_t kFrames = 0x00280008, kRows = 0x00280010, kColumns = 0x00280011;
constexpr std::uint32_t kBits = 0x00280100, kPixels = 0x7FE00010;
constexpr std::uint32_t kType = 0x00620001, kSegments = 0x00620002, kSegmentNumber = 0x00620004,
                        kSegmentLabel = 0x00620005;
constexpr std::uint32_t kShared = 0x52009229, kPerFrame = 0x52009230;
constexpr std::uint32_t kPositions = 0x00209113, kPosition = 0x00200032;
constexpr std::uint32_t kOrientations = 0x00209116, kOrientation = 0x00200037;
constexpr std::uint32_t kMeasures = 0x00289110, kSpacing = 0x00280030, kThickness = 0x00180050,
                        kBetween = 0x00180088;
constexpr std::uint32_t kIdentifications = 0x0062000A, kReferenced = 0x0062000B;
}  // namespace tag

constexpr const char* kSegmentationClass = "1.2.840.10008.5.1.4.1.1.66.4";
/// By which a plane may lie beside its place, voxels.
constexpr double kMostAside = 0.1;

double dot(const Triple& a, const Triple& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Triple cross(const Triple& a, const Triple& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Triple minus(const Triple& a, const Triple& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

[[noreturn]] void refuse_other(const DicomDataSet& file) {
  const std::string modality = file.text(tag::kModality);
  if (modality == "RTSTRUCT") {
    throw FormatError(
        "it is a DICOM structure set, of contours and no voxels; rasterise it (plastimatch convert) to NIfTI "
        "or NRRD");
  }
  if (modality == "SEG") {
    throw FormatError(
        "it is a DICOM label map or surface segmentation; convert it to a binary one, NIfTI or NRRD");
  }
  throw FormatError("it is DICOM of the modality " + in_quotes(modality) +
                    ", no segmentation; convert the series to NIfTI or NRRD (dcm2niix) and segment it");
}

void require_binary(const DicomDataSet& file) {
  if (file.text(tag::kClass) != kSegmentationClass) {
    refuse_other(file);
  }
  if (file.text(tag::kType) == "FRACTIONAL") {
    throw FormatError(
        "it is a fractional DICOM segmentation, of probabilities; export a binary one (threshold it first)");
  }
  if (file.text(tag::kType) != "BINARY" || file.number(tag::kBits, 0) != 1) {
    throw FormatError("it is a DICOM segmentation of the type " + in_quotes(file.text(tag::kType)) +
                      " with " + std::to_string(file.number(tag::kBits, 0)) +
                      " bits per voxel, which is not BINARY with one; export it again");
  }
}

/// What the functional groups say of a frame, its own before those that all frames share.
class FrameGroups {
 public:
  FrameGroups(const DicomDataSet& own, const DicomDataSet* shared) : own_(own), shared_(shared) {}

  [[nodiscard]] const DicomDataSet* group(std::uint32_t sequence) const {
    if (!own_.items(sequence).empty()) {
      return &own_.items(sequence)[0];
    }
    const bool is_shared = shared_ != nullptr && !shared_->items(sequence).empty();
    return is_shared ? &shared_->items(sequence)[0] : nullptr;
  }
  /// Throws FormatError naming the field where it is missing or not `count` finite numbers.
  [[nodiscard]] std::vector<double> numbers(std::uint32_t sequence, std::uint32_t field, std::size_t count,
                                            const char* name) const {
    const DicomDataSet* const found = group(sequence);
    if (found == nullptr || found->text(field).empty()) {
      throw FormatError("a frame of the DICOM segmentation has no " + std::string(name) +
                        ", so that its place is not known; export it again");
    }
    return numbers_of(name, found->text(field), count);
  }

 private:
  const DicomDataSet& own_;
  const DicomDataSet* shared_;
};

struct Frame {
  int segment = 0;
  Triple position{};        ///< LPS mm, centre of its first voxel
  std::int64_t slice = -1;  ///< its place along the normal
};

/// Axes and spacings that all frames have in common.
struct Plane {
  std::array<Triple, 2> axes{};        ///< along a row, along a column
  std::array<double, 2> spacing_mm{};  ///< between columns, between rows
  Triple normal{};
  double slice_mm = 0;  ///< between slices as the file says; 0 where it does not
};

Plane plane_of(const FrameGroups& groups) {
  const auto o = groups.numbers(tag::kOrientations, tag::kOrientation, 6, "ImageOrientationPatient");
  const auto spacing = groups.numbers(tag::kMeasures, tag::kSpacing, 2, "PixelSpacing");
  Plane plane{{{{o[0], o[1], o[2]}, {o[3], o[4], o[5]}}}, {spacing[1], spacing[0]}, {}, 0};
  plane.normal = cross(plane.axes[0], plane.axes[1]);
  for (const std::uint32_t field : {tag::kBetween, tag::kThickness}) {
    const std::string text = groups.group(tag::kMeasures)->text(field);
    if (plane.slice_mm == 0 && !text.empty()) {
      plane.slice_mm = std::fabs(numbers_of("SpacingBetweenSlices", text, 1)[0]);
    }
  }
  constexpr double kMostSkew = 1e-3;
  if (!(std::fabs(dot(plane.normal, plane.normal) - 1) <= kMostSkew)) {
    throw FormatError(
        "its ImageOrientationPatient has axes that are not perpendicular unit vectors; export it again");
  }
  return plane;
}

bool is_like(const Plane& a, const Plane& b) {
  constexpr double kAlike = 1e-4;
  bool alike = true;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const Triple d = minus(a.axes[axis], b.axes[axis]);
    alike = alike && dot(d, d) <= kAlike * kAlike &&
            std::fabs(a.spacing_mm[axis] - b.spacing_mm[axis]) <= kAlike * a.spacing_mm[axis];
  }
  return alike;
}

std::set<int> segment_numbers(const DicomDataSet& file) {
  std::set<int> numbers;
  for (const DicomDataSet& segment : file.items(tag::kSegments)) {
    numbers.insert(segment.number(tag::kSegmentNumber, 0));
  }
  return numbers;
}

std::vector<Segment> named_segments(const DicomDataSet& file) {
  std::vector<Segment> segments;
  for (const DicomDataSet& segment : file.items(tag::kSegments)) {
    segments.push_back(
        {.name = segment.text(tag::kSegmentLabel), .value = segment.number(tag::kSegmentNumber, 0)});
  }
  return segments;
}

Frame frame_of(const FrameGroups& groups, const std::set<int>& segments) {
  const auto p = groups.numbers(tag::kPositions, tag::kPosition, 3, "ImagePositionPatient");
  const DicomDataSet* const identification = groups.group(tag::kIdentifications);
  const int segment = identification == nullptr ? 0 : identification->number(tag::kReferenced, 0);
  if (segment == 0 || !segments.contains(segment)) {
    throw FormatError("a frame of the DICOM segmentation is of the segment " + std::to_string(segment) +
                      ", which is none of its segments; export it again");
  }
  return {segment, {p[0], p[1], p[2]}};
}

/// Differs from a whole number by no more than a plane may lie aside.
bool is_whole(double number) {
  return std::fabs(number - std::round(number)) <= kMostAside;
}

/// The distance between slices: the one that is said where it explains the frames' places, else the least of
/// those between frames.
double slice_distance(const std::vector<double>& heights, double said) {
  double least = 0;
  bool said_fits = said > 0;
  for (std::size_t n = 1; n < heights.size(); ++n) {
    const double step = heights[n] - heights[n - 1];
    constexpr double kSamePlane = 1e-3;  // mm
    if (step > kSamePlane) {
      least = least == 0 ? step : std::min(least, step);
      said_fits = said_fits && is_whole((heights[n] - heights[0]) / said) && step > said / 2;
    }
  }
  if (!said_fits && least == 0) {
    throw FormatError(
        "all frames of the DICOM segmentation lie in one plane and the distance between slices is not said; "
        "export it again");
  }
  return said_fits ? said : least;
}

void require_place(const Frame& frame, const Frame& first, const Plane& plane, double slice_mm) {
  const Triple d = minus(frame.position, first.position);
  for (std::size_t axis = 0; axis < 2; ++axis) {
    if (!(std::fabs(dot(d, plane.axes[axis])) <= kMostAside * plane.spacing_mm[axis])) {
      throw FormatError(
          "the frames of the DICOM segmentation are shifted sideways against each other (a tilted gantry?); "
          "resample it");
    }
  }
  if (!is_whole(dot(d, plane.normal) / slice_mm)) {
    throw FormatError("the frames of the DICOM segmentation are not evenly spaced (every " +
                      number_text(slice_mm) + " mm); resample it");
  }
}

/// Gives every frame its slice; returns how many slices there are.
std::size_t place_frames(std::vector<Frame>& frames, const Plane& plane, ImageHeader& header) {
  const auto height = [&](const Frame& frame) { return dot(frame.position, plane.normal); };
  std::vector<double> heights(frames.size());
  std::transform(frames.begin(), frames.end(), heights.begin(), height);
  std::sort(heights.begin(), heights.end());
  const double slice_mm = slice_distance(heights, plane.slice_mm);
  const auto lowest = std::min_element(frames.begin(), frames.end(),
                                       [&](const Frame& a, const Frame& b) { return height(a) < height(b); });
  const double slices = std::round((heights.back() - heights.front()) / slice_mm) + 1;
  constexpr double kMostEmpty = 100;  // slices for each frame
  if (!(slices <= kMostEmpty * static_cast<double>(frames.size()))) {
    throw FormatError("the frames of the DICOM segmentation are " +
                      number_text(heights.back() - heights.front()) + " mm apart, with slices every " +
                      number_text(slice_mm) + " mm; export it again");
  }
  for (Frame& frame : frames) {
    require_place(frame, *lowest, plane, slice_mm);
    frame.slice = std::llround((height(frame) - heights.front()) / slice_mm);
  }
  header.spacing_mm = {plane.spacing_mm[0], plane.spacing_mm[1], slice_mm};
  header.origin_mm = lowest->position;
  header.axes = {plane.axes[0], plane.axes[1], plane.normal};
  return static_cast<std::size_t>(slices);
}

std::vector<Frame> frames_of(const DicomDataSet& file, Plane& plane) {
  const std::vector<DicomDataSet>& own = file.items(tag::kPerFrame);
  const std::vector<DicomDataSet>& shared = file.items(tag::kShared);
  const auto promised = integers_of("NumberOfFrames", file.text(tag::kFrames), 1)[0];
  if (own.empty() || promised != static_cast<std::int64_t>(own.size())) {
    throw FormatError("its NumberOfFrames is " + std::to_string(promised) + ", but " +
                      std::to_string(own.size()) + " are described; export it again");
  }
  const std::set<int> segments = segment_numbers(file);
  std::vector<Frame> frames;
  for (const DicomDataSet& one : own) {
    const FrameGroups groups(one, shared.empty() ? nullptr : &shared[0]);
    const Plane here = plane_of(groups);
    if (frames.empty()) {
      plane = here;
    } else if (!is_like(plane, here)) {
      throw FormatError(
          "the frames of the DICOM segmentation have several orientations or spacings; resample it");
    }
    frames.push_back(frame_of(groups, segments));
  }
  return frames;
}

/// The pixels, one bit each, the lowest first, frame after frame without gaps.
std::string_view bits_of(const DicomDataSet& file, std::size_t voxels_of_frames) {
  const DicomElement* const pixels = file.find(tag::kPixels);
  if (pixels != nullptr && pixels->is_compressed) {
    throw FormatError("its pixels are compressed; decompress it (gdcmconv --raw, dcmdrle)");
  }
  const std::size_t found = pixels == nullptr ? 0 : pixels->value.size(),
                    promised = (voxels_of_frames + 7) / 8;
  if (found < promised || found > promised + 1) {  // the length is even
    throw FormatError("its header promises " + std::to_string(promised) +
                      " bytes of voxels, but the file has " + std::to_string(found) + "; copy it again");
  }
  return pixels->value;
}

/// Sets the voxels of the frames; returns how many are in several segments.
std::size_t set_labels(const std::vector<Frame>& frames, std::string_view bits, std::size_t plane_voxels,
                       std::vector<std::uint16_t>& labels) {
  std::vector<bool> shared(labels.size());
  for (std::size_t f = 0; f < frames.size(); ++f) {
    const std::size_t begin = static_cast<std::size_t>(frames[f].slice) * plane_voxels;
    const auto segment = static_cast<std::uint16_t>(frames[f].segment);
    for (std::size_t p = 0; p < plane_voxels; ++p) {
      const std::size_t bit = f * plane_voxels + p;
      if ((static_cast<unsigned>(bits[bit / 8]) >> bit % 8 & 1U) != 0) {
        std::uint16_t& label = labels[begin + p];
        shared[begin + p] = shared[begin + p] || (label != 0 && label != segment);
        label = std::max(label, segment);
      }
    }
  }
  return static_cast<std::size_t>(std::count(shared.begin(), shared.end(), true));
}

std::string whole_file(const std::filesystem::path& path) {
  std::error_code error;
  return head_of_file(path, Encoding::raw, static_cast<std::size_t>(std::filesystem::file_size(path, error)));
}

}  // namespace

DicomSegmentation read_dicom_segmentation(const std::filesystem::path& path) {
  const std::string bytes = whole_file(path);
  const DicomDataSet file = parse_dicom(bytes);
  require_binary(file);
  DicomSegmentation result;
  ImageHeader& header = result.header;
  header.format = "DICOM SEG";
  header.component = Component::uint16;
  header.segments = named_segments(file);
  Plane plane;
  std::vector<Frame> frames = frames_of(file, plane);
  header.size[0] = size_of("Columns", file.number(tag::kColumns, 0));
  header.size[1] = size_of("Rows", file.number(tag::kRows, 0));
  const std::size_t plane_voxels = header.size[0] * header.size[1];
  const std::string_view bits = bits_of(file, frames.size() * plane_voxels);
  header.size[2] = place_frames(frames, plane, header);
  require_sound(header);
  result.labels.resize(plane_voxels * header.size[2]);
  if (const std::size_t shared = set_labels(frames, bits, plane_voxels, result.labels); shared > 0) {
    header.warnings.push_back(std::to_string(shared) +
                              " voxels are in several segments; each has the highest number of them");
  }
  return result;
}

}  // namespace cbc3d::formats
