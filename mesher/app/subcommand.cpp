#include "mesher/app/subcommand.hpp"

#include "mesher/command_line/number_range.hpp"
#include "mesher/core/atomic_file.hpp"
#include "mesher/core/error.hpp"
#include "mesher/core/runtime.hpp"

namespace cbc3d {

void add_report_option(CLI::App& command, CommonOptions& common, const std::string& text) {
  command.add_option("--report", common.report_file, text)->type_name("FILE");
}

void complete_command(CLI::App& command, CommonOptions& common, int& exit_code,
                      const std::function<void()>& run) {
  command.add_option("--threads", common.threads, "threads of all pools [all cores]")
      ->type_name("N")
      ->check(thread_count());
  command.add_flag("--quiet", common.quiet, "no progress");
  command.callback([&common, &exit_code, run] {
    common.threads = set_thread_count(common.threads);
    if (!common.report_file.empty()) {
      require_writable(common.report_file);
    }
    run();
    exit_code = kExitSuccess;
  });
}

}  // namespace cbc3d
