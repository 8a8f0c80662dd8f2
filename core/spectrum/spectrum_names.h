// Spectra of light by name.
#pragma once
#include <string>
#include <vector>

#include "spectrum/spectrum.h"

namespace etendue {

// Illuminants by name.
struct Illuminant {
  const char *name, *label, *source;
  Spectrum (*make)();
};
const std::vector<Illuminant>& illuminants();

// A spectrum by the name of an illuminant, a temperature such as "2700K", points such as "400:0.2 700:1"
// (spectrum_points.h), or the path of a file.
Result<Spectrum> find_spectrum(const std::string& name);
// Whether a name that `find_spectrum` accepts is that of a file.
bool names_spectrum_file(const std::string& name);

}  // namespace etendue
