#include "spectrum/spectrum_names.h"

#include <algorithm>
#include <cstdlib>
#include <string_view>

#include "spectrum/illuminant_fl2.h"
#include "spectrum/spectrum_points.h"

namespace etendue {
namespace {

// A spectrum with the values of a table of the observer's wavelengths.
template <class Value>
Spectrum from_table(Value&& value) {
  std::vector<Spectrum::Sample> samples;
  for (size_t i = 0; i < kWavelengths; ++i) samples.push_back({table_wavelength(i), value(i)});
  return *Spectrum::piecewise_linear(std::move(samples));
}

}  // namespace

const std::vector<Illuminant>& illuminants() {
  static const std::vector<Illuminant> all{
      {"a", "Illuminant A, incandescent light", "CIE 15:2004; a black body of 2855.54 K",
       [] { return *Spectrum::blackbody(2855.54); }},
      {"d65", "Illuminant D65, daylight", "CIE 15:2004",
       [] { return from_table([](size_t i) { return d65_at(table_wavelength(i)); }); }},
      {"e", "Illuminant E, equal energy", "CIE 15:2004", [] { return Spectrum::constant(1); }},
      {"fl2", "Illuminant FL2, fluorescent tube", "CIE 15:2004",
       [] { return from_table([](size_t i) { return kIlluminantFl2[i]; }); }}};
  return all;
}

Result<Spectrum> find_spectrum(const std::string& name) {
  for (const Illuminant& illuminant : illuminants())
    if (name == illuminant.name) return illuminant.make();
  if (is_point_list(name)) return spectrum_of_points(name);
  char* end = nullptr;
  const double kelvin = std::strtod(name.c_str(), &end);
  if (end != name.c_str() && std::string_view(end) == "K") return Spectrum::blackbody(kelvin);
  return read_spectrum(name);
}

bool names_spectrum_file(const std::string& name) {
  if (std::ranges::find(illuminants(), name, &Illuminant::name) != illuminants().end()) return false;
  if (is_point_list(name)) return false;
  char* end = nullptr;
  std::strtod(name.c_str(), &end);
  return end == name.c_str() || std::string_view(end) != "K";
}

}  // namespace etendue
