// Light tracing with next event estimation: contribution rays.   thesis 9.2.2, Remarks 9.10, 9.11; digest 8-10: S20
//
// At every vertex of a random walk from a light the camera is connected: the dual of path tracing. The value of a
// connection is
//
//   flux f*(x) |cos| V d(raster) / d(area across the ray)         mean over as many walks as there are pixels
//
// Accidental hits of the lens are not counted besides.
#pragma once
#include "integrator/shooting.h"

namespace etendue::integrator {

class Light final : public Shooting<Light> {
 public:
  static constexpr Description kDescription{
      "light",
      "Light tracing",
      "Random walks from the lights, each vertex of which is connected to the camera",
      "E[(D|G).*]L",
      "E(D|G).*L",
      Bias::unbiased,
      "2 rays per vertex; a picture beside the film",
      "what the camera sees in mirrors and through glass: black; views of a small part of what is lit: few walks come "
      "by",
      Sampling::only_splats};

  Number<int> roulette_start{
      "roulette-start", "Roulette from vertex", 4, {1, 64}, "Earlier ends more paths: faster, noisier"};

  auto knobs() { return std::tie(max_depth, roulette_start); }

  // The light itself in view. A point has no area to be seen.
  template <class M>
  void see_light(const Pass& pass, const typename LightWalks<M>::Start& start, Vec2 lens, uint32_t seed,
                 Splatter& splatter) const {
    using namespace transport;
    const Emission& e = start.emission;
    if (e.density.delta || !(e.density.first > 0)) return;
    if constexpr (M::kClasses)
      if (!pass.model->paths->matches("EL")) return;
    if (e.density.infinite) return see_infinity<M>(pass, start, lens, seed, splatter);
    const auto view = pass.camera->view(e.position, lens, e.time);
    if (!view) return;
    const float cosine = glm::dot(start.point.front ? start.point.ng : -start.point.ng, view->wi);
    const auto to = cosine > 0 ? splatter.pixel(view->raster, seed) : std::nullopt;
    if (!to) return;
    Ray ray;
    start.point.spawn_segment(view->wi, view->distance, ray);
    const auto through = transmittance<M>(start.point, view->wi, view->distance);
    splatter.connect(ray, e.time, seed, *to, start.emitted * through * (cosine * view->importance / e.density.first));
  }

  template <class M>
  void estimate(const Pass& pass, LightWalks<M>& walks, transport::Front<M>& front, Splatter& splatter) const {
    using namespace transport;
    while (front.advance())
      while (front.arrive()) {
        if (front.length() == 1) walks.dim_first_vertices(front);
        if (at_limit(front.length())) continue;
        connect_to_camera(pass, walks, front, splatter);
        scatter(front, roulette_start, Transport::importance);
      }
  }

 private:
  template <class M>
  static void see_infinity(const Pass& pass, const typename LightWalks<M>::Start& start, Vec2 lens, uint32_t seed,
                           Splatter& splatter) {
    if (!pass.scene->lights().environment().visible()) return;
    const Emission& e = start.emission;
    const auto view = pass.camera->view_of_infinity(-e.direction, lens, e.time);
    const auto to = view ? splatter.pixel(view->raster, seed) : std::nullopt;
    if (to) splatter.connect(view->ray, e.time, seed, *to, start.emitted * (view->importance / e.density.first));
  }

  template <class M>
  static void connect_to_camera(const Pass& pass, const LightWalks<M>& walks, transport::Front<M>& front,
                                Splatter& splatter) {
    using namespace transport;
    const bool lens = pass.camera->has_lens();
    if (lens) front.draw(dimensions(vertex_dimension::kLightPoint, 2));
    for (int i = 0; i < front.arrived(); ++i) {
      const scene::SurfacePoint& point = front.point(i);
      const Bsdf<M>& bsdf = front.bsdf(i);
      if (!bsdf.has_non_delta()) continue;
      const int path = front.path_at(i);
      auto& state = front.state(path);
      const Vec2 on_lens = lens ? front.random_2d(vertex_dimension::kLightPoint, i) : Vec2(0);
      const auto view = pass.camera->view(point.position, on_lens, state.time);
      if (!view) continue;
      const uint32_t seed = path_seed(state.seed, front.sample()) + static_cast<uint32_t>(front.length());
      const auto to = splatter.pixel(view->raster, seed);
      if (!to) continue;
      auto f_cos = bsdf.evaluate(front.wo(i), view->wi, Transport::importance).f_cos;
      if constexpr (M::kClasses) f_cos = front.shares().of_connection(path, bsdf, front.wo(i), view->wi, f_cos);
      if (is_black(f_cos)) continue;
      Ray ray;
      point.spawn_segment(view->wi, view->distance, ray);
      const auto through = transmittance<M>(point, view->wi, view->distance);
      splatter.connect(ray, state.time, seed, *to,
                       state.throughput * f_cos * through * (walks.flux(path) * view->importance));
    }
  }
};

}  // namespace etendue::integrator
