// A BSDF as a sum of lobes, stored by value.
//
//   f = sum of T_k f_k
//
// f_k is lobe k. T_k is the part of its light that the coating layers above it transmit, 1 without layers. Sampling
// selects one lobe and draws a direction from it. The probability p_k of a lobe is proportional to its sampling_weight
// times the light that the layers above it transmit. The density of a direction that is not a delta is the mixture sum
// of p_k pdf_k, whichever lobe generated it.
#pragma once
#include <array>
#include <variant>

#include "bsdf/lobe.h"
#include "bsdf/lobes/dielectric.h"
#include "bsdf/lobes/lambert.h"
#include "bsdf/lobes/metallic_roughness.h"
#include "bsdf/lobes/thin_transmission.h"

namespace etendue {

template <size_t first, class F, class Variant>
decltype(auto) visit_from(F&& f, const Variant& lobe) {
  if constexpr (first + 1 == std::variant_size_v<Variant>)
    return f(*std::get_if<first>(&lobe));
  else
    return lobe.index() == first ? f(*std::get_if<first>(&lobe)) : visit_from<first + 1>(f, lobe);
}

// Calls f with the lobe that the variant holds. libstdc++ inlines std::visit as a switch for up to 11 alternatives;
// beyond that it calls through a table, and a chain of comparisons is faster.
template <class F, class... L>
decltype(auto) visit_lobe(F&& f, const std::variant<L...>& lobe) {
  if constexpr (sizeof...(L) <= 11)
    return std::visit(f, lobe);
  else
    return visit_from<0>(f, lobe);
}

// The width of the glossy part of a lobe as an equivalent microfacet roughness alpha; 1 for a lobe without a glossy
// part, 0 for deltas.
template <class Lobe>
float alpha_of(const Lobe& lobe) {
  if constexpr (requires { lobe.alpha(); })
    return lobe.alpha();
  else if constexpr (requires { lobe.facets; })
    return std::max(lobe.facets.alpha_x, lobe.facets.alpha_y);
  else
    return 1.0f;
}

template <class Variant, class Color>
inline constexpr bool kAreLobes = false;
template <class... L, class Color>
inline constexpr bool kAreLobes<std::variant<L...>, Color> = (LobeFor<L, Color> && ...);

// For sets without coating layers (coating_layers.h).
struct NoCoatingLayers {
  static constexpr bool kAny = false;
};

// At most `max_lobes` lobes. Lobe is a std::variant of their types; CoatingLayers attenuates lobes that lie below
// others.
template <class ColorType, class Lobe, int max_lobes, class CoatingLayers = NoCoatingLayers>
class LobeSet {
  static_assert(kAreLobes<Lobe, ColorType>);

 public:
  using Color = ColorType;
  using Probabilities = std::array<float, max_lobes>;  // by lobe

  // The set must hold fewer than `max_lobes` lobes.
  void add(const Lobe& lobe) { lobes_[static_cast<size_t>(count_++)] = lobe; }
  void clear() {
    count_ = 0;
    coatings_ = {};
  }
  bool empty() const { return count_ == 0; }
  int size() const { return count_; }
  // The lobe of a set that holds exactly one, if it is of this type; else null.
  template <class Type>
  const Type* single_lobe_as() const {
    return count_ == 1 ? std::get_if<Type>(&lobes_[0]) : nullptr;
  }

  // Removes all lobes except deltas, or all deltas. The set must have no coating layers.
  void keep_deltas(bool deltas) {
    int kept = 0;
    for (int i = 0; i < count_; ++i)
      if (visit(i, [](const auto& l) { return l.is_delta(); }) == deltas)
        lobes_[static_cast<size_t>(kept++)] = lobes_[static_cast<size_t>(i)];
    count_ = kept;
  }

  // Puts a layer over all lobes added so far. Lobes that are added later lie above it.
  template <class Layer>
  void add_coating(const Layer& layer) {
    coatings_.add(count_, layer);
  }

