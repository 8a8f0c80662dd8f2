// The base of integrators that trace paths from the camera: a wavefront of camera rays, one path per pixel.
//
// Derived is an IntegratorBase that also offers `template <class M> void estimate(transport::PathWavefront<M>&) const`,
// which traces the paths and adds their contributions to their radiance. If `estimate` is correct at vertices in
// scattering media, Derived defines `static constexpr bool kScatteringMedia = true` and states it in its
// IntegratorInfo; likewise `kSpectral` if it supports spectral rendering besides.
//
// With `LightSampling light_sampling() const`, Derived learns how to choose lights: `estimate` has this sampling, with
// learned probabilities, as its second argument.
#pragma once
#include "integrator/integrator_base.h"
#include "integrator/shared/camera_paths.h"
#include "integrator/shared/light_learning.h"
#include "transport/wavefront/path_estimators.h"

namespace etendue::integrator {

// Why paths without light sampling find no light in this scene; empty if they do.
inline std::string incompatibility_with_point_lights(const RenderContext& context) {
  const LightTable& lights = context.scene->lights();
  if (lights.placed_count() == 0 || !lights.triangles().empty() || !lights.environment().black()) return {};
  return "all lights of the scene are points or directions, which paths without light sampling cannot hit: use an "
         "integrator that samples lights";
}

// Description of the parameter `lights` (LightStrategy).
inline constexpr const char* kLightsDoc =
    "All: no noise of the choice, but a cost that grows with the number of lights. One: constant cost. The light tree "
    "favours nearby lights. Automatic: the light tree from eight lights on, and in integrators that learn, choices "
    "between groups of lights that follow what reaches the visible surfaces";

template <class Derived>
class CameraPathIntegrator : public IntegratorBase<Derived> {
 public:
  std::unique_ptr<RenderState> begin(const RenderContext& context, const RenderState*) const final {
    return std::make_unique<Blocks>(this->self(), context);
  }

 private:
  // Renders blocks independently of each other.
  class Blocks final : public RenderState {
   public:
    Blocks(const Derived& integrator, const RenderContext& context) : integrator_(integrator), context_(context) {
      if constexpr (kLearns) learned_ = learn_light_choice(context, integrator.light_sampling(), integrator.max_depth);
    }

    std::optional<uint64_t> sample(const PixelBlock& block, std::span<Rgb> radiance,
                                   const TaskContext& task_context) override {
      const auto render = [&]<class M>(M) {
        transport::PathWavefront<M>& paths = thread_wavefront<M>();
        const PixelOrder order(block);
        launch_camera_paths(context_, block, order, task_context, paths);
        paths.stratify_channels();
        estimate(paths);
        if (task_context.recorder) task_context.recorder->collect(paths.size());
        if (task_context.spectra) append_spectra(paths, *task_context.spectra);
        return collect(paths, order, radiance);
      };
      if constexpr (requires { Derived::kSpectral; })
        return transport::with_spectral_model(*context_.model, render);
      else if constexpr (requires { Derived::kScatteringMedia; })
        return transport::with_scattering_model(*context_.model, render);
      else
        return transport::with_model(*context_.model, render);
    }

   private:
    static constexpr bool kLearns = requires(const Derived& d) { d.light_sampling(); };

    template <class M>
    void estimate(transport::PathWavefront<M>& paths) const {
      if constexpr (kLearns) {
        integrator_.template estimate<M>(paths, integrator_.light_sampling().with(learned_.get()));
      } else {
        integrator_.template estimate<M>(paths);
      }
    }

    const Derived& integrator_;
    const RenderContext context_;
    std::shared_ptr<const LearnedLightChoice> learned_;  // null: nothing to learn
  };
};

}  // namespace etendue::integrator
