#include "viewer/files/scene_export.h"

#include "render/scene_saving.h"
#include "scene/gltf/write.h"

namespace etendue::viewer {

void SceneWriter::write(const std::string& file, const render::Document& document) {
  job_.start([file, document]() -> Result<SavedScene> {
    SavedScene saved{file, {}};
    if (auto r = scene::save_gltf(render::scene_to_save(document), file, &saved.warnings); !r) return r.error();
    return saved;
  });
}

}  // namespace etendue::viewer