  // Replaces the lobes by convert(lobe) for each lobe of another set, and the coating layers by those of that set.
  template <class Other, class Convert>
  void assign(const Other& other, Convert&& convert) {
    count_ = 0;
    for (int i = 0; i < other.size(); ++i) add(other.visit(i, convert));
    coatings_ = other.coatings();
  }
  const CoatingLayers& coatings() const { return coatings_; }
  // Calls f with lobe i.
  template <class F>
  auto visit(int i, F&& f) const {
    return visit_lobe(f, lobes_[static_cast<size_t>(i)]);
  }

  // Replaces the index of refraction of every dielectric boundary, for a surface between two media. `eta` is the index
  // inside over the index outside, `outside_eta` the index outside.
  void set_relative_eta(float eta, float outside_eta) {
    for (int i = 0; i < count_; ++i)
      std::visit(
          [&](auto& lobe) {
            if constexpr (requires { lobe.set_relative_eta(eta, outside_eta); })
              lobe.set_relative_eta(eta, outside_eta);
          },
          lobes_[static_cast<size_t>(i)]);
  }

  // Whether light sampling can contribute: some lobe is not a delta.
  bool has_non_delta_lobe() const {
    for (int i = 0; i < count_; ++i)
      if (!visit(i, [](const auto& l) { return l.is_delta(); })) return true;
    return false;
  }

  // f, without deltas.
  Color eval(const Vec3& wo, const Vec3& wi, TransportMode mode) const {
    return sum(wo, wi, [&](const auto& l) { return l.eval(wo, wi, mode); });
  }

  // The smallest equivalent roughness of all lobes, which tells nearly specular surfaces from rough ones.
  float min_alpha() const {
    float least = 1;
    for (int i = 0; i < count_; ++i) least = std::min(least, visit(i, [](const auto& l) { return alpha_of(l); }));
    return least;
  }

  // Whether `eval_component` can differ from 0 for this type.
  bool has_component(ScatterType type) const {
    for (int i = 0; i < count_; ++i)
      if (visit(i, [&](const auto& l) { return l.has_component(type); })) return true;
    return false;
  }

  // The part of `eval` of one scattering type.
  Color eval_component(ScatterType type, const Vec3& wo, const Vec3& wi, TransportMode mode) const {
    return sum(wo, wi, [&](const auto& l) { return l.eval_component(type, wo, wi, mode); });
  }

  // Density of the mixture per solid angle of wi, without deltas.
  float pdf(const Vec3& wo, const Vec3& wi, TransportMode mode) const {
    const Probabilities selection = selection_probabilities(wo);
    float p = 0;
    for (int i = 0; i < count_; ++i)
      p += selection[static_cast<size_t>(i)] * visit(i, [&](const auto& l) { return l.pdf(wo, wi, mode); });
    return p;
  }

  // False if the sample is absorbed. s must be default-initialised.
  bool sample(const Vec3& wo, LobeRandom random, TransportMode mode, LobeSample<Color>& s) const {
    if (count_ == 0) return false;
    const Probabilities selection = selection_probabilities(wo);
    int chosen = 0;
    float below = 0;
    while (chosen + 1 < count_ && random.choice >= below + selection[static_cast<size_t>(chosen)])
      below += selection[static_cast<size_t>(chosen++)];
    const float probability = selection[static_cast<size_t>(chosen)];
    if (count_ > 1) random.choice = std::min((random.choice - below) / probability, kOneMinusEpsilon);
    if (!visit(chosen, [&](const auto& l) { return l.sample(wo, random, mode, s); })) return false;
    if (count_ == 1) return true;
    if (s.delta) {
      s.weight /= probability;
      if constexpr (CoatingLayers::kAny) s.weight *= coatings_.transmittance(chosen, wo, s.wi);
      return true;
    }
    s.pdf_solid_angle = pdf(wo, s.wi, mode);
    s.weight = eval(wo, s.wi, mode) * (std::abs(s.wi.z) / s.pdf_solid_angle);
    return true;
  }

