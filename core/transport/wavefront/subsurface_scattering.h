// Subsurface scattering by diffusion: moves vertices of camera paths to where light enters the body.
//                                                                    [Christensen and Burley 2015; King et al. 2013]
//
// The BSSRDF is S = f(w_o, w_i) R(|x_o - x_i|) / A, with f the diffuse lobe of the surface, a product of a function of
// w_o and one of w_i, and R / A a diffusion profile (bsdf/diffusion). A vertex on such a surface is the point x_o where
// light leaves. The path either follows the deltas of the surface there, or is moved to a point x_i where light enters.
// The choice is random, in proportion to their albedos. x_i is sampled by a radius from the profile of one channel, a
// direction around an axis (the normal or one of two tangents), and a probe ray along the axis. The probes find x_i
// with the density per area
//
//   p = sum over axes a and channels c of  P_a / 3  R_c(r_a) / A_c  |n_i . a|
//
// with r_a the distance of x_i from x_o perpendicular to a. Each hit of a probe on the same object has the weight
// w = R(|x_o - x_i|) / (A p). One hit is chosen with the probability q in proportion to w, and the throughput is
// multiplied by w / q. The path continues at x_i by the diffuse lobe there. The result is biased by the assumption of
// the profile that the surface is flat.
#pragma once
#include "bsdf/diffusion/diffusion_profiles.h"
#include "transport/wavefront/path_wavefront.h"

namespace etendue::transport {

// Samples the points where light enters, for one type of profile.
template <class Profile>
class SubsurfaceProbe {
 public:
  struct Entry {
    Hit hit;
    Vec3 normal;  // outwards, geometric
    Rgb weight;   // R / A over the density
  };

  // `outside` is the geometric normal at the point of exit, on the side of the viewer.
  SubsurfaceProbe(const scene::CompiledScene& scene, const scene::SurfacePoint& exit, const Vec3& outside,
                  const Rgb& albedo, float time)
      : scene_(scene),
        exit_(exit),
        frame_(outside),
        time_(time),
        profiles_{profile(albedo, 0), profile(albedo, 1), profile(albedo, 2)} {}

  // False if the sample finds no point of entry.
  bool sample(float choice, float radius, float angle, float which, Entry& entry) const {
    const int channel = std::min(static_cast<int>(choice * 3), 2);
    const float rest = choice * 3 - static_cast<float>(channel);
    const Profile& profile = profiles_[static_cast<size_t>(channel)];
    const int axis = rest < kNormal ? 2 : rest < kNormal + kTangent ? 0 : 1;
    const float r = profile.sample_radius(radius);
    const float reach2 = sqr(profile.largest_radius()) - r * r;
    if (!(reach2 > 0)) return false;
    const float reach = std::sqrt(reach2);
    const float phi = 2 * kPi * angle;
    const Vec3 direction = -axis_of(axis);
    const Vec3 across = std::cos(phi) * axis_of((axis + 1) % 3) + std::sin(phi) * axis_of((axis + 2) % 3);
    std::array<Hit, kMostHits> hits;
    const size_t count = hits_along(exit_.position + r * across - reach * direction, direction, 2 * reach, hits);
    return choose({hits.data(), count}, direction, which, entry);
  }

 private:
  static constexpr size_t kMostHits = 16;
  static constexpr float kNormal = 0.5f, kTangent = 0.25f;  // probabilities of the axes

  // Of a channel. A channel without a mean free path gets a small one: its light must not be lost.
  Profile profile(const Rgb& albedo, int channel) const {
    const Subsurface& material = exit_.material->subsurface;
    const float least = 1e-3f * max_component(material.mean_free_path);
    return make_profile<Profile>(material, std::max(material.mean_free_path[channel], least),
                                 std::clamp(albedo[channel], 0.0f, 1.0f));
  }

  const Vec3& axis_of(int i) const { return i == 0 ? frame_.x : i == 1 ? frame_.y : frame_.z; }

  // The hits on the same object on a segment, from its start.
  size_t hits_along(const Vec3& from, const Vec3& direction, float length, std::array<Hit, kMostHits>& hits) const {
    const uint32_t instance = exit_.instance->number;
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
    return count;
  }

  // R / A at a point over the density with which the probes of all axes find it.
  Rgb weight_at(const scene::SurfacePoint& at) const {
    const Vec3 local = frame_.to_local(at.position - exit_.position);
    const Vec3 cosines = glm::abs(frame_.to_local(at.ng));
    const float distance2 = length_squared(local);
    const float distance = std::sqrt(distance2);
    Rgb values(0);
    float pdf = 0;
    for (int c = 0; c < 3; ++c) {
      const Profile& profile = profiles_[static_cast<size_t>(c)];
      if (!(distance < profile.largest_radius())) continue;
      values[c] = profile.value(distance);
      for (int axis = 0; axis < 3; ++axis)
        pdf += (axis == 2 ? kNormal : kTangent) / 3 * profile.value(safe_sqrt(distance2 - sqr(local[axis]))) *
               cosines[axis];
    }
    if (!(pdf > 0)) return Rgb(0);
    const Rgb weight = values / pdf;
    return is_finite(weight) ? weight : Rgb(0);
  }

