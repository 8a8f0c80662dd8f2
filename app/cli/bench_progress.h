// The progress of a benchmark.
#pragma once
#include <atomic>
#include <string>

#include "bench/progress.h"
#include "interrupt.h"
#include "progress_bar.h"

namespace etendue::cli {

// The share of the progress bar for computing the reference.
inline constexpr double kReferenceProgress = 0.67;

// One progress bar for the reference and the methods.
class BenchProgress {
 public:
  explicit BenchProgress(const std::atomic<bool>& interrupted) : interrupted_(interrupted) {}

  // The part of the bar from `begin` to `end`, both fractions.
  bench::Progress part(double begin, double end) {
    return [this, begin, end](double done, const std::string& task) {
      progress_.show(begin + done * (end - begin), task);
      return !interrupted_;
    };
  }
  void finish() { progress_.finish(); }

 private:
  const std::atomic<bool>& interrupted_;
  Progress progress_;
};

}  // namespace etendue::cli
