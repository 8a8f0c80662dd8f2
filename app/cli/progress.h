// How long work tells about itself: a bar on a terminal, a line now and then elsewhere. Standard error only.
#pragma once
#include <chrono>
#include <string>

namespace etendue::cli {

class Progress {
 public:
  Progress();
  ~Progress();
  // `done` from 0 to 1; `text` is what is known beside it ("128 spp, 1.9 Ms/s").
  void show(double done, const std::string& text);
  void finish();

 private:
  bool terminal_;
  bool shown_ = false;
  std::chrono::steady_clock::time_point start_, last_;
};

std::string duration_text(double seconds);

}  // namespace etendue::cli
