// Adds up the time that some part of the work takes, for whoever asks what it costs. Of one thread.
#pragma once
#include <chrono>

namespace etendue {

class Stopwatch {
  using Clock = std::chrono::steady_clock;

 public:
  double seconds() const { return std::chrono::duration<double>(total_).count(); }

  // Lets the watch run for its life. Without a watch nothing is measured.
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
