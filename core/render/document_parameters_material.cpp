// Sections "material.N": the reflection model with its parameters, and the glTF surface.
#include <algorithm>

#include "render/document_parameters_medium.h"
#include "render/document_parameters_texture.h"

template <>
struct etendue::Options<etendue::AlphaMode> {
  static constexpr std::array<etendue::Option, 3> kOptions{
      {{"opaque", "Opaque"}, {"mask", "Mask"}, {"blend", "Blend"}}};
};
template <>
struct etendue::Options<etendue::Layering> {
  static constexpr std::array<etendue::Option, 2> kOptions{
      {{"gltf", "As in glTF"}, {"energy-conserving", "Energy conserving"}}};
};

namespace etendue::render {
namespace {

constexpr const char* kGltfModel = "gltf";

// Whether a parameter of the glTF surface also applies to materials with a reflection model.
bool applies_to_all_models(std::string_view name) {
  constexpr std::array<std::string_view, 8> kPrefixes{"base-color.", "alpha",    "normal-scale", "double-sided",
                                                      "unlit",       "emission", "attenuation-", "dispersion"};
  return std::ranges::any_of(kPrefixes, [&](std::string_view prefix) { return name.starts_with(prefix); });
}

void set_model(Document& document, size_t index, std::shared_ptr<const BsdfModel> model) {
  edit_scene(document, [&](scene::Scene& s) { s.materials[index].model.model = std::move(model); });
}

DocumentParameter model_choice(const Material& m, size_t index, const std::string& section) {
  DocumentParameter parameter;
  parameter.section = section;
  parameter.info.name = section + ".model";
  parameter.info.label = "Reflection model";
  parameter.info.doc = "The glTF surface, or a reflection model from the literature";
  parameter.info.type = ParameterType::choice;
  parameter.info.options.emplace_back(kGltfModel);
  parameter.info.option_labels.emplace_back("glTF surface");
  for (const auto& info : bsdf_model_infos()) {
    parameter.info.options.emplace_back(info.description.name);
    parameter.info.option_labels.emplace_back(info.description.label);
  }
  parameter.info.default_value = std::string(m.model ? m.model->info().description.name : kGltfModel);
  parameter.assign = [index](Document& d, const Value& v) {
    set_model(d, index, make_bsdf_model(std::get<std::string>(v)));
  };
  return parameter;
}

// A named set of values for all parameters of a reflection model.
DocumentParameter preset_choice(const BsdfModelRef& model, size_t index, const std::string& section) {
  DocumentParameter parameter;
  parameter.section = section;
  parameter.info.name = section + "." + model->info().description.name + ".preset";
  parameter.info.label = "Preset";
  parameter.info.doc = "Sets the parameters to those of a known material";
  parameter.info.type = ParameterType::choice;
  parameter.info.options.emplace_back(kNoPreset);
  parameter.info.option_labels.emplace_back("None");
  for (const ModelPreset& preset : model->info().presets) {
    parameter.info.options.push_back(preset.name);
    parameter.info.option_labels.push_back(preset.label);
  }
  parameter.info.default_value = std::string(preset_of(*model.model));
  parameter.assign = [index](Document& d, const Value& v) {
    const auto& current = d.scene->materials[index].model.model;
    set_model(d, index, with_preset(current, std::get<std::string>(v)));
  };
  return parameter;
}

void add_model(DocumentParameters& list, const Material& m, size_t index, const std::string& section) {
  list.push_back(model_choice(m, index, section));
  if (!m.model) return;
  if (!m.model->info().presets.empty()) list.push_back(preset_choice(m.model, index, section));
  for (const ParameterInfo& info : m.model->parameters()) {
    DocumentParameter parameter;
    parameter.section = section;
    parameter.info = info;
    parameter.info.name = section + "." + m.model->info().description.name + "." + info.name;
    parameter.assign = [index, name = info.name](Document& d, const Value& v) {
      set_model(d, index, d.scene->materials[index].model->with(name, v));
    };
    list.push_back(std::move(parameter));
  }
}

// Adds parameters that are members of one material.
class MaterialParameterList {
 public:
  MaterialParameterList(DocumentParameters& list, const Material& material, const std::string& section, size_t index)
      : list_(list), material_(material), section_(section), index_(index) {}

