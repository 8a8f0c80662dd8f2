// Conversions of lobes from RGB to the wavelengths of a path: `to_spectral`, one overload for each lobe whose colours
// are converted once. All other lobes convert their values at each evaluation (uplifted_lobe.h).
#include "bsdf/spectral_lobes.h"

#include <new>

#include "bsdf/all_lobe_types.h"
#include "bsdf/fresnel/spectral_fresnel.h"
#include "bsdf/fresnel/spectral_thin_film.h"
#include "bsdf/uplifted_lobe.h"

namespace etendue {
namespace {

template <class Lobe>
UpliftedLobe<Lobe> to_spectral(const Lobe& lobe, const Wavelengths& wavelengths) {
  return {lobe, &wavelengths};
}

Lambert<SampledSpectrum> to_spectral(const Lambert<Rgb>& lobe, const Wavelengths& wavelengths) {
  return {uplift_reflectance(lobe.albedo, wavelengths)};
}

MetallicRoughness<SampledSpectrum> to_spectral(const MetallicRoughness<Rgb>& from, const Wavelengths& wavelengths) {
  MetallicRoughness<SampledSpectrum> lobe;
  lobe.f0 = uplift_reflectance(from.f0, wavelengths);
  lobe.f90 = uplift_reflectance(from.f90, wavelengths);
  lobe.dielectric_f0 = from.dielectric_f0;
  lobe.dielectric_f90 = from.dielectric_f90;
  lobe.base = uplift_reflectance(from.base, wavelengths);
  lobe.facets = from.facets;
  lobe.normalization = from.normalization;
  return lobe;
}

Dielectric<SampledSpectrum> to_spectral(const Dielectric<Rgb>& from, const Wavelengths& wavelengths) {
  Dielectric<SampledSpectrum> lobe;
  lobe.tint = uplift_reflectance(from.tint, wavelengths);
  lobe.eta = from.eta;
  lobe.share = from.share;
  lobe.facets = from.facets;
  return lobe;
}

Mirror<SampledSpectrum> to_spectral(const Mirror<Rgb>& from, const Wavelengths& wavelengths) {
  Mirror<SampledSpectrum> lobe;
  lobe.tint = uplift_reflectance(from.tint, wavelengths);
  lobe.fresnel = FresnelTerm<SampledSpectrum>::of(from.fresnel, wavelengths);
  return lobe;
}

template <class Facets>
MicrofacetReflection<SampledSpectrum, Facets> to_spectral(const MicrofacetReflection<Rgb, Facets>& from,
                                                          const Wavelengths& wavelengths) {
  MicrofacetReflection<SampledSpectrum, Facets> lobe;
  lobe.tint = uplift_reflectance(from.tint, wavelengths);
  lobe.fresnel = FresnelTerm<SampledSpectrum>::of(from.fresnel, wavelengths);
  lobe.facets = from.facets;
  return lobe;
}

VGrooveMicrofacet<SampledSpectrum> to_spectral(const VGrooveMicrofacet<Rgb>& from, const Wavelengths& wavelengths) {
  VGrooveMicrofacet<SampledSpectrum> lobe;
  lobe.tint = uplift_reflectance(from.tint, wavelengths);
  lobe.fresnel = FresnelTerm<SampledSpectrum>::of(from.fresnel, wavelengths);
  lobe.slopes = from.slopes;
  lobe.count = from.count;
  lobe.masked = from.masked;
  return lobe;
}

using SpectralFilmFresnel = FilmFresnel<SampledSpectrum, SpectralThinFilm>;

void set_film_fresnel(const FilmFresnel<Rgb>& from, const Wavelengths& wavelengths, SpectralFilmFresnel& to) {
  to.dielectric_f0 = uplift_reflectance(from.dielectric_f0, wavelengths);
  to.dielectric_f90 = from.dielectric_f90;
  to.metal_f0 = uplift_reflectance(from.metal_f0, wavelengths);
  to.dielectric = from.dielectric;
  to.metal = from.metal;
  to.film = {from.film, &wavelengths};
  to.strength = from.strength;
}

MetallicRoughness<SampledSpectrum, SpectralFilmFresnel> to_spectral(
    const MetallicRoughness<Rgb, FilmFresnel<Rgb>>& from, const Wavelengths& wavelengths) {
  MetallicRoughness<SampledSpectrum, SpectralFilmFresnel> lobe;
  set_film_fresnel(from, wavelengths, lobe);
  lobe.base = uplift_reflectance(from.base, wavelengths);
  lobe.facets = from.facets;
  lobe.normalization = from.normalization;
  return lobe;
}

ThinTransmission<SampledSpectrum, SpectralFilmFresnel> to_spectral(const ThinTransmission<Rgb, FilmFresnel<Rgb>>& from,
                                                                   const Wavelengths& wavelengths) {
  ThinTransmission<SampledSpectrum, SpectralFilmFresnel> lobe;
  set_film_fresnel(from, wavelengths, lobe);
  lobe.tint = uplift_reflectance(from.tint, wavelengths);
  lobe.share = from.share;
  lobe.facets = from.facets;
  return lobe;
}

template <class Variant>
struct SpectralVariant;
template <class... Lobe>
struct SpectralVariant<std::variant<Lobe...>> {
  using type = std::variant<decltype(to_spectral(std::declval<const Lobe&>(), std::declval<const Wavelengths&>()))...>;
};

using SpectralLobe = SpectralVariant<AnyLobe<Rgb>>::type;
using SpectralLobeSet = LobeSet<SampledSpectrum, SpectralLobe, 5, CoatingLayers>;

}  // namespace

struct SpectralLobesAccess {
  using Lobes = AllLobes<SampledSpectrum>;
  // Copying an AllLobes copies the bytes of its set.
  static_assert(std::is_trivially_copyable_v<SpectralLobeSet> && std::is_trivially_destructible_v<SpectralLobeSet>);
  static_assert(sizeof(SpectralLobeSet) <= Lobes::kBytes && alignof(SpectralLobeSet) <= Lobes::kAlignment);

