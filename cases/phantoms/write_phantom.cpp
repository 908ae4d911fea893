// Phantoms as files, the large ones in slabs.
#include <algorithm>
#include <fstream>
#include <sstream>

#include "cases/core/sha256.hpp"
#include "cases/phantoms/registry.hpp"
#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"
#include "mesher/core/image_io.hpp"

namespace cbc3d::cases {
namespace {

namespace fs = std::filesystem;

std::string digest_of_labels(const LabelImage& image) {
  constexpr std::size_t kPiece = std::size_t{1} << 20U;
  Sha256 digest;
  std::vector<unsigned char> bytes;
  for (std::size_t first = 0; first < image.voxels.size(); first += kPiece) {
    const std::size_t count = std::min(kPiece, image.voxels.size() - first);
    bytes.resize(count);
    for (std::size_t v = 0; v < count; ++v) {
      bytes[v] = static_cast<unsigned char>(image.labels[image.voxels[first + v]]);
    }
    digest.add(bytes.data(), count);
  }
  return digest.finish();
}

/// Positions in NRRD's space "left-posterior-superior" are ours.
std::string nrrd_header(const ImageFrame& frame) {
  std::ostringstream header;
  header.precision(17);
  const Vec3& s = frame.spacing_mm;
  header << "NRRD0004\ntype: unsigned char\ndimension: 3\nspace: left-posterior-superior\nsizes: "
         << frame.size[0] << ' ' << frame.size[1] << ' ' << frame.size[2] << "\nspace directions: (" << s.x
         << ",0,0) (0," << s.y << ",0) (0,0," << s.z
         << ")\nkinds: domain domain domain\nencoding: raw\nspace origin: (0,0,0)\n\n";
  return header.str();
}

/// Slices that share a slab of about a hundred million voxels.
int slices_per_slab(const ImageFrame& frame) {
  constexpr std::size_t kSlabVoxels = 100'000'000;
  const auto slice = static_cast<std::size_t>(frame.size[0]) * static_cast<std::size_t>(frame.size[1]);
  return static_cast<int>(std::max<std::size_t>(1, kSlabVoxels / slice));
}

std::string stream_model(const PhantomModel& model, const ImageFrame& frame, std::ostream& out) {
  const auto slice = static_cast<std::size_t>(frame.size[0]) * static_cast<std::size_t>(frame.size[1]);
  const int step = std::min(slices_per_slab(frame), frame.size[2]);
  std::vector<PaintedVoxel> slab(slice * static_cast<std::size_t>(step));
  Sha256 digest;
  out << nrrd_header(frame);
  for (int first = 0; first < frame.size[2] && out; first += step) {
    const int last = std::min(first + step, frame.size[2]);
    paint_slab(model, frame, first, last, slab.data());
    const std::size_t count = slice * static_cast<std::size_t>(last - first);
    // Material m has label m: the voxels are the bytes of the file.
    out.write(reinterpret_cast<const char*>(slab.data()), static_cast<std::streamsize>(count));
    digest.add(slab.data(), count);
  }
  return digest.finish();
}

std::string write_streamed(const Phantom& phantom, const PhantomModel& model, const fs::path& path) {
  if (path.extension() != ".nrrd") {
    throw InputError("cannot write '" + path.string() + "': an image so large is written as .nrrd only");
  }
  ImageFrame frame;
  frame.size = phantom.size;
  frame.spacing_mm = phantom.spacing_mm;
  AtomicFile file(path);
  errno = 0;
  std::ofstream out(file.temporary(), std::ios::binary);
  std::string digest = stream_model(model, frame, out);
  out.close();
  if (!out) {
    fail_to_write(path);
  }
  file.commit();
  return digest;
}

}  // namespace

std::string write_phantom(const Phantom& phantom, const fs::path& path, std::size_t streamed_voxels) {
  require_writable(path);
  const PhantomKind& kind = require_kind(phantom);
  ImageFrame frame;
  frame.size = phantom.size;
  if (kind.model != nullptr && frame.voxel_count() > streamed_voxels) {
    return write_streamed(phantom, kind.model(phantom.size, phantom.spacing_mm, phantom.seed), path);
  }
  const LabelImage image = make_phantom(phantom);
  write_label_image(image, path);
  return digest_of_labels(image);
}

}  // namespace cbc3d::cases
