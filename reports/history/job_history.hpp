// A store as series: for every job on a machine its figures from commit to commit.
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "reports/history/store.hpp"

namespace cbc3d::reports {

/// A job's repeats at a commit as one.
struct JobPoint {
  std::size_t commit = 0;  ///< number in History::commits
  int runs = 0;
  std::string failure;             ///< status and reason of a run that is not ok; empty: all are
  std::set<std::string> versions;  ///< of the mesher
  metrics::Figures figures;        ///< of the runs that are ok
};

struct JobHistory {
  std::string name;  ///< "liver, cgal, 1 thread", and parameters where several jobs would have that name
  std::string machine;
  std::string case_name, mesher;
  std::vector<JobPoint> points;  ///< in the order of the commits
};

struct History {
  std::vector<Commit> commits;   ///< oldest first
  std::vector<JobHistory> jobs;  ///< by machine and name
};

/// The runs as series. Commits are in the order of their dates, then of their first runs, then of their
/// names. What makes jobs different: machine, case, image, mesher, threads, budget and parameters.
History make_history(const std::vector<HistoryRun>& runs);

/// The number of the commit with that name or of the only one whose name begins so. Throws InputError that
/// begins with `option` where there is none, or several.
std::size_t commit_number(const History& history, const std::string& name, const std::string& option);

/// The history up to a commit, with it.
History up_to(const History& history, std::size_t commit);

/// What is looked at of a history; empty lists: all.
struct HistorySelection {
  std::vector<std::string> cases, meshers, machines;
};

/// The jobs that are selected. Throws InputError that names what the store does not have.
History select(const History& history, const HistorySelection& selection);

/// A commit's name as it is shown: of a hash the first 10 digits.
std::string short_name(const Commit& commit);

}  // namespace cbc3d::reports
