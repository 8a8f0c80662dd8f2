// What methods that shoot from the lights share: as many light paths for each sample as the picture has pixels.
//
// Derived is a Method that offers
//
//   template <class M> void estimate(const Pass&, LightWalks<M>&, transport::Front<M>&, Splatter&) const
//   template <class M> void see_light(const Pass&, const typename LightWalks<M>::Start&, Vec2 lens, uint32_t seed,
//                                     Splatter&) const
//
// which let the walks go, and look at their starts.
#pragma once
#include "integrator/integrator_base.h"
#include "integrator/shared/light_subpaths.h"
#include "integrator/shared/splatter.h"

namespace etendue::integrator {

template <class Derived>
class Shooting : public Method<Derived> {
 public:
  std::unique_ptr<Work> begin(const Pass& pass, const Work*) const final {
    return std::make_unique<Paths>(this->self(), pass);
  }

 private:
  class Paths final : public Work {
   public:
    Paths(const Derived& method, const Pass& pass) : method_(method), pass_(pass) {}

    std::vector<Phase> phases(uint32_t) override { return {{"tracing light paths", (paths() + kTask - 1) / kTask}}; }

    std::optional<uint64_t> run(uint32_t sample, size_t, int task, const Turn& turn) override {
      return transport::with_model(*pass_.model, [&]<class M>(M) { return run_with<M>(sample, task, turn); });
    }

   private:
    static constexpr int kTask = SampleTable::kPaths;
    int paths() const { return pass_.width * pass_.height; }

    template <class M>
    std::optional<uint64_t> run_with(uint32_t sample, int task, const Turn& turn) const {
      static thread_local const auto walks = std::make_unique<LightWalks<M>>();
      transport::Front<M>& front = front_of_thread<M>();
      Splatter splatter(pass_, turn, 1 / static_cast<float>(paths()));
      const int first = task * kTask, count = std::min(kTask, paths() - first);
      walks->launch(
          pass_, sample, count, turn, front, [&](int i) { return static_cast<uint32_t>(first + i); },
          [&](const typename LightWalks<M>::Start& start, Vec2 lens) {
            method_.template see_light<M>(pass_, start, lens, front.state(start.path).seed + sample, splatter);
            return true;
          });
      method_.template estimate<M>(pass_, *walks, front, splatter);
      if (front.given_up()) return {};
      return splatter.finish() + front.rays_traced();
    }

    const Derived& method_;
    const Pass pass_;
  };
};

}  // namespace etendue::integrator
