// Methods as a user names them: integrator[:name=value]..., the sampler among the values.
#pragma once
#include <string>
#include <vector>

#include "render/document.h"

namespace etendue::bench {

struct MethodSpec {
  std::string name;  // as it was written
  render::Document document;
};

// Of "path:sampler=sobol": the base document with that method.
Result<MethodSpec> parse_method(const std::string& text, const render::Document& base);

// Of "path:sampler=sobol,path-pure:max-depth=3": the base document with one method each. A name that does not exist, a
// value out of range, a setting that changes the picture rather than the way to it (its size, the camera, the scene,
// the seed), a method that is named twice and an empty list are usage errors.
Result<std::vector<MethodSpec>> parse_methods(const std::string& list, const render::Document& base);

}  // namespace etendue::bench
