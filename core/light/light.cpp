#include "light/light.h"

#include <algorithm>
#include <cassert>

#include "light/area_light.h"
#include "light/placed_light.h"

namespace etendue {
namespace {

template <class Type>
const LightTypeInfo& info_of() {
  static const LightTypeInfo info{Type::kDescription, describe_all(Type().parameters())};
  return info;
}

template <class... P>
bool equal_values(const std::tuple<P...>& a, const std::tuple<P...>& b) {
  return [&]<size_t... I>(std::index_sequence<I...>) { return ((std::get<I>(a).value == std::get<I>(b).value) && ...); }
  (std::index_sequence_for<P...>());
}

Mat4 node_matrix(const LightPlace& place) {
  const Frame frame(-place.direction);
  return {Vec4(frame.x, 0), Vec4(frame.y, 0), Vec4(frame.z, 0), Vec4(place.position, 1)};
}

// A light without extent at a node.
PlacedLight placed_light(const LightEmitter& emitter, const Mat4& node, const std::shared_ptr<const Motion>& motion) {
  return {.emitter = emitter,
          .place = LightPlace(motion ? motion->matrix_at(0.5f) : node),
          .motion = motion,
          .name = {},
          .type = nullptr};
}

// The motion of a place in the frame of a node.
std::shared_ptr<const Motion> attached(const Motion& motion, const Mat4& local) {
  auto moved = std::make_shared<Motion>();
  for (const Mat4& m : motion.to_world) moved->to_world.push_back(without_scale(m) * local);
  return moved;
}

// A share of an area light emits as a point with an intensity proportional to cos^(k + 1): the radiance times the
// projected area.
template <class Type>
void place_point_samples(const Type& type, const Rgb& color, const Mat4& node,
                         const std::shared_ptr<const Motion>& motion, std::vector<PlacedLight>& lights) {
  SpotLight::Emitter emitter;
  emitter.color = type.radiance(color, type.area());
  emitter.intensity = type.area() / static_cast<float>(type.point_samples);
  emitter.profile = SpotProfile::cosine;
  emitter.exponent = 1 + type.cosine_exponent;
  emitter.outer_cone = kPi / 2;
  emitter.cos_inner = emitter.cos_outer = std::cos(kPi / 2);
  for (int k = 0; k < type.point_samples; ++k) {
    LightPlace place = type.point_sample(SpreadPoint(k, type.point_samples));
    for (int side = 0; side < type.sides(); ++side) {
      const Mat4 local = node_matrix(place);
      lights.push_back(placed_light(emitter, without_scale(node) * local, motion ? attached(*motion, local) : nullptr));
      place.direction = -place.direction;
    }
  }
}

template <class Type>
class LightModelOf final : public LightModel {
 public:
  explicit LightModelOf(const Type& type = {}) : type_(type) {}

  const LightTypeInfo& info() const override { return info_of<Type>(); }
  std::vector<ParameterInfo> parameters() const override {
    Type copy = type_;
    return describe_all(copy.parameters());
  }
  std::shared_ptr<const LightModel> with(std::string_view name, const Value& value) const override {
    Type changed = type_;
    [[maybe_unused]] const bool known = assign_by_name(changed.parameters(), name, value);
    assert(known);
    return std::make_shared<LightModelOf>(changed);
  }
  bool equals(const LightModel& other) const override {
    if (&info() != &other.info()) return false;
    Type a = type_;
    Type b = static_cast<const LightModelOf&>(other).type_;
    return equal_values(a.parameters(), b.parameters());
  }
  float intensity() const override { return type_.intensity; }

  Rgb flux(const Rgb& color) const override {
    if constexpr (HasEmitter<Type>)
      return type_.emitter(color).flux();
    else
      return type_.flux(color, type_.area());
  }
  std::optional<AreaLight> area_light(const Rgb& color) const override {
    if constexpr (HasSurface<Type>)
      return AreaLight{.shape = type_.shape(),
                       .radiance = type_.radiance(color, type_.area()),
                       .cosine_exponent = type_.cosine_exponent,
                       .two_sided = type_.sides() == 2,
                       .hit_by_rays = type_.point_samples == 0};
    else
      return std::nullopt;
  }
  void place(const std::string& name, const Rgb& color, const Mat4& node, const std::shared_ptr<const Motion>& motion,
             std::vector<PlacedLight>& lights) const override {
    const size_t first = lights.size();
    if constexpr (HasEmitter<Type>)
      lights.push_back(placed_light(type_.emitter(color), node, motion));
    else
      place_point_samples(type_, color, node, motion, lights);
    for (size_t i = first; i < lights.size(); ++i) {
      lights[i].name = name;
      lights[i].type = &info().description;
    }
  }

 private:
  Type type_;
};

struct Entry {
  const LightTypeInfo* info;
  std::shared_ptr<const LightModel> model;  // with default parameters
};

template <class... Type>
std::vector<Entry> entries_of(LightTypeList<Type...>) {
  return {{&info_of<Type>(), std::make_shared<LightModelOf<Type>>()}...};
}

const std::vector<Entry>& entries() {
  static const std::vector<Entry> all = entries_of(LightTypes());
  return all;
}

const Entry* find_entry(std::string_view name) {
  const auto found = std::ranges::find_if(entries(), [&](const Entry& e) { return e.info->description.name == name; });
  return found == entries().end() ? nullptr : &*found;
}

Triple color_parameter(const Rgb& color) {
  return {"color", "Colour", Vec3(color.r, color.g, color.b), {0, 1}, "Multiplies the intensity"};
}

constexpr const char* kSpectrumParameter = "spectrum";

}  // namespace

const std::vector<LightTypeInfo>& light_type_infos() {
  static const auto infos = [] {
    std::vector<LightTypeInfo> list;
    for (const Entry& e : entries()) list.push_back(*e.info);
    return list;
  }();
  return infos;
}

const LightTypeInfo* find_light_type(std::string_view name) {
  const Entry* entry = find_entry(name);
  return entry ? entry->info : nullptr;
}

Light::Light() : model(find_entry("point")->model) {}

std::vector<ParameterInfo> Light::parameters() const {
  std::vector<ParameterInfo> infos;
  append_description(color_parameter(color), infos);
  append_description(emission_spectrum_parameter(kSpectrumParameter, spectrum), infos);
  for (ParameterInfo& info : model->parameters()) infos.push_back(std::move(info));
  return infos;
}

std::optional<Value> Light::parameter(std::string_view key) const {
  const auto infos = parameters();
  const ParameterInfo* found = find_parameter(infos, key);
  return found ? std::optional(found->default_value) : std::nullopt;
}

bool Light::set(std::string_view key, const Value& value) {
  Triple c = color_parameter(color);
  if (assign_if_named(c, key, value)) {
    color = {c.value.x, c.value.y, c.value.z};
    return true;
  }
  if (key == kSpectrumParameter) {
    spectrum = emission_spectrum_or_none(std::get<std::string>(value));
    return true;
  }
  if (!find_parameter(info().parameters, key)) return false;
  model = model->with(key, value);
  return true;
}

bool operator==(const Light& a, const Light& b) {
  return a.name == b.name && a.color == b.color && a.spectrum == b.spectrum &&
         (a.model == b.model || a.model->equals(*b.model));
}

Light make_light(std::string_view type, std::initializer_list<std::pair<std::string_view, Value>> parameters) {
  Light light;
  const Entry* entry = find_entry(type);
  assert(entry);
  light.model = entry->model;
  for (const auto& [name, value] : parameters) {
    [[maybe_unused]] const bool known = light.set(name, value);
    assert(known);
  }
  return light;
}

}  // namespace etendue
