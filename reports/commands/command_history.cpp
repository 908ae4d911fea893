// cbc3d-bench history: figures from commit to commit.
#include <iostream>

#include "mesher/command_line/number_range.hpp"
#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"
#include "mesher/core/runtime.hpp"
#include "reports/commands/commands.hpp"
#include "reports/history/history_page.hpp"
#include "reports/history/history_tables.hpp"

namespace cbc3d::reports {
namespace {

struct HistoryOptions {
  std::string store;
  // add
  std::string out;
  GivenCommit commit;
  std::string machine;
  // show, regressions
  HistorySelection selection;
  std::vector<std::string> metrics;
  std::size_t last = 20;
  std::string since;
  std::string page, title = "CBC3D: figures by commit";
  ChangeOptions changes;
  int threads = 0;
  bool quiet = false;
};

int add(const HistoryOptions& options) {
  const std::vector<JobResult> results = results_of(options.out);
  const FoundCommit found = find_commit(results, options.commit, ".");
  const Added count = add_to_store(options.store, results, found.commit, options.machine);
  if (!options.quiet) {
    std::cout << "commit " << found.commit.name << " (by " << found.from << ") of " << found.commit.date
              << " (by " << found.date_from << "): " << count.added << " runs added, " << count.known
              << " were there already\n";
  }
  return kExitSuccess;
}

/// The selected jobs of the store, with what changed in them.
struct Looked {
  History history;
  ChangeOptions options;
  std::vector<Change> changes;
};

Looked look(const HistoryOptions& options) {
  set_thread_count(options.threads);
  Looked looked{select(make_history(read_store(options.store)), options.selection), options.changes, {}};
  for (const std::string& key : options.metrics) {
    looked.options.metrics.push_back(metric_of_key(key, "--metric"));
  }
  looked.changes = find_changes(looked.history, looked.options);
  return looked;
}

int show(const HistoryOptions& options) {
  const Looked looked = look(options);
  const auto ids = looked.options.metrics.empty() ? shown_metrics() : looked.options.metrics;
  for (std::size_t job = 0; job < looked.history.jobs.size(); ++job) {
    std::cout << to_markdown(job_table(looked.history, job, ids, looked.changes, options.last)) << '\n';
  }
  std::cout << to_markdown(change_table(looked.history, looked.changes, "changes", "Changes")) << '\n';
  return kExitSuccess;
}

int write_page(const HistoryOptions& options) {
  require_writable(options.page);
  const Looked looked = look(options);
  const auto ids = looked.options.metrics.empty() ? default_metrics() : looked.options.metrics;
  write_text_file(options.page, history_page(options.title, looked.history, looked.changes, ids));
  if (!options.quiet) {
    std::cout << options.page << ": " << looked.history.jobs.size() << " jobs, " << looked.changes.size()
              << " changes\n";
  }
  return kExitSuccess;
}

/// The commit whose figures are known already: the named one, else the last but one.
std::optional<std::size_t> known_commit(const HistoryOptions& options, const History& history) {
  if (!options.since.empty()) {
    return commit_number(history, options.since, "--since");
  }
  return history.commits.size() < 2 ? std::nullopt : std::optional(history.commits.size() - 2);
}

std::vector<Change> for_the_worse(const std::vector<Change>& changes) {
  std::vector<Change> worse;
  for (const Change& change : changes) {
    if (change.direction == Direction::worse) {
      worse.push_back(change);
    }
  }
  return worse;
}

int regressions(const HistoryOptions& options) {
  const Looked looked = look(options);
  const std::vector<Change> all = for_the_worse(looked.changes);
  const auto since = known_commit(options, looked.history);
  const std::vector<Change> fresh = new_regressions(looked.history, looked.changes, since, looked.options);
  const std::string after = since ? "commit " + short_name(looked.history.commits[*since]) : "the beginning";
  if (!options.quiet && !all.empty()) {
    std::cout << to_markdown(change_table(looked.history, all, "regressions", "Regressions")) << '\n';
  }
  if (!fresh.empty()) {
    std::cout << to_markdown(change_table(looked.history, fresh, "new", "New since " + after)) << '\n';
  }
  if (!options.quiet || !fresh.empty()) {
    std::cout << "regressions: " << all.size() << ", new since " << after << ": " << fresh.size() << '\n';
  }
  return fresh.empty() ? kExitSuccess : kExitGateFailed;
}

void add_store_option(CLI::App* parser, HistoryOptions& options) {
  parser->add_option("--store", options.store, "folder of the history, a *.jsonl file for each commit")
      ->required();
}

void add_look_options(CLI::App* parser, HistoryOptions& options) {
  add_store_option(parser, options);
  parser->add_option("--case", options.selection.cases, "only these cases");
  parser->add_option("--mesher", options.selection.meshers, "only these meshers");
  parser->add_option("--machine", options.selection.machines, "only these machines");
  parser->add_option("--metric", options.metrics,
                     "only these figures, by their keys (see: list metrics); default: those of the gate");
  parser
      ->add_option("--level", options.changes.level,
                   "probability of an alarm in a store in which nothing changes, for all series together")
      ->check(number_between(1e-6, 0.5))
      ->capture_default_str();
  parser->add_option("--at-least", options.changes.least_percent, "leave out smaller changes, %")
      ->check(number_between(0, 1e6))
      ->capture_default_str();
  parser->add_option("--seed", options.changes.seed, "of the permutation test")
      ->check(seed_value())
      ->capture_default_str();
  add_threads_option(parser, options.threads);
}

Command add_add(CLI::App* parent, const std::shared_ptr<HistoryOptions>& options) {
  CLI::App* parser = parent->add_subcommand(
      "add", "Adds the results of a run to the store; the same run again changes nothing");
  parser->add_option("OUT", options->out, "folder of a run, with results.jsonl")->required();
  add_store_option(parser, *options);
  parser->add_option(
      "--commit", options->commit.name,
      "hash or name of the mesher's state; default: the commit of the build in the results, for "
      "meshers from outside that which git has checked out here");
  parser->add_option("--date", options->commit.date,
                     "its date, ISO 8601; default: by the results, by git, else that of the first run");
  parser->add_option("--machine", options->machine, "name of the machine; default: its CPU and cores");
  add_idle_options(parser, options->threads, "adding needs", options->quiet, "no summary on the screen");
  return {parser, [options] { return add(*options); }};
}

Command add_show(CLI::App* parent, const std::shared_ptr<HistoryOptions>& options) {
  CLI::App* parser =
      parent->add_subcommand("show", "Prints the figures of every job by commit, and what changed");
  add_look_options(parser, *options);
  parser->add_option("--last", options->last, "commits of each job that are shown, the newest")
      ->check(whole_number_between(1, 1000000))
      ->capture_default_str();
  parser->add_flag("--quiet", options->quiet, "no progress (showing has none)");
  return {parser, [options] { return show(*options); }};
}

Command add_page(CLI::App* parent, const std::shared_ptr<HistoryOptions>& options) {
  CLI::App* parser = parent->add_subcommand(
      "page", "Writes one HTML file: plots of every job by commit, with its changes marked");
  add_look_options(parser, *options);
  parser->add_option("-o,--out", options->page, "HTML file to write")->required();
  parser->add_option("--title", options->title, "title of the page")->capture_default_str();
  parser->add_flag("--quiet", options->quiet, "no summary on the screen");
  return {parser, [options] { return write_page(*options); }};
}

Command add_regressions(CLI::App* parent, const std::shared_ptr<HistoryOptions>& options) {
  CLI::App* parser = parent->add_subcommand(
      "regressions", "Lists the change points that are for the worse; exit code 1 when some are new");
  add_look_options(parser, *options);
  parser->add_option(
      "--since", options->since,
      "new is what the figures up to this commit did not show yet; default: the last commit but "
      "one, so that an alarm comes once");
  parser->add_flag("--quiet", options->quiet, "print nothing but what is new");
  return {parser, [options] { return regressions(*options); }};
}

}  // namespace

Command add_history_command(CLI::App& app) {
  CLI::App* parser = app.add_subcommand(
      "history", "Keeps the figures of runs by commit in plain files, and finds since when they are others");
  parser->require_subcommand(1);
  const auto options = std::make_shared<HistoryOptions>();
  const std::vector<Command> commands{add_add(parser, options), add_show(parser, options),
                                      add_page(parser, options), add_regressions(parser, options)};
  return {parser, [commands] {
            for (const Command& command : commands) {
              if (command.parser->parsed()) {
                return command.run();
              }
            }
            return kExitBadInput;
          }};
}

}  // namespace cbc3d::reports
