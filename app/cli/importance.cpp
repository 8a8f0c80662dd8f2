// etendue importance: where light contributes to the image of a camera, by object and as a picture.
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <memory>

#include "base/json_text.h"
#include "command.h"
#include "image/image.h"
#include "interrupt.h"
#include "json.h"
#include "metrics/convergence.h"
#include "metrics/heat_map.h"
#include "render/transport_audit.h"
#include "scene/compiled_scene.h"
#include "scene_options.h"

namespace etendue::cli {
namespace {

struct ImportanceArguments {
  SceneArguments scene;
  std::string out, view;
  uint32_t samples = 16;
  double radius = 0;
  int64_t seed = -1;
  int threads = 0;
  bool json = false;
};

// Three numbers separated by commas.
bool parse_point(std::string_view text, Vec3& point) {
  for (int i = 0; i < 3; ++i) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), point[i]);
    if (error != std::errc()) return false;
    text.remove_prefix(static_cast<size_t>(end - text.data()));
    if (i < 2 && (text.empty() || text.front() != ',')) return false;
    if (i < 2) text.remove_prefix(1);
  }
  return text.empty();
}

// The camera that looks at the scene: a camera of the scene, or POSITION:TARGET.
Result<Camera> view_of(const std::string& text, const render::Document& document) {
  if (text.empty()) return document.camera;
  const std::string_view all = text;
  Vec3 position(0), target(0);
  if (const size_t colon = all.find(':'); colon != std::string_view::npos &&
                                          parse_point(all.substr(0, colon), position) &&
                                          parse_point(all.substr(colon + 1), target) && position != target) {
    Camera camera = document.camera;
    camera.to_world = look_at(position, target, {0, 1, 0}, 1).to_world;
    camera.lens_radius = 0;
    return camera;
  }
  for (const Camera& camera : scene::placed_cameras(*document.scene))
    if (camera.name == text) return camera;
  return usage_error("--view: '" + text +
                     "' is no camera of the scene; give its name, or position and target as X,Y,Z:X,Y,Z");
}

Result<void> write_picture(const std::string& path, const render::Document& d, const image::Layer& picture) {
  if (path.ends_with(".exr")) {
    image::LayeredImage image;
    image.width = d.width;
    image.height = d.height;
    image.layers = {picture};
    return image::write_exr(path, image);
  }
  // A few pixels may be brighter.
  const auto most = static_cast<float>(metrics::quantile({picture.pixels.begin(), picture.pixels.end()}, 0.995));
  std::vector<float> scaled;
  for (const float v : picture.pixels) scaled.push_back(most > 0 ? std::min(v / most, 1.0f) : 0);
  return image::write_png(path, d.width, d.height, metrics::color_mapped(scaled));
}

int run_importance(const ImportanceArguments& a) {
  if (!a.out.empty() && !a.out.ends_with(".png") && !a.out.ends_with(".exr"))
    return fail(usage_error("importance: '" + a.out + "' cannot hold the picture; give -o FILE.png or FILE.exr"));
  auto document = open_document(a.scene);
  if (!document) return fail(document.error());
  if (a.seed >= 0) document->seed = static_cast<uint64_t>(a.seed);
  const auto view = view_of(a.view, *document);
  if (!view) return fail(view.error());
  const auto scene = scene::compile(document->scene, document->camera, nullptr);
  const std::atomic<bool>& interrupted = watch_interrupts();
  const auto audit = render::audit_importance(*document, scene, *view, a.samples, static_cast<float>(a.radius),
                                              a.threads, [&] { return !interrupted.load(); });
  if (interrupted) return static_cast<int>(Fault::interrupted);
  if (!audit) return fail(input_error(a.scene.scene + ": " + audit.error().message));
  if (a.json) {
    json objects = json::array();
    for (const auto& o : audit->objects)
      objects.push_back({{"name", o.name},
                         {"node", o.node},
                         {"importance", o.importance.value},
                         {"standard_error", o.importance.standard_error}});
    std::printf("%s\n", json_text(json{{"scene", document->scene_name}, {"objects", objects}}, 2).c_str());
  } else {
    std::printf("%-24s  mean radiance of the image if the object emitted 1 cd/m^2\n", "object");
    for (const auto& o : audit->objects)
      std::printf("%-24s  %.4g ± %.2g\n", o.name.c_str(), o.importance.value, o.importance.standard_error);
  }
  if (!a.out.empty())
    if (const auto ok = write_picture(a.out, *document, audit->picture); !ok) return fail(ok.error());
  return 0;
}

}  // namespace

Command importance_command() {
  const auto a = std::make_shared<ImportanceArguments>();
  return {.name = "importance",
          .summary = "Where light contributes to the image of a camera, by object and as a picture",
          .options = {scene_option(a->scene.scene),
                      {.names = "-o,--out",
                       .target = &a->out,
                       .doc = "Picture of the importance: .png in false colours, or .exr in 1/m^2"},
                      {.names = "--view",
                       .target = &a->view,
                       .doc = "Camera of the picture: one of the scene, or position and target X,Y,Z:X,Y,Z (the camera "
                              "whose importance it is)"},
                      {.names = "--spp",
                       .target = &a->samples,
                       .doc = "Camera paths per pixel (16)",
                       .bounds = between(2, 1024)},
                      {.names = "--radius",
                       .target = &a->radius,
                       .doc = "Radius of the density estimate in metres (1 % of the scene's diagonal)",
                       .bounds = kPositive},
                      set_option(a->scene.settings),
                      size_option(a->scene.size),
                      camera_option(a->scene.camera),
                      environment_option(a->scene.environment),
                      seed_option(a->seed),
                      threads_option(a->threads),
                      json_flag(a->json)},
          .run = [a] { return run_importance(*a); }};
}

}  // namespace etendue::cli
