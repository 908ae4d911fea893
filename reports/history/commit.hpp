// Which commit a run's figures belong to.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/results/job_result.hpp"

namespace cbc3d::reports {

struct Commit {
  std::string name;  ///< a hash, or what a team calls its states: letters, digits, . _ and -
  std::string date;  ///< UTC, see date.hpp
};

/// A commit with where it is known from, in words.
struct FoundCommit {
  Commit commit;
  std::string from;       ///< "--commit", "the results' provenance", "git in '.'"
  std::string date_from;  ///< likewise
};

/// What is given on the command line; empty: not given.
struct GivenCommit {
  std::string name, date;
};

/// True for 1 to 80 letters, digits, dots, hyphens and underscores that begin with no dot and no hyphen, so
/// that the name can be a file's.
bool is_commit_name(const std::string& name);

/// The commit of the mesher that made `results`: the given one; else, where all meshers are built in, that of
/// the build in the results' provenance; else that which is checked out in `folder`. A given name that git
/// knows in `folder` (HEAD, a tag, the beginning of a hash) stands for its whole hash. The date is the given
/// one, else that of the commit in the provenance or by git, else that of the first run. Throws InputError
/// where there is no commit, where the results come from several, and where the sources differed from it.
FoundCommit find_commit(const std::vector<JobResult>& results, const GivenCommit& given,
                        const std::filesystem::path& folder);

}  // namespace cbc3d::reports
