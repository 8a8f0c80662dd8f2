// Sections: camera, environment, material.N, light.N, node.N.
#include "render/document_parameters.h"
#include "scene/rotation.h"

namespace etendue::render {
namespace {

constexpr float kFar = 1e9f;
constexpr const char* kGltfModel = "gltf";

// What a reflection model has numbers of its own for.
bool is_of_gltf(std::string_view name) {
  for (const char* kept :
       {"base-color.", "alpha", "normal-scale", "double-sided", "unlit", "emission.", "attenuation-"})
    if (name.starts_with(kept)) return false;
  return true;
}

// Three numbers NAME.r, NAME.g, NAME.b for one colour.
template <class Store>
void add_color(std::vector<DocumentParameter>& list, const std::string& section, const char* const (&names)[3],
               const char* label, const Rgb& now, float most, const char* doc, Store store) {
  for (int c = 0; c < 3; ++c)
    list.push_back(binding(section, Number<float>{names[c], label, now[c], {0, most}, doc},
                           [store, c](Document& document, float v) { store(document, c, v); }));
}

template <class Store>
void add_vector(std::vector<DocumentParameter>& list, const std::string& section, const char* const (&names)[3],
                const char* label, const Vec3& now, float most, const char* doc, const char* unit, Store store) {
  for (int c = 0; c < 3; ++c)
    list.push_back(binding(section, Number<float>{names[c], label, now[c], {-most, most}, doc, unit},
                           [store, c](Document& document, float v) { store(document, c, v); }));
}

// A binding of one member of a material.
template <class Knob, class Member>
DocumentParameter of_material(const std::string& section, size_t index, const Knob& knob, Member Material::*member) {
  return binding(section, knob, [index, member](Document& document, const auto& v) {
    edit_scene(document, [&](scene::Scene& s) { s.materials[index].*member = v; });
  });
}

template <class Knob, class Member>
DocumentParameter of_light(const std::string& section, size_t index, const Knob& knob, Member Light::*member) {
  return binding(section, knob, [index, member](Document& document, const auto& v) {
    edit_scene(document, [&](scene::Scene& s) { s.lights[index].*member = v; });
  });
}

void set_reflection(Document& document, size_t index, std::shared_ptr<const BsdfModel> model) {
  edit_scene(document, [&](scene::Scene& s) { s.materials[index].model.model = std::move(model); });
}

// glTF's own surface, or one of the reflection models.
DocumentParameter model_choice(const Material& m, size_t index, const std::string& section) {
  DocumentParameter b;
  b.section = section;
  b.info.name = section + ".model", b.info.label = "Model";
  b.info.doc = "How the surface reflects light: as glTF describes it, or by a model of the literature";
  b.info.type = ParameterType::choice;
  b.info.options.emplace_back(kGltfModel), b.info.option_labels.emplace_back("glTF surface");
  for (const auto& info : bsdf_model_infos()) {
    b.info.options.emplace_back(info.description.name);
    b.info.option_labels.emplace_back(info.description.label);
  }
  b.info.default_value = std::string(m.model ? m.model->info().description.name : kGltfModel);
  b.assign = [index](Document& d, const Value& v) {
    set_reflection(d, index, make_bsdf_model(std::get<std::string>(v)));
  };
  return b;
}

// Values of its parameters that go together.
DocumentParameter preset_choice(const BsdfModelRef& use, size_t index, const std::string& section) {
  DocumentParameter b;
  b.section = section;
  b.info.name = section + "." + use->info().description.name + ".preset", b.info.label = "Preset";
  b.info.doc = "Sets the parameters to those of a known material";
  b.info.type = ParameterType::choice;
  b.info.options.emplace_back(kNoPreset), b.info.option_labels.emplace_back("None");
  for (const ModelPreset& preset : use->info().presets) {
    b.info.options.push_back(preset.name);
    b.info.option_labels.push_back(preset.label);
  }
  b.info.default_value = std::string(preset_of(*use.model));
  b.assign = [index](Document& d, const Value& v) {
    const auto& model = d.scene->materials[index].model.model;
    set_reflection(d, index, with_preset(model, std::get<std::string>(v)));
  };
  return b;
}

void add_model(std::vector<DocumentParameter>& list, const Material& m, size_t index, const std::string& section) {
  list.push_back(model_choice(m, index, section));
  if (!m.model) return;
  if (!m.model->info().presets.empty()) list.push_back(preset_choice(m.model, index, section));
  for (const ParameterInfo& info : m.model->parameters()) {
    DocumentParameter b;
    b.section = section, b.info = info;
    b.info.name = section + "." + m.model->info().description.name + "." + info.name;
    b.assign = [index, name = info.name](Document& d, const Value& v) {
      set_reflection(d, index, d.scene->materials[index].model->with(name, v));
    };
    list.push_back(b);
  }
}

template <class Add>
void add_spot(Add&& add, const Light& l) {
  add(Number<float>{"inner-cone", "Inner cone", l.inner_cone, {0, kPi / 2}, "Half angle of full intensity", "rad"},
      &Light::inner_cone);
  add(Number<float>{"outer-cone", "Outer cone", l.outer_cone, {0, kPi / 2}, "Half angle where the light ends", "rad"},
      &Light::outer_cone);
  add(
      Choice<SpotProfile>{
          "profile", "Profile", l.profile,
          "How intensity falls off between the cones; the power of the cosine knows the outer one only"},
      &Light::profile);
  add(Number<float>{"exponent", "Exponent", l.exponent, {0, 1000}, "Of the profile that is a power of the cosine"},
      &Light::exponent);
}

template <class Add>
void add_surface(Add&& add, const Light& l) {
  constexpr float kLargest = 1e6f;
  const auto size = [&](const char* name, const char* label, float now, const char* doc, float Light::*member) {
    add(Number<float>{name, label, now, {0, kLargest}, doc, "m", Scale::logarithmic}, member);
  };
  if (l.type == LightType::quad) {
    size("width", "Width", l.width, "Along the node's x", &Light::width);
    size("height", "Height", l.height, "Along the node's y", &Light::height);
  } else {
    size("radius", "Radius", l.radius, "The node's scale does not count", &Light::radius);
  }
  add(Choice<SurfaceQuantity>{"quantity", "Quantity", l.quantity, "What the intensity says"}, &Light::quantity);
  add(Number<float>{"focus",
                    "Focus",
                    l.focus,
                    {0, 1000},
                    "Radiance falls off from the normal as this power of the cosine; 0 is the same in every direction"},
      &Light::focus);
  if (l.type != LightType::sphere)
    add(Toggle{"two-sided", "Two-sided", l.two_sided, "Shines from its back as well"}, &Light::two_sided);
  add(
      Number<int>{
          "points",
          "Points",
          l.points,
          {0, 4096},
          "So many lamps without extent stand for the surface, which is not seen then: hard shadows, banded where "
          "they are few; 0 is the surface itself"},
      &Light::points);
}

// Rotation and scale, which only exist where the transform has these parts. The first edit takes a matrix apart.
void add_parts(std::vector<DocumentParameter>& list, const std::string& section, size_t index,
               const scene::Transform& transform) {
  const auto parts = scene::in_parts(transform);
  if (!parts) return;
  const auto edit = [index](Document& d, auto change) {
    edit_scene(d, [&](scene::Scene& s) {
      auto& t = s.nodes[index].transform;
      if (const auto taken_apart = scene::in_parts(t)) change(t = *taken_apart);
    });
  };
  static constexpr const char* kRotation[4] = {"rotation.x", "rotation.y", "rotation.z", "rotation.w"};
  for (int c = 0; c < 4; ++c)
    list.push_back(binding(section,
                           Number<float>{kRotation[c],
                                         "Rotation",
                                         parts->rotation[c],
                                         {-1.001f, 1.001f},
                                         "A quaternion relative to the parent; it is made a unit where it is used"},
                           [edit, c](Document& d, float v) { edit(d, [&](auto& t) { t.rotation[c] = v; }); }));
  add_vector(list, section, {"scale.x", "scale.y", "scale.z"}, "Scale", parts->scale, 1e6f,
             "Relative to the parent; negative mirrors, 0 hides", "",
             [edit](Document& d, int c, float v) { edit(d, [&](auto& t) { t.scale[c] = v; }); });
}

}  // namespace
}  // namespace etendue::render

