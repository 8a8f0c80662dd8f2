// Registration of integrators.
//
// An integrator is one .cpp file: its class with `static IntegratorInfo info()`, and at the end of the file
//
//   Registration path_tracing() { return registration<PathTracing>(); }
//
// and one line in registry.cpp with the name of that function.
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
