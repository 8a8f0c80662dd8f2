// The base of lobes that consist of deltas only: value, density and components are 0.
#pragma once
#include "bsdf/lobe.h"

namespace etendue {

template <class Color>
struct DeltaLobe {
  bool is_delta() const { return true; }
  float alpha() const { return 0; }
  Color eval(const Vec3&, const Vec3&, TransportMode) const { return Color(0); }
  float pdf(const Vec3&, const Vec3&, TransportMode) const { return 0; }
  bool has_component(ScatterType) const { return false; }
  Color eval_component(ScatterType, const Vec3&, const Vec3&, TransportMode) const { return Color(0); }

 protected:
  static Vec3 mirrored(const Vec3& w) { return {-w.x, -w.y, w.z}; }
};

}  // namespace etendue
