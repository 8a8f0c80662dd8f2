// Final gathering: what a wide surface gets from other wide surfaces, estimated from photons where rays arrive.
//                                                                      thesis Remark 9.34, L18169-18188; S37 d, S38
// Rays are drawn from the surface's BSDF and follow narrow parts further. They count no light that they meet.
#pragma once
#include "integrator/photon/photon_lookup.h"
#include "integrator/shared/camera_paths.h"

namespace etendue::integrator {

template <class M>
class FinalGather {
 public:
  using Color = typename M::Color;
  using PathWavefront = transport::PathWavefront<M>;

  // A map and how it is looked up; a map that is null holds nothing.
  struct Source {
    PhotonView view;
    NearestPhotons nearest;
  };

  // `rays` from each vertex; where they are shorter than `near`, they gather again.
  void begin(const Source& global, const Source& caustics, int rays, float near) {
    global_ = global, caustics_ = caustics, rays_ = rays, near_ = near;
    rays_traced_ = 0, given_up_ = false;
  }
  bool cancelled() const { return given_up_; }
  uint64_t rays_traced() const { return rays_traced_; }

  // What arrivals reflect of caustics.
  template <class Selected = transport::EveryHit>
  void add_caustics(PathWavefront& paths, int before = 0, const Selected& selected = {}) const {
    if (caustics_.view.map) add_nearest_photons(paths, caustics_.view, caustics_.nearest, before, selected);
  }

  // What arrivals of walks from the camera reflect from wide surfaces.
  void gather(const RenderContext& context, const TaskContext& task_context, PathWavefront& eye) {
    begin_rays(context, task_context, eye);
    for (int i = 0; i < eye.hit_count(); ++i) {
      if (!split().has_rough(eye.bsdf(i))) continue;
      for (int k = 0; k < rays_; ++k) {
        const auto number = static_cast<uint32_t>(eye.length() * rays_ + k);
        origins_[static_cast<size_t>(paths_.size())] = static_cast<uint8_t>(i);
        paths_.add(hash_combine(eye.state_at(i).seed, number));
        if (paths_.size() == PathWavefront::kCapacity) trace(task_context, eye), begin_rays(context, task_context, eye);
      }
    }
    if (paths_.size() > 0) trace(task_context, eye);
  }

 private:
  static constexpr int kLobe = 2;  // the number for the choice of a lobe, after those for the direction

  const transport::LobeSplit& split() const { return global_.view.split; }

  void begin_rays(const RenderContext& context, const TaskContext& task_context, const PathWavefront& eye) {
    paths_.begin(*context.scene, *context.sampler, eye.sample(), task_context.keep_going, context.model->moving);
    if constexpr (M::kClasses) paths_.filter_paths(context.model->paths->automaton());
  }

  void trace(const TaskContext& task_context, PathWavefront& eye) {
    launch(eye);
    while (!given_up_ && paths_.trace())
      while (!given_up_ && paths_.next_hits()) {
        look_up(eye.length());
        given_up_ = !should_continue(task_context);
      }
    given_up_ = given_up_ || paths_.cancelled();
    rays_traced_ += paths_.rays_traced();
    for (int i = 0; i < paths_.size(); ++i) eye.state_at(origin(i)).radiance += paths_.state(i).radiance;
  }

  int origin(int ray) const { return origins_[static_cast<size_t>(ray)]; }

  void launch(PathWavefront& eye) {
    const SampleTable& random = paths_.draw_start(dimensions(0, kLobe + 1));
    for (int ray = 0; ray < paths_.size(); ++ray) {
      const int i = origin(ray);
      const auto at = [&](int dimension) {
        return random.values[static_cast<size_t>(dimension)][static_cast<size_t>(ray)];
      };
      paths_.state(ray).radiance = Color(0);
      LobeSample<Color> s;
      if (!eye.bsdf(i).sample(eye.wo(i), LobeRandom(at(kLobe), {at(0), at(1)}), TransportMode::radiance, s)) continue;
      if (!take_wide(eye, i, s)) continue;
      Ray along;
      eye.point(i).spawn(s.wi, along);
      paths_.launch(ray, along, eye.medium_beyond(i, s.wi), eye.state_at(i).time);
      auto &path = paths_.state(ray), &from = eye.state_at(i);
      const auto rays = static_cast<float>(rays_);
      path.throughput = from.throughput * s.weight / rays;
      path.eta_scale = from.eta_scale * sqr(s.eta) * rays;  // roulette takes the rays for one
      path.from = eye.point(i).position;
      path.all_specular = false;
      if constexpr (M::kClasses) {
        paths_.shares().take_over(ray, eye.shares(), eye.path_at(i));
        scatter_wide(eye.bsdf(i), eye.wo(i), s, ray);
      }
    }
  }

  bool take_wide(const PathWavefront& eye, int i, LobeSample<Color>& s) const {
    if (s.delta) return false;
    const Bsdf<M>& bsdf = eye.bsdf(i);
    if (split().has_near_specular_gloss(bsdf))
      s.weight *= ratio(bsdf.eval_component(ScatterType::diffuse, eye.wo(i), s.wi), bsdf.eval(eye.wo(i), s.wi));
    return !is_black(s.weight);
  }

  void scatter_wide(const Bsdf<M>& bsdf, const Vec3& wo, const LobeSample<Color>& s, int ray) {
    if (split().has_near_specular_gloss(bsdf))
      paths_.shares().scatter_by(ray, transport::Event::diffuse);
    else
      paths_.shares().scatter(ray, bsdf, wo, s);
  }

  void look_up(int before) {
    using namespace transport;
    const int longest = global_.view.longest;
    if (longest > 0 && before + paths_.length() >= longest) return;
    bool any = false;
    for (int i = 0; i < paths_.hit_count(); ++i) {
      const float length = glm::distance(paths_.state_at(i).from, paths_.point(i).position);
      any |= near_by_[static_cast<size_t>(i)] = length < near_;
    }
    const auto is_near = [this](int i) { return near_by_[static_cast<size_t>(i)]; };
    if (any) {
      add_light_by_parts(paths_, split(), LitParts::rough, is_near);
      add_caustics(paths_, before, is_near);
    }
    add_nearest_photons(paths_, global_.view, global_.nearest, before, [&](int i) { return !is_near(i); });
    const TakeNearSpecular narrow{split()};
    sample_bsdf(paths_, 1, TransportMode::radiance, [&](PathWavefront& paths, int i, LobeSample<Color>& s) {
      return is_near(i) ? TakeAll()(paths, i, s) : narrow(paths, i, s);
    });
  }

  Source global_, caustics_;
  int rays_ = 1;
  float near_ = 0;
  uint64_t rays_traced_ = 0;
  bool given_up_ = false;
  PathWavefront paths_;
  std::array<uint8_t, PathWavefront::kCapacity> origins_;  // by ray: the camera's arrival that it left
  std::array<bool, PathWavefront::kHitsAtATime> near_by_{};
};

}  // namespace etendue::integrator
