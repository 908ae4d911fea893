#include "mesher/core/terminal_progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <string>

#include "mesher/core/one_line.hpp"

namespace cbc3d {

TerminalProgress::TerminalProgress(bool quiet)
    : Progress([this](std::string_view stage, double fraction) {
        show(stage, fraction);
        return true;
      }),
      quiet_(quiet),
      terminal_(::isatty(STDERR_FILENO) == 1) {}

TerminalProgress::~TerminalProgress() {
  done();
}

void TerminalProgress::clear_bar() const {
  if (bar_shown_) {
    std::fputs("\r\033[K", stderr);
  }
}

void TerminalProgress::show(std::string_view name, double fraction) {
  if (quiet_) {
    return;
  }
  const std::string stage = one_line(std::string(name));
  const double share = std::clamp(fraction, 0.0, 1.0);
  if (!terminal_) {
    std::fprintf(stderr, "[%6.1f s] %3.0f %% %s\n", watch_.seconds(), 100 * share, stage.c_str());
    return;
  }
  constexpr int kWidth = 30;
  const int filled = static_cast<int>(share * kWidth);
  const std::string bar = std::string(static_cast<std::size_t>(filled), '#') +
                          std::string(static_cast<std::size_t>(kWidth - filled), '.');
  std::fprintf(stderr, "\r\033[K[%s] %3.0f %% %6.1f s  %s", bar.c_str(), 100 * share, watch_.seconds(),
               stage.c_str());
  std::fflush(stderr);
  bar_shown_ = true;
}

void TerminalProgress::line(std::string_view text, bool important) {
  if (quiet_ && !important) {
    return;
  }
  clear_bar();
  bar_shown_ = false;
  std::fprintf(stderr, "%s\n", one_line(std::string(text)).c_str());
}

void TerminalProgress::done() {
  clear_bar();
  bar_shown_ = false;
}

}  // namespace cbc3d
