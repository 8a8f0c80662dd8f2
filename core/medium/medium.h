// Homogeneous participating media.                                                            [Lang, sec. 4.1.2]
#pragma once
#include <memory>

#include "medium/phase_function.h"
#include "spectrum/rgb.h"

namespace etendue {

// A medium as a user edits it. The coefficients are probabilities per length, in 1/m.
struct MediumDescription {
  Rgb scattering{0};
  Rgb absorption{0};
  PhaseFunctionRef phase;

  bool scatters() const { return !is_black(scattering); }
  // Whether light passes it as it passes a vacuum.
  bool is_clear() const { return is_black(scattering) && is_black(absorption); }
  friend bool operator==(const MediumDescription&, const MediumDescription&) = default;
};

// A medium in the form that rendering reads.
struct HomogeneousMedium {
  Rgb scattering{0};  // 1/m
  Rgb extinction{0};  // scattering plus absorption, 1/m
  std::shared_ptr<const PhaseFunction> phase;

  HomogeneousMedium() = default;
  explicit HomogeneousMedium(const MediumDescription& m)
      : scattering(m.scattering), extinction(m.scattering + m.absorption), phase(m.phase.get()) {}

  bool scatters() const { return !is_black(scattering); }
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
};

}  // namespace etendue
