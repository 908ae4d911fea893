#include "reports/history/commit.hpp"

#include <algorithm>
#include <cstdlib>
#include <optional>
#include <set>

#include "mesher/core/error.hpp"
#include "mesher/core/plain_name.hpp"
#include "reports/history/date.hpp"
#include "reports/run/child_process.hpp"

namespace cbc3d::reports {
namespace {

constexpr const char* kUnknown = "unknown";

/// What git prints to standard output; none where it fails or is not there.
std::optional<std::string> git(const std::filesystem::path& folder,
                               const std::vector<std::string>& arguments) {
  constexpr double kTimeoutS = 60;
  // run_child keeps the end of standard error, so the shell lets git's standard output take its place.
  std::vector<std::string> argv{"/bin/sh", "-c", "exec \"$@\" 1>&2 2>/dev/null", "sh", "git", "-C", folder};
  argv.insert(argv.end(), arguments.begin(), arguments.end());
  const ChildResult child = run_child({argv, 0, kTimeoutS, 0});
  if (child.end != ChildEnd::exited || child.exit_code != 0) {
    return std::nullopt;
  }
  return child.stderr_tail;
}

/// The commit that `name` stands for in `folder`.
std::optional<Commit> git_commit(const std::filesystem::path& folder, const std::string& name) {
  const auto text = git(folder, {"show", "--no-patch", "--format=%H %ct", name + "^{commit}", "--"});
  const std::string line = text ? last_line(*text) : "";
  const std::size_t blank = line.find(' ');
  if (blank == std::string::npos) {
    return std::nullopt;
  }
  return Commit{line.substr(0, blank), utc_text(std::strtoll(line.c_str() + blank + 1, nullptr, 10))};
}

bool is_changed(const std::filesystem::path& folder) {
  const auto changes = git(folder, {"status", "--porcelain", "--untracked-files=no"});
  return changes && !last_line(*changes).empty();
}

std::string text_of(const Json& value) {
  return value.is_string() ? value.get<std::string>() : "";
}

std::string first_run(const std::vector<JobResult>& results) {
  std::string first;
  for (const JobResult& result : results) {
    const auto date = parse_date(text_of(result.provenance("utc")));
    first = date && (first.empty() || *date < first) ? *date : first;
  }
  return first;
}

/// The distinct texts of a key of the provenance.
std::set<std::string> texts_of(const std::vector<JobResult>& results, const char* key) {
  std::set<std::string> texts;
  for (const JobResult& result : results) {
    texts.insert(text_of(result.provenance(key)));
  }
  return texts;
}

bool has_outside_mesher(const std::vector<JobResult>& results) {
  return std::any_of(results.begin(), results.end(),
                     [](const JobResult& result) { return result.mesher.starts_with("external:"); });
}

[[noreturn]] void refuse_changed(const std::string& what, const std::string& name) {
  throw InputError(what + " differ from commit " + name +
                   ", so the figures are not that commit's; commit first and run again, or name what they "
                   "belong to by --commit");
}

/// The build's commit by the results; none where the provenance does not say.
std::optional<FoundCommit> of_provenance(const std::vector<JobResult>& results) {
  const std::set<std::string> names = texts_of(results, "git_commit");
  if (names.contains("") || names.contains(kUnknown) || has_outside_mesher(results)) {
    return std::nullopt;
  }
  const std::string& name = *names.begin();
  if (names.size() > 1) {
    throw InputError("the results come from builds of several commits, " + name + " and " + *names.rbegin() +
                     "; run the jobs of one again, or give --commit");
  }
  if (!is_commit_name(name)) {
    throw InputError("the results' provenance has git_commit '" + name +
                     "', which is no commit; give --commit");
  }
  if (std::any_of(results.begin(), results.end(),
                  [](const JobResult& result) { return result.provenance("git_dirty") == true; })) {
    refuse_changed("the sources of the build that made the results", name);
  }
  const std::string from = "the results' provenance";
  const auto date = parse_date(*texts_of(results, "git_commit_date").begin());
  return FoundCommit{{name, date.value_or("")}, from, date ? from : ""};
}

FoundCommit of_option(const GivenCommit& given, const std::filesystem::path& folder) {
  if (!is_commit_name(given.name)) {
    throw InputError("--commit '" + given.name +
                     "': give a hash or a name of 1 to 80 letters, digits, dots, hyphens and underscores");
  }
  const auto known = git_commit(folder, given.name);
  return known ? FoundCommit{*known, "--commit", "git"} : FoundCommit{{given.name, ""}, "--commit", ""};
}

FoundCommit of_folder(const std::filesystem::path& folder) {
  const auto head = git_commit(folder, "HEAD");
  if (!head) {
    throw InputError("no commit: the results name none of the meshers' sources, and '" + folder.string() +
                     "' is no git work tree; give --commit NAME and --date DATE");
  }
  if (is_changed(folder)) {
    refuse_changed("the files in '" + folder.string() + "'", head->name);
  }
  return {*head, "git in '" + folder.string() + "'", "git"};
}

void set_date(FoundCommit& found, const std::vector<JobResult>& results, const std::string& given,
              const std::filesystem::path& folder) {
  if (!given.empty()) {
    const auto date = parse_date(given);
    if (!date) {
      throw InputError("--date '" + given + "' is no date; give 2026-11-29 or 2026-11-29T08:05:09+01:00");
    }
    found.commit.date = *date;
    found.date_from = "--date";
  }
  if (found.commit.date.empty()) {
    const auto known = git_commit(folder, found.commit.name);
    found.commit.date = known ? known->date : first_run(results);
    found.date_from = known ? "git" : "the first run, for nothing here knows the commit's";
  }
  if (found.commit.date.empty()) {
    throw InputError("commit " + found.commit.name + ": its date is not known; give --date");
  }
}

}  // namespace

bool is_commit_name(const std::string& name) {
  std::string dotless = name;
  std::replace(dotless.begin(), dotless.end(), '.', '_');
  return is_plain_name(dotless) && name.front() != '.' && name.front() != '-';
}

FoundCommit find_commit(const std::vector<JobResult>& results, const GivenCommit& given,
                        const std::filesystem::path& folder) {
  FoundCommit found;
  if (!given.name.empty()) {
    found = of_option(given, folder);
  } else if (const auto recorded = of_provenance(results)) {
    found = *recorded;
  } else {
    found = of_folder(folder);
  }
  set_date(found, results, given.date, folder);
  return found;
}

}  // namespace cbc3d::reports
