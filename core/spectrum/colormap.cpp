#include "spectrum/colormap.h"

#include <array>

namespace etendue {

Rgb viridis(float x) {
  // Nine evenly spaced colours of the published table, interpolated linearly.
  static constexpr std::array<Rgb, 9> kStops{{{0.2670f, 0.0049f, 0.3294f},
                                              {0.2783f, 0.1803f, 0.4867f},
                                              {0.2297f, 0.3223f, 0.5457f},
                                              {0.1727f, 0.4488f, 0.5579f},
                                              {0.1276f, 0.5669f, 0.5506f},
                                              {0.1579f, 0.6838f, 0.5017f},
                                              {0.3692f, 0.7889f, 0.3829f},
                                              {0.6785f, 0.8637f, 0.1895f},
                                              {0.9932f, 0.9062f, 0.1439f}}};
  const float position = std::clamp(x, 0.0f, 1.0f) * 8;
  const auto cell = std::min(static_cast<size_t>(position), size_t{7});
  return mix(kStops[cell], kStops[cell + 1], position - static_cast<float>(cell));
}

Rgb diverging_color(float x) {
  constexpr Rgb kWhite(0.97f, 0.97f, 0.97f), kBlue(0.13f, 0.40f, 0.67f), kRed(0.70f, 0.09f, 0.17f);
  const float clamped = std::clamp(x, -1.0f, 1.0f);
  return mix(kWhite, clamped < 0 ? kBlue : kRed, std::abs(clamped));
}

}  // namespace etendue
