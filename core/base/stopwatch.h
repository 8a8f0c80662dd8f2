// Measures the total time of a part of the work on one thread.
#pragma once
#include <chrono>

namespace etendue {

class Stopwatch {
  using Clock = std::chrono::steady_clock;

 public:
  double seconds() const { return std::chrono::duration<double>(total_).count(); }

  // Adds its lifetime to a stopwatch. With a null pointer it measures nothing.
  class Lap {
   public:
    explicit Lap(Stopwatch* watch) : watch_(watch) {
      if (watch_) start_ = Clock::now();
    }
    ~Lap() {
      if (watch_) watch_->total_ += Clock::now() - start_;
    }
    Lap(const Lap&) = delete;
    Lap& operator=(const Lap&) = delete;

   private:
    Stopwatch* watch_;
    Clock::time_point start_;
  };

 private:
  Clock::duration total_{0};
};

}  // namespace etendue
