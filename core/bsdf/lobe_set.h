// Mixes of lobes: the sum of a few, of which one is sampled at a time.
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

// Calls f with the lobe that the variant holds: a switch, however many types there are.
template <class F, class... L>
decltype(auto) visit_lobe(F&& f, const std::variant<L...>& lobe) {
  if constexpr (sizeof...(L) <= 11)
    return std::visit(f, lobe);
  else
    return visit_from<0>(f, lobe);
}

// How wide the glossy part of a lobe is: the slope of its facets, or what looks alike. 1 for a lobe without any.
template <class Lobe>
float alpha_of(const Lobe& lobe) {
  if constexpr (requires { lobe.alpha(); })
    return lobe.alpha();
  else if constexpr (requires { lobe.facets; })
    return std::max(lobe.facets.alpha_x, lobe.facets.alpha_y);
  else
    return 1.0f;
}

// Of a mix in which nothing lies over anything else.
struct NoCoatingLayers {
  static constexpr bool kAny = false;
};

// At most kMost lobes; Lobe is a variant of their types. Covers are layers over some of the lobes, of whose light they
// take a part: `passed(i, wo, wi)` is what they leave of that of lobe i.
template <class ColorType, class Lobe, int kMost, class CoatingLayers = NoCoatingLayers>
class LobeSet {
 public:
  using Color = ColorType;
  static constexpr int kMaxLobes = kMost;

  void add(const Lobe& lobe) { lobes_[static_cast<size_t>(count_++)] = lobe; }
  void clear() { count_ = 0, covers_ = {}; }
  bool empty() const { return count_ == 0; }
  int size() const { return count_; }
  // The lobe, if there is but one and it is of this type.
  template <class Type>
  const Type* only() const {
    return count_ == 1 ? std::get_if<Type>(&lobes_[0]) : nullptr;
  }

  // Puts a layer over all lobes that are there.
  template <class Layer>
  void cover(const Layer& layer) {
    covers_.add(count_, layer);
  }

  // True if there is a lobe that a light sample can be combined with.
  bool has_non_delta_lobe() const {
    for (int i = 0; i < count_; ++i)
      if (!visit(i, [](const auto& l) { return l.is_delta(); })) return true;
    return false;
  }

  Color eval(const Vec3& wo, const Vec3& wi, TransportMode mode) const {
    return sum(wo, wi, [&](const auto& l) { return l.eval(wo, wi, mode); });
  }

  // What tells narrow lobes from wide ones: the least slope of those that are glossy.
  float min_alpha() const {
    float least = 1;
    for (int i = 0; i < count_; ++i) least = std::min(least, visit(i, [](const auto& l) { return alpha_of(l); }));
    return least;
  }

  bool has_component(ScatterType letter) const {
    for (int i = 0; i < count_; ++i)
      if (visit(i, [&](const auto& l) { return l.has_component(letter); })) return true;
    return false;
  }

  Color eval_component(ScatterType letter, const Vec3& wo, const Vec3& wi, TransportMode mode) const {
    return sum(wo, wi, [&](const auto& l) { return l.eval_component(letter, wo, wi, mode); });
  }

  float pdf(const Vec3& wo, const Vec3& wi, TransportMode mode) const {
    const Shares shares = lobe_shares(wo);
    float p = 0;
    for (int i = 0; i < count_; ++i)
      p += shares[static_cast<size_t>(i)] * visit(i, [&](const auto& l) { return l.pdf(wo, wi, mode); });
    return p;
  }

