// BSDF models of the literature, which a material can use instead of the glTF surface.           [Lang, sec. 4.2.2.5]
//
// A model is a struct of parameters (base/parameter.h) in a header of its own under models/. It defines
//
//   static constexpr BsdfModelDescription kDescription{...};
//   template <class Color> using Lobes = std::tuple<Lambert<Color>, CosinePower<Color>>;   // the lobe types it adds
//   auto parameters();                                                                     // std::tie of its
//   parameters template <class LobeSet> void add_lobes(const Rgb& base, LobeSet& lobes) const;
//
// and is registered by one line of model_registry.h. `base` is the base colour at the point: that of the material times
// its texture and the vertex colour. Optional members:
//
//   static std::vector<ModelPreset> presets();   named sets of parameter values
//   void prepare();                              precomputes tables; see BsdfModel::prepared
//   Subsurface subsurface() const;               light leaves the surface at other points; see BsdfModel
//   static constexpr bool kSolid = true;         light passes through the surface into a solid body
//
// Models are immutable values: editing a parameter creates another model.
#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/parameter.h"
#include "bsdf/bsdf_model_info.h"
#include "bsdf/diffusion/diffusion_profiles.h"

namespace etendue {

template <class Color>
class AllLobes;

struct BsdfModelInfo {
  BsdfModelDescription description;
  std::vector<ParameterInfo> parameters;
  std::vector<ModelPreset> presets;
};

// All models, in the order of the registry.
const std::vector<BsdfModelInfo>& bsdf_model_infos();
// Null if no model has this name.
const BsdfModelInfo* find_bsdf_model(std::string_view name);

class BsdfModel {
 public:
  virtual ~BsdfModel() = default;

  virtual const BsdfModelInfo& info() const = 0;
  // The parameters of `info`, with the values of this model as defaults.
  virtual std::vector<ParameterInfo> parameters() const = 0;
  // A copy with one parameter changed. The model must have the parameter, and the value must have been checked against
  // its description.
  virtual std::shared_ptr<const BsdfModel> with(std::string_view name, const Value& value) const = 0;
  // A copy with precomputed tables, so that `add_lobes` is fast; this can take a second. Null if nothing needs to be
  // precomputed.
  virtual std::shared_ptr<const BsdfModel> prepared() const = 0;
  // Adds the lobes of the model. A model that is not prepared precomputes its tables at every call.
  virtual void add_lobes(const Rgb& base, AllLobes<Rgb>& lobes) const = 0;
  // Adds the lobes that need no precomputed tables, for a white base colour: enough to find out whether the model has
  // lobes other than deltas and whether it is anisotropic.
  virtual void add_unprepared_lobes(AllLobes<Rgb>& lobes) const = 0;
  // Light passes through the surface into a solid body, which the material's attenuation describes.
  virtual bool is_solid() const = 0;
  // Index of refraction of the solid body; 1 for models without one.
  virtual float index_of_refraction() const = 0;
  // Scattering below the surface; its mean free path is 0 for models whose light leaves where it arrived.
  virtual Subsurface subsurface() const = 0;

 protected:
  BsdfModel() = default;
  BsdfModel(const BsdfModel&) = default;
  BsdfModel& operator=(const BsdfModel&) = default;
};

// A model with its default parameters; null if no model has this name.
std::shared_ptr<const BsdfModel> make_bsdf_model(std::string_view name);

// The name of the preset whose values the model's parameters have, or kNoPreset.
inline constexpr const char* kNoPreset = "none";
std::string_view preset_of(const BsdfModel& model);
// The model with the values of a preset; unchanged if no preset has this name.
std::shared_ptr<const BsdfModel> with_preset(std::shared_ptr<const BsdfModel> model, std::string_view preset);

// The model of a material; null stands for the glTF surface. Two are equal if their names and parameters are.
struct BsdfModelRef {
  std::shared_ptr<const BsdfModel> model = nullptr;

  explicit operator bool() const { return model != nullptr; }
  const BsdfModel* operator->() const { return model.get(); }
  friend bool operator==(const BsdfModelRef& a, const BsdfModelRef& b);
};

}  // namespace etendue
