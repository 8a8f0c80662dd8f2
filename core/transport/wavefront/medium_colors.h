// The coefficients of media in the colours of a path: RGB, or its wavelengths.
#pragma once
#include "scene/compiled_scene.h"

namespace etendue::transport {

template <class Color>
struct MediumColors;

template <>
struct MediumColors<Rgb> {
  static const MediumCoefficients<Rgb>& of(const HomogeneousMedium& medium) { return medium; }
  static const HeterogeneousCoefficients<Rgb>& of(const HeterogeneousMedium& medium) { return medium; }
  // Of a solid that only absorbs, over a distance in metres.
  static Rgb transmittance(const scene::Solid& solid, float distance) { return solid.transmittance(distance); }
};

template <>
struct MediumColors<SampledSpectrum> {
  const Wavelengths* wavelengths = nullptr;

  MediumCoefficients<SampledSpectrum> of(const HomogeneousMedium& medium) const { return medium.at(*wavelengths); }
  HeterogeneousCoefficients<SampledSpectrum> of(const HeterogeneousMedium& medium) const {
    return medium.at(*wavelengths);
  }
  SampledSpectrum transmittance(const scene::Solid& solid, float distance) const {
    return solid.transmittance_at(*wavelengths, distance);
  }
};

}  // namespace etendue::transport
