#include "mesher/core/progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace cbc3d {

Progress::Progress(bool quiet) : quiet_(quiet), terminal_(::isatty(STDERR_FILENO) == 1) {}

Progress::~Progress() {
  done();
}

void Progress::clear_bar() const {
  if (bar_shown_) {
    std::fputs("\r\033[K", stderr);
  }
}

void Progress::step(std::string_view name, double fraction) {
  if (quiet_) {
    return;
  }
  const double share = std::clamp(fraction, 0.0, 1.0);
  const int length = static_cast<int>(name.size());
  if (!terminal_) {
    std::fprintf(stderr, "[%6.1f s] %3.0f %% %.*s\n", watch_.seconds(), 100 * share, length, name.data());
    return;
  }
  constexpr int kWidth = 30;
  const int filled = static_cast<int>(share * kWidth);
  const std::string bar = std::string(static_cast<std::size_t>(filled), '#') +
                          std::string(static_cast<std::size_t>(kWidth - filled), '.');
  std::fprintf(stderr, "\r\033[K[%s] %3.0f %% %6.1f s  %.*s", bar.c_str(), 100 * share, watch_.seconds(),
               length, name.data());
  std::fflush(stderr);
  bar_shown_ = true;
}

void Progress::line(std::string_view text, bool important) {
  if (quiet_ && !important) {
    return;
  }
  clear_bar();
  bar_shown_ = false;
  std::fprintf(stderr, "%.*s\n", static_cast<int>(text.size()), text.data());
}

void Progress::done() {
  clear_bar();
  bar_shown_ = false;
}

}  // namespace cbc3d
