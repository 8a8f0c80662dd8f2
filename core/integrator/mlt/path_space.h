// Sampling and evaluation of light paths (light_path.h).             [Lang, sec. 8.4.3.3, 9.4.2; Veach 1997, sec. 11.2]
//
// The number of edges of a path is set first. Then its vertices are sampled by subpaths from either end, a connection
// joins them, and `evaluate` computes the quantities of the new edges. All of these functions return false if the path
// has no contribution. Stochastic opacity is decided when an edge is traced and remains valid while the edge exists.
//
// Shading normals that face away from the incoming ray are corrected (CompiledScene); a vertex keeps the normal with
// which it was traced.
//
// In scattering media, edges end at collisions or on surfaces, by free flights (transport::trace_flight).
#pragma once
#include "film/half_buffers.h"
#include "integrator/integrator.h"
#include "integrator/markov_chain/chain_random.h"
#include "integrator/mlt/light_choice.h"
#include "integrator/mlt/medium_lights.h"
#include "integrator/mlt/volume_scattering.h"
#include "integrator/shared/camera_paths.h"
#include "transport/path_expression/path_expression.h"
#include "transport/surface_bsdf.h"
#include "transport/wavefront/medium_tracing.h"

namespace etendue::integrator {

template <class M>
class PathSpace {
 public:
  using Path = LightPath<M>;
  using Vertex = PathVertex<M>;
  using Color = typename M::Color;
  using Medium = transport::MediumState<M>;

  explicit PathSpace(const RenderContext& context)
      : context_(&context),
        scene_(context.scene),
        filter_radius_(context.filter->radius()),
        extent_(Vec2(static_cast<float>(context.width), static_cast<float>(context.height)) + 2 * filter_radius_) {
    if constexpr (M::kScattering) media_share_ = share_of_media(*scene_);
    if constexpr (M::kClasses) {
      shares_.resize(automaton().size());
      next_shares_.resize(automaton().size());
    }
  }

  // The area of image points within the filter radius of a pixel, in pixels.
  float image_area() const { return extent_.x * extent_.y; }
  Vec2 image_point(Vec2 u) const { return u * extent_ - filter_radius_; }
  bool is_in_image(Vec2 raster) const {
    return raster.x >= -filter_radius_ && raster.y >= -filter_radius_ && raster.x < extent_.x - filter_radius_ &&
           raster.y < extent_.y - filter_radius_;
  }

  const CameraRays& camera() const { return *context_->camera; }
  const scene::CompiledScene& scene() const { return *scene_; }
  uint64_t take_rays() { return std::exchange(rays_, 0); }

  // The time of a path: the same at all its vertices.
  float choose_time(ChainRandom& random) const { return context_->model->moving ? random.next() : 0; }

  // ---- Subpaths from the light.

  // Samples x_0; for infinite lights, its direction. The light tree chooses the light for a receiver; without one, the light
  // is chosen by its power.
  bool sample_light(ChainRandom& random, Path& path, const LightReceiver* receiver = nullptr) {
    scene::MediumStack stack;
    const Emission e = sample_emission<M::kScattering>(*scene_, media_share_, random, path.time, stack, receiver);
    if (!(e.density.first > 0)) return false;
    if constexpr (M::kScattering)
      if (e.kind == LightKind::medium) {
        start_in_medium(e, stack, path);
        return true;
      }
    path.light.kind = e.kind;
    path.light.number = e.light;
    path.light.infinite = e.density.infinite;
    path.light.extended = !e.density.delta;
    Vertex& x = path[0];
    x.delta = false;
    if constexpr (M::kMedia) x.media.interface.clear({});
    leave_volume(x);
    if (e.kind == LightKind::triangle) {
      scene_->locate(e, x.hit, x.traced_from);
      build_surface(x, path.time);
    } else {
      x.point.position = e.position;
      x.direction = e.direction;
    }
    if constexpr (M::kMedia) {
      Ray ray;
      ray.origin = x.point.position;
      if (e.kind == LightKind::triangle) x.point.spawn(x.traced_from, ray);
      scene_->find_media_at_light(e, e.kind == LightKind::triangle ? &x.point : nullptr, ray.origin, x.media.interface);
    }
    return true;
  }

