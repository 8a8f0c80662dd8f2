#include "progress.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>

namespace etendue::cli {
namespace {

using Clock = std::chrono::steady_clock;
constexpr double kTerminalInterval = 0.1, kLineInterval = 10;
constexpr int kBarWidth = 24;

double since(Clock::time_point t) { return std::chrono::duration<double>(Clock::now() - t).count(); }

}  // namespace

std::string duration_text(double seconds) {
  if (!std::isfinite(seconds)) return "?";
  const auto s = static_cast<long>(seconds + 0.5);
  char text[32];
  if (s >= 3600)
    std::snprintf(text, sizeof text, "%ld:%02ld:%02ld", s / 3600, s / 60 % 60, s % 60);
  else
    std::snprintf(text, sizeof text, "%ld:%02ld", s / 60, s % 60);
  return text;
}

Progress::Progress() : terminal_(isatty(STDERR_FILENO) != 0), start_(Clock::now()), last_(start_) {}
Progress::~Progress() { finish(); }

void Progress::show(double done, const std::string& text) {
  if (since(last_) < (terminal_ ? kTerminalInterval : kLineInterval)) return;
  last_ = Clock::now();
  const double left = done > 0.005 ? since(start_) * (1 - done) / done : INFINITY;
  if (!terminal_) {
    std::fprintf(stderr, "%3.0f %%  %s  %s left\n", 100 * done, text.c_str(), duration_text(left).c_str());
    return;
  }
  std::string bar;
  for (int i = 0; i < kBarWidth; ++i) bar += i < done * kBarWidth ? "█" : "·";
  std::fprintf(stderr, "\r\033[K%s %3.0f %%  %s  %s left", bar.c_str(), 100 * done, text.c_str(),
               duration_text(left).c_str());
  shown_ = true;
}

void Progress::finish() {
  if (terminal_ && shown_) std::fputs("\r\033[K", stderr);
  shown_ = false;
}

}  // namespace etendue::cli
