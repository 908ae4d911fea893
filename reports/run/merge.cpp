#include "reports/run/merge.hpp"

#include <map>

#include "mesher/core/error.hpp"
#include "reports/run/folder_lock.hpp"

namespace cbc3d::reports {
namespace {
namespace fs = std::filesystem;

void copy_to(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::create_directories(to.parent_path(), error);
  fs::copy_file(from, to, fs::copy_options::overwrite_existing, error);
  if (error) {
    throw JobError("cannot copy '" + from.string() + "' to '" + to.string() + "': " + error.message());
  }
}

/// Copies what belongs to a line. An image that the run generated moves along, so that the source may go.
void copy_files(Json& line, const fs::path& folder, const fs::path& out_dir) {
  if (line["mesh_file"].is_string() && fs::exists(folder / line["mesh_file"].get<std::string>())) {
    copy_to(folder / line["mesh_file"].get<std::string>(), out_dir / line["mesh_file"].get<std::string>());
  }
  for (const char* ending : {".log", ".report.json"}) {
    const fs::path log = fs::path("logs") / (file_stem(line) + ending);
    if (fs::exists(folder / log)) {
      copy_to(folder / log, out_dir / log);
    }
  }
  const Json image = figure(line, {"provenance", "image_file"});
  const fs::path generated = fs::absolute(folder / "images").lexically_normal();
  const fs::path file =
      image.is_string() ? fs::path(image.get<std::string>()).lexically_normal() : fs::path();
  if (file.parent_path() == generated && fs::exists(file)) {
    const fs::path copy = fs::absolute(out_dir / "images" / file.filename()).lexically_normal();
    if (!fs::exists(copy)) {
      copy_to(file, copy);
    }
    line["provenance"]["image_file"] = copy.string();
  }
}

std::vector<Json> lines_of(const fs::path& folder) {
  std::vector<Json> lines = read_results(folder / "results.jsonl");
  if (lines.empty()) {
    throw InputError("'" + folder.string() +
                     "' holds no results.jsonl with lines; name the --out folder of a run");
  }
  return lines;
}

}  // namespace

std::vector<Json> merge_runs(const std::vector<fs::path>& folders, const fs::path& out_dir,
                             const MergeOptions& options) {
  std::error_code error;
  fs::create_directories(out_dir, error);
  if (error) {
    throw InputError("--out '" + out_dir.string() + "': cannot create it: " + error.message());
  }
  const FolderLock lock(out_dir);
  if (!options.replace && !read_results(out_dir / "results.jsonl").empty()) {
    throw InputError("--out '" + out_dir.string() +
                     "' holds results already; give another folder, or --replace");
  }
  std::vector<Json> joint;
  std::map<std::string, std::pair<Json, fs::path>> seen;
  for (const fs::path& folder : folders) {
    for (Json& line : lines_of(folder)) {
      const std::string id = result_id(line);
      const auto [at, is_new] = seen.try_emplace(id, line, folder);
      if (!is_new && at->second.first != line) {
        throw InputError("'" + folder.string() + "' and '" + at->second.second.string() + "' both hold " +
                         id + ", with different lines; merge only one of them");
      }
      if (is_new) {
        copy_files(line, folder, out_dir);
        joint.push_back(std::move(line));
      }
    }
  }
  if (options.expected > 0 && joint.size() != options.expected) {
    throw JobError(std::to_string(options.expected) + " jobs were expected, and the folders hold " +
                   std::to_string(joint.size()) + "; nothing was merged");
  }
  replace_results(out_dir / "results.jsonl", joint);
  return joint;
}

}  // namespace cbc3d::reports
