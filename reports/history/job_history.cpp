#include "reports/history/job_history.hpp"

#include <algorithm>
#include <cctype>
#include <map>
#include <tuple>

#include "mesher/core/error.hpp"
#include "reports/results/joint_figures.hpp"

namespace cbc3d::reports {
namespace {

/// What makes jobs different from each other.
using JobKey = std::tuple<std::string, std::string, std::string, std::int64_t, int, Parameters, std::string>;

JobKey key_of(const HistoryRun& run) {
  return {run.machine, run.case_name,  run.mesher,      run.budget.value_or(0),
          run.threads, run.parameters, run.image_sha256};
}

std::string plain_job_name(const HistoryRun& run) {
  const std::string budget = run.budget ? ", " + std::to_string(*run.budget) + " elements" : "";
  return run.case_name + budget + ", " + run.mesher + ", " + std::to_string(run.threads) +
         (run.threads == 1 ? " thread" : " threads");
}

/// Parameters and the image's digest, for jobs that differ in these alone.
std::string particulars(const HistoryRun& run) {
  constexpr std::size_t kDigits = 8;
  std::string text;
  for (const auto& [key, value] : run.parameters) {
    text += ", " + key + "=" + value;
  }
  return text + (run.image_sha256.empty() ? "" : ", image " + run.image_sha256.substr(0, kDigits));
}

/// Commits, oldest first. Runs of a commit may have different dates, where one was not known from git.
std::vector<Commit> commits_of(const std::vector<HistoryRun>& runs) {
  std::map<std::string, std::pair<std::string, std::string>> dates;  // commit's and first run's, by name
  for (const HistoryRun& run : runs) {
    const auto [at, is_new] = dates.try_emplace(run.commit.name, run.commit.date, run.utc);
    if (!is_new) {
      at->second.first = std::min(at->second.first, run.commit.date);
      at->second.second = std::min(at->second.second, run.utc);
    }
  }
  std::vector<std::tuple<std::string, std::string, std::string>> order;
  order.reserve(dates.size());
  for (const auto& [name, date] : dates) {
    order.emplace_back(date.first, date.second, name);
  }
  std::sort(order.begin(), order.end());
  std::vector<Commit> commits;
  commits.reserve(order.size());
  for (const auto& [date, first_run, name] : order) {
    commits.push_back({name, date});
  }
  return commits;
}

JobPoint point_of(std::size_t commit, const std::vector<const HistoryRun*>& runs) {
  JobPoint point;
  point.commit = commit;
  point.runs = static_cast<int>(runs.size());
  std::vector<const metrics::Figures*> good;
  for (const HistoryRun* run : runs) {
    if (run->is_ok()) {
      good.push_back(&run->figures);
    } else if (point.failure.empty()) {
      point.failure = run->reason.empty() ? run->status : run->status + ": " + run->reason;
    }
    if (!run->mesher_version.empty()) {
      point.versions.insert(run->mesher_version);
    }
  }
  point.figures = joint_figures(good);
  return point;
}

/// Gives jobs of one machine that would have the same name their particulars.
void tell_apart(std::vector<JobHistory>& jobs, const std::vector<std::string>& particulars_of_job) {
  std::map<std::pair<std::string, std::string>, int> counts;
  for (const JobHistory& job : jobs) {
    ++counts[{job.machine, job.name}];
  }
  for (std::size_t n = 0; n < jobs.size(); ++n) {
    if (counts[{jobs[n].machine, jobs[n].name}] > 1) {
      jobs[n].name += particulars_of_job[n];
    }
  }
}

template <class Member>
void require_known(const History& history, const std::vector<std::string>& names, Member member,
                   const std::string& option) {
  for (const std::string& name : names) {
    std::set<std::string> known;
    for (const JobHistory& job : history.jobs) {
      known.insert(job.*member);
    }
    if (!known.contains(name)) {
      std::string list;
      for (const std::string& one : known) {
        list += (list.empty() ? "'" : ", '") + one + "'";
      }
      throw InputError(option + " '" + name + "': the store has " + list);
    }
  }
}

bool is_among(const std::vector<std::string>& names, const std::string& name) {
  return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

History make_history(const std::vector<HistoryRun>& runs) {
  History history{.commits = commits_of(runs), .jobs = {}};
  std::map<std::string, std::size_t> number;
  for (std::size_t n = 0; n < history.commits.size(); ++n) {
    number[history.commits[n].name] = n;
  }
  std::map<JobKey, std::map<std::size_t, std::vector<const HistoryRun*>>> jobs;
  for (const HistoryRun& run : runs) {
    jobs[key_of(run)][number[run.commit.name]].push_back(&run);
  }
  std::vector<std::string> particulars_of_job;
  for (const auto& [key, points] : jobs) {
    const HistoryRun& first = *points.begin()->second.front();
    JobHistory job{plain_job_name(first), first.machine, first.case_name, first.mesher, {}};
    for (const auto& [commit, repeats] : points) {
      job.points.push_back(point_of(commit, repeats));
    }
    history.jobs.push_back(std::move(job));
    particulars_of_job.push_back(particulars(first));
  }
  tell_apart(history.jobs, particulars_of_job);
  return history;
}

std::size_t commit_number(const History& history, const std::string& name, const std::string& option) {
  std::vector<std::size_t> matches;
  for (std::size_t n = 0; n < history.commits.size(); ++n) {
    if (history.commits[n].name == name) {
      return n;
    }
    if (!name.empty() && history.commits[n].name.starts_with(name)) {
      matches.push_back(n);
    }
  }
  if (matches.size() != 1) {
    throw InputError(option + " '" + name + "': " + (matches.empty() ? "no commit" : "several commits") +
                     " of the store " + (matches.empty() ? "has" : "have") +
                     " a name that begins so; `cbc3d-bench history show` lists them");
  }
  return matches.front();
}

History up_to(const History& history, std::size_t commit) {
  History part;
  part.commits.assign(history.commits.begin(),
                      history.commits.begin() + static_cast<std::ptrdiff_t>(commit) + 1);
  for (JobHistory job : history.jobs) {
    std::erase_if(job.points, [&](const JobPoint& point) { return point.commit > commit; });
    part.jobs.push_back(std::move(job));
  }
  return part;
}

History select(const History& history, const HistorySelection& selection) {
  require_known(history, selection.cases, &JobHistory::case_name, "--case");
  require_known(history, selection.meshers, &JobHistory::mesher, "--mesher");
  require_known(history, selection.machines, &JobHistory::machine, "--machine");
  History part{.commits = history.commits, .jobs = {}};
  for (const JobHistory& job : history.jobs) {
    if (is_among(selection.cases, job.case_name) && is_among(selection.meshers, job.mesher) &&
        is_among(selection.machines, job.machine)) {
      part.jobs.push_back(job);
    }
  }
  if (part.jobs.empty()) {
    throw InputError("the store has no job with such --case, --mesher and --machine together");
  }
  return part;
}

std::string short_name(const Commit& commit) {
  constexpr std::size_t kShortestHash = 40, kDigits = 10;
  const bool is_hash = commit.name.size() >= kShortestHash &&
                       std::all_of(commit.name.begin(), commit.name.end(),
                                   [](unsigned char c) { return std::isxdigit(c) != 0; });
  return is_hash ? commit.name.substr(0, kDigits) : commit.name;
}

}  // namespace cbc3d::reports
