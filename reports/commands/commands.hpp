// The commands of cbc3d-bench.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "mesher/command_line/number_range.hpp"

namespace cbc3d::reports {

/// A command: its parser, and what it does once its options are parsed. `run` returns the exit code.
struct Command {
  CLI::App* parser;
  std::function<int()> run;
};

/// Adds the --threads and --quiet of a command that is done by one thread, `work` ("merging needs").
inline void add_idle_options(CLI::App* parser, int& threads, const std::string& work, bool& quiet,
                             const std::string& quiet_text) {
  parser->add_option("--threads", threads, "threads (" + work + " one)")
      ->check(thread_count())
      ->capture_default_str();
  parser->add_flag("--quiet", quiet, quiet_text);
}
inline void add_manifests_option(CLI::App* parser, std::string& folder) {
  parser->add_option("--manifests", folder, "folder of case manifests, *.json; default: the installed ones");
}
/// Adds the --threads of a command that is done by several.
inline void add_threads_option(CLI::App* parser, int& threads) {
  parser->add_option("--threads", threads, "threads; 0: all cores")
      ->check(thread_count())
      ->capture_default_str();
}

Command add_list_command(CLI::App& app);
Command add_run_command(CLI::App& app);
Command add_evaluate_command(CLI::App& app);
Command add_tables_command(CLI::App& app);
Command add_phantom_command(CLI::App& app);
Command add_merge_command(CLI::App& app);
Command add_gate_command(CLI::App& app);
Command add_history_command(CLI::App& app);
Command add_cluster_command(CLI::App& app);
Command add_report_command(CLI::App& app);
Command add_sweep_command(CLI::App& app);

}  // namespace cbc3d::reports