  // Selects one of the hits of a probe in proportion to their weights.
  bool choose(std::span<const Hit> hits, const Vec3& direction, float random, Entry& entry) const {
    std::array<scene::SurfacePoint, kMostHits> points;
    std::array<Vec3, kMostHits> back;
    std::array<float, kMostHits> times;
    std::array<Rgb, kMostHits> weights;
    back.fill(-direction);
    times.fill(time_);
    scene_.surfaces({back.data(), hits.size()}, hits, points.data(), times.data());
    float total = 0;
    for (size_t i = 0; i < hits.size(); ++i) total += average(weights[i] = weight_at(points[i]));
    if (!(total > 0)) return false;
    size_t chosen = 0;
    float rest = random * total;
    for (size_t i = 0; i < hits.size(); ++i) {
      const float share = average(weights[i]);
      if (!(share > 0)) continue;
      chosen = i;
      if (rest < share) break;
      rest -= share;
    }
    entry.hit = hits[chosen];
    entry.normal = points[chosen].ng;
    entry.weight = weights[chosen] * (total / average(weights[chosen]));
    return true;
  }

  const scene::CompiledScene& scene_;
  const scene::SurfacePoint& exit_;
  Frame frame_;
  float time_;
  std::array<Profile, 3> profiles_;
};

// Restricts the surface of a current vertex to its deltas, or to its other lobes. Without effect on surfaces that have
// Lambertian lobes only.
template <class M>
void keep_deltas(PathWavefront<M>& paths, int hit, bool deltas) {
  if constexpr (M::kDiffuse)
    return;
  else if constexpr (M::kScattering)
    paths.bsdf(hit).begin_surface().lobes.keep_deltas(deltas);
  else
    paths.bsdf(hit).lobes.keep_deltas(deltas);
}

// The sum of the deltas of a current vertex; 0 for surfaces without one.
template <class M>
Rgb delta_albedo(const PathWavefront<M>& paths, int hit) {
  const auto deltas = paths.bsdf(hit).deltas(paths.wo(hit));
  Rgb sum(0);
  for (size_t k = 0; k < static_cast<size_t>(deltas.count); ++k) sum += deltas.lobes[k].weight;
  return sum;
}

// Makes a current vertex follow either its deltas or its diffuse lobe. Returns whether light enters the body.
template <class M>
bool choose_entry(PathWavefront<M>& paths, int hit, const Rgb& diffuse, float random) {
  const float reflected = average(delta_albedo(paths, hit));
  if (reflected == 0) return true;
  const float probability = reflected / (reflected + average(diffuse));
  const bool reflects = random < probability;
  paths.state_at(hit).throughput *= 1 / (reflects ? probability : 1 - probability);
  if (reflects) keep_deltas(paths, hit, true);
  return !reflects;
}

// Moves a current vertex to where light enters. `from_normal` and `towards_viewer` are the diffuse lobe for light along
// the normal and a viewer there or at w_o. A path without a point of entry loses its throughput.
template <class M>
void move_to_entry_point(PathWavefront<M>& paths, int hit, const Rgb& from_normal, const Rgb& towards_viewer) {
  const scene::SurfacePoint exit = paths.point(hit);
  auto& path = paths.state_at(hit);
  const Rgb albedo = exit.material->subsurface.albedo_scale * from_normal;
  bool found = false;
  with_profile_type(exit.material->subsurface, [&]<class Profile>() {
    const SubsurfaceProbe<Profile> probe(paths.scene(), exit, exit.ng, albedo, path.time);
    typename SubsurfaceProbe<Profile>::Entry entry;
    found = probe.sample(paths.random(0, hit), paths.random(1, hit), paths.random(2, hit), paths.random(3, hit), entry);
    if (!found) return;
    path.throughput *= entry.weight * ratio(towards_viewer, from_normal);
    paths.move_vertex(hit, entry.hit, entry.normal);
  });
  if (!found) path.throughput = typename M::Color(0);
}

// Applies subsurface scattering to the current vertices. Kept out of the loops, whose speed depends on their size.
template <class M>
[[gnu::cold, gnu::noinline]] void move_to_entry_points(PathWavefront<M>& paths) {
  constexpr uint32_t kStream = 1U << 20;  // beyond those of branches and light sources
  paths.select_rng_stream(kStream);
  paths.draw(dimensions(0, 5));
  for (int i = 0; i < paths.hit_count(); ++i) {
    const scene::SurfacePoint& point = paths.point(i);
    if (point.in_volume || !point.material->has_subsurface || !point.front) continue;
    const Vec3& normal = point.shading.z;
    const Rgb from_normal = paths.bsdf(i).evaluate(normal, normal).f_cos;
    const Rgb towards_viewer = paths.bsdf(i).evaluate(paths.wo(i), normal).f_cos;
    const Rgb diffuse = point.material->subsurface.albedo_scale * towards_viewer;
    if (is_black(diffuse) || !choose_entry(paths, i, diffuse, paths.random(4, i))) continue;
    move_to_entry_point(paths, i, from_normal, towards_viewer);
    keep_deltas(paths, i, false);
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