  template <class Description, class Member>
  void add(const Description& description, Member Material::*member) {
    list_.push_back(make_parameter(section_, description, [index = index_, member](Document& d, const auto& v) {
      edit_scene(d, [&](scene::Scene& s) { s.materials[index].*member = v; });
    }));
  }

  // A file may hold a value above the range; it is shown as the end of the range.
  void add_number(const char* name, const char* label, float Material::*member, Range<float> range, const char* doc,
                  const char* unit = "", Scale scale = Scale::linear) {
    add(Number<float>{name, label, std::min(material_.*member, range.max), range, doc, unit, scale}, member);
  }

  void add_color(const char* const (&names)[3], const char* label, Rgb Material::*member, float largest,
                 const char* doc, const char* unit = "") {
    const Rgb& color = material_.*member;
    add_triple(list_, section_,
               {.names = {names[0], names[1], names[2]},
                .label = label,
                .value = Vec3(color.r, color.g, color.b),
                .range = {0, largest},
                .doc = doc,
                .unit = unit},
               [index = index_, member](Document& d, int c, float v) {
                 edit_scene(d, [&](scene::Scene& s) { (s.materials[index].*member)[c] = v; });
               });
  }

  void add_attenuation_distance() {
    list_.push_back(make_parameter(
        section_,
        Number<float>{"attenuation-distance",
                      "Attenuation distance",
                      std::min(material_.attenuation_distance, kLargestLength),
                      {1e-6f, kLargestLength},
                      "Distance at which white light has the attenuation colour. The largest value stands for no attenuation",
                      "m",
                      Scale::logarithmic},
        [index = index_](Document& d, float v) {
          const float distance = v >= kLargestLength ? kInfinity : v;
          edit_scene(d, [&](scene::Scene& s) { s.materials[index].attenuation_distance = distance; });
        }));
  }

  // The two textures of this model are the same image.
  void add_specular_glossiness() {
    list_.push_back(make_parameter(
        section_,
        Toggle{"specular-glossiness", "Specular-glossiness", material_.specular_glossiness,
               "The base colour is the diffuse albedo, the specular colour the reflectance at normal incidence; metallic "
               "has no effect"},
        [index = index_](Document& d, bool v) {
          edit_scene(d, [&](scene::Scene& s) {
            Material& m = s.materials[index];
            m.specular_glossiness = v;
            if (v) m.metallic_roughness_texture = m.specular_color_texture;
          });
        }));
  }

  void add_emission_spectrum() {
    Text description = emission_spectrum_parameter("emission-spectrum", material_.emission_spectrum);
    description.label = "Emission spectrum";
    list_.push_back(make_parameter(section_, description, [index = index_](Document& d, const std::string& name) {
      edit_scene(d, [&](scene::Scene& s) { s.materials[index].emission_spectrum = emission_spectrum_or_none(name); });
    }));
  }

  // Editing the index or the dispersion replaces the formula of a glass.
  void add_refraction() {
    const auto add_index = [&](const Number<float>& description, float Material::*member) {
      list_.push_back(make_parameter(section_, description, [index = index_, member](Document& d, float v) {
        edit_scene(d, [&](scene::Scene& s) {
          s.materials[index].*member = v;
          s.materials[index].glass = Glass::none;
        });
      }));
    };
    add_index({"ior",
               "IOR",
               std::min(material_.ior, 3.0f),
               {1, 3},
               "Index of refraction of the dielectric; higher reflects and refracts more"},
              &Material::ior);
    add_index({"dispersion",
               "Dispersion",
               std::min(material_.dispersion, 20.0f),
               {0, 20},
               "20 divided by the Abbe number. Raising it separates colours more when a solid refracts light; 0: the "
               "same index for all wavelengths"},
              &Material::dispersion);
    list_.push_back(make_parameter(section_,
                                   Choice<Glass>{"glass", "Glass", material_.glass,
                                                 "Measured index of refraction by wavelength. Sets IOR and dispersion, "
                                                 "which RGB rendering and other programs use"},
                                   [index = index_](Document& d, Glass v) {
                                     edit_scene(d, [&](scene::Scene& s) { set_glass(s.materials[index], v); });
                                   }));
  }

