// Spectra as sums of basis functions.                                          [Lang, thm. 2.1, ex. 2.10, ex. 2.11]
//
//   S(lambda) ~ sum over i of c_i phi_i(lambda),     380 nm <= lambda <= 780 nm
//
// The coefficients minimise the L2 error. Of an orthonormal basis they are the inner products <S, phi_i>; in general
// they solve the linear system of the mass matrix <phi_i, phi_j>. Colours are linear in the coefficients: XYZ and RGB
// follow from a matrix of the inner products of basis and colour matching functions [Lang, ex. 2.21].
#pragma once
#include <vector>

#include "base/parameter.h"
#include "spectrum/spectrum.h"

namespace etendue {

enum class SpectralBasis : uint8_t {
  boxes,          // 1 on one of n equal intervals                                                  [Lang, eq. 2.38]
  samples,        // the values in the middle of n equal intervals, in place of inner products     [Lang, eq. 2.39]
  trigonometric,  // 1, cos, sin, cos 2, sin 2, ... of one period                                   [Lang, eq. 2.40]
  gaussians,      // n equidistant functions; the half width is 1.5 times their distance            [Lang, eq. 2.41]
};

class BasisExpansion {
 public:
  static constexpr size_t kMostFunctions = 64;

  // The best approximation of a spectrum by `count` functions, from 1 to kMostFunctions.
  BasisExpansion(SpectralBasis basis, size_t count, const Spectrum& spectrum);
  // The sum of three functions with a linear sRGB value as a reflectance under illuminant D65. It may be negative or
  // exceed 1, unlike the spectra of uplift.h.
  static BasisExpansion of_color(SpectralBasis basis, const std::array<double, 3>& rgb);

  const std::vector<double>& coefficients() const { return coefficients_; }
  double operator()(double wavelength) const;
  Xyz xyz() const;

  // The L2 norm of the difference to a spectrum over that of the spectrum.
  double relative_error(const Spectrum& spectrum) const;

 private:
  BasisExpansion(SpectralBasis basis, size_t count) : basis_(basis), coefficients_(count) {}

  double function(size_t i, double wavelength) const;

  SpectralBasis basis_;
  std::vector<double> coefficients_;
};

}  // namespace etendue

template <>
struct etendue::Options<etendue::SpectralBasis> {
  static constexpr std::array<etendue::Option, 4> kOptions{
      {{"boxes", "Boxes"}, {"samples", "Samples"}, {"trigonometric", "Trigonometric"}, {"gaussians", "Gaussians"}}};
};