template <>
struct etendue::Options<etendue::AlphaMode> {
  static constexpr std::array<etendue::Option, 3> kOptions{
      {{"opaque", "Opaque"}, {"mask", "Mask"}, {"blend", "Blend"}}};
};
template <>
struct etendue::Options<etendue::SpotProfile> {
  static constexpr std::array<etendue::Option, 4> kOptions{{{"squared", "Squared, as glTF has it"},
                                                            {"smoothstep", "Smoothstep"},
                                                            {"quartic", "Quartic"},
                                                            {"cosine", "Power of the cosine"}}};
};
template <>
struct etendue::Options<etendue::SurfaceQuantity> {
  static constexpr std::array<etendue::Option, 2> kOptions{{{"radiance", "Radiance"}, {"power", "Power"}}};
};
template <>
struct etendue::Options<etendue::Projection> {
  static constexpr std::array<etendue::Option, 2> kOptions{
      {{"perspective", "Perspective"}, {"orthographic", "Orthographic"}}};
};

namespace etendue::render {

std::vector<DocumentParameter> material_bindings(const Document& document, size_t index, const std::string& section) {
  const Material& m = document.scene->materials[index];
  std::vector<DocumentParameter> list;
  add_model(list, m, index, section);
  const size_t own = list.size();
  const auto color = [index](Rgb Material::*member) {
    return [index, member](Document& d, int c, float v) {
      edit_scene(d, [&](scene::Scene& s) { (s.materials[index].*member)[c] = v; });
    };
  };
  const auto number = [&](const char* name, const char* label, float Material::*member, Range<float> range,
                          const char* doc, const char* unit = "", Scale scale = Scale::linear) {
    list.push_back(of_material(
        section, index, Number<float>{name, label, std::min(m.*member, range.max), range, doc, unit, scale}, member));
  };
  add_color(list, section, {"base-color.r", "base-color.g", "base-color.b"}, "Base colour", m.base_color, 1,
            "Diffuse albedo, or the metal's reflectance; multiplies its texture", color(&Material::base_color));
  number("metallic", "Metallic", &Material::metallic, {0, 1}, "0 is a dielectric over a diffuse base, 1 a metal");
  number("roughness", "Roughness", &Material::roughness, {0, 1},
         "The width of the specular lobe: facet slope is its square");
  number("ior", "Index of refraction", &Material::ior, {1, 3},
         "Of the dielectric; sets its reflectance and how it refracts");
  number("specular", "Specular", &Material::specular, {0, 1},
         "Strength of the dielectric's reflection; 0 leaves a purely diffuse surface");
  add_color(list, section, {"specular-color.r", "specular-color.g", "specular-color.b"}, "Specular colour",
            m.specular_color, 1, "Tint of the dielectric's reflection at normal incidence",
            color(&Material::specular_color));
  number("transmission", "Transmission", &Material::transmission, {0, 1},
         "The share of the base that lets light through");
  number("thickness", "Thickness", &Material::thickness, {0, 1000},
         "0 is a thin sheet that does not bend light; anything else a solid that does", "m");
  add_color(list, section, {"attenuation-color.r", "attenuation-color.g", "attenuation-color.b"}, "Attenuation colour",
            m.attenuation_color, 1, "What white light becomes over the attenuation distance inside a solid",
            color(&Material::attenuation_color));
  number("attenuation-distance", "Attenuation distance", &Material::attenuation_distance, {1e-6f, kFar},
         "Where the attenuation colour is reached", "m", Scale::logarithmic);
  number("anisotropy", "Anisotropy", &Material::anisotropy, {0, 1}, "Stretches the specular lobe along the tangent");
  number("anisotropy-rotation", "Anisotropy rotation", &Material::anisotropy_rotation, {-6.2831853f, 6.2831853f},
         "Turns the stretched lobe, counter-clockwise from the tangent", "rad");
  number("clearcoat", "Clear coat", &Material::clearcoat, {0, 1}, "Strength of a clear layer over everything else");
  number("clearcoat-roughness", "Coat roughness", &Material::clearcoat_roughness, {0, 1},
         "The width of the coat's reflection");
  number("clearcoat-normal-scale", "Coat normal map strength", &Material::clearcoat_normal_scale, {-4, 4},
         "Scales the tangential part of the coat's normal map");
  add_color(list, section, {"sheen-color.r", "sheen-color.g", "sheen-color.b"}, "Sheen colour", m.sheen_color, 1,
            "Light that fibres scatter back at grazing angles, as velvet does; black is none",
            color(&Material::sheen_color));
  number("sheen-roughness", "Sheen roughness", &Material::sheen_roughness, {0, 1},
         "How far the fibres lean away from the normal");
  number("iridescence", "Iridescence", &Material::iridescence, {0, 1}, "Strength of a thin film's colours");
  number("iridescence-ior", "Film index", &Material::iridescence_ior, {1, 3}, "Index of refraction of the thin film");
  number("iridescence-thickness-min", "Least film thickness", &Material::iridescence_thickness_min, {0, 3000},
         "Where the thickness texture is 0", "nm");
  number("iridescence-thickness-max", "Film thickness", &Material::iridescence_thickness_max, {0, 3000},
         "Where the thickness texture is 1, and without one everywhere", "nm");
  number("diffuse-transmission", "Diffuse transmission", &Material::diffuse_transmission, {0, 1},
         "The share of the diffuse light that leaves on the other side, as through paper");
  add_color(list, section,
            {"diffuse-transmission-color.r", "diffuse-transmission-color.g", "diffuse-transmission-color.b"},
            "Diffuse transmission colour", m.diffuse_transmission_color, 1, "What passes of each colour",
            color(&Material::diffuse_transmission_color));
  add_color(list, section, {"emission.r", "emission.g", "emission.b"}, "Emission", m.emission, 1e6f,
            "Emitted radiance, W/(m^2 sr)", color(&Material::emission));
  number("alpha", "Opacity", &Material::alpha, {0, 1}, "Counts where the alpha mode is mask or blend");
  list.push_back(of_material(
      section, index,
      Choice<AlphaMode>{"alpha-mode", "Alpha mode", m.alpha_mode, "Opaque, cut out at the cutoff, or blended"},
      &Material::alpha_mode));
  number("alpha-cutoff", "Alpha cutoff", &Material::alpha_cutoff, {0, 1}, "Below this a masked surface is not there");
  number("normal-scale", "Normal map strength", &Material::normal_scale, {-4, 4},
         "Scales the tangential part of the normal map");
  list.push_back(of_material(section, index,
                             Toggle{"double-sided", "Double sided", m.double_sided, "Emits from both sides"},
                             &Material::double_sided));
  list.push_back(of_material(
      section, index, Toggle{"unlit", "Unlit", m.unlit, "Shows its base colour whatever the light"}, &Material::unlit));
  for (size_t i = own; m.model && i < list.size(); ++i)
    if (is_of_gltf(std::string_view(list[i].info.name).substr(section.size() + 1)))
      list[i].inactive_reason = std::string("The model ") + m.model->info().description.label +
                                " has numbers of its own; this one is of glTF's surface";
  return list;
}

std::vector<DocumentParameter> light_bindings(const Document& document, size_t index, const std::string& section) {
  const Light& l = document.scene->lights[index];
  std::vector<DocumentParameter> list;
  const auto add = [&](const auto& knob, auto member) { list.push_back(of_light(section, index, knob, member)); };
  add_color(
      list, section, {"color.r", "color.g", "color.b"}, "Colour", l.color, 1, "Multiplies the intensity",
      [index](Document& d, int c, float v) { edit_scene(d, [&](scene::Scene& s) { s.lights[index].color[c] = v; }); });
  const bool as_power = l.quantity == SurfaceQuantity::power;
  const char* unit = l.type == LightType::ambient       ? "W/(m^2 sr)"
                     : l.type == LightType::directional ? "W/m^2"
                     : !l.is_surface()                  ? "W/sr"
                     : as_power                         ? "W"
                                                        : "W/(m^2 sr)";
  const char* doc = l.type == LightType::ambient ? "Radiance from everywhere, without shadows: no physical light"
                    : l.is_surface() ? "Radiance along the normal, the same from every point; or the power of the whole"
                                     : "Radiant intensity; of a directional light the irradiance on a facing surface";
  add(Number<float>{"intensity", "Intensity", l.intensity, {0, kFar}, doc, unit, Scale::logarithmic},
      &Light::intensity);
  if (l.type == LightType::spot) add_spot(add, l);
  if (l.is_surface()) add_surface(add, l);
  return list;
}

std::vector<DocumentParameter> node_bindings(const Document& document, size_t index, const std::string& section) {
  const scene::Node& n = document.scene->nodes[index];
  std::vector<DocumentParameter> list;
  list.push_back(
      binding(section, Toggle{"visible", "Visible", n.visible, "Hidden objects are not in the scene at all"},
              [index](Document& d, bool v) { edit_scene(d, [&](scene::Scene& s) { s.nodes[index].visible = v; }); }));
  const Vec3 translation = n.transform.matrix ? Vec3((*n.transform.matrix)[3]) : n.transform.translation;
  add_vector(list, section, {"translation.x", "translation.y", "translation.z"}, "Translation", translation, kFar,
             "Relative to the parent", "m", [index](Document& d, int c, float v) {
               edit_scene(d, [&](scene::Scene& s) {
                 auto& t = s.nodes[index].transform;
                 if (t.matrix)
                   (*t.matrix)[3][c] = v;
                 else
                   t.translation[c] = v;
               });
             });
  add_parts(list, section, index, n.transform);
  return list;
}

std::vector<DocumentParameter> environment_bindings(const Document& document, const std::string& section) {
  const Environment& e = document.scene->environment;
  std::vector<DocumentParameter> list;
  add_color(list, section, {"tint.r", "tint.g", "tint.b"}, "Radiance", e.tint, 1e6f,
            "Constant radiance from infinity, or a factor on the map",
            [](Document& d, int c, float v) { edit_scene(d, [&](scene::Scene& s) { s.environment.tint[c] = v; }); });
  list.push_back(binding(
      section,
      Number<float>{
          "rotation", "Rotation", e.rotation, {-2 * kPi, 2 * kPi}, "Turns the map about the vertical axis", "rad"},
      [](Document& d, float v) { edit_scene(d, [v](scene::Scene& s) { s.environment.rotation = v; }); }));
  list.push_back(binding(
      section, Toggle{"visible", "Visible", e.visible, "Whether the camera sees it; it lights the scene either way"},
      [](Document& d, bool v) { edit_scene(d, [v](scene::Scene& s) { s.environment.visible = v; }); }));
  return list;
}

std::vector<DocumentParameter> camera_bindings(const Document& document, const std::string& section) {
  const Camera& c = document.camera;
  std::vector<DocumentParameter> list;
  list.push_back(binding(section,
                         Number<float>{"exposure",
                                       "Exposure",
                                       document.display.exposure,
                                       {-30, 30},
                                       "The picture is multiplied by two to this power; the light stays",
                                       "EV"},
                         [](Document& d, float v) { d.display.exposure = v; }));
  list.push_back(binding(section,
                         Choice<Projection>{"projection", "Projection", c.projection, "Perspective or parallel"},
                         [](Document& d, Projection v) { d.camera.projection = v; }));
  list.push_back(binding(
      section,
      Number<float>{
          "yfov", "Field of view", c.yfov, {1e-3f, 3.1f}, "Vertical opening angle of a perspective camera", "rad"},
      [](Document& d, float v) { d.camera.yfov = v; }));
  list.push_back(binding(section,
                         Number<float>{"ymag",
                                       "Half height",
                                       c.ymag,
                                       {1e-9f, kFar},
                                       "Half the height of the picture of an orthographic camera",
                                       "m",
                                       Scale::logarithmic},
                         [](Document& d, float v) { d.camera.ymag = v; }));
  list.push_back(binding(section,
                         Number<float>{"lens-radius",
                                       "Lens radius",
                                       c.lens_radius,
                                       {0, 1e6f},
                                       "0 is a pinhole: everything is sharp",
                                       "m",
                                       Scale::logarithmic},
                         [](Document& d, float v) { d.camera.lens_radius = v; }));
  list.push_back(binding(section,
                         Number<float>{"focus-distance",
                                       "Focus distance",
                                       c.focus_distance,
                                       {1e-6f, kFar},
                                       "What lies at this distance along the axis is sharp",
                                       "m",
                                       Scale::logarithmic},
                         [](Document& d, float v) { d.camera.focus_distance = v; }));
  list.push_back(
      binding(section,
              Number<float>{"shutter",
                            "Shutter",
                            c.shutter,
                            {0, 1e4f},
                            "How long it is open, from the scene's time on: what moves meanwhile is blurred; "
                            "0 is an instant",
                            "s",
                            Scale::logarithmic},
              [](Document& d, float v) { d.camera.shutter = v; }));
  // The columns of the matrix: x right, y up, z backwards, w where the camera is.
  static constexpr const char* kMatrix[4][3] = {{"right.x", "right.y", "right.z"},
                                                {"up.x", "up.y", "up.z"},
                                                {"back.x", "back.y", "back.z"},
                                                {"eye.x", "eye.y", "eye.z"}};
  static constexpr const char* kLabels[4] = {"Right", "Up", "Back", "Eye"};
  for (int column = 0; column < 4; ++column)
    add_vector(list, section, kMatrix[column], kLabels[column], Vec3(c.to_world[column]), column == 3 ? kFar : 1.001f,
               "Where the camera is and how it is turned", column == 3 ? "m" : "",
               [column](Document& d, int i, float v) { d.camera.to_world[column][i] = v; });
  return list;
}

}  // namespace etendue::render
