// The stop condition of long computations.
#pragma once
#include <functional>

namespace etendue::radiosity {

// Polled at intervals: false ends the computation, which can be continued later. A null pointer never ends it.
using KeepGoing = std::function<bool()>;

inline bool stops(const KeepGoing* keep_going) { return keep_going && !(*keep_going)(); }

// Calls work(i) for i from `next` to count - 1 and polls the stop condition every few thousand steps. `cost(i)` is the
// number of operations of a step. False if it was stopped; `next` is where to continue.
template <class Cost, class Work>
bool continue_loop(size_t& next, size_t count, const KeepGoing* keep_going, Cost&& cost, Work&& work) {
  constexpr size_t kOperations = 200'000;  // between two polls: about 0.2 ms
  for (size_t spent = 0; next < count; ++next) {
    if (spent >= kOperations) {
      if (stops(keep_going)) return false;
      spent = 0;
    }
    work(next);
    spent += cost(next);
  }
  return true;
}

}  // namespace etendue::radiosity
