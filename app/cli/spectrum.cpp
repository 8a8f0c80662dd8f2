// etendue spectrum: colour and luminous efficacy of the spectrum of a light.
#include "spectrum/spectrum.h"

#include <cstdio>
#include <memory>

#include "base/number_text.h"
#include "command.h"
#include "json.h"
#include "scene_options.h"
#include "spectrum/blackbody.h"

namespace etendue::cli {
namespace {

struct SpectrumArguments {
  std::string subject;
  bool json = false;
};

// A name of the registry, a temperature such as "2700K", or a file.
Result<Spectrum> find_spectrum(const std::string& subject) {
  for (const Illuminant& illuminant : illuminants())
    if (subject == illuminant.name) return illuminant.make();
  char* end = nullptr;
  const double kelvin = std::strtod(subject.c_str(), &end);
  if (end != subject.c_str() && std::string_view(end) == "K") return Spectrum::blackbody(kelvin);
  return read_spectrum(subject);
}

json spectrum_json(const std::string& subject, const Spectrum& spectrum) {
  const Xyz c = spectrum.xyz();
  const double sum = c.x + c.y + c.z;
  const auto rgb = spectrum.rgb();
  const Rgb shown(static_cast<float>(std::max(rgb[0], 0.0)), static_cast<float>(std::max(rgb[1], 0.0)),
                  static_cast<float>(std::max(rgb[2], 0.0)));
  return {{"spectrum", subject},
          {"chromaticity", sum > 0 ? json{c.x / sum, c.y / sum} : json()},
          {"rgb", rgb},
          {"nearest_temperature", sum > 0 ? number_json(nearest_temperature(shown)) : json()},
          {"luminous_efficacy", spectrum.luminous_efficacy()}};
}

void print_spectrum(const json& j) {
  std::printf("%s\n", j["spectrum"].get<std::string>().c_str());
  if (j["chromaticity"].is_null()) {
    std::printf("  black between 380 and 780 nm\n");
    return;
  }
  std::printf("  chromaticity        x %.5f, y %.5f\n", j["chromaticity"][0].get<double>(),
              j["chromaticity"][1].get<double>());
  std::printf("  linear sRGB         %.4f, %.4f, %.4f, with luminance 1\n", j["rgb"][0].get<double>(),
              j["rgb"][1].get<double>(), j["rgb"][2].get<double>());
  std::printf("  nearest temperature %.0f K\n", j["nearest_temperature"].get<double>());
  std::printf("  luminous efficacy   %.1f lm/W between 380 and 780 nm\n", j["luminous_efficacy"].get<double>());
}

}  // namespace

Command spectrum_command() {
  const auto a = std::make_shared<SpectrumArguments>();
  return {.name = "spectrum",
          .summary = "Show colour and luminous efficacy of the spectrum of a light",
          .options = {{.names = "subject",
                       .target = &a->subject,
                       .doc = "An illuminant of `list spectra`, a temperature such as 2700K, or a file with a "
                              "wavelength in nm and a value per row",
                       .required = true},
                      json_flag(a->json)},
          .run = [a] {
            const auto spectrum = find_spectrum(a->subject);
            if (!spectrum) return fail(spectrum.error());
            const json result = spectrum_json(a->subject, *spectrum);
            if (a->json)
              std::printf("%s\n", result.dump(2).c_str());
            else
              print_spectrum(result);
            return 0;
          }};
}

}  // namespace etendue::cli
