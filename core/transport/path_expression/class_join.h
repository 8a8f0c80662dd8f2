// Path expressions evaluated from the camera and from the light: whether the words of a camera subpath and a light
// subpath together form a selected path.
//
// For each state of the automaton that reads from the light, the compatible states of the one that reads from the
// camera are those from which it accepts the reversed word. The share of a connection is the sum over all compatible
// pairs of the product of both shares.
#pragma once
#include <vector>

#include "transport/path_expression/class_shares.h"
#include "transport/path_expression/path_expression.h"

namespace etendue::transport {

class ClassJoin {
 public:
  using State = Automaton::State;
  using States = Automaton::States;

  explicit ClassJoin(const PathExpression& paths)
      : camera_(&paths.automaton()), light_(&*paths.from_light()), compatible_(light_->size(), 0) {
    std::vector<State> open{light_->start()};
    compatible_[light_->start()] = camera_->accepting();
    std::vector<bool> seen(light_->size(), false);
    while (!open.empty()) {
      const State state = open.back();
      open.pop_back();
      if (seen[state]) continue;
      seen[state] = true;
      for (size_t e = 0; e < kEvents; ++e) {
        const auto event = static_cast<Event>(e);
        const State next = light_->next(state, event);
        if (next == Automaton::kDead) continue;
        compatible_[next] = camera_->before(compatible_[state], event);
        open.push_back(next);
      }
    }
  }

  const Automaton& camera() const { return *camera_; }
  const Automaton& light() const { return *light_; }
  bool are_compatible(State of_camera, State of_light) const { return compatible_[of_light] >> of_camera & 1; }

 private:
  const Automaton* camera_;
  const Automaton* light_;
  std::vector<States> compatible_;
};

}  // namespace etendue::transport
