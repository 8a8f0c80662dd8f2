// A light without extent in world space.
#pragma once
#include <memory>
#include <string>

#include "geometry/motion.h"
#include "light/light_place.h"
#include "light/light_type_traits.h"
#include "spectrum/emission_spectrum.h"

namespace etendue {

struct PlacedLight {
  LightEmitter emitter;
  LightPlace place;                                // at the middle of the shutter interval
  std::shared_ptr<const Motion> motion = nullptr;  // of its node; null if it stands still
  // The light that it is, or is a point sample of.
  std::string name;
  const LightTypeDescription* type = nullptr;
  // Of the light; null: its colour determines it.
  std::shared_ptr<const EmissionSpectrum> spectrum = nullptr;

  LightPlace at(float time) const { return motion ? LightPlace(motion->matrix_at(time)) : place; }
  // f of the emitter.
  template <class F>
  decltype(auto) visit(F&& f) const {
    return std::visit(f, emitter);
  }
  bool is_infinite() const {
    return visit([](const auto& e) { return e.kIsInfinite; });
  }
};

}  // namespace etendue
