#include <sstream>

#include "cases/manifest.hpp"
#include "cases/phantoms/registry.hpp"
#include "cases/sha256.hpp"
#include "mesher/core/error.hpp"
#include "mesher/core/image_io.hpp"

namespace cbc3d::cases {
namespace {

namespace fs = std::filesystem;

std::string quoted_list(const std::vector<fs::path>& folders) {
  std::string list;
  for (const fs::path& folder : folders) {
    list += (list.empty() ? "'" : ", '") + folder.string() + "'";
  }
  return list.empty() ? "none given" : list;
}

ResolvedImage find_file(const Case& which, const std::vector<fs::path>& data_dirs) {
  std::string mismatch;
  for (const fs::path& folder : data_dirs) {
    const fs::path path = folder / *which.image_file;
    std::error_code error;
    if (!fs::is_regular_file(path, error)) {
      continue;
    }
    const std::string found = sha256_of_file(path);
    if (found == which.image_sha256) {
      return {path, ""};
    }
    mismatch = "'" + path.string() + "' is another file than the case's: its sha256 is " + found +
               ", expected " + which.image_sha256;
  }
  const std::string remedy = "; get it from " + which.image_source + " and name its folder with --data";
  if (!mismatch.empty()) {
    return {{}, mismatch + remedy};
  }
  return {{},
          "image '" + *which.image_file + "' is in no data folder (" + quoted_list(data_dirs) + ")" + remedy};
}

fs::path cached_name(const Phantom& phantom, const PhantomKind& kind) {
  std::ostringstream name;
  name.precision(17);
  name << phantom.name << "-v" << kind.version << '-' << phantom.size[0] << 'x' << phantom.size[1] << 'x'
       << phantom.size[2] << '-' << phantom.spacing_mm.x << 'x' << phantom.spacing_mm.y << 'x'
       << phantom.spacing_mm.z << "-seed" << phantom.seed << ".nrrd";
  return name.str();
}

ResolvedImage generate(const Phantom& phantom, const fs::path& cache_dir) {
  const PhantomKind* kind = find_phantom(phantom.name);
  if (kind == nullptr) {
    throw InputError("phantom '" + phantom.name + "' is unknown; choose one of " + phantom_names());
  }
  const fs::path path = cache_dir / cached_name(phantom, *kind);
  std::error_code error;
  if (fs::is_regular_file(path, error)) {
    return {path, ""};
  }
  fs::create_directories(cache_dir, error);
  if (error) {
    throw JobError("cannot create the folder '" + cache_dir.string() + "': " + error.message());
  }
  write_label_image(make_phantom(phantom), path);
  return {path, ""};
}

}  // namespace

ResolvedImage resolve_image(const Case& which, const std::vector<fs::path>& data_dirs,
                            const fs::path& cache_dir) {
  return which.phantom ? generate(*which.phantom, cache_dir) : find_file(which, data_dirs);
}

}  // namespace cbc3d::cases
