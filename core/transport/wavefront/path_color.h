// The colours of the paths of a wavefront: RGB values of the scene as colours of the transport model, and back.
//
// In RGB models the functions return their arguments. In the spectral model each path has its own wavelengths.
#pragma once
#include <array>

#include "sampling/sampler.h"
#include "spectrum/uplift.h"
#include "transport/model_types.h"
#include "transport/wavefront/medium_colors.h"

namespace etendue::transport {

template <class M, bool spectral = M::kSpectral>
class PathColor;

template <class M>
class PathColor<M, false> {
 public:
  // Emitted light with this RGB value. `spectrum` is that of the emitter, or null.
  static const Rgb& emission(int, const Rgb& color, const EmissionSpectrum*) { return color; }
  static MediumColors<Rgb> media(int) { return {}; }
  static const Rgb& to_rgb(int, const Rgb& color) { return color; }
};

template <class M>
class PathColor<M, true> {
 public:
  using Color = typename M::Color;

  void start(int path, float random) { at(path) = sample_wavelengths(random); }
  const Wavelengths& wavelengths(int path) const { return wavelengths_[static_cast<size_t>(path)]; }

  Color emission(int path, const Rgb& color, const EmissionSpectrum* spectrum) const {
    if (spectrum) return spectrum->emission(color, wavelengths(path));
    // Many paths in succession find the same light.
    if (!(color == last_color_)) {
      last_color_ = color;
      last_emission_ = RgbSpectrum::emission(color);
    }
    return last_emission_.at(wavelengths(path));
  }
  MediumColors<Color> media(int path) const { return {&wavelengths(path)}; }
  // An unbiased estimate of the RGB value.
  Rgb to_rgb(int path, const Color& color) const { return rgb_estimate(color, wavelengths(path)); }

  // Ends the secondary wavelengths, whose paths deviate from that of the hero wavelength. The hero wavelength takes
  // over their weight: `weight` is one over its share of the density of the path, four without scattering media.
  void end_secondary(int path, float weight, Color& throughput) {
    at(path).hero_only = true;
    Color hero(0);
    hero[0] = weight * throughput[0];
    throughput = hero;
  }

 private:
  Wavelengths& at(int path) { return wavelengths_[static_cast<size_t>(path)]; }

  std::array<Wavelengths, SampleTable::kPaths> wavelengths_;
  // The spectrum of the colour that was converted last.
  mutable Rgb last_color_{0};
  mutable RgbSpectrum last_emission_;
};

}  // namespace etendue::transport