  // Samples x_1 from x_0.
  bool trace_from_light(ChainRandom& random, Path& path) {
    if (path.light.kind == LightKind::triangle && path.light.number == Path::Light::kUnlisted) return false;
    if (path.light.kind == LightKind::medium)
      return trace_from_light(path[0].point.position, square_to_sphere(random.next_2d()), random, path);
    Emission e;
    e.kind = path.light.kind;
    e.light = path.light.number;
    e.position = path[0].point.position;
    e.direction = path[0].direction;
    e.time = path.time;
    scene_->lights().resample_emission(random.next_2d(), e);
    if (e.kind != LightKind::triangle) return trace_from_light(e.position, e.direction, random, path);
    const Vec3& ng = path[0].point.ng;
    return trace_from_light(e.position, Frame(e.back ? -ng : ng).to_world(e.direction), random, path);
  }

  // Traces x_1 along a given ray.
  bool trace_from_light(const Vec3& origin, const Vec3& direction, ChainRandom& random, Path& path) {
    Ray ray;
    ray.origin = origin;
    ray.direction = direction;
    if (path.light.kind == LightKind::triangle) path[0].point.spawn(direction, ray);
    return trace_next(ray, medium_to_camera(0, direction, path), 0, random, path);
  }

  // Samples x_{i+1} from x_i, i > 0.
  bool scatter_to_camera(int i, ChainRandom& random, Path& path) {
    LobeSample<Color> s;
    Vertex& x = path[i];
    if (!sample(x, path.direction_to_light(i), TransportMode::importance, random, s)) return false;
    return trace_to_camera(i, s.wi, random, path);
  }
  bool trace_to_camera(int i, const Vec3& direction, ChainRandom& random, Path& path) {
    Ray ray;
    path[i].point.spawn(direction, ray);
    return trace_next(ray, medium_to_camera(i, direction, path), i, random, path);
  }

  // ---- Subpaths from the camera.

  // Traces x_{k-1} through this image and lens point.
  bool trace_from_camera(Vec2 raster, Vec2 lens, ChainRandom& random, Path& path) {
    path.raster = raster;
    path.lens = lens;
    const Ray ray = camera().ray(raster, lens, path.time);
    return trace_previous(ray, medium_at_camera<M>(*context_, ray, path.time), path.edges(), random, path);
  }
  // Samples x_{i-1} from x_i, 0 < i < k.
  bool scatter_to_light(int i, ChainRandom& random, Path& path) {
    LobeSample<Color> s;
    Vertex& x = path[i];
    if (!sample(x, path.direction_to_camera(i), TransportMode::radiance, random, s)) return false;
    return trace_to_light(i, s.wi, random, path);
  }
  bool trace_to_light(int i, const Vec3& direction, ChainRandom& random, Path& path) {
    Ray ray;
    path[i].point.spawn(direction, ray);
    return trace_previous(ray, medium_at(path[i], direction), i, random, path);
  }

  // Makes x_0, the end of a camera subpath, the light vertex; false if it does not emit.
  bool end_on_light(Path& path) const {
    set_light(path);
    return evaluate_light(path);
  }

  // ---- Connections.

  // Connects x_i to x_{i+1}; a connection to the lens determines the image point.
  bool connect(int i, Path& path) {
    const int last = path.edges() - 1;
    Vertex& x = path[i];
    x.delta = false;
    if (i == last) return connect_to_lens(path);
    path[i + 1].delta = false;
    if (i == 0 && path.light.infinite) {
      x.length = kInfinity;
      return connect_media(i, kInfinity, path);
    }
    const Vec3 edge = path[i + 1].point.position - x.point.position;
    x.length = std::sqrt(length_squared(edge));
    if (!(x.length > 0)) return false;
    x.direction = edge / x.length;
    return connect_media(i, x.length, path);
  }

  // Whether nothing lies between x_i and x_{i+1}.
  bool visible(int i, ChainRandom& random, Path& path) {
    Ray ray;
    float length = path[i].length;
    if (i < path.edges() - 1) {
      path[i + 1].point.spawn_segment(-path[i].direction, path[i].length, ray);
    } else if (i == 0 && path.light.infinite) {
      const auto view = camera().view_direction(-path[0].direction, path.lens, path.time);
      if (!view) return false;
      ray = view->ray;
    } else {
      const auto view = camera().view(path[i].point.position, path.lens, path.time);
      if (!view) return false;
      path[i].point.spawn_segment(view->wi, view->distance, ray);
      length = view->distance;
    }
    const uint32_t seed = random.bits();
    if constexpr (M::kScattering) {
      return pass_media(i, ray, length, seed, path);
    } else if constexpr (M::kMedia) {
      return is_transparent(i, ray, length, seed, path);
    } else {
      ++rays_;
      return !scene_->intersect(ray, seed, path.time);
    }
  }

