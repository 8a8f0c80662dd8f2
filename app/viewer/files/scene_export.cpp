#include "viewer/files/scene_export.h"

#include "render/document.h"
#include "render/scene_saving.h"
#include "scene/gltf/save_gltf.h"

namespace etendue::viewer {

void SceneExport::write(const std::string& file, const render::Document& document) {
  const auto work = [file, document]() -> Result<SavedScene> {
    SavedScene saved{.file = file, .scene = document.scene, .warnings = {}};
    const auto written = scene::save_gltf(render::scene_to_save(document), file, &saved.warnings);
    if (!written) return written.error();
    return saved;
  };
  task_.start(work, wake_);
}

}  // namespace etendue::viewer
