// Participating media as a user edits them, and homogeneous media.                            [Lang, sec. 4.1.2]
#pragma once
#include <memory>

#include "medium/density_field.h"
#include "medium/phase_function.h"
#include "spectrum/rgb.h"

namespace etendue {

// How the transmittance of a heterogeneous medium is estimated. All of them are unbiased.
enum class TransmittanceEstimator : uint8_t { delta, ratio, residual_ratio, regular };

template <>
struct Options<TransmittanceEstimator> {
  static constexpr std::array<Option, 4> kOptions{{{"delta", "Delta tracking"},
                                                   {"ratio", "Ratio tracking"},
                                                   {"residual-ratio", "Residual ratio tracking"},
                                                   {"regular", "Regular tracking"}}};
};

// A medium as a user edits it. The coefficients are probabilities per length, in 1/m.
struct MediumDescription {
  Rgb scattering{0};
  Rgb absorption{0};
  PhaseFunctionRef phase;
  // The source function of emission: the radiance of the medium where it is optically thick and does not scatter. The
  // emission coefficient is the product with the absorption coefficient.                      [Lang, sec. 4.1.2]
  Rgb emission{0};
  // Of the hottest part, kelvin; it gives `emission` the colour of a black body. 0: no dependence on the temperature.
  float temperature = 0;
  DensityRef density = {};  // factor on all coefficients; null in homogeneous media
  TransmittanceEstimator estimator = TransmittanceEstimator::residual_ratio;

  bool scatters() const { return !is_black(scattering); }
  bool emits() const { return !is_black(emission) && !is_black(absorption); }
  bool is_heterogeneous() const { return density && !is_clear(); }
  // Whether paths through it need more than Beer's law.
  bool is_volume() const { return scatters() || emits() || is_heterogeneous(); }
  // Whether light passes it as it passes a vacuum.
  bool is_clear() const { return is_black(scattering) && is_black(absorption); }
  friend bool operator==(const MediumDescription&, const MediumDescription&) = default;
};

// A medium in the form that rendering reads.
struct HomogeneousMedium {
  Rgb scattering{0};  // 1/m
  Rgb extinction{0};  // scattering plus absorption, 1/m
  Rgb emission{0};    // radiance per metre
  std::shared_ptr<const PhaseFunction> phase;

  HomogeneousMedium() = default;
  explicit HomogeneousMedium(const MediumDescription& m);

  bool scatters() const { return !is_black(scattering); }
  bool emits() const { return !is_black(emission); }
  // Optical depth of a path of this length in metres, which may be infinite.
  Rgb optical_depth(float length) const {
    Rgb depth;
    for (int c = 0; c < 3; ++c) depth[c] = extinction[c] > 0 ? extinction[c] * length : 0;
    return depth;
  }
  // exp(-optical depth).                                                                     [Lang, eq. 4.59]
  Rgb transmittance(float length) const {
    const Rgb depth = optical_depth(length);
    return {std::exp(-depth.r), std::exp(-depth.g), std::exp(-depth.b)};
  }
  // The radiance that this length of the medium emits towards its start.                     [Lang, eq. 4.59]
  Rgb emitted(float length) const;
};

}  // namespace etendue
