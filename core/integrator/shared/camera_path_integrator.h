// What all methods that gather from the camera share: a front of camera rays to start with, and a pixel for each path.
//
// Derived is a Method that offers `template <class M> void estimate(transport::Front<M>&) const` too, which lets the
// walks go and adds what they find to their radiance.
#pragma once
#include "integrator/integrator_base.h"
#include "integrator/shared/camera_paths.h"
#include "transport/wavefront/path_estimators.h"

namespace etendue::integrator {

// What stands in the way of walks that count light only where they meet it.
inline std::string obstacle_to_meeting_lights(const Pass& pass) {
  const LightTable& lights = pass.scene->lights();
  if (lights.placed().empty() || !lights.triangles().empty() || !lights.environment().black()) return {};
  return "no walk can meet a light without extent, and the scene has no others: take a method that samples lights";
}

// Of the choice of lights (LightStrategy).
inline constexpr const char* kLightsDoc =
    "Every light has no noise of choosing; one has the same cost however many there are, and by the tree those near by "
    "are asked more often than those far away";

template <class Derived>
class Gathering : public Method<Derived> {
 public:
  std::unique_ptr<Work> begin(const Pass& pass, const Work*) const final {
    return std::make_unique<Blocks>(this->self(), pass);
  }

 private:
  // Nothing but the walks of each block.
  class Blocks final : public Work {
   public:
    Blocks(const Derived& method, const Pass& pass) : method_(method), pass_(pass) {}

    std::optional<uint64_t> sample(const PixelBlock& block, std::span<Rgb> radiance, const Turn& turn) override {
      return transport::with_model(*pass_.model, [&]<class M>(M) {
        transport::Front<M>& front = front_of_thread<M>();
        const BlockOrder order(block);
        launch_camera_walks(pass_, block, order, turn, front);
        method_.template estimate<M>(front);
        return collect(front, order, radiance);
      });
    }

   private:
    const Derived& method_;
    const Pass pass_;
  };
};

}  // namespace etendue::integrator
