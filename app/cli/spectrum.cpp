// etendue spectrum: colour and luminous efficacy of the spectrum of a light.
#include "spectrum/spectrum_names.h"

#include <cmath>
#include <cstdio>
#include <memory>

#include "base/number_text.h"
#include "command.h"
#include "json.h"
#include "scene_options.h"
#include "spectrum/basis_expansion.h"
#include "spectrum/blackbody.h"
#include "spectrum/uplift.h"

namespace etendue::cli {
namespace {

struct SpectrumArguments {
  std::string subject;
  int functions = 0;
  bool json = false;
};

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

// The L2 error of an approximation relative to the spectrum, and the largest error of a component of its linear sRGB
// value. Both spectra are scaled to a luminance of 1.
json approximation_json(const std::string& name, int numbers, double relative_error, const Xyz& xyz,
                        const Spectrum& spectrum) {
  const auto shown = spectrum.rgb();
  const auto rgb = rgb_of({xyz.x / spectrum.xyz().y, xyz.y / spectrum.xyz().y, xyz.z / spectrum.xyz().y});
  double largest = 0;
  for (size_t c = 0; c < 3; ++c) largest = std::max(largest, std::abs(rgb[c] - shown[c]));
  return {{"approximation", name}, {"numbers", numbers}, {"relative_error", relative_error}, {"color_error", largest}};
}

// The smooth spectrum of the RGB colour, which rendering uses where only the colour is known.
json smooth_approximation_json(const Spectrum& spectrum) {
  const auto rgb = spectrum.rgb();
  const Rgb color(static_cast<float>(std::max(rgb[0], 0.0)), static_cast<float>(std::max(rgb[1], 0.0)),
                  static_cast<float>(std::max(rgb[2], 0.0)));
  const double scale = spectrum.xyz().y / find_spectrum("d65")->xyz().y;
  std::vector<Spectrum::Sample> samples;
  double squared = 0, norm = 0;
  for (int nm = 380; nm <= 780; ++nm) {
    Wavelengths wavelengths;
    wavelengths.nm.fill(static_cast<float>(nm));
    samples.push_back(
        {static_cast<double>(nm), scale * d65_at(nm) * static_cast<double>(uplift_emission(color, wavelengths)[0])});
    squared += std::pow(samples.back().value - spectrum(nm), 2);
    norm += std::pow(spectrum(nm), 2);
  }
  const Spectrum smooth = *Spectrum::piecewise_linear(std::move(samples));
  return approximation_json("smooth spectrum of the colour", 3, std::sqrt(squared / norm), smooth.xyz(), spectrum);
}

json approximations_json(const Spectrum& spectrum, int functions) {
  json list = json::array();
  const auto& options = Options<SpectralBasis>::kOptions;
  for (size_t i = 0; i < options.size(); ++i) {
    const BasisExpansion expansion(static_cast<SpectralBasis>(i), static_cast<size_t>(functions), spectrum);
    list.push_back(
        approximation_json(options[i].name, functions, expansion.relative_error(spectrum), expansion.xyz(), spectrum));
  }
  list.push_back(smooth_approximation_json(spectrum));
  return list;
}

void print_approximations(const json& list) {
  std::printf("  %-30s %7s %15s %12s\n", "approximation", "numbers", "relative error", "sRGB error");
  for (const json& j : list)
    std::printf("  %-30s %7d %15.4f %12.4f\n", j["approximation"].get<std::string>().c_str(), j["numbers"].get<int>(),
                j["relative_error"].get<double>(), j["color_error"].get<double>());
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
                      {.names = "--basis",
                       .target = &a->functions,
                       .doc = "Also the errors of sums of this many basis functions: boxes, samples, sines and "
                              "Gaussians",
                       .bounds = between(1, static_cast<double>(BasisExpansion::kMostFunctions))},
                      json_flag(a->json)},
          .run = [a] {
            const auto spectrum = find_spectrum(a->subject);
            if (!spectrum) return fail(spectrum.error());
            json result = spectrum_json(a->subject, *spectrum);
            if (a->functions > 0 && !result["chromaticity"].is_null())
              result["approximations"] = approximations_json(*spectrum, a->functions);
            if (a->json)
              std::printf("%s\n", result.dump(2).c_str());
            else
              print_spectrum(result);
            if (!a->json && result.contains("approximations")) print_approximations(result["approximations"]);
            return 0;
          }};
}

}  // namespace etendue::cli