 private:
  static void set_glass(Material& material, Glass glass) {
    material.glass = glass;
    const SellmeierFormula* formula = find_sellmeier(glass);
    material.ior = formula ? static_cast<float>(formula->index_d()) : material.ior;
    material.dispersion = formula ? static_cast<float>(formula->dispersion()) : material.dispersion;
  }

  DocumentParameters& list_;
  const Material& material_;
  const std::string& section_;
  size_t index_;
};

void add_base(MaterialParameterList& parameters) {
  parameters.add_color({"base-color.r", "base-color.g", "base-color.b"}, "Base colour", &Material::base_color, 1,
                       "Diffuse albedo, or reflectance of a metal; multiplies its texture");
  parameters.add_number("metallic", "Metallic", &Material::metallic, {0, 1},
                        "0: dielectric over a diffuse base; 1: metal");
  parameters.add_number("roughness", "Roughness", &Material::roughness, {0, 1},
                        "Higher widens highlights. The microfacet roughness α is its square");
  parameters.add_refraction();
  parameters.add_number("specular", "Specular", &Material::specular, {0, 1},
                        "Strength of the dielectric reflection; 0: purely diffuse surface");
  parameters.add_color({"specular-color.r", "specular-color.g", "specular-color.b"}, "Specular colour",
                       &Material::specular_color, 1, "Tint of the dielectric reflection at normal incidence");
  parameters.add_specular_glossiness();
}

void add_transmission(MaterialParameterList& parameters) {
  parameters.add_number("transmission", "Transmission", &Material::transmission, {0, 1},
                        "Fraction of the light entering the base that is transmitted");
  parameters.add_number("thickness", "Thickness", &Material::thickness, {0, 1000},
                        "0: thin-walled, without refraction; greater: the boundary of a solid volume, which refracts",
                        "m");
  parameters.add_color({"attenuation-color.r", "attenuation-color.g", "attenuation-color.b"}, "Attenuation colour",
                       &Material::attenuation_color, 1,
                       "Colour of white light after the attenuation distance inside the volume");
  parameters.add_attenuation_distance();
}

// The medium inside a solid.
void add_medium(DocumentParameters& list, MaterialParameterList& parameters, const Material& m, size_t index,
                const std::string& section) {
  const size_t first = list.size();
  add_medium_parameters(
      list, {section, [index](scene::Scene& s) -> MediumDescription& { return s.materials[index].medium; }}, m.medium);
  parameters.add(Toggle{"boundary-only", "Boundary of the medium only", m.boundary_only,
                        "Light passes the surface without reflection or refraction; the index of refraction is 1"},
                 &Material::boundary_only);
  parameters.add(Number<int>{"medium-priority",
                             "Medium priority",
                             m.medium_priority,
                             {-1000, 1000},
                             "Where solids overlap, the one with the highest priority is the medium"},
                 &Material::medium_priority);
  for (size_t i = first; !m.is_solid() && i < list.size(); ++i)
    if (list[i].info.name != section + ".boundary-only")
      list[i].inactive_reason =
          "The material encloses no solid: set transmission and thickness, or Boundary of the medium only";
}

void add_layers(MaterialParameterList& parameters, const Material& m) {
  parameters.add(Choice<Layering>{"layering", "Layering", m.layering,
                                  "Light that a layer leaves to the base below. As in glTF: gains energy at grazing "
                                  "angles. Energy conserving: reflects at most all light, at a higher cost"},
                 &Material::layering);
  parameters.add_number("anisotropy", "Anisotropy", &Material::anisotropy, {0, 1},
                        "Stretches highlights along the tangent");
  parameters.add_number("anisotropy-rotation", "Anisotropy rotation", &Material::anisotropy_rotation,
                        {-6.2831853f, 6.2831853f}, "Rotates stretched highlights counter-clockwise from the tangent",
                        "rad");
  parameters.add_number("clearcoat", "Clear coat", &Material::clearcoat, {0, 1}, "Strength of the clear coat");
  parameters.add_number("clearcoat-roughness", "Clear coat roughness", &Material::clearcoat_roughness, {0, 1},
                        "Higher widens the highlights of the clear coat");
  parameters.add_number("clearcoat-normal-scale", "Clear coat normal strength", &Material::clearcoat_normal_scale,
                        {-4, 4}, "Scales the tangential components of the clear coat's normal map");
  parameters.add_color({"sheen-color.r", "sheen-color.g", "sheen-color.b"}, "Sheen colour", &Material::sheen_color, 1,
                       "Light that fibres scatter at grazing angles, as on velvet; black: none");
  parameters.add_number("sheen-roughness", "Sheen roughness", &Material::sheen_roughness, {0, 1},
                        "Deviation of the fibres from the normal; higher spreads the sheen");
  parameters.add_number("iridescence", "Iridescence", &Material::iridescence, {0, 1},
                        "Strength of the thin-film interference colours");
  parameters.add_number("iridescence-ior", "Thin-film IOR", &Material::iridescence_ior, {1, 3},
                        "Index of refraction of the thin film");
  parameters.add_number("iridescence-thickness-min", "Min. film thickness", &Material::iridescence_thickness_min,
                        {0, 3000}, "Film thickness where the thickness texture is 0", "nm");
  parameters.add_number("iridescence-thickness-max", "Max. film thickness", &Material::iridescence_thickness_max,
                        {0, 3000}, "Film thickness where the thickness texture is 1, or everywhere without texture",
                        "nm");
  parameters.add_number("diffuse-transmission", "Diffuse transmission", &Material::diffuse_transmission, {0, 1},
                        "Fraction of the diffuse light that leaves on the other side, as through paper");
  parameters.add_color({"diffuse-transmission-color.r", "diffuse-transmission-color.g", "diffuse-transmission-color.b"},
                       "Diffuse transmission colour", &Material::diffuse_transmission_color, 1,
                       "Tint of the diffusely transmitted light");
}

void add_emission_and_opacity(MaterialParameterList& parameters, const Material& m) {
  parameters.add_color({"emission.r", "emission.g", "emission.b"}, "Emission", &Material::emission, 1e6f,
                       "Emitted luminance; glTF: emissiveFactor times emissiveStrength", "cd/m\u00b2");
  parameters.add_emission_spectrum();
  parameters.add_number("alpha", "Opacity", &Material::alpha, {0, 1}, "Used by the alpha modes Mask and Blend");
  parameters.add(Choice<AlphaMode>{"alpha-mode", "Alpha mode", m.alpha_mode,
                                   "Opaque; Mask: cut out below the cutoff; Blend: partly transparent"},
                 &Material::alpha_mode);
  parameters.add_number("alpha-cutoff", "Alpha cutoff", &Material::alpha_cutoff, {0, 1},
                        "Opacity below which a masked surface is cut out");
  parameters.add_number("normal-scale", "Normal map strength", &Material::normal_scale, {-4, 4},
                        "Scales the tangential components of the normal map");
  parameters.add(Toggle{"double-sided", "Double sided", m.double_sided, "Emits light from both sides"},
                 &Material::double_sided);
  parameters.add(Toggle{"unlit", "Unlit", m.unlit, "Shows the base colour regardless of illumination"},
                 &Material::unlit);
}

}  // namespace

DocumentParameters material_parameters(const Document& document, size_t index, const std::string& section) {
  const Material& m = document.scene->materials[index];
  DocumentParameters list;
  add_model(list, m, index, section);
  const size_t first_of_surface = list.size();
  MaterialParameterList parameters(list, m, section, index);
  add_base(parameters);
  add_transmission(parameters);
  add_layers(parameters, m);
  add_emission_and_opacity(parameters, m);
  const size_t end_of_surface = list.size();
  add_medium(list, parameters, m, index, section);
  for (size_t i = first_of_surface; m.model && i < end_of_surface; ++i)
    if (!applies_to_all_models(std::string_view(list[i].info.name).substr(section.size() + 1)))
      list[i].inactive_reason = std::string("The reflection model ") + m.model->info().description.label +
                                " has parameters of its own; this one belongs to the glTF surface";
  add_texture_parameters(list, *document.scene, index, section);
  return list;
}

}  // namespace etendue::render
