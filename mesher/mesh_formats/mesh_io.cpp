#include "mesher/mesh_formats/mesh_io.hpp"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"
#include "mesher/core/mesh_coordinates.hpp"
#include "mesher/mesh_formats/gmsh_writing.hpp"
#include "mesher/mesh_formats/mesh_format.hpp"

namespace cbc3d {
namespace fs = std::filesystem;
namespace {

void require_readable(const fs::path& path) {
  std::error_code error;
  if (fs::exists(path, error) && !fs::is_regular_file(path, error)) {
    throw InputError("cannot read '" + path.string() + "': it is a folder, device or pipe; name a mesh file");
  }
  if (!fs::is_regular_file(path, error)) {
    throw InputError("cannot read '" + path.string() + "': " +
                     (error && error != std::errc::no_such_file_or_directory
                          ? error.message() + "; check its permissions"
                          : "the file does not exist; check its name"));
  }
  if (::access(path.c_str(), R_OK) != 0) {
    throw InputError("cannot read '" + path.string() + "': the file cannot be opened (" +
                     std::strerror(errno) + "); check its permissions");
  }
}

template <typename AnyMesh>
void write_any(const AnyMesh& mesh, const MeshFormat& format, const fs::path& path,
               const MeshFileOptions& options) {
  const FileMesh view(mesh, {.interfaces = format.interfaces, .split = options.split_interfaces});
  AtomicFile file(path);
  file.fill([&](const fs::path& temporary) { format.write(view, temporary, options); });
}

template <typename AnyMesh>
void write_checked(const AnyMesh& mesh, const fs::path& path, const MeshFileOptions& options) {
  const MeshFormat& format = format_of(path, options.format);
  try {
    write_any(mesh, format, path, options);
  } catch (const InputError& error) {
    throw InputError("cannot write '" + path.string() + "': " + error.what());
  }
}

}  // namespace

void require_writable_mesh_path(const fs::path& path, const MeshFileOptions& options) {
  format_of(path, options.format);
  require_writable(path);
}

void require_writable_labels(const std::vector<Label>& labels, const fs::path& path) {
  if (!format_of(path).positive_labels) return;
  try {
    require_gmsh_labels(labels);
  } catch (const InputError& error) {
    throw InputError("cannot write '" + path.string() + "': " + error.what());
  }
}

void write_mesh(const Mesh& mesh, const fs::path& path, const MeshFileOptions& options) {
  write_checked(mesh, path, options);
}

void write_mesh(const QuadraticMesh& mesh, const fs::path& path, const MeshFileOptions& options) {
  write_checked(mesh, path, options);
}

Mesh read_mesh(const fs::path& path, const ReadMeshOptions& options) {
  MeshFileOptions stated;
  return read_mesh(path, options, nullptr, stated);
}

Mesh read_mesh(const fs::path& path, const ReadMeshOptions& options, const ImageFrame* frame,
               MeshFileOptions& stated) {
  const MeshFormat& format = format_of(path);
  if (format.read == nullptr) {
    throw InputError("'" + path.string() + "': the format " + std::string(format.name) +
                     " is written alone, not read; give " + read_extensions());
  }
  require_readable(path);
  stated = {};
  Mesh mesh = format.read(path, options, stated);
  try {
    to_lps(mesh, stated.coordinates, frame);
  } catch (const InputError& error) {
    throw InputError("'" + path.string() + "' states its coordinates: " + error.what());
  }
  return mesh;
}

}  // namespace cbc3d
