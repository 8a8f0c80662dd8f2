// Progress of long work on standard error: a bar on a terminal, a line every ten seconds otherwise.
#pragma once
#include <chrono>
#include <string>

namespace etendue::cli {

class Progress {
 public:
  Progress();
  ~Progress();
  // `done` is the fraction of the work, 0 to 1. `text` is shown beside it ("128 spp, 1.90 Msamples/s").
  void show(double done, const std::string& text);
  // Removes the bar.
  void finish();

 private:
  bool is_terminal_;
  bool is_shown_ = false;
  std::chrono::steady_clock::time_point start_, last_update_;
};

}  // namespace etendue::cli
