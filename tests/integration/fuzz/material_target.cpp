// Material files. Whatever they contain, a material that is read is in range: its parameters can be written and read again.
#include <unistd.h>

#include "base/file.h"
#include "integration/fuzz/json_mutation.h"
#include "render/document.h"
#include "render/material_settings.h"

namespace etendue::fuzz {
namespace {

namespace fs = std::filesystem;

std::string material_file() {
  static const fs::path file = fs::temp_directory_path() / ("etendue-fuzz-" + std::to_string(::getpid()) + ".material");
  return file.string();
}

const render::Document& cornell() {
  static const render::Document document = *render::new_document("cornell");
  return document;
}

void read_material(Input input) {
  require(static_cast<bool>(write_file(material_file(), input.data(), input.size())), "the input cannot be written");
  const auto document = render::with_material_file(cornell(), 0, material_file());
  fs::remove(material_file());
  if (!document) return;
  require(static_cast<bool>(render::write_material_file(material_file(), *document->scene, 0)),
          "a material cannot be written");
  require(static_cast<bool>(render::with_material_file(cornell(), 0, material_file())),
          "a material that was written cannot be read");
  fs::remove(material_file());
}

// Materials with a reflection model, a medium and a spectrum. Mutations add textures, which are files that do not exist.
std::vector<Bytes> materials() {
  std::vector<Bytes> seeds;
  render::Document document = cornell();
  for (const auto& [name, value] : {std::pair{"material.0.roughness", "0.25"},
                                    {"material.0.scattering.r", "3"},
                                    {"material.0.emission-spectrum", "2700K"},
                                    {"material.0.model", "mirror"}}) {
    auto changed = render::with_text(document, name, value);
    require(static_cast<bool>(changed), "a parameter cannot be set");
    document = std::move(*changed);
    require(static_cast<bool>(render::write_material_file(material_file(), *document.scene, 0)),
            "a seed is not written");
    const auto bytes = read_file(material_file());
    require(static_cast<bool>(bytes), "a seed cannot be read");
    seeds.push_back(*bytes);
  }
  seeds.push_back(bytes_of(R"({"program":"etendue","name":"a","settings":{},"textures":{"base-color":"none.png"}})"));
  fs::remove(material_file());
  return seeds;
}

}  // namespace

const Target kTarget{.run = read_material, .seeds = materials, .mutate = change_json_text};

}  // namespace etendue::fuzz
