// Estimators for paths from the lights: connections to the camera and hits of the lens.
//                                                             [Lang, sec. 9.2.2, Remarks 9.10, 9.11; Dutré et al. 1993]
//
// The contribution of a connection of a vertex x to the camera is
//
//    flux f*(x) |cos| V d(raster) / d(area across the ray)
//
// averaged over as many light paths as the image has pixels. Every function takes a function that returns a weight, for
// integrators that find the same paths by other techniques as well. Weights of connections may be ConnectionWeights.
#pragma once
#include "integrator/shared/light_subpaths.h"
#include "integrator/shared/splatter.h"

namespace etendue::integrator {

inline Ray ray_to(const scene::SurfacePoint& point, const Vec3& wi, float distance) {
  Ray ray;
  point.spawn_segment(wi, distance, ray);
  return ray;
}

// Connects the start of a light path to the camera: the directly visible light of surfaces, environments and media.
// Lights without extent contribute nothing. weight_of(density, wi, distance) receives the density of the light's point
// as sampled from the camera, in pixels per area of the light (infinite lights: per solid angle), and the direction and
// distance to the camera.
template <class M, class Weight>
void connect_light_to_camera(const RenderContext& context, const typename LightSubpaths<M>::Start& start, Vec2 lens,
                             uint32_t seed, Splatter& splatter, Weight&& weight_of) {
  const Emission& e = start.emission;
  if (e.density.delta || !(e.density.first > 0) || is_black(start.emitted)) return;
  if constexpr (M::kClasses)
    if (!context.model->paths->matches("EL")) return;
  if (e.density.infinite) {
    const EnvironmentMap& map = context.scene->lights().environment();
    if (!map.visible()) return;
    const auto view = context.camera->view_direction(-e.direction, lens, e.time);
    if (!view || !splatter.reaches(view->raster)) return;
    const auto weight = weight_of(view->importance, e.direction, kInfinity);
    const float value = view->importance / e.density.first * transport::known_factor(weight);
    const auto seen = map.shows_backdrop() ? typename M::Color(map.seen_radiance(-e.direction)) : start.emitted;
    return splatter.connect(start.path, view->ray, e.time, seed, medium_at_camera<M>(context, view->ray, e.time),
                            kInfinity, view->raster, seen * value, weight);
  }
  const auto view = context.camera->view(e.position, lens, e.time);
  if (!view || !splatter.reaches(view->raster)) return;
  if (e.kind == LightKind::medium) {
    scene::SurfacePoint at;
    at.position = e.position;
    const auto weight = weight_of(view->importance, view->wi, view->distance);
    const float value = view->importance / e.density.first * transport::known_factor(weight);
    return splatter.connect(start.path, ray_to(at, view->wi, view->distance), e.time, seed,
                            start.medium_beyond(view->wi), view->distance, view->raster, start.emitted * value, weight);
  }
  const scene::SurfacePoint& point = *start.point;
  const float facing = glm::dot(point.front ? point.ng : -point.ng, view->wi);
  // A double-sided emitter emits from the other side as well.
  const float cosine = point.material->description.double_sided ? std::abs(facing) : facing;
  if (!(cosine > 0)) return;
  const float density = cosine * view->importance, beam = point.beam(view->wi);
  const auto weight = weight_of(density, view->wi, view->distance);
  splatter.connect(start.path, ray_to(point, view->wi, view->distance), e.time, seed, start.medium_beyond(view->wi),
                   view->distance, view->raster,
                   start.emitted * (beam * density / e.density.first * transport::known_factor(weight)), weight);
}

// Connects the selected current vertices to the camera; weight_of(hit, view).
template <class M, class Weight, class Selected = transport::EveryHit>
void connect_to_camera(const RenderContext& context, const LightSubpaths<M>& subpaths,
                       transport::PathWavefront<M>& paths, Splatter& splatter, Weight&& weight_of,
                       const Selected& selected = {}) {
  const bool lens = context.camera->has_lens();
  if (lens) paths.draw(dimensions(vertex_dimension::kLightPoint, 2));
  for (int i = 0; i < paths.hit_count(); ++i) {
    if (!selected(i)) continue;
    const scene::SurfacePoint& point = paths.point(i);
    const Bsdf<M>& bsdf = paths.bsdf(i);
    if (!bsdf.has_non_delta_lobe()) continue;
    const int path = paths.path_at(i);
    const auto& state = paths.state(path);
    const Vec2 on_lens = lens ? paths.random_2d(vertex_dimension::kLightPoint, i) : Vec2(0);
    const auto view = context.camera->view(point.position, on_lens, state.time);
    if (!view || !splatter.reaches(view->raster)) continue;
    auto f_cos = bsdf.evaluate(paths.wo(i), view->wi, TransportMode::importance).f_cos;
    if constexpr (M::kClasses) f_cos = paths.shares().connection_value(path, bsdf, paths.wo(i), view->wi, f_cos);
    if (is_black(f_cos)) continue;
    const auto weight = weight_of(i, *view);
    const float factor = transport::known_factor(weight);
    if (factor == 0) continue;
    const uint32_t seed = paths.opacity_seed(path) + static_cast<uint32_t>(paths.length());
    splatter.connect(path, ray_to(point, view->wi, view->distance), state.time, seed, paths.medium_beyond(i, view->wi),
                     view->distance, view->raster,
                     state.throughput * f_cos * (subpaths.flux(path) * view->importance * factor), weight);
  }
}

// Adds the contribution of a segment that hits the lens; weight_of(path, lens_hit, survival), where `survival` is the
// probability that a free flight reaches the lens.
template <class M, class Weight>
void add_lens_hit(const RenderContext& context, const LightSubpaths<M>& subpaths, transport::PathWavefront<M>& paths,
                  int path, const Vec3& direction, float length, Splatter& splatter, Weight&& weight_of) {
  const auto& state = paths.state(path);
  Ray ray;
  ray.origin = state.from;
  ray.direction = direction;
  const auto hit = context.camera->intersect_lens(ray, length, state.time);
  if (!hit || !splatter.reaches(hit->raster)) return;
  const auto at_lens = paths.point_on_segment(path, hit->distance);
  auto contribution =
      transport::terminal_throughput(paths, at_lens.throughput, path) * (subpaths.flux(path) * hit->importance);
  if (paths.length() == 1) contribution *= paths.scene().lights().range_window(subpaths.light(path), hit->distance);
  const uint32_t seed = paths.opacity_seed(path) + static_cast<uint32_t>(paths.length());
  splatter.add(path, hit->raster, seed, contribution * weight_of(path, *hit, at_lens.survival));
}

// Lens hits of all traced segments: of those that left the scene, and of those that end at the current vertices. To be
// called before the vertices are processed further.
template <class M, class Weight>
void add_lens_hits_of_misses(const RenderContext& context, const LightSubpaths<M>& subpaths,
                             transport::PathWavefront<M>& paths, Splatter& splatter, Weight&& weight_of) {
  for (int i = 0; i < paths.miss_count(); ++i)
    add_lens_hit(context, subpaths, paths, paths.path_of_miss(i), paths.miss_direction(i), kInfinity, splatter,
                 weight_of);
}
template <class M, class Weight>
void add_lens_hits_of_segments(const RenderContext& context, const LightSubpaths<M>& subpaths,
                               transport::PathWavefront<M>& paths, Splatter& splatter, Weight&& weight_of) {
  for (int i = 0; i < paths.hit_count(); ++i)
    add_lens_hit(context, subpaths, paths, paths.path_at(i), -paths.wo(i),
                 glm::distance(paths.state_at(i).from, paths.point(i).position), splatter, weight_of);
}

}  // namespace etendue::integrator
