#include "reports/history/store.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <map>
#include <set>
#include <string_view>

#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"
#include "mesher/core/json_text.hpp"

namespace cbc3d::reports {
namespace {
namespace fs = std::filesystem;

using metrics::metric;
using metrics::MetricId;

constexpr const char* kFormat = "cbc3d-history-1";
constexpr const char* kExtension = ".jsonl";

/// Holds a folder for one writer; the kernel lets go of it when the process ends.
class StoreLock {
 public:
  explicit StoreLock(const fs::path& folder)
      : descriptor_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
    if (descriptor_ < 0 || ::flock(descriptor_, LOCK_EX) != 0) {
      throw JobError("cannot lock the store '" + folder.string() + "': " + std::strerror(errno));
    }
  }
  ~StoreLock() { ::close(descriptor_); }
  StoreLock(const StoreLock&) = delete;
  StoreLock& operator=(const StoreLock&) = delete;

 private:
  int descriptor_;
};

std::string text_of(const Json& value) {
  return value.is_string() ? value.get<std::string>() : "";
}

/// What a mesher calls its version; several libraries are JSON of their own.
std::string version_text(const Json& value) {
  return value.is_null() ? "" : value.is_string() ? value.get<std::string>() : json_text(value, -1);
}

/// The figures of a good job that are taken as they are; others derive from them.
Json figures_json(const JobResult& result) {
  Json figures = Json::object();
  for (const MetricId id : metrics::all_metrics()) {
    const auto& value = result.figures[id];
    if (value && metric(id).source != metrics::Source::derived) {
      figures[std::string(metric(id).key)] = *value;
    }
  }
  return figures;
}

Json line_of(const JobResult& result, const Commit& commit, const std::string& machine) {
  return {{"format", kFormat},
          {"commit", commit.name},
          {"date", commit.date},
          {"machine", machine.empty() ? machine_of(result) : machine},
          {"case", result.case_name},
          {"mesher", result.mesher},
          {"mesher_version", version_text(result.provenance("mesher_version"))},
          {"threads", result.threads},
          {"repeat", result.repeat},
          {"budget", result.budget ? Json(*result.budget) : Json()},
          {"parameters", result.parameters},
          {"image_sha256", text_of(result.provenance("image_sha256"))},
          {"utc", text_of(result.provenance("utc"))},
          {"status", result.status},
          {"reason", result.reason},
          {"figures", result.is_ok() ? figures_json(result) : Json::object()}};
}

const std::map<std::string, MetricId, std::less<>>& ids_by_key() {
  static const auto ids = [] {
    std::map<std::string, MetricId, std::less<>> by_key;
    for (const MetricId id : metrics::all_metrics()) {
      by_key.emplace(metric(id).key, id);
    }
    return by_key;
  }();
  return ids;
}

/// Keys that the catalog does not have, as of a newer version, are left out.
metrics::Figures figures_of(const Json& object) {
  metrics::Figures figures;
  for (const auto& [key, value] : object.items()) {
    const auto found = ids_by_key().find(key);
    if (found != ids_by_key().end() && value.is_number()) {
      figures[found->second] = value.get<double>();
    }
  }
  figures.derive();
  return figures;
}

Parameters parameters_of(const Json& object) {
  Parameters parameters;
  for (const auto& [key, value] : object.items()) {
    parameters[key] = value.is_string() ? value.get<std::string>() : value.dump();
  }
  return parameters;
}

template <class Number>
Number number_at(const Json& line, const char* key, Number otherwise) {
  const Json value = figure(line, {key});
  return value.is_number_integer() ? value.get<Number>() : otherwise;
}

/// Throws InputError, whose line begins with `subject`, where the line is none of a store.
void require_line(const Json& line, const std::string& subject) {
  if (figure(line, {"format"}) != kFormat) {
    throw InputError(subject + ": \"format\" is not \"" + kFormat +
                     "\"; remove the line, or read it with the "
                     "version that wrote it");
  }
  for (const char* key : {"commit", "date", "machine", "status"}) {
    if (text_of(figure(line, {key})).empty()) {
      throw InputError(subject + ": \"" + key +
                       "\" is missing or no text; remove the line and add its run again");
    }
  }
  for (const char* key : {"parameters", "figures"}) {
    if (!figure(line, {key}).is_object()) {
      throw InputError(subject + ": \"" + key + "\" is no object; remove the line and add its run again");
    }
  }
}

HistoryRun decode_run(const Json& line, const std::string& subject) {
  require_line(line, subject);
  HistoryRun run;
  run.commit = {text_of(line["commit"]), text_of(line["date"])};
  run.machine = text_of(line["machine"]);
  run.case_name = text_of(line["case"]);
  run.mesher = text_of(line["mesher"]);
  run.mesher_version = text_of(figure(line, {"mesher_version"}));
  run.threads = number_at(line, "threads", 1);
  run.repeat = number_at(line, "repeat", 0);
  if (figure(line, {"budget"}).is_number_integer()) {
    run.budget = line["budget"].get<std::int64_t>();
  }
  run.parameters = parameters_of(line["parameters"]);
  run.image_sha256 = text_of(figure(line, {"image_sha256"}));
  run.utc = text_of(figure(line, {"utc"}));
  run.status = text_of(line["status"]);
  run.reason = text_of(figure(line, {"reason"}));
  run.figures = figures_of(line["figures"]);
  return run;
}

void make_store(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    throw InputError("--store '" + folder.string() + "': cannot create it: " + error.message());
  }
}

void write_attributes(const fs::path& folder) {
  if (!fs::exists(folder / ".gitattributes")) {
    write_text_file(folder / ".gitattributes", std::string("*") + kExtension + " merge=union\n");
  }
}

}  // namespace

std::string machine_of(const JobResult& result) {
  const std::string cpu = text_of(result.provenance("cpu"));
  const Json cores = result.provenance("cores");
  return (cpu.empty() ? "unknown" : cpu) + (cores.is_number() ? ", " + cores.dump() + " cores" : "");
}

Added add_to_store(const fs::path& folder, const std::vector<JobResult>& results, const Commit& commit,
                   const std::string& machine) {
  make_store(folder);
  const StoreLock lock(folder);
  write_attributes(folder);
  const fs::path file = folder / (commit.name + kExtension);
  std::set<std::string> lines;
  for (const Json& line : read_results(file)) {
    require_line(line, "'" + file.string() + "'");
    lines.insert(json_text(line, -1));
  }
  Added count;
  for (const JobResult& result : results) {
    ++(lines.insert(json_text(line_of(result, commit, machine), -1)).second ? count.added : count.known);
  }
  std::string text;
  for (const std::string& line : lines) {
    text += line + "\n";
  }
  if (count.added > 0) {
    write_text_file(file, text);
  }
  return count;
}

std::vector<HistoryRun> read_store(const fs::path& folder) {
  std::set<fs::path> files;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    if (entry.path().extension() == kExtension) {
      files.insert(entry.path());
    }
  }
  std::vector<HistoryRun> runs;
  for (const fs::path& file : files) {
    std::set<std::string> seen;  // a union of branches may have a line twice
    std::size_t number = 0;
    for (const Json& line : read_results(file)) {
      const std::string subject = "'" + file.string() + "': line " + std::to_string(++number);
      if (seen.insert(json_text(line, -1)).second) {
        runs.push_back(decode_run(line, subject));
      }
    }
  }
  if (runs.empty()) {
    throw InputError("--store '" + folder.string() +
                     "' holds no *.jsonl with lines; `cbc3d-bench history add OUT --store DIR` makes them");
  }
  return runs;
}

}  // namespace cbc3d::reports
