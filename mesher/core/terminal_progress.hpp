// Progress on standard error: a bar on a terminal, plain lines elsewhere, nothing when quiet.
#pragma once

#include <string_view>

#include "mesher/core/progress.hpp"
#include "mesher/core/runtime.hpp"

namespace cbc3d {

class TerminalProgress : public Progress {
 public:
  /// `quiet`: nothing is printed but important lines.
  explicit TerminalProgress(bool quiet = false);
  ~TerminalProgress();
  TerminalProgress(const TerminalProgress&) = delete;
  TerminalProgress& operator=(const TerminalProgress&) = delete;

  /// Prints a line that stays, such as a warning; when quiet, only if it is `important`.
  void line(std::string_view text, bool important = false);
  /// Removes the bar.
  void done();

 private:
  void show(std::string_view name, double fraction);
  void clear_bar() const;
  bool quiet_;
  bool terminal_;
  bool bar_shown_ = false;
  Stopwatch watch_;
};

}  // namespace cbc3d
