// Lights: what a user edits.
#pragma once
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/parameter.h"
#include "base/vec.h"
#include "light/environment.h"
#include "light/light_type.h"
#include "spectrum/emission_spectrum.h"
#include "spectrum/rgb.h"

namespace etendue {

struct AreaLight;
struct Motion;
struct PlacedLight;

struct LightTypeInfo {
  LightTypeDescription description;
  std::vector<ParameterInfo> parameters;  // with their defaults
};

// All light types, in the order of types/registry.h.
const std::vector<LightTypeInfo>& light_type_infos();
// The type of this name, or null.
const LightTypeInfo* find_light_type(std::string_view name);

// A light type with values of its parameters. Immutable: an edit makes another one.
class LightModel {
 public:
  virtual ~LightModel() = default;

  virtual const LightTypeInfo& info() const = 0;
  // The descriptions of `info` with the current values as defaults.
  virtual std::vector<ParameterInfo> parameters() const = 0;
  // A copy with one parameter changed. The parameter must exist and the value have its type.
  virtual std::shared_ptr<const LightModel> with(std::string_view name, const Value& value) const = 0;
  virtual bool equals(const LightModel& other) const = 0;
  virtual float intensity() const = 0;

  // The quantities below are those of a light of this colour.

  // Emitted flux, lm; zero where it depends on the scene (light from infinity, ambient light).
  virtual Rgb flux(const Rgb& color) const = 0;
  // The surface of an area light; none of a light without extent.
  virtual std::optional<AreaLight> area_light(const Rgb& color) const = 0;
  // Appends the lights without extent at a node: the light itself, or the point samples of an area light. `motion` is
  // that of the node, or null.
  virtual void place(const std::string& name, const Rgb& color, const Mat4& node,
                     const std::shared_ptr<const Motion>& motion, std::vector<PlacedLight>& lights) const = 0;

 protected:
  LightModel() = default;
  LightModel(const LightModel&) = default;
  LightModel& operator=(const LightModel&) = default;
};

// A light at a node: it emits from the node's origin along its -z axis; a quad's width lies along x. The node's scale
// has no effect.
struct Light {
  std::string name;
  Rgb color{1};  // multiplies the intensity
  EmissionSpectrumRef spectrum = {};
  std::shared_ptr<const LightModel> model;

  // A point light with default parameters.
  Light();

  const LightTypeInfo& info() const { return model->info(); }
  bool is_area_light() const { return info().description.light_class == LightClass::area; }
  float intensity() const { return model->intensity(); }
  // The RGB value of spectrum and colour for an intensity of 1.
  Rgb emitted_color() const { return spectrum.applied_to(color); }
  Rgb flux() const { return model->flux(emitted_color()); }

  // color.r, color.g, color.b, spectrum and the parameters of the type, with the current values as defaults.
  std::vector<ParameterInfo> parameters() const;
  // The value of a parameter, if the type has it.
  std::optional<Value> parameter(std::string_view key) const;
  // Changes a parameter of `parameters()`; the value must have its type. False if there is no such parameter.
  bool set(std::string_view key, const Value& value);

  friend bool operator==(const Light& a, const Light& b);
};

// A light of a registered type; parameters that are not given have their defaults. An unknown type or parameter is a
// programming error.
Light make_light(std::string_view type, std::initializer_list<std::pair<std::string_view, Value>> parameters = {});

}  // namespace etendue