  // ---- Evaluation.

  // The direction of a specular vertex in the other direction than `wo`; false if there is none.
  static bool specular_direction(const Vertex& x, const Vec3& wo, TransportMode mode,
                                 DeltaDirection<Color>& direction) {
    if constexpr (M::kScattering)
      return !x.media.in_volume && x.bsdf.surface().delta_direction(wo, x.transmitted, mode, direction);
    else
      return x.bsdf.delta_direction(wo, x.transmitted, mode, direction);
  }

  // Computes all data of a path that follows from its ends, edges and hits.
  bool rebuild(Path& path) {
    if (path.light.kind == LightKind::medium) place_in_medium(path[0]);
    for (int i = 0; i < path.edges(); ++i) {
      if constexpr (M::kScattering)
        if (path[i].media.in_volume) {
          build_collision(path[i], path[i].point.position);
          continue;
        }
      if (path.is_surface(i)) build_surface(path[i], path.time);
    }
    return evaluate(0, path.edges(), path);
  }

  // Evaluates vertices first .. last (surfaces; the ends are always evaluated) and the contribution of the path.
  bool evaluate(int first, int last, Path& path) {
    const int k = path.edges();
    for (int i = std::max(first, 1); i <= std::min(last, k - 1); ++i)
      if (!evaluate_vertex(i, path)) return false;
    return evaluate_light(path) && evaluate_camera(path) && evaluate_color(path);
  }

 private:
  const transport::Automaton& automaton() const { return context_->model->paths->automaton(); }

  static bool sample(Vertex& x, const Vec3& wo, TransportMode mode, ChainRandom& random, LobeSample<Color>& s) {
    const float choice = random.next();
    if (!x.bsdf.sample(wo, {choice, random.next_2d()}, mode, s)) return false;
    x.delta = s.delta;
    x.transmitted = s.transmitted;
    return true;
  }

  // Finds the surface that a ray hits if it starts in this medium state, or the collision before it. In models with
  // media, `store_segment` receives the segment.
  template <class StoreSegment>
  bool trace(const Ray& ray, const Medium& medium, float time, ChainRandom& random, Vertex& x,
             StoreSegment&& store_segment) {
    ++rays_;
    Hit hit;
    leave_volume(x);
    if constexpr (M::kScattering) {
      transport::BasicFlightSegment<Rgb> segment;
      const uint32_t seed = random.bits();
      transport::trace_flight(*scene_, ray, seed, time, medium, random.next(), segment);
      rays_ += segment.rays - 1;
      hit = segment.hit;
      x.media.interface = segment.interface;
      store_segment(segment);
      if (segment.collision.phase) {
        x.traced_from = -ray.direction;
        build_collision(x, segment.collision.position);
        x.delta = false;
        return true;
      }
    } else if constexpr (M::kMedia) {
      transport::MediumSegment segment;
      transport::trace_segment(*scene_, ray, ray.tfar, random.bits(), time, medium, segment);
      rays_ += segment.rays;
      hit = segment.hit;
      x.media.interface = segment.interface;
      store_segment(segment);
    } else {
      hit = scene_->intersect(ray, random.bits(), time);
    }
    if (!hit) return false;
    x.hit = hit;
    x.traced_from = -ray.direction;
    build_surface(x, time);
    x.delta = false;
    return true;
  }

  // The medium state of a ray that leaves a vertex in this direction.
  Medium medium_at(const Vertex& x, const Vec3& direction) const {
    if constexpr (M::kMedia)
      return x.media.interface.side(glm::dot(x.point.ng, direction) >= 0);
    else
      return {};
  }
  // The same for x_i, which may be a light. No solid contains points at infinity.
  Medium medium_to_camera(int i, const Vec3& direction, const Path& path) const {
    if (i == 0 && path.light.infinite) return {};
    return medium_at(path[i], direction);
  }

