#include "render/division.h"

#include <cctype>

#include "integrator/integrator_info.h"

namespace etendue::render {
namespace {

std::string dividing_integrators(bool regions) {
  std::string names;
  for (const auto& info : integrator::integrator_infos()) {
    if (info.division.unit == integrator::DivisionUnit::none || (regions && !info.division.regions)) continue;
    names += (names.empty() ? "" : ", ") + info.name;
  }
  return names;
}

// "The chains continue." as a part of a sentence: "the chains continue".
std::string clause(std::string sentence) {
  if (!sentence.empty()) sentence[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(sentence[0])));
  if (sentence.ends_with('.')) sentence.pop_back();
  return sentence;
}

}  // namespace

std::string division_incompatibility(const Document& document) {
  if (document.automatic.is_pending())
    return "the automatic choice of the integrator may differ between parts: name an integrator, or use --like";
  const auto& info = *integrator::find_integrator(document.method.integrator);
  const auto& division = info.division;
  if (division.unit == integrator::DivisionUnit::none)
    return info.name + " does not divide into samples, because " + clause(division.reason) + ": use one of " +
           dividing_integrators(false);
  const PixelRect all{0, 0, document.width, document.height};
  if (document.part.region.value_or(all) != all && !division.regions)
    return info.name + " does not divide into regions: " + clause(division.reason) +
           "; divide by --samples, or use one of " + dividing_integrators(true);
  if (document.method.adaptive != Adaptive::off)
    return "adaptive sampling does not divide, because the sample counts follow from all earlier samples: set "
           "render.adaptive to off";
  if (document.fireflies == film::Fireflies::reweight)
    return "the re-weighting of fireflies does not divide, because it needs the brightness of each sample: set "
           "film.fireflies to keep";
  return {};
}

}  // namespace etendue::render
