// Final gathering: indirect light between rough surfaces, estimated from photons at the ends of gather rays.
//                                                                                      [Lang, Remark 9.34; Jensen 2001]
//
// Gather rays are sampled from the rough lobes and continue by near-specular lobes. They do not count light that they
// hit. At a collision in a medium they end: direct light is sampled there, the other light comes from volume photons.
#pragma once
#include "integrator/photon/photon_lookup.h"
#include "integrator/shared/camera_paths.h"

namespace etendue::integrator {

template <class M>
class FinalGather {
 public:
  using Color = typename M::Color;
  using PathWavefront = transport::PathWavefront<M>;

  // A map and its lookup parameters; a null map is empty.
  struct MapLookup {
    PhotonView view;
    NearestPhotons nearest;
  };

  // `rays` is the number of gather rays from each vertex; at rays shorter than `near` gathering is repeated.
  void begin(const MapLookup& global, const MapLookup& caustics, int rays, float near) {
    global_ = global;
    caustics_ = caustics;
    rays_ = rays;
    near_ = near;
    rays_traced_ = 0;
    cancelled_ = false;
  }
  bool cancelled() const { return cancelled_; }
  uint64_t rays_traced() const { return rays_traced_; }

  // Adds the caustics that the current hits reflect.
  template <class Selected = transport::EveryHit>
  void add_caustics(PathWavefront& paths, int before = 0, const Selected& selected = {}) const {
    if (caustics_.view.map) add_nearest_photons(paths, caustics_.view, caustics_.nearest, before, selected);
  }

  // Adds the light that the current collisions scatter, except for direct light.
  void add_volume_photons(PathWavefront& paths, ShallowCollisions<M>& shallow) const {
    add_nearest_volume_photons(paths, global_.view, global_.nearest, 0, shallow);
  }

  // Adds the indirect light from rough surfaces that the current hits of the camera paths reflect.
  void gather(const RenderContext& context, const TaskContext& task_context, PathWavefront& camera_paths) {
    begin_rays(context, task_context, camera_paths);
    for (int i = 0; i < camera_paths.hit_count(); ++i) {
      if (camera_paths.in_volume(i) || !split().has_rough(camera_paths.bsdf(i))) continue;
      for (int k = 0; k < rays_; ++k) {
        const auto number = static_cast<uint32_t>(camera_paths.length() * rays_ + k);
        origins_[static_cast<size_t>(paths_.size())] = static_cast<uint8_t>(i);
        paths_.add(hash_combine(camera_paths.state_at(i).seed, number));
        if (paths_.size() == PathWavefront::kCapacity) {
          trace(task_context, camera_paths);
          begin_rays(context, task_context, camera_paths);
        }
      }
    }
    if (paths_.size() > 0) trace(task_context, camera_paths);
  }

 private:
  static constexpr int kLobe = 2;  // dimension of the lobe choice, after those of the direction

  const transport::LobeSplit& split() const { return global_.view.split; }

  void begin_rays(const RenderContext& context, const TaskContext& task_context, const PathWavefront& camera_paths) {
    paths_.begin(*context.scene, *context.sampler, camera_paths.sample(), task_context.keep_going,
                 context.model->moving);
    if constexpr (M::kClasses) paths_.filter_paths(context.model->paths->automaton());
  }

  void trace(const TaskContext& task_context, PathWavefront& camera_paths) {
    launch(camera_paths);
    while (!cancelled_ && paths_.trace())
      while (!cancelled_ && paths_.next_hits()) {
        look_up_photons(camera_paths.length());
        cancelled_ = !should_continue(task_context);
      }
    cancelled_ = cancelled_ || paths_.cancelled();
    rays_traced_ += paths_.rays_traced();
    for (int i = 0; i < paths_.size(); ++i) camera_paths.state_at(origin(i)).radiance += paths_.state(i).radiance;
  }

  int origin(int ray) const { return origins_[static_cast<size_t>(ray)]; }

