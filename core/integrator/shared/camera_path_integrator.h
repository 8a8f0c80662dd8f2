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
inline std::string incompatibility_with_point_lights(const RenderContext& context) {
  const LightTable& lights = context.scene->lights();
  if (lights.placed_count() == 0 || !lights.triangles().empty() || !lights.environment().black()) return {};
  return "no walk can meet a light without extent, and the scene has no others: take a method that samples lights";
}

// Of the choice of lights (LightStrategy).
inline constexpr const char* kLightsDoc =
    "Every light has no noise of choosing; one has the same cost however many there are, and by the tree those near by "
    "are asked more often than those far away";

template <class Derived>
class CameraPathIntegrator : public IntegratorBase<Derived> {
 public:
  std::unique_ptr<RenderState> begin(const RenderContext& context, const RenderState*) const final {
    return std::make_unique<Blocks>(this->self(), context);
  }

 private:
  // Nothing but the walks of each block.
  class Blocks final : public RenderState {
   public:
    Blocks(const Derived& method, const RenderContext& context) : method_(method), context_(context) {}

    std::optional<uint64_t> sample(const PixelBlock& block, std::span<Rgb> radiance,
                                   const TaskContext& task_context) override {
      return transport::with_model(*context_.model, [&]<class M>(M) {
        transport::PathWavefront<M>& paths = thread_wavefront<M>();
        const PixelOrder order(block);
        launch_camera_paths(context_, block, order, task_context, paths);
        method_.template estimate<M>(paths);
        return collect(paths, order, radiance);
      });
    }

   private:
    const Derived& method_;
    const RenderContext context_;
  };
};

}  // namespace etendue::integrator
