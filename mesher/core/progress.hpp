// Progress of long work on standard error: a bar on a terminal, plain lines elsewhere, nothing when quiet.
#pragma once

#include <string>
#include <string_view>

#include "mesher/core/runtime.hpp"

namespace cbc3d {

class Progress {
 public:
  /// `quiet`: print nothing at all.
  explicit Progress(bool quiet = false);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Announces the step now begun; `fraction` in [0,1] is the share of the whole work that is done.
  void step(std::string_view name, double fraction);
  /// A line that stays (a warning, say), printed even when quiet if `important`.
  void line(std::string_view text, bool important = false);
  /// Ends the bar.
  void done();

 private:
  void clear_bar() const;
  bool quiet_;
  bool terminal_;
  bool bar_shown_ = false;
  Stopwatch watch_;
};

}  // namespace cbc3d