  static void create(Lobes& lobes) { new (lobes.set_.data()) SpectralLobeSet; }
  static SpectralLobeSet& of(Lobes& lobes) {
    return *std::launder(reinterpret_cast<SpectralLobeSet*>(lobes.set_.data()));
  }
  static const SpectralLobeSet& of(const Lobes& lobes) {
    return *std::launder(reinterpret_cast<const SpectralLobeSet*>(lobes.set_.data()));
  }
};

namespace {

SpectralLobeSet& spectral_set(AllLobes<SampledSpectrum>& lobes) { return SpectralLobesAccess::of(lobes); }
const SpectralLobeSet& spectral_set(const AllLobes<SampledSpectrum>& lobes) { return SpectralLobesAccess::of(lobes); }

}  // namespace

AllLobes<SampledSpectrum>::AllLobes() { SpectralLobesAccess::create(*this); }

void AllLobes<SampledSpectrum>::assign(const AllLobes<Rgb>& lobes, const Wavelengths& wavelengths) {
  spectral_set(*this).assign(lobe_set(lobes),
                             [&](const auto& lobe) -> SpectralLobe { return to_spectral(lobe, wavelengths); });
}

void AllLobes<SampledSpectrum>::assign_lambertian(const Color& albedo) {
  spectral_set(*this).clear();
  spectral_set(*this).add(Lambert<SampledSpectrum>{albedo});
}

void AllLobes<SampledSpectrum>::clear() { spectral_set(*this).clear(); }
bool AllLobes<SampledSpectrum>::empty() const { return spectral_set(*this).empty(); }
int AllLobes<SampledSpectrum>::size() const { return spectral_set(*this).size(); }
bool AllLobes<SampledSpectrum>::has_non_delta_lobe() const { return spectral_set(*this).has_non_delta_lobe(); }
float AllLobes<SampledSpectrum>::min_alpha() const { return spectral_set(*this).min_alpha(); }
bool AllLobes<SampledSpectrum>::has_component(ScatterType type) const {
  return spectral_set(*this).has_component(type);
}
SampledSpectrum AllLobes<SampledSpectrum>::eval(const Vec3& wo, const Vec3& wi, TransportMode mode) const {
  return spectral_set(*this).eval(wo, wi, mode);
}
SampledSpectrum AllLobes<SampledSpectrum>::eval_component(ScatterType type, const Vec3& wo, const Vec3& wi,
                                                          TransportMode mode) const {
  return spectral_set(*this).eval_component(type, wo, wi, mode);
}
float AllLobes<SampledSpectrum>::pdf(const Vec3& wo, const Vec3& wi, TransportMode mode) const {
  return spectral_set(*this).pdf(wo, wi, mode);
}
bool AllLobes<SampledSpectrum>::sample(const Vec3& wo, const LobeRandom& random, TransportMode mode,
                                       LobeSample<SampledSpectrum>& s) const {
  return spectral_set(*this).sample(wo, random, mode, s);
}
void AllLobes<SampledSpectrum>::add_deltas(const Vec3& wo, TransportMode mode,
                                           DeltaSet<SampledSpectrum>& deltas) const {
  spectral_set(*this).add_deltas(wo, mode, deltas);
}

}  // namespace etendue
