// The scattering function at one surface point: a mix of at most kMaxLobes lobes in a fixed value on the stack.
//
// Directions are in world space, point away from the surface, and are unit. `eval` leaves the cosine out; densities are
// per solid angle of wi. Which side a direction is on is decided by the geometric normal, the shape of the lobes by the
// shading normal (Veach 1997, section 5.3), so that light never leaks through a surface.
#pragma once
#include <array>
#include <variant>

#include "base/frame.h"
#include "material/dielectric.h"
#include "material/lambert.h"
#include "material/layered.h"
#include "material/lobe.h"
#include "material/thin_sheet.h"

namespace etendue {

// The whole set of surfaces, for models that need them all.
template <class Color>
using AnyLobe = std::variant<Lambert<Color>, Layered<Color>, Dielectric<Color>, ThinSheet<Color>>;

template <class Color>
class LobeMix {
 public:
  static constexpr int kMaxLobes = 2;

  void add(const AnyLobe<Color>& lobe) { lobes_[static_cast<size_t>(count_++)] = lobe; }
  void clear() { count_ = 0; }
  bool empty() const { return count_ == 0; }

  // True if there is a lobe that a light sample can be combined with.
  bool has_non_delta() const {
    for (int i = 0; i < count_; ++i)
      if (!visit(i, [](const auto& l) { return l.is_delta(); })) return true;
    return false;
  }

  Color eval(const Vec3& wo, const Vec3& wi, Transport mode) const {
    Color f(0);
    for (int i = 0; i < count_; ++i) f += visit(i, [&](const auto& l) { return l.eval(wo, wi, mode); });
    return f;
  }

  // The slope of the facets that all glossy lobes of a surface have in common: what tells narrow ones from wide ones.
  float alpha() const {
    const auto slope = [](const auto& lobe) {
      if constexpr (requires { lobe.facets; })
        return std::max(lobe.facets.alpha_x, lobe.facets.alpha_y);
      else
        return 1.0f;
    };
    return count_ > 0 ? visit(0, slope) : 1.0f;
  }

  bool scatters(Scatter letter) const {
    for (int i = 0; i < count_; ++i)
      if (visit(i, [&](const auto& l) { return l.scatters(letter); })) return true;
    return false;
  }

  Color eval_part(Scatter letter, const Vec3& wo, const Vec3& wi, Transport mode) const {
    Color f(0);
    for (int i = 0; i < count_; ++i) f += visit(i, [&](const auto& l) { return l.eval_part(letter, wo, wi, mode); });
    return f;
  }

  float pdf(const Vec3& wo, const Vec3& wi, Transport mode) const {
    const Shares shares = lobe_shares(wo);
    float p = 0;
    for (int i = 0; i < count_; ++i)
      p += shares[static_cast<size_t>(i)] * visit(i, [&](const auto& l) { return l.pdf(wo, wi, mode); });
    return p;
  }

  bool sample(const Vec3& wo, LobeDraw draw, Transport mode, LobeSample<Color>& s) const {
    if (count_ == 0) return false;
    const Shares shares = lobe_shares(wo);
    int chosen = 0;
    if (count_ == 2 && draw.choice >= shares[0]) chosen = 1;
    const float share = shares[static_cast<size_t>(chosen)];
    if (count_ == 2) draw.choice = std::min((chosen ? draw.choice - shares[0] : draw.choice) / share, kOneMinusEpsilon);
    if (!visit(chosen, [&](const auto& l) { return l.sample(wo, draw, mode, s); })) return false;
    if (count_ == 1) return true;
    if (s.delta) return s.weight /= share, true;
    s.pdf_solid_angle = pdf(wo, s.wi, mode);
    s.weight = eval(wo, s.wi, mode) * (std::abs(s.wi.z) / s.pdf_solid_angle);
    return true;
  }

  void add_deltas(const Vec3& wo, Transport mode, Deltas<Color>& deltas) const {
    const Shares shares = lobe_shares(wo);
    for (int i = 0; i < count_; ++i) {
      const int first = deltas.count;
      visit(i, [&](const auto& l) { l.add_deltas(wo, mode, deltas); });
      for (int k = first; k < deltas.count; ++k)
        deltas.probabilities[static_cast<size_t>(k)] *= shares[static_cast<size_t>(i)];
    }
  }