  bool sample(const Vec3& wo, LobeRandom random, TransportMode mode, LobeSample<Color>& s) const {
    if (count_ == 0) return false;
    const Shares shares = lobe_shares(wo);
    int chosen = 0;
    float below = 0;
    while (chosen + 1 < count_ && random.choice >= below + shares[static_cast<size_t>(chosen)])
      below += shares[static_cast<size_t>(chosen++)];
    const float share = shares[static_cast<size_t>(chosen)];
    if (count_ > 1) random.choice = std::min((random.choice - below) / share, kOneMinusEpsilon);
    if (!visit(chosen, [&](const auto& l) { return l.sample(wo, random, mode, s); })) return false;
    if (count_ == 1) return true;
    if (s.delta) {
      s.weight /= share;
      if constexpr (CoatingLayers::kAny) s.weight *= covers_.passed(chosen, wo, s.wi);
      return true;
    }
    s.pdf_solid_angle = pdf(wo, s.wi, mode);
    s.weight = eval(wo, s.wi, mode) * (std::abs(s.wi.z) / s.pdf_solid_angle);
    return true;
  }

  void add_deltas(const Vec3& wo, TransportMode mode, DeltaSet<Color>& deltas) const {
    const Shares shares = lobe_shares(wo);
    for (int i = 0; i < count_; ++i) {
      const int first = deltas.count;
      visit(i, [&](const auto& l) { l.add_deltas(wo, mode, deltas); });
      for (auto k = static_cast<size_t>(first); k < static_cast<size_t>(deltas.count); ++k) {
        deltas.probabilities[k] *= shares[static_cast<size_t>(i)];
        if constexpr (CoatingLayers::kAny) deltas.lobes[k].weight *= covers_.passed(i, wo, deltas.lobes[k].wi);
      }
    }
  }

 private:
  using Shares = std::array<float, kMaxLobes>;

  template <class F>
  auto visit(int i, F&& f) const {
    return visit_lobe(f, lobes_[static_cast<size_t>(i)]);
  }

  template <class F>
  Color sum(const Vec3& wo, const Vec3& wi, F&& of_lobe) const {
    Color f(0);
    for (int i = 0; i < count_; ++i) {
      if constexpr (CoatingLayers::kAny)
        f += visit(i, of_lobe) * covers_.passed(i, wo, wi);
      else
        f += visit(i, of_lobe);
    }
    return f;
  }

  Shares lobe_shares(const Vec3& wo) const {
    Shares shares{1};
    if (count_ < 2) return shares;
    float total = 0;
    for (int i = 0; i < count_; ++i)
      total += shares[static_cast<size_t>(i)] = visit(i, [&](const auto& l) { return l.sampling_weight(wo); });
    float rest = 1;
    for (int i = 0; i + 1 < count_; ++i) {
      float& share = shares[static_cast<size_t>(i)];
      share = total > 0 ? share / total : 1 / static_cast<float>(count_);
      rest -= share;
    }
    shares[static_cast<size_t>(count_ - 1)] = std::max(rest, 0.0f);
    return shares;
  }

  std::array<Lobe, kMaxLobes> lobes_;
  int count_ = 0;
  [[no_unique_address]] CoatingLayers covers_;
};

// The lobes of glTF's core and of what is as common in its files.
template <class Color>
using StandardLobe = std::variant<Lambert<Color>, MetallicRoughness<Color>, Dielectric<Color>, ThinTransmission<Color>>;

template <class Color>
using StandardLobes = LobeSet<Color, StandardLobe<Color>, 2>;

// A model whose surfaces are all Lambertian pays for nothing else.
template <class Color>
class DiffuseOnly {
 public:
  void add(const Lambert<Color>& lobe) { lobe_ = lobe; }
  void clear() { lobe_.albedo = Color(0); }
  bool empty() const { return is_black(lobe_.albedo); }
  bool has_non_delta_lobe() const { return !empty(); }
  Color eval(const Vec3& wo, const Vec3& wi, TransportMode mode) const { return lobe_.eval(wo, wi, mode); }
  bool has_component(ScatterType letter) const { return lobe_.has_component(letter); }
  Color eval_component(ScatterType letter, const Vec3& wo, const Vec3& wi, TransportMode mode) const {
    return lobe_.eval_component(letter, wo, wi, mode);
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