  // Sets the transmittance of a connection of `length` metres, which ends where the camera ray starts. Returns false if
  // the media at both ends differ: a boundary lies between them.
  bool connect_media(int i, float length, Path& path) const {
    if constexpr (M::kMedia) {
      const scene::Solids& solids = scene_->solids();
      Vertex& x = path[i];
      const bool from_camera = i < path.edges() - 1;
      const uint32_t medium =
          from_camera ? medium_at(path[i + 1], -x.direction).top() : medium_to_camera(i, x.direction, path).top();
      if (from_camera && !solids.segments_may_cross_media() && medium != medium_to_camera(i, x.direction, path).top())
        return false;
      if constexpr (M::kScattering) {
        x.media.transmittance = x.media.survival = Color(1);  // `visible` computes them
      } else {
        const scene::Solid* solid = solids.find(medium);
        x.media.transmittance = solid ? solid->transmittance(length) : Color(1);
      }
    }
    return true;
  }

  // The solids around the start of the ray of `visible`.
  Medium medium_of_connection(int i, const Ray& ray, const Path& path) const {
    if (i < path.edges() - 1) return medium_at(path[i + 1], -path[i].direction);
    if (i == 0 && path.light.infinite) return medium_at_camera<M>(*context_, ray, path.time);
    return medium_at(path[i], path[i].direction);
  }

  // Computes what passes a connection in scattering media; false if it is occluded.
  bool pass_media(int i, const Ray& ray, float length, uint32_t seed, Path& path) requires(M::kScattering) {
    transport::MediumSegment segment;
    transport::trace_segment(*scene_, ray, length, seed, path.time, medium_of_connection(i, ray, path), segment, {},
                             transport::MediumDetail::exact);
    rays_ += 1 + segment.rays;
    store_segment_of_edge(segment, path[i]);
    return !segment.hit && evaluate_color(path);
  }

  // Whether a connection is unoccluded. `connect_media` has set its transmittance, except where stochastic opacity may
  // let it pass boundaries of solids.
  bool is_transparent(int i, const Ray& ray, float length, uint32_t seed, Path& path) {
    const Color transmittance =
        transport::connection_passage(*scene_, ray, length, seed, path.time, medium_of_connection(i, ray, path), rays_)
            .transmittance;
    if (is_black(transmittance)) return false;
    if (!scene_->solids().segments_may_cross_media()) return true;
    path[i].media.transmittance = transmittance;
    return evaluate_color(path);
  }

  void build_surface(Vertex& x, float time) const {
    scene_->surfaces({&x.traced_from, 1}, {&x.hit, 1}, &x.point, context_->model->moving ? &time : nullptr);
    if constexpr (M::kMedia) {
      x.point.outside = scene_->solids().find(x.media.interface.top(true));
      x.point.inside = scene_->solids().find(x.media.interface.top(false));
      x.point.offset = std::max(x.point.offset, x.media.interface.offset);
    }
    transport::build_bsdf<M>(x.point, x.bsdf);
  }

  static void leave_volume([[maybe_unused]] Vertex& x) {
    if constexpr (M::kScattering) {
      x.media.in_volume = x.point.in_volume = false;
      x.media.scattering = x.media.extinction = Color(1);
    }
  }
  // Places a vertex at a collision in the medium that its interface states.
  void build_collision(Vertex& x, const Vec3& position) const requires(M::kScattering) {
    const VolumeScattering scattering = scattering_at(scene_->solids(), x.media.interface.side(true), position);
    transport::set_volume_point({position, scattering.phase, scattering.scattering}, x.traced_from, x.point);
    x.bsdf.set_volume(*scattering.phase);
    x.media.in_volume = true;
    x.media.scattering = scattering.scattering;
    x.media.extinction = scattering.extinction;
  }

  bool trace_next(const Ray& ray, const Medium& medium, int i, ChainRandom& random, Path& path) {
    const auto set = [&](const auto& segment) { store_segment_of_edge(segment, path[i]); };
    if (!trace(ray, medium, path.time, random, path[i + 1], set)) return false;
    path[i].direction = ray.direction;
    path[i].length =
        i == 0 && path.light.infinite ? kInfinity : glm::distance(path[i].point.position, path[i + 1].point.position);
    return path[i].length > 0;
  }

