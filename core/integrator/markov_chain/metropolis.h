// The Metropolis-Hastings acceptance decision, and the contributions of both states.
//                                                  [Lang, sec. 9.4, eq. 9.116, 9.120, fig. 9.27, corrected; Veach 1997]
//
// Every iteration counts, whether its proposal is accepted or not. The current state is recorded with the weight 1 - a,
// the proposal with the acceptance probability a: the same mean as recording the state of the chain, with less
// variance.
#pragma once
#include <algorithm>
#include <cstdint>
#include <utility>

namespace etendue::integrator {

struct AcceptanceDecision {
  double acceptance;  // probability of accepting the proposal
  bool accepted;
};

// The decision for target values `current` and `proposed`, both at least zero. `reverse_over_forward` is the density of
// proposing the current state from the proposal over that of the proposal. `u` is uniform in [0, 1).
inline AcceptanceDecision decide_acceptance(double current, double proposed, double u,
                                            double reverse_over_forward = 1) {
  const double ratio = proposed * reverse_over_forward;
  const double acceptance = !(ratio > 0) ? 0.0 : current > 0 ? std::min(1.0, ratio / current) : 1.0;
  return {acceptance, u < acceptance};
}

// The expected number of iterations in the current state of a chain since it was last recorded.
class Occupancy {
 public:
  // on_leave(weight) records the state that the chain leaves, on_reject(weight) a proposal that was rejected. `extra`
  // is added to the weight of the proposal.
  template <class OnLeave, class OnReject>
  void record(const AcceptanceDecision& decision, OnLeave&& on_leave, OnReject&& on_reject, double extra = 0) {
    iterations_ += 1 - decision.acceptance;
    if (decision.accepted)
      on_leave(std::exchange(iterations_, decision.acceptance + extra));
    else if (decision.acceptance + extra > 0)
      on_reject(decision.acceptance + extra);
  }
  // The weight to be recorded for the current state at the end.
  double take_remaining() { return std::exchange(iterations_, 0.0); }

 private:
  double iterations_ = 0;
};

// Counts of one kind of mutation.
struct Acceptance {
  uint64_t proposed = 0, accepted = 0;

  void count(const AcceptanceDecision& decision) {
    ++proposed;
    accepted += decision.accepted ? 1 : 0;
  }
  Acceptance& operator+=(const Acceptance& other) {
    proposed += other.proposed;
    accepted += other.accepted;
    return *this;
  }
};

}  // namespace etendue::integrator
