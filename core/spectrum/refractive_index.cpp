#include "spectrum/refractive_index.h"

#include <algorithm>
#include <cmath>

namespace etendue {
namespace {

constexpr double kLineD = 587.56, kLineF = 486.13, kLineC = 656.27;  // nm

}  // namespace

double SellmeierFormula::index(double wavelength) const {
  const double squared = wavelength * wavelength * 1e-6;  // square micrometres
  double n2 = 1;
  for (size_t k = 0; k < b.size(); ++k) n2 += b[k] * squared / (squared - c[k]);
  return std::sqrt(n2);
}

double SellmeierFormula::index_d() const { return index(kLineD); }

double SellmeierFormula::dispersion() const { return 20 * (index(kLineF) - index(kLineC)) / (index_d() - 1); }

const std::array<SellmeierFormula, 5>& sellmeier_formulas() {
  static const std::array<SellmeierFormula, 5> formulas{
      {{Glass::n_bk7,
        "n-bk7",
        "Schott N-BK7 (crown)",
        "Schott glass catalogue",
        {1.03961212, 0.231792344, 1.01046945, 0},
        {0.00600069867, 0.0200179144, 103.560653, 0}},
       {Glass::n_sf11,
        "n-sf11",
        "Schott N-SF11 (flint)",
        "Schott glass catalogue",
        {1.73759695, 0.313747346, 1.89878101, 0},
        {0.013188707, 0.0623068142, 155.23629, 0}},
       {Glass::fused_silica,
        "fused-silica",
        "Fused silica",
        "Malitson 1965",
        {0.6961663, 0.4079426, 0.8974794, 0},
        {0.0684043 * 0.0684043, 0.1162414 * 0.1162414, 9.896161 * 9.896161, 0}},
       {Glass::diamond,
        "diamond",
        "Diamond",
        "Peter 1923",
        {0.3306, 4.3356, 0, 0},
        {0.1750 * 0.1750, 0.1060 * 0.1060, 0, 0}},
       {Glass::water,
        "water",
        "Water at 20 degrees",
        "Daimon and Masumura 2007",
        {0.5684027565, 0.1726177391, 0.02086189578, 0.1130748688},
        {0.005101829712, 0.01821153936, 0.02620722293, 10.69792721}}}};
  return formulas;
}

const SellmeierFormula* find_sellmeier(Glass glass) {
  for (const SellmeierFormula& formula : sellmeier_formulas())
    if (formula.glass == glass) return &formula;
  return nullptr;
}

float RefractiveIndex::at(float wavelength) const {
  if (const SellmeierFormula* formula = find_sellmeier(glass)) return static_cast<float>(formula->index(wavelength));
  if (!varies()) return index_d;
  constexpr double kSlope = 1 / (1 / (kLineF * kLineF) - 1 / (kLineC * kLineC));  // nm^2
  const double slope = (index_d - 1.0) * dispersion / 20 * kSlope;
  const double n = index_d + slope * (1 / (double{wavelength} * wavelength) - 1 / (kLineD * kLineD));
  return static_cast<float>(std::max(n, 1.0));
}

}  // namespace etendue