 private:
  using Shares = std::array<float, kMaxLobes>;

  template <class F>
  auto visit(int i, F&& f) const {
    return std::visit(f, lobes_[static_cast<size_t>(i)]);
  }

  Shares lobe_shares(const Vec3& wo) const {
    if (count_ < 2) return {1, 0};
    const float a = visit(0, [&](const auto& l) { return l.weight(wo); });
    const float b = visit(1, [&](const auto& l) { return l.weight(wo); });
    const float first = a + b > 0 ? a / (a + b) : 0.5f;
    return {first, 1 - first};
  }

  std::array<AnyLobe<Color>, kMaxLobes> lobes_;
  int count_ = 0;
};

// A model whose surfaces are all Lambertian pays for nothing else.
template <class Color>
class DiffuseOnly {
 public:
  void add(const Lambert<Color>& lobe) { lobe_ = lobe; }
  void clear() { lobe_.albedo = Color(0); }
  bool empty() const { return is_black(lobe_.albedo); }
  bool has_non_delta() const { return !empty(); }
  Color eval(const Vec3& wo, const Vec3& wi, Transport mode) const { return lobe_.eval(wo, wi, mode); }
  bool scatters(Scatter letter) const { return lobe_.scatters(letter); }
  Color eval_part(Scatter letter, const Vec3& wo, const Vec3& wi, Transport mode) const {
    return lobe_.eval_part(letter, wo, wi, mode);
  }
  float pdf(const Vec3& wo, const Vec3& wi, Transport mode) const { return lobe_.pdf(wo, wi, mode); }
  bool sample(const Vec3& wo, const LobeDraw& draw, Transport mode, LobeSample<Color>& s) const {
    return lobe_.sample(wo, draw, mode, s);
  }
  void add_deltas(const Vec3&, Transport, Deltas<Color>&) const {}

 private:
  Lambert<Color> lobe_;
};

// M is a transport model: it names Color and Lobes.
template <class M>
class Bsdf {
 public:
  using Color = typename M::Color;

  // Without lobes. `geometric_normal` and the frame's z point to the front of the surface; both must stay where they
  // are.
  void build(const Frame& shading, const Vec3& geometric_normal) {
    frame_ = &shading, ng_ = &geometric_normal;
    lobes.clear();
  }

  // After a copy: the same at a copy of the point.
  void refer_to(const Frame& shading, const Vec3& geometric_normal) { frame_ = &shading, ng_ = &geometric_normal; }

  typename M::Lobes lobes;

  bool has_non_delta() const { return lobes.has_non_delta(); }
  const Frame& frame() const { return *frame_; }

  Color eval(const Vec3& wo, const Vec3& wi, Transport mode = Transport::radiance) const {
    const Vec3 o = frame_->to_local(wo), i = frame_->to_local(wi);
    return consistent(wo, wi, o, i) ? lobes.eval(o, i, mode) * adjoint_factor(wo, wi, o, i, mode) : Color(0);
  }

  // Whether `eval` can have a part of this letter; deltas are none of it.
  bool scatters(Scatter letter) const { return lobes.scatters(letter); }

  // The part of `eval` that is of one letter.
  Color eval_part(Scatter letter, const Vec3& wo, const Vec3& wi, Transport mode = Transport::radiance) const {
    const Vec3 o = frame_->to_local(wo), i = frame_->to_local(wi);
    if (!consistent(wo, wi, o, i)) return Color(0);
    return lobes.eval_part(letter, o, i, mode) * adjoint_factor(wo, wi, o, i, mode);
  }

  float pdf(const Vec3& wo, const Vec3& wi, Transport mode = Transport::radiance) const {
    const Vec3 o = frame_->to_local(wo), i = frame_->to_local(wi);
    return consistent(wo, wi, o, i) ? lobes.pdf(o, i, mode) : 0;
  }

