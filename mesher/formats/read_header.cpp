#include "mesher/formats/read_header.hpp"

#include "mesher/formats/byte_stream.hpp"
#include "mesher/formats/gipl.hpp"
#include "mesher/formats/header_text.hpp"
#include "mesher/formats/inrimage.hpp"
#include "mesher/formats/metaimage.hpp"
#include "mesher/formats/mgh.hpp"
#include "mesher/formats/mif.hpp"
#include "mesher/formats/nifti.hpp"
#include "mesher/formats/nrrd.hpp"

namespace cbc3d::formats {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostHeader = std::size_t{1} << 20U;
constexpr const char* kKnown = "give NIfTI, NRRD, MHA/MHD, Analyze, INRIMAGE, GIPL, MGH/MGZ or MIF";

/// What else a file may be, by its first bytes.
struct Signature {
  std::string_view bytes;
  const char* what;
};

constexpr Signature kSignatures[] = {
    {"\x89PNG", "a PNG picture; `cbc3d tile` stacks slices to a volume"},
    {"\xFF\xD8\xFF", "a JPEG picture, whose compression changes labels; give slices as PNG to `cbc3d tile`"},
    {"BM", "a BMP picture; `cbc3d tile` stacks slices to a volume"},
    {"II*", "a TIFF picture; `cbc3d tile` stacks slices and pages to a volume"},
    {std::string_view("MM\0*", 4), "a TIFF picture; `cbc3d tile` stacks slices and pages to a volume"},
    {"II+", "a BigTIFF picture; `cbc3d tile` stacks slices and pages to a volume"},
    {"\x89HDF", "an HDF5 file (MINC-2, ITK or Imaris); convert it to NIfTI or NRRD"},
    {"CDF", "a netCDF file (MINC-1); convert it to NIfTI or NRRD"},
    {"# vtk", "a VTK file; convert an image to NIfTI, NRRD or MHA"},
    {"<?xml", "an XML file; convert an image to NIfTI, NRRD or MHA"},
    {"<VTKFile", "a VTK file; convert an image to NIfTI, NRRD or MHA"},
    {"PK\x03\x04", "a zip archive; unpack it"},
    {"MATLAB", "a MATLAB file; export it as NIfTI or NRRD"},
    {"\x93NUMPY", "a NumPy array without spacing; save it as NIfTI or NRRD"},
    {"version https://git-lfs", "a pointer of Git LFS, not the file itself; fetch it with `git lfs pull`"},
};

[[noreturn]] void refuse_unknown(std::string_view head, std::size_t least) {
  if (head.size() >= 132 && head.substr(128, 4) == "DICM") {
    throw FormatError(
        "it is DICOM; convert it, a segmentation by dcmqi's segimage2itkimage, to NIfTI or NRRD");
  }
  for (const Signature& signature : kSignatures) {
    if (head.starts_with(signature.bytes)) {
      throw FormatError(std::string("it is ") + signature.what);
    }
  }
  throw FormatError(head.empty()          ? "the file is empty; copy it again"
                    : head.size() < least ? "the file has " + std::to_string(head.size()) +
                                                " bytes, fewer than any header; copy it again"
                                          : std::string("not an image format that is known; ") + kKnown);
}

ImageHeader header_of(std::string_view head, const fs::path& path, Encoding encoding) {
  if (is_nrrd(head) || is_metaimage(head)) {
    if (encoding != Encoding::raw) {
      throw FormatError(
          "it is an NRRD or MetaImage file compressed as a whole; decompress it (gunzip, bunzip2)");
    }
    return is_nrrd(head) ? read_nrrd_header(head, path) : read_metaimage_header(head, path);
  }
  if (is_inrimage(head)) return read_inrimage_header(head, path, encoding);
  if (is_mif(head)) return read_mif_header(head, path, encoding);
  if (is_nifti(head)) return read_nifti_header(head, path, encoding);
  if (is_gipl(head)) return read_gipl_header(head, path, encoding);
  if (is_mgh(head, path)) return read_mgh_header(head, path, encoding);
  constexpr std::size_t kLeastHeader = 60;
  refuse_unknown(head, kLeastHeader);
}

/// The header beside voxels that were named in its place.
fs::path header_file(const fs::path& path) {
  fs::path base = path;
  const std::string extension = lower_case(base.extension().string());
  if (extension == ".gz" || extension == ".bz2") {
    base.replace_extension();
  }
  if (lower_case(base.extension().string()) == ".img") {
    fs::path header = base.replace_extension(base.extension() == ".IMG" ? ".HDR" : ".hdr");
    std::error_code error;
    if (fs::is_regular_file(header, error)) {
      return header;
    }
  }
  return path;
}

}  // namespace

ImageHeader read_image_header(const fs::path& path) {
  const fs::path file = header_file(path);
  const Encoding encoding = encoding_of_file(file);
  const std::string head = head_of_file(file, encoding, kMostHeader);
  ImageHeader header = header_of(head, file, encoding);
  require_sound(header);
  return header;
}

}  // namespace cbc3d::formats
