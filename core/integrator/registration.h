// How an integrator enters the registry.
//
// An integrator is one .cpp file: its class with `static IntegratorInfo info()`, and at the end of the file
//
//   Registration path_tracing() { return registration<Path>(); }
//
// The second place is one line in registry.cpp, which names that function.
#pragma once
#include "integrator/integrator.h"

namespace etendue::integrator {

struct Registration {
  IntegratorInfo info;
  std::unique_ptr<Integrator> (*make)();
};

template <class T>
Registration registration() {
  IntegratorInfo info = T::info();
  info.parameters = T().parameter_infos();
  return {std::move(info), []() -> std::unique_ptr<Integrator> { return std::make_unique<T>(); }};
}

}  // namespace etendue::integrator
