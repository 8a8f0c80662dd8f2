// Virtual point lights: the vertices of a few light paths.    [Lang, sec. 9.6, eq. 9.148-9.158, corrected; Keller 1997]
//
// With y_1, y_2, ... the vertices after that on the light, each light path creates a virtual light at every y_j that is
// not purely specular. The incident flux at y_j is
//
//   Phi_j = L_e / (p_A(y_0) p(y_0 -> y_1)) prod over i < j of f_s(y_i) cos / p(y_i -> y_i+1)
//
// divided by the number of light paths, and its contribution to z is Phi_j f_s(y_j) G(y_j, z) f_s(z). A Lambertian
// virtual light instead emits uniformly the flux that one sampled direction scatters, which estimates the albedo.
//
// Collisions in media become virtual lights that scatter by the phase function, whose cosine is 1.
#pragma once
#include "integrator/shared/light_subpaths.h"
#include "integrator/shared/random_subset.h"
#include "transport/path_expression/join_weights.h"

namespace etendue::integrator {

struct VirtualLight {
  scene::SurfacePoint point;
  Vec3 wo{0};      // toward the previous vertex
  Rgb power{0};    // incident flux; Lambertian: emitted flux
  float side = 1;  // of the normal to which a Lambertian light emits
  int length = 1;  // edges to the light
  uint32_t subset = 0;
  uint8_t state = 0;  // of the path class automaton: before scattering at this vertex; Lambertian: after it
  const PhaseFunction* phase = nullptr;  // of a light in a medium

  // The cosine to the geometric normal; 1 in media.
  float cosine(const Vec3& w) const { return phase ? 1 : glm::dot(point.ng, w); }
};

// A path through a dense medium has hundreds of collisions: the mean number of virtual lights of a light path is at
// most this.
inline constexpr size_t kMostVirtualLightsPerPath = 16;

struct VirtualLightPlan {
  int paths = 1;    // a multiple of subsets
  int subsets = 1;  // path k belongs to subset k modulo their number and is one of paths / subsets
  bool lambertian = true;
  int max_length = 0;  // edges to the light; 0: no limit
  static constexpr int kTask = 64;
  int tasks() const { return (paths + kTask - 1) / kTask; }

  friend bool operator==(const VirtualLightPlan&, const VirtualLightPlan&) = default;
};

// Creates a virtual light at every hit, with the incident flux, or the flux scattered by a BSDF sample.
template <class M>
class VirtualLightRecorder {
 public:
  using Color = typename M::Color;
  using PathWavefront = transport::PathWavefront<M>;

  VirtualLightRecorder(const VirtualLightPlan& plan, const LightSubpaths<M>& subpaths, int first,
                       std::vector<VirtualLight>& lights)
      : plan_(plan), subpaths_(subpaths), first_(first), lights_(lights) {}

  void add_hits(PathWavefront& paths) {
    for (int i = 0; i < paths.hit_count(); ++i)
      if (paths.bsdf(i).has_non_delta_lobe()) add(paths, i, Color(1), 1);
  }

  // The filter of BSDF samples for Lambertian virtual lights.
  bool operator()(PathWavefront& paths, int hit, LobeSample<Color>& s) const {
    const bool accepted = transport::AcceptAll()(paths, hit, s);
    if (accepted && !s.delta) add(paths, hit, s.weight, glm::dot(paths.point(hit).ng, s.wi) < 0 ? -1.0f : 1.0f);
    return accepted;
  }

 private:
  void add(PathWavefront& paths, int hit, const Color& scattered, float side) const {
    const int path = paths.path_at(hit);
    VirtualLight light;
    light.point = paths.point(hit);
    light.wo = paths.wo(hit);
    light.side = side;
    const float subset_size = static_cast<float>(plan_.paths) / static_cast<float>(plan_.subsets);
    light.power = paths.state(path).throughput * scattered * (subpaths_.flux(path) / subset_size);
    light.length = paths.length();
    if constexpr (M::kScattering) light.phase = paths.collision(hit).phase;
    light.subset = static_cast<uint32_t>((first_ + path) % plan_.subsets);
    if constexpr (M::kClasses) {
      const auto drawn = transport::draw_state(paths.shares(), path, paths.random(vertex_dimension::kLightChoice, hit));
      light.power *= drawn.weight;
      light.state = drawn.state;
    }
    if (!is_black(light.power)) lights_.push_back(light);
  }

  const VirtualLightPlan& plan_;
  const LightSubpaths<M>& subpaths_;
  int first_;
  std::vector<VirtualLight>& lights_;
};

// Creates the virtual lights of one task of a sample. Returns the number of rays, or nothing if it was cancelled.
template <class M>
std::optional<uint64_t> make_virtual_lights(const RenderContext& context, uint32_t sample, const VirtualLightPlan& plan,
                                            int task, const TaskContext& task_context,
                                            std::vector<VirtualLight>& lights) {
  using namespace transport;
  static thread_local const auto subpaths = std::make_unique<LightSubpaths<M>>();
  PathWavefront<M>& paths = thread_wavefront<M>();
  lights.clear();
  const int first = task * VirtualLightPlan::kTask;
  subpaths->launch(
      context, sample, std::min(VirtualLightPlan::kTask, plan.paths - first), task_context, paths,
      [&](int i) { return static_cast<uint32_t>(first + i); }, [](auto&&...) { return true; },
      LightPathStarts::anywhere);
  VirtualLightRecorder<M> recorder(plan, *subpaths, first, lights);
  while (paths.trace())
    while (paths.next_hits()) {
      if (paths.length() == 1) subpaths->apply_range_window(paths);
      if (plan.max_length > 0 && paths.length() > plan.max_length) continue;
      if constexpr (M::kClasses) paths.draw(dimensions(vertex_dimension::kLightChoice, 1));
      if (plan.lambertian) {
        sample_bsdf(paths, 1, TransportMode::importance, recorder);
      } else {
        recorder.add_hits(paths);
        sample_bsdf(paths, 1, TransportMode::importance);
      }
    }
  if (paths.cancelled()) return {};
  if constexpr (M::kScattering)
    thin_randomly(lights, kMostVirtualLightsPerPath * VirtualLightPlan::kTask,
                  hash_combine(light_path_seed(context.seed, static_cast<uint32_t>(first), sample % film::kHalfBuffers),
                               sample / film::kHalfBuffers),
                  [](VirtualLight& light, float factor) { light.power *= factor; });
  return paths.rays_traced();
}

}  // namespace etendue::integrator
