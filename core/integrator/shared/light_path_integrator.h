// The base of integrators that trace paths from the lights: per sample, as many light paths as the image has pixels.
//
// Derived is an IntegratorBase that also offers
//
//   template <class M> void estimate(const RenderContext&, LightSubpaths<M>&, transport::PathWavefront<M>&,
//                                    Splatter&) const
//   template <class M> void connect_light_to_camera(const RenderContext&, const typename LightSubpaths<M>::Start&,
//                                                   Vec2 lens, uint32_t seed, Splatter&) const
//
// The first traces the paths and splats their contributions, the second splats the contribution of their starts.
#pragma once
#include "integrator/integrator_base.h"
#include "integrator/shared/light_subpaths.h"
#include "integrator/shared/splatter.h"

namespace etendue::integrator {

template <class Derived>
class LightPathIntegrator : public IntegratorBase<Derived> {
 public:
  std::unique_ptr<RenderState> begin(const RenderContext& context, const RenderState*) const final {
    return std::make_unique<Paths>(this->self(), context);
  }

 private:
  class Paths final : public RenderState {
   public:
    Paths(const Derived& integrator, const RenderContext& context) : integrator_(integrator), context_(context) {}

    std::vector<Phase> phases(uint32_t) override {
      return {{"tracing light paths", (path_count() + kTask - 1) / kTask}};
    }

    std::optional<uint64_t> run(uint32_t sample, size_t, int task, const TaskContext& task_context) override {
      return transport::with_scattering_model(*context_.model,
                                              [&]<class M>(M) { return run_with<M>(sample, task, task_context); });
    }

   private:
    static constexpr int kTask = SampleTable::kPaths;
    int path_count() const { return context_.width * context_.height; }

    template <class M>
    std::optional<uint64_t> run_with(uint32_t sample, int task, const TaskContext& task_context) const {
      static thread_local const auto subpaths = std::make_unique<LightSubpaths<M>>();
      transport::PathWavefront<M>& paths = thread_wavefront<M>();
      Splatter splatter(context_, task_context, 1 / static_cast<float>(path_count()));
      const int first = task * kTask, count = std::min(kTask, path_count() - first);
      subpaths->launch(
          context_, sample, count, task_context, paths, [&](int i) { return static_cast<uint32_t>(first + i); },
          [&](const typename LightSubpaths<M>::Start& start, Vec2 lens) {
            integrator_.template connect_light_to_camera<M>(context_, start, lens,
                                                            paths.state(start.path).seed + sample, splatter);
            return true;
          },
          LightPathStarts::anywhere);
      integrator_.template estimate<M>(context_, *subpaths, paths, splatter);
      if (paths.cancelled()) return {};
      return splatter.finish() + paths.rays_traced();
    }

    const Derived& integrator_;
    const RenderContext context_;
  };
};

}  // namespace etendue::integrator