  // The probabilities with which `sample` selects the lobes. They sum to 1; equal for all lobes if every sampling
  // weight is 0.
  Probabilities selection_probabilities(const Vec3& wo) const {
    Probabilities selection{1};
    if (count_ < 2) return selection;
    float total = 0;
    for (int i = 0; i < count_; ++i) {
      float weight = visit(i, [&](const auto& l) { return l.sampling_weight(wo); });
      if constexpr (CoatingLayers::kAny) weight *= coatings_.max_transmittance(i, wo);
      total += selection[static_cast<size_t>(i)] = weight;
    }
    float rest = 1;
    for (int i = 0; i + 1 < count_; ++i) {
      float& probability = selection[static_cast<size_t>(i)];
      probability = total > 0 ? probability / total : 1 / static_cast<float>(count_);
      rest -= probability;
    }
    selection[static_cast<size_t>(count_ - 1)] = std::max(rest, 0.0f);
    return selection;
  }

  // Appends the deltas of all lobes.
  void add_deltas(const Vec3& wo, TransportMode mode, DeltaSet<Color>& deltas) const {
    const Probabilities selection = selection_probabilities(wo);
    for (int i = 0; i < count_; ++i) {
      const int first = deltas.count;
      visit(i, [&](const auto& l) { l.add_deltas(wo, mode, deltas); });
      for (auto k = static_cast<size_t>(first); k < static_cast<size_t>(deltas.count); ++k) {
        deltas.probabilities[k] *= selection[static_cast<size_t>(i)];
        if constexpr (CoatingLayers::kAny) deltas.lobes[k].weight *= coatings_.transmittance(i, wo, deltas.lobes[k].wi);
      }
    }
  }

 private:
  template <class F>
  Color sum(const Vec3& wo, const Vec3& wi, F&& of_lobe) const {
    Color f(0);
    for (int i = 0; i < count_; ++i) {
      if constexpr (CoatingLayers::kAny)
        f += visit(i, of_lobe) * coatings_.transmittance(i, wo, wi);
      else
        f += visit(i, of_lobe);
    }
    return f;
  }

  std::array<Lobe, max_lobes> lobes_;
  int count_ = 0;
  [[no_unique_address]] CoatingLayers coatings_;
};

// The lobes of glTF's core material and of the extensions that are as common: ior, specular, transmission, volume,
// anisotropy.
template <class Color>
using StandardLobe = std::variant<Lambert<Color>, MetallicRoughness<Color>, Dielectric<Color>, ThinTransmission<Color>>;

template <class Color>
using StandardLobes = LobeSet<Color, StandardLobe<Color>, 2>;

// The lobe set of scenes whose surfaces are all Lambertian: the functions of LobeSet without any selection.
template <class Color>
class DiffuseOnly {
 public:
  void add(const Lambert<Color>& lobe) { lobe_ = lobe; }
  void assign_lambertian(const Color& albedo) { lobe_.albedo = albedo; }
  void clear() { lobe_.albedo = Color(0); }
  bool empty() const { return is_black(lobe_.albedo); }
  bool has_non_delta_lobe() const { return !empty(); }
  Color eval(const Vec3& wo, const Vec3& wi, TransportMode mode) const { return lobe_.eval(wo, wi, mode); }
  bool has_component(ScatterType type) const { return lobe_.has_component(type); }
  Color eval_component(ScatterType type, const Vec3& wo, const Vec3& wi, TransportMode mode) const {
    return lobe_.eval_component(type, wo, wi, mode);
  }
  float pdf(const Vec3& wo, const Vec3& wi, TransportMode mode) const { return lobe_.pdf(wo, wi, mode); }
  bool sample(const Vec3& wo, const LobeRandom& random, TransportMode mode, LobeSample<Color>& s) const {
    return lobe_.sample(wo, random, mode, s);
  }
  void add_deltas(const Vec3&, TransportMode, DeltaSet<Color>&) const {}

 private:
  Lambert<Color> lobe_;
};

}  // namespace etendue
