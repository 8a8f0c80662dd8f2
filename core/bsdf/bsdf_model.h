// Reflection models: what a surface does with light where glTF's own description is not asked.     thesis 4.2.2.5
//
// A model is a struct of knobs (base/parameter.h) in a file of its own under models/. It has a `kDescription`, names
// the types of its lobes,
//
//   template <class Color> using Lobes = std::tuple<Lambert<Color>, CosinePower<Color>>;
//
// and puts them into a mix for a base colour, which is that of the material with its texture and the colour of
// vertices:
//
//   template <class Mix> void add_lobes(const Rgb& base, Mix& lobes) const;
//
// It is registered by one line of models.h. Models are immutable values: an edit is another one. What takes long to
// find from the knobs, a table for example, is found by `void prepare()`: not while a hand turns them, but once before
// `add_lobes` runs at every vertex.
#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/parameter.h"
#include "bsdf/bsdf_model_info.h"

namespace etendue {

template <class Color>
class AllLobes;

struct BsdfModelInfo {
  BsdfModelDescription description;
  std::vector<ParameterInfo> parameters;
  std::vector<ModelPreset> presets;
};

// All models, in the order of the thesis.
const std::vector<BsdfModelInfo>& bsdf_model_infos();
const BsdfModelInfo* find_bsdf_model(std::string_view name);

class BsdfModel {
 public:
  virtual ~BsdfModel() = default;

  virtual const BsdfModelInfo& info() const = 0;
  // Those of `info` with the values they have here as defaults.
  virtual std::vector<ParameterInfo> parameters() const = 0;
  // Another one; the name must be a parameter's, and the value have been checked against its description.
  virtual std::shared_ptr<const BsdfModel> with(std::string_view name, const Value& value) const = 0;
  // The same model, for whose `add_lobes` everything is ready; that may take a second. Null if it is so already.
  virtual std::shared_ptr<const BsdfModel> prepared() const = 0;
  // Of a model that was not prepared, in a copy that is.
  virtual void add_lobes(const Rgb& base, AllLobes<Rgb>& lobes) const = 0;
  // At once, without what takes long to find: enough to tell mirrors and directed surfaces from others.
  virtual void sketch(AllLobes<Rgb>& lobes) const = 0;
  // Light passes through it into a solid body, whose colour is the material's attenuation.
  virtual bool is_solid() const = 0;

 protected:
  BsdfModel() = default;
  BsdfModel(const BsdfModel&) = default;
  BsdfModel& operator=(const BsdfModel&) = default;
};

// A model with its default parameters; null if there is none of this name.
std::shared_ptr<const BsdfModel> make_bsdf_model(std::string_view name);

// The name of the preset that the model's parameters are, or kNoPreset.
inline constexpr const char* kNoPreset = "none";
std::string_view preset_of(const BsdfModel& model);
// The model with the values of a preset; an unknown name leaves it as it is.
std::shared_ptr<const BsdfModel> with_preset(std::shared_ptr<const BsdfModel> model, std::string_view preset);

// A material's model: none is glTF's own surface. Equal if name and parameters are.
struct BsdfModelRef {
  std::shared_ptr<const BsdfModel> model = nullptr;

  explicit operator bool() const { return model != nullptr; }
  const BsdfModel* operator->() const { return model.get(); }
  friend bool operator==(const BsdfModelRef& a, const BsdfModelRef& b);
};

}  // namespace etendue
