// A plane mirror: one delta.                                     thesis (4.116)-(4.123), items 33, 34, erratum E6
//
//   f = tint F(cos) delta(wi - mirrored wo) / cos
#pragma once
#include "material/fresnel_term.h"
#include "material/lobe.h"

namespace etendue {

// Fresnel: from the cosine to a reflectance by band.
template <class Color, class Fresnel = FresnelTerm<Color>>
struct Mirror {
  Color tint{1};
  Fresnel fresnel;

  bool is_delta() const { return true; }
  float weight(const Vec3& wo) const { return average(reflected(wo)); }
  float slope() const { return 0; }

  Color eval(const Vec3&, const Vec3&, Transport) const { return Color(0); }
  float pdf(const Vec3&, const Vec3&, Transport) const { return 0; }
  bool scatters(Scatter) const { return false; }
  Color eval_part(Scatter, const Vec3&, const Vec3&, Transport) const { return Color(0); }

  bool sample(const Vec3& wo, const LobeDraw&, Transport, LobeSample<Color>& s) const {
    s.wi = mirrored(wo);
    s.weight = reflected(wo);
    s.scatter = Scatter::specular;
    s.delta = true;
    return true;
  }
  void add_deltas(const Vec3& wo, Transport, Deltas<Color>& deltas) const {
    deltas.reflect(mirrored(wo), reflected(wo), 1);
  }

 private:
  static Vec3 mirrored(const Vec3& w) { return {-w.x, -w.y, w.z}; }
  Color reflected(const Vec3& wo) const { return tint * fresnel(std::abs(wo.z)); }
};

}  // namespace etendue
