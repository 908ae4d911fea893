// What all commands share.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

namespace cbc3d {

/// The options of every command.
struct CommonOptions {
  int threads = 0;          ///< 0: all cores; the number in force once the command runs
  bool quiet = false;       ///< no progress
  std::string report_file;  ///< JSON report; empty: none
};

/// Adds --report with this help text.
void add_report_option(CLI::App& command, CommonOptions& common, const std::string& text);

/// Adds --threads and --quiet. When the command is called, the threads are set, the report is known to be
/// writable, `run` does the work and the exit code becomes that of success. `run` throws InputError and
/// JobError; `common` must outlive the command.
void complete_command(CLI::App& command, CommonOptions& common, int& exit_code,
                      const std::function<void()>& run);

}  // namespace cbc3d
