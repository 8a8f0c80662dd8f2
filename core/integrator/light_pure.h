// Pure light tracing.                                              thesis 9.2.1, (9.33)-(9.35), errata E7, E18, E19
//
// A random walk from a light that counts when it falls onto the lens of the camera: the dual of pure path tracing. All
// pixels are made of the same walks. Scattering is the adjoint one: power is not compressed by refraction.
#pragma once
#include "integrator/shooting.h"

namespace etendue::integrator {

class LightPure final : public Shooting<LightPure> {
 public:
  static constexpr Description kDescription{
      "light-pure",
      "Pure light tracing",
      "Random walks from the lights that count when they fall onto the lens",
      "E(D|G|S)*L",
      "E.*L",
      Bias::unbiased,
      "1 ray per vertex; a picture beside the film",
      "the lens is small: noise grows as one over its area; through a pinhole or in a parallel projection: never",
      Sampling::only_splats};

  Number<int> roulette_start{
      "roulette-start", "Roulette from vertex", 4, {1, 64}, "Earlier ends more paths: faster, noisier"};

  auto knobs() { return std::tie(max_depth, roulette_start); }

  template <class M>
  void see_light(const Pass&, const typename LightWalks<M>::Start&, Vec2, uint32_t, Splatter&) const {}

  template <class M>
  void estimate(const Pass& pass, LightWalks<M>& walks, transport::Front<M>& front, Splatter& splatter) const {
    using namespace transport;
    while (front.advance()) {
      for (int i = 0; i < front.escaped(); ++i)
        arrive(pass, walks, front, front.path_of_escape(i), front.escape_direction(i), kInfinity, splatter);
      while (front.arrive()) {
        for (int i = 0; i < front.arrived(); ++i)
          arrive(pass, walks, front, front.path_at(i), -front.wo(i),
                 glm::distance(front.state_at(i).from, front.point(i).position), splatter);
        if (at_limit(front.length())) continue;
        if (front.length() == 1) walks.dim_first_vertices(front);
        scatter(front, roulette_start, Transport::importance);
      }
    }
  }

 private:
  // The last segment of a walk may lead through the lens.
  template <class M>
  static void arrive(const Pass& pass, const LightWalks<M>& walks, transport::Front<M>& front, int path,
                     const Vec3& direction, float length, Splatter& splatter) {
    auto& state = front.state(path);
    Ray ray;
    ray.origin = state.from, ray.direction = direction;
    const auto arrival = pass.camera->arrival(ray, length, state.time);
    if (!arrival) return;
    const auto to = splatter.pixel(arrival->raster, state.seed ^ static_cast<uint32_t>(front.length()));
    if (!to) return;
    typename M::Color carried = transport::admitted(front, state, path) * (walks.flux(path) * arrival->importance);
    if (front.length() == 1) carried *= front.scene().lights().window(walks.light(path), arrival->distance);
    splatter.add(*to, carried);
  }
};

}  // namespace etendue::integrator
