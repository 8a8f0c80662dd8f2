// A BRDF that is data, as a lobe. The lobe references the data, which stay valid until the program ends
// (measured_data.h).
#pragma once
#include "bsdf/lobes/opaque_lobe.h"

namespace etendue {

// Data defines f(o, i), density(o, i), sample_direction(o, random, i) and alpha() as OpaqueLobe requires, and
// albedo(o).
template <class ColorType, class Data>
struct MeasuredLobe : OpaqueLobe<ColorType, MeasuredLobe<ColorType, Data>> {
  const Data* data = nullptr;
  ColorType tint{1};

  static MeasuredLobe of(const Data& data, const ColorType& tint) {
    MeasuredLobe lobe;
    lobe.data = &data;
    lobe.tint = tint;
    return lobe;
  }

  ColorType f(const Vec3& o, const Vec3& i) const { return tint * data->f(o, i); }
  float density(const Vec3& o, const Vec3& i) const { return data->density(o, i); }
  bool sample_direction(const Vec3& o, const LobeRandom& random, Vec3& i) const {
    return data->sample_direction(o, random, i);
  }
  float sampling_weight(const Vec3& wo) const { return average(tint) * data->albedo(wo); }
  float alpha() const { return data->alpha(); }
};

}  // namespace etendue