  // Both at once, the first times the cosine.
  struct Value {
    Color f_cos{0};
    float pdf = 0;
  };
  Value evaluate(const Vec3& wo, const Vec3& wi, Transport mode = Transport::radiance) const {
    const Vec3 o = frame_->to_local(wo), i = frame_->to_local(wi);
    if (!consistent(wo, wi, o, i)) return {};
    return {lobes.eval(o, i, mode) * (adjoint_factor(wo, wi, o, i, mode) * std::abs(i.z)), lobes.pdf(o, i, mode)};
  }

  // s.weight is f cos / pdf with the cosine to the shading normal; s.wi is in world space. False: the path ends here.
  bool sample(const Vec3& wo, const LobeDraw& draw, Transport mode, LobeSample<Color>& s) const {
    const Vec3 o = frame_->to_local(wo);
    if (o.z == 0 || !lobes.sample(o, draw, mode, s)) return false;
    const Vec3 i = s.wi;
    s.wi = frame_->to_world(i);
    if (!consistent(wo, s.wi, o, i)) return false;
    s.weight *= adjoint_factor(wo, s.wi, o, i, mode);
    return !is_black(s.weight);
  }

  // Every delta with its coefficient, in world space: what `sample` finds when it chooses one, each over the
  // probability of that choice.
  Deltas<Color> deltas(const Vec3& wo, Transport mode = Transport::radiance) const {
    Deltas<Color> all, kept;
    const Vec3 o = frame_->to_local(wo);
    if (o.z != 0) lobes.add_deltas(o, mode, all);
    for (int k = 0; k < all.count; ++k) {
      LobeSample<Color> s = all.lobes[static_cast<size_t>(k)];
      const Vec3 i = s.wi;
      s.wi = frame_->to_world(i);
      if (!consistent(wo, s.wi, o, i)) continue;
      s.weight *= adjoint_factor(wo, s.wi, o, i, mode);
      if (!is_black(s.weight)) kept.lobes[static_cast<size_t>(kept.count++)] = s;
    }
    return kept;
  }

  // The delta that takes wo to this side of the surface; d.wi is in world space, and d.value without the adjoint's
  // ratio of cosines. False if there is none.
  bool follow(const Vec3& wo, bool transmitted, Transport mode, SingleDirection<Color>& d) const {
    const Vec3 o = frame_->to_local(wo);
    Deltas<Color> all;
    if (o.z != 0) lobes.add_deltas(o, mode, all);
    d = {};
    Vec3 i(0);
    // Those of several lobes that lead the same way are one.
    for (size_t k = 0; k < static_cast<size_t>(all.count); ++k) {
      const LobeSample<Color>& lobe = all.lobes[k];
      if (lobe.transmitted != transmitted) continue;
      i = lobe.wi, d.eta = lobe.eta;
      d.value += lobe.weight, d.probability += all.probabilities[k];
    }
    if (!(d.probability > 0) || is_black(d.value)) return false;
    d.wi = frame_->to_world(i);
    return consistent(wo, d.wi, o, i);
  }

  // |cos| to the shading normal: what an integral over solid angle multiplies f by.
  float cosine(const Vec3& wi) const { return std::abs(glm::dot(frame_->z, wi)); }

 private:
  // Both normals must agree on whether the pair is a reflection or a transmission.
  bool consistent(const Vec3& wo, const Vec3& wi, const Vec3& o, const Vec3& i) const {
    return glm::dot(*ng_, wo) * o.z > 0 && glm::dot(*ng_, wi) * i.z > 0;
  }

  // Shading normals make scattering asymmetric: the adjoint carries the ratio of cosines (Veach 1997, (5.19)).
  float adjoint_factor(const Vec3& wo, const Vec3& wi, const Vec3& o, const Vec3& i, Transport mode) const {
    if (mode == Transport::radiance) return 1;
    return std::abs(o.z * glm::dot(*ng_, wi) / (i.z * glm::dot(*ng_, wo)));
  }

  const Frame* frame_ = nullptr;
  const Vec3* ng_ = nullptr;
};

}  // namespace etendue
