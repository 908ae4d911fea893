#include "mesher/input/table_beside.hpp"

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "mesher/formats/header_text.hpp"

namespace cbc3d {
namespace fs = std::filesystem;
namespace {

/// The name without its extension, or its two.
std::string stem_of(const fs::path& image) {
  const std::string name = image.filename().string(), lower = formats::lower_case(name);
  for (const char* const twofold : {".nii.gz", ".nii.bz2", ".img.gz", ".mgh.gz", ".mif.gz", ".seg.nrrd"}) {
    if (lower.ends_with(twofold)) {
      return name.substr(0, name.size() - std::string(twofold).size());
    }
  }
  return image.stem().string();
}

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

/// "sub-01", "desc-aseg", "dseg" of "sub-01_desc-aseg_dseg".
std::set<std::string> parts_of(const std::string& name) {
  const auto words = formats::words_of(name, "_");
  return {words.begin(), words.end()};
}

/// The table of the folder that applies to an image with these parts of its name.
std::optional<fs::path> table_of_folder(const fs::path& folder, const std::set<std::string>& image) {
  fs::path best;
  std::size_t most = 0;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (!name.ends_with("dseg.tsv") || !is_file(entry.path())) {
      continue;
    }
    const auto parts = parts_of(entry.path().stem().string());
    const bool applies =
        parts.contains("dseg") && std::includes(image.begin(), image.end(), parts.begin(), parts.end());
    // Of two with as many entities the first by name is taken, whatever order the folder has.
    if (applies && (parts.size() > most || (parts.size() == most && entry.path() < best))) {
      most = parts.size();
      best = entry.path();
    }
  }
  return best.empty() ? std::nullopt : std::optional(best);
}

std::optional<fs::path> bids_table(const fs::path& image, const std::string& stem) {
  constexpr int kMostFolders = 4;  // data set, subject, session, anat
  const auto parts = parts_of(stem);
  if (!parts.contains("dseg")) {
    return std::nullopt;
  }
  std::error_code error;
  fs::path folder = fs::absolute(image, error).parent_path();
  for (int n = 0; n < kMostFolders && !error; ++n) {
    if (auto table = table_of_folder(folder, parts)) {
      return table;
    }
    if (is_file(folder / "dataset_description.json") || folder == folder.parent_path()) {
      break;
    }
    folder = folder.parent_path();
  }
  return std::nullopt;
}

}  // namespace

std::optional<fs::path> table_beside(const fs::path& image) {
  const std::string stem = stem_of(image);
  for (const char* const extension : {".tsv", ".label", ".ctbl", ".csv", ".txt"}) {
    fs::path table = image.parent_path() / (stem + extension);
    if (is_file(table)) {
      return table;
    }
  }
  return bids_table(image, stem);
}

}  // namespace cbc3d
