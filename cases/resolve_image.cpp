#include <sstream>

#include "cases/core/sha256.hpp"
#include "cases/derive.hpp"
#include "cases/manifest.hpp"
#include "cases/phantoms/registry.hpp"
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

ResolvedImage find_file(const std::string& name, const Case& which, const std::vector<fs::path>& data_dirs) {
  std::string mismatch;
  for (const fs::path& folder : data_dirs) {
    const fs::path path = folder / name;
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
  return {{}, "image '" + name + "' is in no data folder (" + quoted_list(data_dirs) + ")" + remedy};
}

fs::path cached_name(const Phantom& phantom, const PhantomKind& kind) {
  std::ostringstream name;
  name.precision(17);
  name << phantom.name << "-v" << kind.version << '-' << phantom.size[0] << 'x' << phantom.size[1] << 'x'
       << phantom.size[2] << '-' << phantom.spacing_mm.x << 'x' << phantom.spacing_mm.y << 'x'
       << phantom.spacing_mm.z << "-seed" << phantom.seed << ".nrrd";
  return name.str();
}

void create_cache(const fs::path& cache_dir) {
  std::error_code error;
  fs::create_directories(cache_dir, error);
  if (error) {
    throw JobError("cannot create the folder '" + cache_dir.string() + "': " + error.message());
  }
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
  create_cache(cache_dir);
  const std::string sha256 = write_phantom(phantom, path);
  if (!phantom.sha256.empty() && sha256 != phantom.sha256) {
    fs::remove(path, error);
    throw JobError("phantom '" + phantom.name +
                   "' came out with other voxels than its case's: their sha256 is " + sha256 + ", expected " +
                   phantom.sha256 + "; report this machine and compiler");
  }
  return {path, ""};
}

/// What was done, as part of a file's name.
std::string name_of(const Derivation& derivation) {
  std::string name = derivation.fill_holes ? "-holes-filled" : "";
  if (derivation.repeats()) {
    const auto& [x, y, z] = derivation.repeat;
    name += "-repeated-" + std::to_string(x) + "x" + std::to_string(y) + "x" + std::to_string(z);
  }
  return name;
}

/// The digest of a file's content, or the name of a phantom, identifies what a derived image was made from.
ResolvedImage derive(const Case& which, const ResolvedImage& source, const fs::path& cache_dir) {
  const std::string origin = which.phantom ? source.path.stem().string() : which.image_sha256;
  const fs::path path = cache_dir / (origin + name_of(which.derive) + ".nrrd");
  std::error_code error;
  if (fs::is_regular_file(path, error)) {
    return {path, ""};
  }
  create_cache(cache_dir);
  LabelImage image = read_label_image(source.path);
  if (which.derive.fill_holes) {
    fill_holes(image);
  }
  write_label_image(which.derive.repeats() ? repeated(image, which.derive.repeat) : image, path);
  return {path, ""};
}

}  // namespace

ResolvedImage resolve_image(const Case& which, const std::vector<fs::path>& data_dirs,
                            const fs::path& cache_dir) {
  ResolvedImage source = which.phantom ? generate(*which.phantom, cache_dir)
                                       : find_file(which.image_file.value_or(""), which, data_dirs);
  const bool as_it_is = !which.derive.any() || !source.skipped_reason.empty();
  return as_it_is ? source : derive(which, source, cache_dir);
}

}  // namespace cbc3d::cases
