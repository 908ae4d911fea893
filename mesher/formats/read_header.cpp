#include "mesher/formats/read_header.hpp"

#include "mesher/formats/byte_stream.hpp"
#include "mesher/formats/dicom_data_set.hpp"
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
constexpr const char* kKnown =
    "give NIfTI, NRRD, MHA/MHD, Analyze, INRIMAGE, GIPL, MGH/MGZ, MIF or DICOM SEG";

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
    {"7z\xBC\xAF", "a 7z archive; unpack it"},
    {"Rar!", "a RAR archive; unpack it"},
    {"\xFD"
     "7zXZ",
     "compressed by xz; decompress it (unxz)"},
    {"\x28\xB5\x2F\xFD", "compressed by Zstandard; decompress it (unzstd)"},
    {"\x1F\x8B", "compressed twice; decompress it once (gunzip, bunzip2)"},
    {"BZh", "compressed twice; decompress it once (gunzip, bunzip2)"},
    {"\x1F\x9D", "compressed by compress; decompress it (uncompress)"},
    {"solid ", "an STL surface, not an image; voxelise it and save NIfTI or NRRD"},
    {"ply", "a PLY surface, not an image; voxelise it and save NIfTI or NRRD"},
    {"$MeshFormat", "a Gmsh mesh, not an image"},
    {"%PDF", "a PDF document, not an image"},
    {"GIF8", "a GIF picture; give slices as PNG to `cbc3d tile`"},
    {"<!DOCTYPE", "a web page, not the file itself; download it again"},
    {"<html", "a web page, not the file itself; download it again"},
    {"MATLAB", "a MATLAB file; export it as NIfTI or NRRD"},
    {"\x93NUMPY", "a NumPy array without spacing; save it as NIfTI or NRRD"},
    {"version https://git-lfs", "a pointer of Git LFS, not the file itself; fetch it with `git lfs pull`"},
};

[[noreturn]] void refuse_unknown(std::string_view head, std::size_t least) {
  if (is_dicom(head)) {
    throw FormatError("it is DICOM; of its objects binary segmentations alone are read");
  }
  constexpr std::size_t kTarMagic = 257;
  if (head.size() > kTarMagic + 5 && head.substr(kTarMagic, 5) == "ustar") {
    throw FormatError("it is a tar archive; unpack it (tar -xf)");
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

/// A header that is cut off still has its size at its beginning.
void require_whole_nifti(std::string_view head) {
  constexpr std::size_t kNifti1 = 348;
  const bool begins = head.size() >= 4 && (head.starts_with(std::string_view("\x5C\x01\0\0", 4)) ||
                                           head.starts_with(std::string_view("\0\0\x01\x5C", 4)));
  if (begins && head.size() < kNifti1) {
    throw FormatError("it begins as NIfTI or Analyze and ends within the header (truncated); copy it again");
  }
}

/// The name of voxels of a pair says that their header is another file.
void require_header_beside(const fs::path& path) {
  if (lower_case(path.extension().string()) == ".img") {
    fs::path header = path;
    throw FormatError("its header '" + header.replace_extension(".hdr").string() +
                      "' is not there; put it beside the voxels");
  }
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
  require_whole_nifti(head);
  require_header_beside(path);
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
