// Sections "light.N".
#include "render/document_parameters.h"

template <>
struct etendue::Options<etendue::SpotProfile> {
  static constexpr std::array<etendue::Option, 4> kOptions{{{"squared", "Squared (glTF)"},
                                                            {"smoothstep", "Smoothstep"},
                                                            {"quartic", "Quartic"},
                                                            {"cosine", "Cosine power"}}};
};
template <>
struct etendue::Options<etendue::SurfaceQuantity> {
  static constexpr std::array<etendue::Option, 2> kOptions{{{"radiance", "Radiance"}, {"power", "Power"}}};
};

namespace etendue::render {
namespace {

// Adds parameters that are members of one light.
class LightParameterList {
 public:
  LightParameterList(DocumentParameters& list, const std::string& section, size_t index)
      : list_(list), section_(section), index_(index) {}

  template <class Description, class Member>
  void add(const Description& description, Member Light::*member) {
    list_.push_back(make_parameter(section_, description, [index = index_, member](Document& d, const auto& v) {
      edit_scene(d, [&](scene::Scene& s) { s.lights[index].*member = v; });
    }));
  }

 private:
  DocumentParameters& list_;
  const std::string& section_;
  size_t index_;
};

void add_intensity(LightParameterList& parameters, const Light& l) {
  const bool as_power = l.quantity == SurfaceQuantity::power;
  const char* unit = l.type == LightType::ambient       ? "W/(m^2 sr)"
                     : l.type == LightType::directional ? "W/m^2"
                     : !l.is_surface()                  ? "W/sr"
                     : as_power                         ? "W"
                                                        : "W/(m^2 sr)";
  const char* doc = l.type == LightType::ambient ? "Radiance from all directions, without shadows; not a physical light"
                    : l.is_surface() ? "Radiance along the normal, the same at every point, or power of the surface"
                                     : "Radiant intensity; for directional lights irradiance on a facing surface";
  parameters.add(
      Number<float>{"intensity", "Intensity", l.intensity, {0, kLargestLength}, doc, unit, Scale::logarithmic},
      &Light::intensity);
}

void add_spot(LightParameterList& parameters, const Light& l) {
  parameters.add(Number<float>{"inner-cone",
                               "Inner cone angle",
                               l.inner_cone,
                               {0, kPi / 2},
                               "Half angle of the cone with full intensity",
                               "rad"},
                 &Light::inner_cone);
  parameters.add(Number<float>{"outer-cone",
                               "Outer cone angle",
                               l.outer_cone,
                               {0, kPi / 2},
                               "Half angle at which the intensity reaches zero",
                               "rad"},
                 &Light::outer_cone);
  parameters.add(
      Choice<SpotProfile>{"profile", "Falloff", l.profile,
                          "Falloff of the intensity between the two cones. Cosine power ignores the inner cone"},
      &Light::profile);
  parameters.add(Number<float>{"exponent",
                               "Cosine exponent",
                               l.exponent,
                               {0, 1000},
                               "Exponent of the cosine power falloff; higher narrows the beam"},
                 &Light::exponent);
}

void add_surface(LightParameterList& parameters, const Light& l) {
  constexpr float kLargestSize = 1e6f;
  const auto add_size = [&](const char* name, const char* label, float value, const char* doc, float Light::*member) {
    parameters.add(Number<float>{name, label, value, {0, kLargestSize}, doc, "m", Scale::logarithmic}, member);
  };
  if (l.type == LightType::quad) {
    add_size("width", "Width", l.width, "Size along the node's x axis", &Light::width);
    add_size("height", "Height", l.height, "Size along the node's y axis", &Light::height);
  } else {
    add_size("radius", "Radius", l.radius, "Radius; the node's scale has no effect on it", &Light::radius);
  }
  parameters.add(Choice<SurfaceQuantity>{"quantity", "Quantity", l.quantity,
                                         "Meaning of the intensity: radiance, or power of the whole surface"},
                 &Light::quantity);
  parameters.add(Number<float>{"focus",
                               "Cosine exponent",
                               l.focus,
                               {0, 1000},
                               "Radiance falls off as this power of the cosine to the normal; higher narrows the "
                               "beam, 0: the same in all directions"},
                 &Light::focus);
  if (l.type != LightType::sphere)
    parameters.add(Toggle{"two-sided", "Two-sided", l.two_sided, "Emits from both sides"}, &Light::two_sided);
  parameters.add(Number<int>{"points",
                             "Point samples",
                             l.points,
                             {0, 4096},
                             "Replaces the surface by this number of point lights, which are invisible and cast hard "
                             "shadows; few show bands. 0: exact surface"},
                 &Light::points);
}

}  // namespace

DocumentParameters light_parameters(const Document& document, size_t index, const std::string& section) {
  const Light& l = document.scene->lights[index];
  DocumentParameters list;
  add_triple(
      list, section,
      {.names = {"color.r", "color.g", "color.b"},
       .label = "Colour",
       .value = Vec3(l.color.r, l.color.g, l.color.b),
       .range = {0, 1},
       .doc = "Colour of the light; multiplies the intensity"},
      [index](Document& d, int c, float v) { edit_scene(d, [&](scene::Scene& s) { s.lights[index].color[c] = v; }); });
  LightParameterList parameters(list, section, index);
  add_intensity(parameters, l);
  if (l.type == LightType::spot) add_spot(parameters, l);
  if (l.is_surface()) add_surface(parameters, l);
  return list;
}

}  // namespace etendue::render
