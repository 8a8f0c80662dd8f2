#include "render/document_parameters_texture.h"

#include <algorithm>

#include "material/texture_slots.h"

namespace etendue::render {
namespace {

constexpr float kLargestOffset = 1e4f, kLargestScale = 1e4f;

// Edits a use of a texture. The two textures of the specular-glossiness model are the same image.
template <class Edit>
void edit_use(Document& document, size_t material, TextureUse Material::*use, const Edit& edit) {
  edit_scene(document, [&](scene::Scene& s) {
    Material& m = s.materials[material];
    edit(m.*use);
    if (!m.specular_glossiness) return;
    if (use == &Material::specular_color_texture) m.metallic_roughness_texture = m.specular_color_texture;
    if (use == &Material::metallic_roughness_texture) m.specular_color_texture = m.metallic_roughness_texture;
  });
}

// Adds the parameters of one slot.
class SlotParameters {
 public:
  SlotParameters(DocumentParameters& list, const TextureSlot& slot, size_t material, const std::string& section)
      : list_(list), slot_(slot), material_(material), section_(section), name_(std::string("texture.") + slot.name) {}

  // Removing a texture also resets its transform, which is no parameter then.
  void add_texture(const TextureUse& use, size_t textures) {
    const std::string doc = std::string(slot_.doc) + ". Index of a texture of the scene; -1: none";
    const int last = static_cast<int>(textures) - 1;
    add(Number<int>{name_.c_str(), slot_.label, std::min(use.texture, last), {-1, last}, doc.c_str()},
        [](TextureUse& u, int v) {
          if (v < 0) u = {};
          u.texture = v;
        });
  }

  void add_transform(const TextureUse& use) {
    add_part(".uv-set", "Coordinates", use.uv_set, Range<int>{0, 1}, "Set of texture coordinates of the mesh", "",
             [](TextureUse& u, int v) { u.uv_set = v; });
    add_pair(".offset", "Offset", use.offset, {-kLargestOffset, kLargestOffset},
             "Added to the texture coordinates after rotation and scale", &TextureUse::offset);
    add_part(".rotation", "Rotation", use.rotation, Range<float>{-6.2831853f, 6.2831853f},
             "Counter-clockwise rotation of the texture coordinates about their origin", "rad",
             [](TextureUse& u, float v) { u.rotation = v; });
    add_pair(".scale", "Scale", use.scale, {-kLargestScale, kLargestScale},
             "Multiplies the texture coordinates; higher repeats the image more often", &TextureUse::scale);
  }

 private:
  template <class Description, class Store>
  void add(const Description& description, Store store) {
    DocumentParameter parameter;
    parameter.info = describe(description);
    parameter.info.name = section_ + "." + parameter.info.name;
    parameter.section = section_;
    using T = decltype(description.value);
    parameter.assign = [material = material_, use = slot_.use, store](Document& d, const Value& value) {
      Number<T> number{};
      etendue::assign(number, value);
      edit_use(d, material, use, [&](TextureUse& u) { store(u, number.value); });
    };
    list_.push_back(std::move(parameter));
  }

  template <class T, class Store>
  void add_part(const std::string& part, const char* label, T value, Range<T> range, const char* doc, const char* unit,
                Store store) {
    const std::string name = name_ + part;
    add(Number<T>{name.c_str(), label, value, range, doc, unit}, store);
  }

  void add_pair(const std::string& part, const std::string& label, Vec2 value, Range<float> range, const char* doc,
                Vec2 TextureUse::*member) {
    constexpr const char* kNames[] = {".x", ".y"};
    constexpr const char* kLabels[] = {" u", " v"};
    for (int c = 0; c < 2; ++c)
      add_part(part + kNames[c], (label + kLabels[c]).c_str(), value[c], range, doc, "",
               [member, c](TextureUse& u, float v) { (u.*member)[c] = v; });
  }

  DocumentParameters& list_;
  const TextureSlot& slot_;
  size_t material_;
  const std::string& section_;
  std::string name_;
};

}  // namespace

void add_texture_parameters(DocumentParameters& list, const scene::Scene& scene, size_t material,
                            const std::string& section) {
  const Material& m = scene.materials[material];
  for (const TextureSlot& slot : texture_slots()) {
    const size_t first = list.size();
    SlotParameters parameters(list, slot, material, section);
    const TextureUse& use = m.*slot.use;
    parameters.add_texture(use, scene.textures.size());
    if (use.texture >= 0) parameters.add_transform(use);
    for (size_t i = first; m.model && !slot.applies_to_models && i < list.size(); ++i)
      list[i].inactive_reason = std::string("The reflection model ") + m.model->info().description.label +
                                " does not use this texture; it belongs to the glTF surface";
  }
}

}  // namespace etendue::render