  bool trace_previous(const Ray& ray, const Medium& medium, int i, ChainRandom& random, Path& path) {
    Vertex& x = path[i - 1];
    x.direction = -ray.direction;
    if (trace(ray, medium, path.time, random, x, [&](const auto& segment) { store_segment_of_edge(segment, x); })) {
      x.length = glm::distance(i == path.edges() ? ray.origin : path[i].point.position, x.point.position);
      if (i == 1) set_light(path);
      return x.length > 0;
    }
    if (scene_->lights().environment().black()) return false;
    x.length = kInfinity;
    x.delta = false;
    if (i == 1) set_light(path);
    return i == 1;
  }

  template <class Segment>
  static void store_segment_of_edge(const Segment& segment, Vertex& x) {
    x.media.transmittance = segment.transmittance;
    if constexpr (M::kScattering) x.media.survival = segment.survival;
  }

  // The light is the last vertex of a camera subpath.
  void set_light(Path& path) const {
    if (std::isinf(path[0].length))
      path.light = {LightKind::environment, Path::Light::kUnlisted, true, true};
    else
      path.light = {LightKind::triangle, scene_->light_at(path[0].point), false, true};
  }

  bool connect_to_lens(Path& path) {
    const int last = path.edges() - 1;
    Vertex& x = path[last];
    if (last == 0 && path.light.infinite) {
      const auto view = camera().view_direction(-x.direction, path.lens, path.time);
      if (!view) return false;
      path.raster = view->raster;
      x.length = kInfinity;
      return is_in_image(path.raster) && connect_media(last, kInfinity, path);
    }
    const auto view = camera().view(x.point.position, path.lens, path.time);
    if (!view || !is_in_image(view->raster)) return false;
    path.raster = view->raster;
    x.direction = view->wi;
    x.length = glm::distance(camera().ray(path.raster, path.lens, path.time).origin, x.point.position);
    return x.length > 0 && connect_media(last, view->distance, path);
  }

  bool evaluate_vertex(int i, Path& path) const {
    Vertex& x = path[i];
    const Vec3 wo = path.direction_to_camera(i), wi = path.direction_to_light(i);
    Color f(0);
    if (x.delta) {
      DeltaDirection<Color> seen, sent;
      if (!specular_direction(x, wo, TransportMode::radiance, seen)) return false;
      if (!specular_direction(x, wi, TransportMode::importance, sent)) return false;
      f = seen.value;
      x.projected_ratio = x.bsdf.cosine(wo) / (x.bsdf.cosine(wi) * sqr(seen.eta));
      x.to_light = seen.probability;
      x.to_camera = sent.probability * x.projected_ratio;
    } else {
      const auto seen = x.bsdf.evaluate(wo, wi, TransportMode::radiance);
      f = seen.f_cos;
      if constexpr (M::kScattering) f *= x.media.scattering;
      x.to_light = seen.pdf;
      x.to_camera = x.bsdf.pdf(wi, wo, TransportMode::importance);
    }
    x.value = max_component(f);
    if (!(x.value > 0) || !std::isfinite(x.value) || !is_finite(f)) return false;
    x.color = f / x.value;
    return path.cosine_to_camera(i) > 0 && path.cosine_to_light(i) > 0;
  }

  bool evaluate_light(Path& path) const {
    auto& light = path.light;
    const Vec3& direction = path[0].direction;
    EmissionDensity density;
    if (light.kind == LightKind::triangle) {
      scene::SurfacePoint& point = path[0].point;
      const float cosine = glm::dot(point.ng, direction);
      point.front = cosine > 0;
      light.emitted = scene_->emitted(point, direction);
      density = scene_->lights().emission_density(light.number, cosine, path.time);
      if (cosine == 0 || !is_light_visible(path)) return false;
    } else if (light.kind == LightKind::environment) {
      const EnvironmentMap& map = scene_->lights().environment();
      const bool is_seen = path.edges() == 1;
      light.emitted = is_seen ? map.seen_radiance(-direction) : map.radiance(-direction);
      density = scene_->lights().environment_emission_density(-direction);
      if (is_seen && !map.visible()) return false;
    } else if (light.kind == LightKind::medium) {
      // Its densities are those with which it was sampled.
      light.emitted = emission_in_medium(*scene_, path[0]);
      return !is_black(light.emitted);
    } else {
      // Lights without extent are not directly visible.
      if (path.edges() == 1) return false;
      light.emitted = scene_->lights().emitted_by_placed(light.number, direction, path[0].length, path.time);
      LightSample sample;
      sample.kind = LightKind::placed;
      sample.light = light.number;
      density = scene_->lights().emission_density(sample, path.time);
    }
    light.first = density.first * (1 - media_share_);
    light.second = density.second;
    if constexpr (M::kScattering)
      if (light.infinite && scene_->atmosphere_is_unbounded()) return false;
    return !is_black(light.emitted);
  }

