// The cases as files: one JSON manifest a case, described in cases/README.md.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cases/core/case.hpp"

namespace cbc3d::cases {

/// Reads every *.json of a folder, sorted by file name. Throws InputError naming file, key and remedy when
/// the folder is absent or holds no manifest, a manifest is no JSON, a key is missing, unknown or of the
/// wrong kind, a phantom is unknown or impossible, or two manifests have the same name.
std::vector<Case> load_cases(const std::filesystem::path& manifest_dir);

/// Lays a case's parameter set over its parameters. Throws InputError naming the sets there are when the case
/// has none of that name.
void use_parameter_set(Case& which, const std::string& set);

struct ResolvedImage {
  std::filesystem::path path;  ///< empty when skipped
  std::string skipped_reason;  ///< one line; empty when the image is there
};

/// Finds a case's image in the data folders, in order, and checks its sha256; or generates its phantom under
/// `cache_dir` (created where absent), once: the file name holds all arguments. What the case derives from it
/// is written there too, once. Throws InputError when the image to derive from cannot be read, JobError when
/// a file cannot be written or a phantom's voxels are not those whose sha256 the case has.
ResolvedImage resolve_image(const Case& which, const std::vector<std::filesystem::path>& data_dirs,
                            const std::filesystem::path& cache_dir);

}  // namespace cbc3d::cases
