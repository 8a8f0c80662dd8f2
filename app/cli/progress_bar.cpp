#include "progress_bar.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>

#include "base/number_text.h"

namespace etendue::cli {
namespace {

using Clock = std::chrono::steady_clock;
constexpr double kBarInterval = 0.1, kLineInterval = 10;  // seconds
constexpr int kBarWidth = 24;

double seconds_since(Clock::time_point t) { return std::chrono::duration<double>(Clock::now() - t).count(); }

}  // namespace

Progress::Progress() : is_terminal_(isatty(STDERR_FILENO) != 0), start_(Clock::now()), last_update_(start_) {}
Progress::~Progress() { finish(); }

void Progress::show(double done, const std::string& text) {
  if (seconds_since(last_update_) < (is_terminal_ ? kBarInterval : kLineInterval)) return;
  last_update_ = Clock::now();
  std::string line = format_text("%3.0f %%  %s", 100 * done, text.c_str());
  if (done > 0.005) line += "  " + format_duration(seconds_since(start_) * (1 - done) / done) + " left";
  if (!is_terminal_) {
    std::fprintf(stderr, "%s\n", line.c_str());
    return;
  }
  std::string bar;
  for (int i = 0; i < kBarWidth; ++i) bar += i < done * kBarWidth ? "█" : "·";
  std::fprintf(stderr, "\r\033[K%s %s", bar.c_str(), line.c_str());
  is_shown_ = true;
}

void Progress::finish() {
  if (is_terminal_ && is_shown_) std::fputs("\r\033[K", stderr);
  is_shown_ = false;
}

}  // namespace etendue::cli