  // An unlit surface (KHR_materials_unlit) is directly visible but lights nothing.
  static bool is_light_visible(const Path& path) {
    if (!path[0].point.material->description.unlit) return true;
    for (int i = 1; i < path.edges(); ++i)
      if (!path[i].delta) return false;
    return true;
  }

  bool evaluate_camera(Path& path) const {
    const Vertex& x = path[path.edges() - 1];
    const bool far = std::isinf(x.length);
    path.importance =
        far && !camera().sees_environment() ? 0 : camera().pixels_per_area(-x.direction, far ? 1 : x.length, path.time);
    return far || path.importance > 0;
  }

  bool evaluate_color(Path& path) {
    Color color = path.light.emitted;
    double scale = 1;
    const auto scale_color = [&](const Color& by) {
      color *= by;
      const float largest = max_component(color);
      if (largest > 0) color /= largest;
      scale *= double{largest};
    };
    for (int i = 1; i < path.edges(); ++i) scale_color(path[i].color);
    if constexpr (M::kScattering) {
      for (int i = 0; i < path.edges(); ++i) {
        const auto value = static_cast<float>(path.edge_value(i));
        if (!(value > 0)) return false;
        scale_color(path[i].media.transmittance / value);
      }
    } else if constexpr (M::kMedia) {
      for (int i = 0; i < path.edges(); ++i) scale_color(path[i].media.transmittance);
    }
    if constexpr (M::kClasses) scale_color(class_share(path));
    const double y = luminance(color);
    path.brightness = y * scale;
    if (!(path.brightness > 0) || !std::isfinite(path.brightness)) return false;
    path.color = color / static_cast<float>(y);
    return true;
  }

  // The share of the path's contribution that belongs to the selected path classes.
  Color class_share(const Path& path) {
    using Shares = transport::ClassShares<M>;
    using transport::Event;
    using State = transport::Automaton::State;
    const transport::Automaton& classes = automaton();
    shares_.assign(classes.size(), Color(0));
    shares_[classes.next(classes.start(), Event::camera)] = Color(1);
    for (int i = path.edges() - 1; i > 0; --i) {
      const Vertex& x = path[i];
      next_shares_.assign(classes.size(), Color(0));
      if constexpr (M::kScattering)
        if (x.media.in_volume) {
          for (size_t q = 0; q < classes.size(); ++q)
            next_shares_[classes.next(static_cast<State>(q), Event::volume)] += shares_[q];
          std::swap(shares_, next_shares_);
          continue;
        }
      const auto parts = x.delta ? typename Shares::Parts{Color(0), Color(0), Color(1)}
                                 : Shares::letter_parts(x.bsdf, path.direction_to_camera(i), path.direction_to_light(i),
                                                        Event::diffuse);
      for (size_t q = 0; q < classes.size(); ++q) {
        const auto state = static_cast<State>(q);
        next_shares_[classes.next(state, Event::diffuse)] += shares_[q] * parts.diffuse;
        next_shares_[classes.next(state, Event::glossy)] += shares_[q] * parts.glossy;
        next_shares_[classes.next(state, Event::specular)] += shares_[q] * parts.specular;
      }
      std::swap(shares_, next_shares_);
    }
    Color sum(0);
    for (size_t q = 0; q < classes.size(); ++q)
      if (classes.accepts(classes.next(static_cast<State>(q), Event::light))) sum += shares_[q];
    return sum;
  }

  const RenderContext* context_;
  const scene::CompiledScene* scene_;
  float filter_radius_;
  Vec2 extent_;
  float media_share_ = 0;  // of starts in media that emit
  uint64_t rays_ = 0;
  std::vector<Color> shares_, next_shares_;  // by automaton state
};

}  // namespace etendue::integrator
