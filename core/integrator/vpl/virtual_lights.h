// Virtual point lights: the vertices of a few light paths.             thesis 9.6, (9.148)-(9.158), erratum E33; S40
//
// With y_1, y_2, ... the vertices after the one on the light, each light path leaves a virtual light at every y_j that
// scatters other than as a mirror. What arrives at y_j is
//
//   Phi_j = L_e / (p_A(y_0) p(y_0 -> y_1)) prod over i < j of f_s(y_i) cos / p(y_i -> y_i+1)
//
// over the number of light paths, and what it sends to z is Phi_j f_s(y_j) G(y_j, z) f_s(z). Or the virtual light is
// taken for Lambertian: then it sends out evenly what one sampled direction carries on, which is the albedo's estimate.
#pragma once
#include "integrator/shared/light_subpaths.h"
#include "transport/path_expression/join_weights.h"

namespace etendue::integrator {

struct VirtualLight {
  scene::SurfacePoint point;
  Vec3 wo{0};      // back along the light path
  Rgb power{0};    // what arrives; of a Lambertian one what it sends out
  float side = 1;  // of the normal that a Lambertian one shines to
  int length = 1;  // edges to the light
  uint32_t subset = 0;
  uint8_t state = 0;  // of classes: before this vertex scatters; of a Lambertian one after
};

struct VirtualLightPlan {
  int paths = 1;    // a multiple of subsets
  int subsets = 1;  // path k belongs to subset k modulo their number, and is one of paths / subsets
  bool lambertian = true;
  int longest = 0;  // edges to the light; 0: no limit
  static constexpr int kTask = 64;
  int tasks() const { return (paths + kTask - 1) / kTask; }

  friend bool operator==(const VirtualLightPlan&, const VirtualLightPlan&) = default;
};

// Leaves a light at every arrival, with what arrives there, or with what a sample of the BSDF carries on.
template <class M>
class VirtualLightMaker {
 public:
  using Color = typename M::Color;
  using PathWavefront = transport::PathWavefront<M>;

  VirtualLightMaker(const VirtualLightPlan& plan, const LightSubpaths<M>& walks, int first,
                    std::vector<VirtualLight>& lights)
      : plan_(plan), walks_(walks), first_(first), lights_(lights) {}

  void add_arrivals(PathWavefront& paths) {
    for (int i = 0; i < paths.hit_count(); ++i)
      if (paths.bsdf(i).has_non_delta_lobe()) add(paths, i, Color(1), 1);
  }

  // What `scatter` is given for Lambertian ones.
  bool operator()(PathWavefront& paths, int hit, LobeSample<Color>& s) const {
    const bool goes_on = transport::TakeAll()(paths, hit, s);
    if (goes_on && !s.delta) add(paths, hit, s.weight, glm::dot(paths.point(hit).ng, s.wi) < 0 ? -1.0f : 1.0f);
    return goes_on;
  }

 private:
  void add(PathWavefront& paths, int hit, const Color& scattered, float side) const {
    const int path = paths.path_at(hit);
    VirtualLight light;
    light.point = paths.point(hit), light.wo = paths.wo(hit), light.side = side;
    const float subset_size = static_cast<float>(plan_.paths) / static_cast<float>(plan_.subsets);
    light.power = paths.state(path).throughput * scattered * (walks_.flux(path) / subset_size);
    light.length = paths.length();
    light.subset = static_cast<uint32_t>((first_ + path) % plan_.subsets);
    if constexpr (M::kClasses) {
      const auto drawn = transport::draw_state(paths.shares(), path, paths.random(vertex_dimension::kLightChoice, hit));
      light.power *= drawn.weight, light.state = drawn.state;
    }
    if (!is_black(light.power)) lights_.push_back(light);
  }

  const VirtualLightPlan& plan_;
  const LightSubpaths<M>& walks_;
  int first_;
  std::vector<VirtualLight>& lights_;
};

// The lights of one task of a sample; the number of rays, or nothing if they were given up.
template <class M>
std::optional<uint64_t> make_virtual_lights(const RenderContext& context, uint32_t sample, const VirtualLightPlan& plan,
                                            int task, const TaskContext& task_context,
                                            std::vector<VirtualLight>& lights) {
  using namespace transport;
  static thread_local const auto walks = std::make_unique<LightSubpaths<M>>();
  PathWavefront<M>& paths = thread_wavefront<M>();
  lights.clear();
  const int first = task * VirtualLightPlan::kTask;
  walks->launch(
      context, sample, std::min(VirtualLightPlan::kTask, plan.paths - first), task_context, paths,
      [&](int i) { return static_cast<uint32_t>(first + i); }, [](auto&&...) { return true; });
  VirtualLightMaker<M> maker(plan, *walks, first, lights);
  while (paths.trace())
    while (paths.next_hits()) {
      if (paths.length() == 1) walks->dim_first_vertices(paths);
      if (plan.longest > 0 && paths.length() > plan.longest) continue;
      if constexpr (M::kClasses) paths.draw(dimensions(vertex_dimension::kLightChoice, 1));
      if (plan.lambertian) {
        sample_bsdf(paths, 1, TransportMode::importance, maker);
      } else {
        maker.add_arrivals(paths);
        sample_bsdf(paths, 1, TransportMode::importance);
      }
    }
  if (paths.cancelled()) return {};
  return paths.rays_traced();
}

}  // namespace etendue::integrator
