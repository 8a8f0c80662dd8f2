// What methods that shoot from the lights do at the vertices of their walks: bringing them to the camera.
//                                             thesis 9.2.2, Remarks 9.10, 9.11; digest 8-10: S19, S20
//
// The value of a connection is
//
//   flux f*(x) |cos| V d(raster) / d(area across the ray)         mean over as many walks as there are pixels
//
// Each takes a function that says how much of it counts, for methods that find the same paths in other ways too.
#pragma once
#include "integrator/shared/light_subpaths.h"
#include "integrator/shared/splatter.h"

namespace etendue::integrator {

inline Ray ray_to(const scene::SurfacePoint& point, const Vec3& wi, float distance) {
  Ray ray;
  point.spawn_segment(wi, distance, ray);
  return ray;
}

// The light itself in view, where the walk starts. A point has no area to be seen. weigh(pixels, wi, distance) gets
// the density of the light's point as a camera walk finds it, in pixels to an area of the light or to a solid angle,
// and the direction to the camera.
template <class M, class Weigh>
void see_light(const RenderContext& context, const typename LightSubpaths<M>::Start& start, Vec2 lens, uint32_t seed,
               Splatter& splatter, Weigh&& weigh) {
  const Emission& e = start.emission;
  if (e.density.delta || !(e.density.first > 0) || is_black(start.emitted)) return;
  if constexpr (M::kClasses)
    if (!context.model->paths->matches("EL")) return;
  if (e.density.infinite) {
    if (!context.scene->lights().environment().visible()) return;
    const auto view = context.camera->view_direction(-e.direction, lens, e.time);
    if (!view || !splatter.reaches(view->raster)) return;
    const float value = view->importance / e.density.first * weigh(view->importance, e.direction, kInfinity);
    return splatter.connect(start.path, view->ray, e.time, seed, transport::MediumState<M>(), kInfinity, view->raster,
                            start.emitted * value);
  }
  const auto view = context.camera->view(e.position, lens, e.time);
  if (!view || !splatter.reaches(view->raster)) return;
  const scene::SurfacePoint& point = *start.point;
  const float facing = glm::dot(point.front ? point.ng : -point.ng, view->wi);
  // Whichever side the walk left by, the other one shines as well.
  const float cosine = point.material->description.double_sided ? std::abs(facing) : facing;
  if (!(cosine > 0)) return;
  const float density = cosine * view->importance, beam = point.beam(view->wi);
  splatter.connect(start.path, ray_to(point, view->wi, view->distance), e.time, seed, start.medium_beyond(view->wi),
                   view->distance, view->raster,
                   start.emitted * (beam * density / e.density.first * weigh(density, view->wi, view->distance)));
}

// Connects those of the present vertices that are wanted; weigh(arrival, view).
template <class M, class Weigh, class Selected = transport::EveryHit>
void connect_to_camera(const RenderContext& context, const LightSubpaths<M>& walks, transport::PathWavefront<M>& paths,
                       Splatter& splatter, Weigh&& weigh, const Selected& selected = {}) {
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
    if constexpr (M::kClasses) f_cos = paths.shares().of_connection(path, bsdf, paths.wo(i), view->wi, f_cos);
    if (is_black(f_cos)) continue;
    const float weight = weigh(i, *view);
    if (weight == 0) continue;
    const uint32_t seed = paths.opacity_seed(path) + static_cast<uint32_t>(paths.length());
    splatter.connect(path, ray_to(point, view->wi, view->distance), state.time, seed, paths.medium_beyond(i, view->wi),
                     view->distance, view->raster,
                     state.throughput * f_cos * (walks.flux(path) * view->importance * weight));
  }
}

// The last segment of a walk may lead through the lens; weigh(path, arrival).
template <class M, class Weigh>
void fall_onto_lens(const RenderContext& context, const LightSubpaths<M>& walks, transport::PathWavefront<M>& paths,
                    int path, const Vec3& direction, float length, Splatter& splatter, Weigh&& weigh) {
  const auto& state = paths.state(path);
  Ray ray;
  ray.origin = state.from, ray.direction = direction;
  const auto hit = context.camera->intersect_lens(ray, length, state.time);
  if (!hit || !splatter.reaches(hit->raster)) return;
  const auto throughput = paths.throughput_after(path, hit->distance);
  auto carried = transport::admitted(paths, throughput, path) * (walks.flux(path) * hit->importance);
  if (paths.length() == 1) carried *= paths.scene().lights().range_window(walks.light(path), hit->distance);
  const uint32_t seed = paths.opacity_seed(path) + static_cast<uint32_t>(paths.length());
  splatter.add(path, hit->raster, seed, carried * weigh(path, *hit));
}

// The same for all walks that were traced: before anything else is done with the vertices that were reached.
template <class M, class Weigh>
void escape_through_lens(const RenderContext& context, const LightSubpaths<M>& walks,
                         transport::PathWavefront<M>& paths, Splatter& splatter, Weigh&& weigh) {
  for (int i = 0; i < paths.miss_count(); ++i)
    fall_onto_lens(context, walks, paths, paths.path_of_miss(i), paths.miss_direction(i), kInfinity, splatter, weigh);
}
template <class M, class Weigh>
void pass_through_lens(const RenderContext& context, const LightSubpaths<M>& walks, transport::PathWavefront<M>& paths,
                       Splatter& splatter, Weigh&& weigh) {
  for (int i = 0; i < paths.hit_count(); ++i)
    fall_onto_lens(context, walks, paths, paths.path_at(i), -paths.wo(i),
                   glm::distance(paths.state_at(i).from, paths.point(i).position), splatter, weigh);
}

}  // namespace etendue::integrator
