// Spherical harmonics: the orthonormal functions Y_lm on the unit sphere, l = 0, 1, ..., m = -l, ..., l.
//                                                                                     [Lang, Def. 2.34, eq. 2.340-2.344]
//
//   complex   Y_lm = p_lm(cos theta) e^(i m phi) / sqrt(2 pi)
//   real      p_lm cos(m phi) / sqrt(pi) for m > 0,   p_l0 / sqrt(2 pi),   p_l|m| sin(|m| phi) / sqrt(pi) for m < 0
//
// p_lm are associated Legendre functions whose squares have the integral 1 over [-1, 1], with the sign (-1)^m of Condon and
// Shortley. A function of `bands` bands has bands^2 coefficients; that of Y_lm has the index l (l + 1) + m.
#pragma once
#include <cmath>
#include <complex>
#include <cstddef>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

namespace etendue {

// Nodes and weights of Gauss and Legendre on [0, 1], exact for polynomials of degree 2 n - 1.
struct GaussLegendre {
  std::vector<double> x, weight;
  explicit GaussLegendre(int n);
};

// |p_lm(z)| with the sign of the polynomial but without (-1)^m, for all l from m to bands - 1; p[l]. `diagonal` is
// p_mm(z).
template <class T, class Array>
void normalized_legendre(int bands, int m, T z, T diagonal, Array& p) {
  p[static_cast<size_t>(m)] = diagonal;
  T previous = 0, current = diagonal;
  for (int l = m + 1; l < bands; ++l) {
    const T l2 = static_cast<T>(l * l), m2 = static_cast<T>(m * m), b2 = static_cast<T>((l - 1) * (l - 1));
    const T a = std::sqrt((4 * l2 - 1) / (l2 - m2));
    const T c = l > m + 1 ? std::sqrt((b2 - m2) / (4 * b2 - 1)) : T(0);
    const T next = a * (z * current - c * previous);
    previous = current;
    current = next;
    p[static_cast<size_t>(l)] = current;
  }
}

// p_mm(z) from `previous`, that of m - 1, with sine = sqrt(1 - z^2). The first one is sqrt(1/2).
template <class T>
T next_legendre_diagonal(int m, T sine, T previous) {
  return previous * sine * std::sqrt(static_cast<T>(2 * m + 1) / static_cast<T>(2 * m));
}

using HarmonicDirection = glm::dvec3;  // unit
using HarmonicCoefficients = std::vector<double>;

constexpr size_t harmonic_count(int bands) { return static_cast<size_t>(bands * bands); }
constexpr size_t harmonic_index(int l, int m) { return static_cast<size_t>(l * (l + 1) + m); }

double real_harmonic(int l, int m, const HarmonicDirection& direction);
std::complex<double> complex_harmonic(int l, int m, const HarmonicDirection& direction);
// All real harmonics of the first bands.
HarmonicCoefficients real_harmonics(int bands, const HarmonicDirection& direction);

// The coefficients of f. The quadrature has `nodes` polar angles and twice as many azimuths in each hemisphere z > 0 and
// z < 0; it is exact if f times Y is a polynomial of degree below `nodes` in each of them.
HarmonicCoefficients project_on_harmonics(const std::function<double(const HarmonicDirection&)>& f, int bands,
                                          int nodes = 64);
double evaluate_harmonics(const HarmonicCoefficients& c, const HarmonicDirection& direction);

// The integral of the product of two functions.
double harmonic_product(const HarmonicCoefficients& a, const HarmonicCoefficients& b);

// The coefficients of the function w -> f(R^-1 w) for those of f. `rotation` must be orthonormal.
HarmonicCoefficients rotate_harmonics(const HarmonicCoefficients& c, const glm::dmat3& rotation);

// The coefficient (l, 0) of the clamped cosine max(cos theta, 0); those with m != 0 vanish.  [Ramamoorthi and Hanrahan 2001]
double clamped_cosine_coefficient(int l);

// The coefficients of the integral of kernel(w . w') f(w') over w', where `zonal` are the coefficients (l, 0) of the kernel
// (theorem of Funk and Hecke). With the clamped cosine: irradiance from radiance.
HarmonicCoefficients convolve_harmonics(const HarmonicCoefficients& c, const std::vector<double>& zonal);

}  // namespace etendue
