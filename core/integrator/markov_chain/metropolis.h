// The heart of Metropolis sampling: whether a chain goes on to what was proposed, and what either state counts.
//                                                     thesis 9.4, (9.116), (9.120), Fig 9.27; errata E27; digest: S23
//
// Every iteration counts, accepted or not. Both states are recorded, each with the probability that the chain is there
// afterwards: the same mean as of recording where it is, with less noise.
#pragma once
#include <algorithm>
#include <cstdint>
#include <utility>

namespace etendue::integrator {

struct Verdict {
  double acceptance;  // probability that the chain goes on to the proposal
  bool accepted;
};

// Of the values of the target function at both states, at least zero; `back_over_forth` is the density with which the
// present state would be proposed from the other, over that of the proposal. `u` is uniform in [0, 1).
inline Verdict judge(double present, double proposed, double u, double back_over_forth = 1) {
  const double ratio = proposed * back_over_forth;
  const double acceptance = !(ratio > 0) ? 0.0 : present > 0 ? std::min(1.0, ratio / present) : 1.0;
  return {acceptance, u < acceptance};
}

// How many iterations the present state of a chain has counted since it was last recorded.
class Stay {
 public:
  // leave(iterations) records the state that the chain leaves, pass(iterations) a proposal that it does not go to.
  // `more` is what the proposal counts besides.
  template <class Leave, class RenderContext>
  void take(const Verdict& verdict, Leave&& leave, RenderContext&& context, double more = 0) {
    iterations_ += 1 - verdict.acceptance;
    if (verdict.accepted)
      leave(std::exchange(iterations_, verdict.acceptance + more));
    else if (verdict.acceptance + more > 0)
      context(verdict.acceptance + more);
  }
  // To be recorded for the present state at the end.
  double settle() { return std::exchange(iterations_, 0.0); }

 private:
  double iterations_ = 0;
};

// Of one kind of mutation.
struct Acceptance {
  uint64_t proposed = 0, accepted = 0;

  void count(const Verdict& verdict) {
    ++proposed;
    accepted += verdict.accepted ? 1 : 0;
  }
  Acceptance& operator+=(const Acceptance& other) {
    proposed += other.proposed;
    accepted += other.accepted;
    return *this;
  }
};

}  // namespace etendue::integrator
