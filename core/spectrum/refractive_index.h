// The index of refraction of transparent media by wavelength.
//
//   Sellmeier   n^2 = 1 + sum of B_k lambda^2 / (lambda^2 - C_k)
//   Cauchy      n = A + B / lambda^2, from the index at the d line and the Abbe number       [KHR_materials_dispersion]
//
// The Abbe number is V = (n_d - 1) / (n_F - n_C), with the lines d 587.56 nm, F 486.13 nm and C 656.27 nm.
#pragma once
#include <array>
#include <cstdint>

#include "base/parameter.h"

namespace etendue {

// Media with a Sellmeier formula.
enum class Glass : uint8_t { none, n_bk7, n_sf11, fused_silica, diamond, water };

struct SellmeierFormula {
  Glass glass;
  const char *name, *label, *source;
  std::array<double, 4> b, c;  // c in square micrometres

  // `wavelength` in nm.
  double index(double wavelength) const;
  double index_d() const;
  // The parameter of KHR_materials_dispersion, 20 / V.
  double dispersion() const;
};

// All of them.
const std::array<SellmeierFormula, 5>& sellmeier_formulas();
// Null for Glass::none.
const SellmeierFormula* find_sellmeier(Glass glass);

struct RefractiveIndex {
  float index_d = 1;     // at the d line
  float dispersion = 0;  // 20 / Abbe number; 0: the same index at all wavelengths
  Glass glass = Glass::none;

  bool varies() const { return glass != Glass::none || (dispersion > 0 && index_d > 1); }
  // The index at a wavelength in nm, at least 1 if `varies`.
  float at(float wavelength) const;
  friend bool operator==(const RefractiveIndex&, const RefractiveIndex&) = default;
};

}  // namespace etendue

template <>
struct etendue::Options<etendue::Glass> {
  static constexpr std::array<etendue::Option, 6> kOptions{{{"none", "None"},
                                                            {"n-bk7", "Schott N-BK7 (crown)"},
                                                            {"n-sf11", "Schott N-SF11 (flint)"},
                                                            {"fused-silica", "Fused silica"},
                                                            {"diamond", "Diamond"},
                                                            {"water", "Water at 20 degrees"}}};
};
