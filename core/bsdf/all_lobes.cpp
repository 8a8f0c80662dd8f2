#include "bsdf/all_lobes.h"

#include <new>

#include "bsdf/all_lobe_types.h"

namespace etendue {

struct AllLobesAccess {
  using Set = AnyLobeSet<Rgb>;
  // Copying an AllLobes copies the bytes of its set.
  static_assert(std::is_trivially_copyable_v<Set> && std::is_trivially_destructible_v<Set>);
  static_assert(sizeof(Set) <= AllLobes<Rgb>::kBytes && alignof(Set) <= AllLobes<Rgb>::kAlignment);

  static void create(AllLobes<Rgb>& lobes) { new (lobes.set_.data()) Set; }
  static Set& of(AllLobes<Rgb>& lobes) { return *std::launder(reinterpret_cast<Set*>(lobes.set_.data())); }
  static const Set& of(const AllLobes<Rgb>& lobes) {
    return *std::launder(reinterpret_cast<const Set*>(lobes.set_.data()));
  }
};

AnyLobeSet<Rgb>& lobe_set(AllLobes<Rgb>& lobes) { return AllLobesAccess::of(lobes); }
const AnyLobeSet<Rgb>& lobe_set(const AllLobes<Rgb>& lobes) { return AllLobesAccess::of(lobes); }

AllLobes<Rgb>::AllLobes() { AllLobesAccess::create(*this); }
void AllLobes<Rgb>::clear() { lobe_set(*this).clear(); }
bool AllLobes<Rgb>::empty() const { return lobe_set(*this).empty(); }
int AllLobes<Rgb>::size() const { return lobe_set(*this).size(); }
void AllLobes<Rgb>::set_relative_eta(float eta, float outside_eta) {
  lobe_set(*this).set_relative_eta(eta, outside_eta);
}
void AllLobes<Rgb>::keep_deltas(bool deltas) { lobe_set(*this).keep_deltas(deltas); }
bool AllLobes<Rgb>::has_non_delta_lobe() const { return lobe_set(*this).has_non_delta_lobe(); }
float AllLobes<Rgb>::min_alpha() const { return lobe_set(*this).min_alpha(); }
bool AllLobes<Rgb>::has_component(ScatterType type) const { return lobe_set(*this).has_component(type); }
Rgb AllLobes<Rgb>::eval(const Vec3& wo, const Vec3& wi, TransportMode mode) const {
  return lobe_set(*this).eval(wo, wi, mode);
}
Rgb AllLobes<Rgb>::eval_component(ScatterType type, const Vec3& wo, const Vec3& wi, TransportMode mode) const {
  return lobe_set(*this).eval_component(type, wo, wi, mode);
}
float AllLobes<Rgb>::pdf(const Vec3& wo, const Vec3& wi, TransportMode mode) const {
  return lobe_set(*this).pdf(wo, wi, mode);
}
bool AllLobes<Rgb>::sample(const Vec3& wo, const LobeRandom& random, TransportMode mode, LobeSample<Rgb>& s) const {
  return lobe_set(*this).sample(wo, random, mode, s);
}
void AllLobes<Rgb>::add_deltas(const Vec3& wo, TransportMode mode, DeltaSet<Rgb>& deltas) const {
  lobe_set(*this).add_deltas(wo, mode, deltas);
}

bool depends_on_azimuth(const AllLobes<Rgb>& lobes) {
  const auto turned = [](const Vec3& w, float phi) {
    return Vec3(std::cos(phi) * w.x - std::sin(phi) * w.y, std::sin(phi) * w.x + std::cos(phi) * w.y, w.z);
  };
  const Vec3 wo = glm::normalize(Vec3(0.5f, 0.1f, 0.7f));
  for (const Vec3& to : {Vec3(-0.5f, -0.1f, 0.7f), Vec3(-0.3f, -0.3f, 0.7f), Vec3(0.4f, 0.3f, 0.5f)})
    for (const float phi : {0.7f, 1.6f, 3.5f}) {
      const Vec3 wi = glm::normalize(to);
      const float f = average(lobes.eval(wo, wi, TransportMode::radiance));
      const float f_turned = average(lobes.eval(turned(wo, phi), turned(wi, phi), TransportMode::radiance));
      if (std::abs(f - f_turned) > 1e-2f * std::max(f, f_turned) + 1e-4f) return true;
    }
  return false;
}

}  // namespace etendue
