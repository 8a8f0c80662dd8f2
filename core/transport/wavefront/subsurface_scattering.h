// Subsurface scattering by diffusion: moves vertices of camera paths to where light enters the body.
//                                                                    [Christensen and Burley 2015; King et al. 2013]
//
// A vertex on a surface with a diffusion profile is the point x_o where light leaves. The point x_i where it enters is
// sampled: a radius by the profile of one channel, a direction around an axis (the normal or one of two tangents), and a
// probe ray along the axis. One of the hits of the probe on the same object is chosen. The density of x_i per area is
//
//   p = sum over axes a and channels c of  P_a / 3  R_c(r_a) |n_i . a| / (number of hits)
//
// with r_a the distance of x_i from x_o perpendicular to a, and the throughput is multiplied by R(|x_o - x_i|) / p. The
// path then continues at x_i, where the surface is Lambertian. The result is biased by the assumption of the profile
// that the surface is flat.
#pragma once
#include "bsdf/diffusion_profile.h"
#include "transport/wavefront/path_wavefront.h"

namespace etendue::transport {

class SubsurfaceProbe {
 public:
  struct Entry {
    Hit hit;
    Vec3 normal;  // outwards, geometric
    Rgb weight;   // R over the density
  };

  // `outside` is the geometric normal at the point of exit, on the side of the viewer.
  SubsurfaceProbe(const scene::CompiledScene& scene, const scene::SurfacePoint& exit, const Vec3& outside,
                  const Rgb& albedo, float time)
      : scene_(scene), exit_(exit), frame_(outside), time_(time) {
    // A channel without a mean free path gets a small one: its light must not be lost.
    const Rgb& lengths = exit.material->mean_free_path;
    const float least = 1e-3f * max_component(lengths);
    for (int c = 0; c < 3; ++c)
      profiles_[static_cast<size_t>(c)] =
          DiffusionProfile(std::max(lengths[c], least), std::clamp(albedo[c], 0.0f, 1.0f));
  }

  // False if the sample finds no point of entry.
  bool sample(float choice, float radius, float angle, float which, Entry& entry) const {
    const int channel = std::min(static_cast<int>(choice * 3), 2);
    const float rest = choice * 3 - static_cast<float>(channel);
    const DiffusionProfile& profile = profiles_[static_cast<size_t>(channel)];
    const int axis = rest < kNormal ? 2 : rest < kNormal + kTangent ? 0 : 1;
    const float r = profile.sample_radius(radius);
    const float reach2 = sqr(profile.largest_radius()) - r * r;
    if (!(reach2 > 0)) return false;
    const float reach = std::sqrt(reach2);
    const float phi = 2 * kPi * angle;
    const Vec3 direction = -axis_of(axis);
    const Vec3 across = std::cos(phi) * axis_of((axis + 1) % 3) + std::sin(phi) * axis_of((axis + 2) % 3);
    std::array<Hit, kMostHits> hits;
    const int count = hits_along(exit_.position + r * across - reach * direction, direction, 2 * reach, hits);
    if (count == 0) return false;
    entry.hit = hits[static_cast<size_t>(std::min(static_cast<int>(which * static_cast<float>(count)), count - 1))];
    return weigh(direction, count, entry);
  }

 private:
  static constexpr size_t kMostHits = 16;
  static constexpr float kNormal = 0.5f, kTangent = 0.25f;  // probabilities of the axes

  const Vec3& axis_of(int i) const { return i == 0 ? frame_.x : i == 1 ? frame_.y : frame_.z; }

  // The hits on the same object on a segment, from its start.
  int hits_along(const Vec3& from, const Vec3& direction, float length, std::array<Hit, kMostHits>& hits) const {
    const auto instance = static_cast<uint32_t>(exit_.instance - scene_.instances().data());
    Ray ray;
    ray.origin = from;
    ray.direction = direction;
    ray.tnear = 0;
    ray.tfar = length;
    size_t count = 0;
    constexpr int kMostSteps = 64;
    for (int step = 0; step < kMostSteps && count < kMostHits; ++step) {
      const Hit hit = scene_.intersect(ray, 0, time_);
      if (!hit) break;
      if (hit.instance == instance) hits[count++] = hit;
      ray.tnear = hit.t + std::max(1e-5f * length, 4e-7f * hit.t);
      if (!(ray.tnear < ray.tfar)) break;
    }
    return static_cast<int>(count);
  }

  bool weigh(const Vec3& direction, int count, Entry& entry) const {
    scene::SurfacePoint at;
    const Vec3 back = -direction;
    scene_.surfaces({&back, 1}, {&entry.hit, 1}, &at, &time_);
    entry.normal = at.ng;
    const Vec3 local = frame_.to_local(at.position - exit_.position);
    const Vec3 cosines = glm::abs(frame_.to_local(at.ng));
    const float distance2 = length_squared(local);
    const float distance = std::sqrt(distance2);
    float pdf = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const float r = safe_sqrt(distance2 - sqr(local[axis]));
      for (const DiffusionProfile& profile : profiles_)
        if (distance < profile.largest_radius())
          pdf += (axis == 2 ? kNormal : kTangent) / 3 * profile.value(r) * cosines[axis];
    }
    pdf /= static_cast<float>(count);
    if (!(pdf > 0)) return false;
    for (int c = 0; c < 3; ++c) {
      const DiffusionProfile& profile = profiles_[static_cast<size_t>(c)];
      entry.weight[c] = distance < profile.largest_radius() ? profile.value(distance) / pdf : 0;
    }
    return is_finite(entry.weight);
  }

  const scene::CompiledScene& scene_;
  const scene::SurfacePoint& exit_;
  Frame frame_;
  float time_;
  std::array<DiffusionProfile, 3> profiles_{{{1, 1}, {1, 1}, {1, 1}}};
};

// Moves the current vertices on surfaces with a diffusion profile; paths without a point of entry lose their
// throughput. Kept out of the loops, whose speed depends on their size.
template <class M>
[[gnu::cold, gnu::noinline]] void move_to_entry_points(PathWavefront<M>& paths) {
  constexpr uint32_t kStream = 1U << 20;  // beyond those of branches and light sources
  paths.select_rng_stream(kStream);
  paths.draw(dimensions(0, 4));
  for (int i = 0; i < paths.hit_count(); ++i) {
    const scene::SurfacePoint exit = paths.point(i);
    if (exit.in_volume || !exit.material->has_subsurface || !exit.front) continue;
    auto& path = paths.state_at(i);
    const Vec3& normal = exit.shading.z;
    const Rgb albedo = kPi * paths.bsdf(i).evaluate(paths.wo(i), normal).f_cos;
    if (is_black(albedo)) continue;
    const SubsurfaceProbe probe(paths.scene(), exit, exit.ng, albedo, path.time);
    SubsurfaceProbe::Entry entry;
    if (!probe.sample(paths.random(0, i), paths.random(1, i), paths.random(2, i), paths.random(3, i), entry)) {
      path.throughput = typename M::Color(0);
      continue;
    }
    path.throughput *= entry.weight;
    paths.move_vertex(i, entry.hit, entry.normal);
  }
  paths.select_rng_stream(0);
}

// In models with wavelengths, scenes with diffusion are refused.
template <class M>
void scatter_below_surface([[maybe_unused]] PathWavefront<M>& paths) {
  if constexpr (M::kSpectral)
    return;
  else if (paths.scene().has_subsurface()) [[unlikely]]
    move_to_entry_points(paths);
}

}  // namespace etendue::transport