  void launch(PathWavefront& camera_paths) {
    const SampleTable& random = paths_.draw_start(dimensions(0, kLobe + 1));
    for (int ray = 0; ray < paths_.size(); ++ray) {
      const int i = origin(ray);
      const auto at = [&](int dimension) {
        return random.values[static_cast<size_t>(dimension)][static_cast<size_t>(ray)];
      };
      paths_.state(ray).radiance = Color(0);
      LobeSample<Color> s;
      if (!camera_paths.bsdf(i).sample(camera_paths.wo(i), LobeRandom(at(kLobe), {at(0), at(1)}),
                                       TransportMode::radiance, s))
        continue;
      if (!accept_rough(camera_paths, i, s)) continue;
      Ray ray_along;
      camera_paths.point(i).spawn(s.wi, ray_along);
      paths_.launch(ray, ray_along, camera_paths.medium_beyond(i, s.wi), camera_paths.state_at(i).time);
      auto &path = paths_.state(ray), &from = camera_paths.state_at(i);
      const auto rays = static_cast<float>(rays_);
      path.throughput = from.throughput * s.weight / rays;
      path.eta_scale = from.eta_scale * sqr(s.eta) * rays;  // Russian roulette ignores the division by `rays`
      path.from = camera_paths.point(i).position;
      path.all_specular = false;
      if constexpr (M::kClasses) {
        paths_.shares().copy_from(ray, camera_paths.shares(), camera_paths.path_at(i));
        scatter_rough(camera_paths.bsdf(i), camera_paths.wo(i), s, ray);
      }
    }
  }

  bool accept_rough(const PathWavefront& camera_paths, int i, LobeSample<Color>& s) const {
    if (s.delta) return false;
    const Bsdf<M>& bsdf = camera_paths.bsdf(i);
    if (split().has_near_specular_gloss(bsdf))
      s.weight *= ratio(bsdf.eval_component(ScatterType::diffuse, camera_paths.wo(i), s.wi),
                        bsdf.eval(camera_paths.wo(i), s.wi));
    return !is_black(s.weight);
  }

  void scatter_rough(const Bsdf<M>& bsdf, const Vec3& wo, const LobeSample<Color>& s, int ray) {
    if (split().has_near_specular_gloss(bsdf))
      paths_.shares().scatter_by(ray, transport::Event::diffuse);
    else
      paths_.shares().scatter(ray, bsdf, wo, s);
  }

  void look_up_photons(int before) {
    using namespace transport;
    const int max_length = global_.view.max_length;
    if (max_length > 0 && before + paths_.length() >= max_length) return;
    bool any = false;
    for (int i = 0; i < paths_.hit_count(); ++i) {
      const float length = glm::distance(paths_.state_at(i).from, paths_.point(i).position);
      is_near_[static_cast<size_t>(i)] = length < near_ && !paths_.in_volume(i);
      any |= length < near_ || paths_.in_volume(i);
    }
    const auto is_near = [this](int i) { return is_near_[static_cast<size_t>(i)]; };
    if (any) {
      add_direct_light_by_lobe(paths_, split(), LitLobes::rough,
                               [&](int i) { return is_near(i) || paths_.in_volume(i); });
      add_caustics(paths_, before, is_near);
    }
    add_nearest_photons(paths_, global_.view, global_.nearest, before, [&](int i) { return !is_near(i); });
    add_nearest_volume_photons(paths_, global_.view, global_.nearest, before, NeverShallow());
    const AcceptNearSpecular near_specular{split()};
    sample_bsdf_where(
        paths_, 1, TransportMode::radiance,
        [&](int i) { return is_near(i) || split().template may_have_near_specular<M>(paths_.bsdf(i)); },
        [](int, const auto&) {},
        [&](PathWavefront& paths, int i, LobeSample<Color>& s) {
          return is_near(i) ? AcceptAll()(paths, i, s) : near_specular(paths, i, s);
        });
  }

  MapLookup global_, caustics_;
  int rays_ = 1;
  float near_ = 0;
  uint64_t rays_traced_ = 0;
  bool cancelled_ = false;
  PathWavefront paths_;
  std::array<uint8_t, PathWavefront::kCapacity> origins_;  // by ray: the hit of the camera paths from which it starts
  std::array<bool, PathWavefront::kHitsAtATime> is_near_{};
};

}  // namespace etendue::integrator
