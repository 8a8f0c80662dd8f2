#include "manual_images.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "bsdf/bsdf_model.h"
#include "experiments/experiment.h"
#include "experiments/experiment_output.h"
#include "figures/composition.h"
#include "film/film_image.h"
#include "image/display.h"
#include "image/image.h"
#include "integrator/integrator.h"
#include "light/environments/builtin_environment.h"
#include "light/light.h"
#include "render/document.h"
#include "render/incompatibility.h"
#include "render/session.h"
#include "sampling/sampler.h"
#include "scene/builtin/builtin.h"
#include "scene/builtin/shapes.h"
#include "scene/compiled_scene.h"
#include "stress/case.h"

namespace etendue::cli {
namespace {

constexpr int kWidth = 240, kHeight = 180, kStressSize = 96, kFigureWidth = 220;

class ImageWriter {
 public:
  ImageWriter(std::filesystem::path folder, int threads, bool only_missing)
      : folder_(std::move(folder)), threads_(threads), only_missing_(only_missing) {}

  Result<void> render(const std::string& kind, const std::string& name, render::Document document,
                      uint32_t samples) const {
    if (is_kept(kind, name)) return {};
    document.width = kWidth;
    document.height = kHeight;
    const film::Film film = render::rendered(document, samples, threads_);
    const std::vector<uint8_t> pixels =
        image::display_pixels(film::radiance_of(film), document.display.exposure, image::ToneCurve::agx);
    return write(kind, name, kWidth, kHeight, pixels);
  }

  Result<void> write(const std::string& kind, const std::string& name, int width, int height,
                     const std::vector<uint8_t>& pixels) const {
    const std::filesystem::path file = path_of(kind, name);
    std::fprintf(stderr, "%s\n", file.filename().c_str());
    return image::write_png(file, width, height, pixels);
  }

  bool has(const std::string& kind, const std::string& name) const {
    std::error_code error;
    return std::filesystem::exists(path_of(kind, name), error);
  }

  // Whether the image exists and is to be kept.
  bool is_kept(const std::string& kind, const std::string& name) const { return only_missing_ && has(kind, name); }

  int threads() const { return threads_; }

 private:
  std::filesystem::path path_of(const std::string& kind, const std::string& name) const {
    return folder_ / (kind + "-" + name + ".png");
  }

  std::filesystem::path folder_;
  int threads_;
  bool only_missing_;
};

// A sphere on a floor, and the camera that looks at it.
render::Document stage(const Material& material, scene::Scene scene) {
  Material floor = scene::diffuse(Rgb(0.35f));
  floor.name = "floor";
  scene::add(scene, scene::quad(8), floor);
  Mat4 above(1);
  above[3] = Vec4(0, 1, 0, 1);
  scene::add(scene, scene::sphere(1, 64, false), material, above);
  render::Document d;
  d.scene = std::make_shared<const scene::Scene>(std::move(scene));
  d.camera = look_at({0, 2.2f, 5.2f}, {0, 0.9f, 0}, {0, 1, 0}, 0.55f);
  return d;
}

scene::Scene lit_by(const Light& light, const Vec3& position) {
  scene::Scene scene;
  scene::Transform transform;
  transform.matrix = look_at(position, {0, 0.5f, 0}, {0, 0.99f, 0.1f}, 1).to_world;
  scene::add(scene, light, transform);
  return scene;
}

render::Document surface_stage(const BsdfModelRef& model) {
  Material material;
  material.base_color = Rgb(0.8f, 0.45f, 0.25f);
  material.model = model;
  scene::Scene scene = lit_by(make_light("quad", {{"width", 2.0}, {"height", 2.0}, {"intensity", 12.0}}), {2.5f, 4, 2});
  scene.environment.tint = Rgb(0.15f);
  return stage(material, std::move(scene));
}

// Intensities that give a similar exposure for all types.
render::Document light_stage(const LightTypeInfo& type) {
  const LightClass light_class = type.description.light_class;
  const double intensity = light_class == LightClass::delta_position    ? 40
                           : light_class == LightClass::delta_direction ? 2.5
                           : light_class == LightClass::area            ? 14
                                                                        : 0.8;
  Light light = make_light(type.description.name, {{"intensity", intensity}});
  const std::string_view name = type.description.name;
  if (name == "photometric") light.set("profile", std::string("batwing"));
  if (name == "cylinder") light.set("intensity", 50.0);  // its surface is small
  return stage(scene::diffuse(Rgb(0.7f)), lit_by(light, {2, 3.6f, 2}));
}

bool is_compatible(const render::Document& d) {
  return render::incompatibility(d, *scene::compile(d.scene, d.camera, nullptr)).empty();
}

Result<void> write_integrators(const ImageWriter& out) {
  render::Document d = *render::new_document("cornell-spheres");
  for (const auto& info : integrator::integrator_infos()) {
    d.method.integrator = info.name;
    render::Document seen = d;
    uint32_t samples = 64;
    // Light paths that must hit the lens see nothing through a pinhole.
    if (!is_compatible(seen)) {
      seen.camera.lens_radius = 0.3f;
      samples = 2048;
    }
    // Radiosity needs diffuse surfaces.
    if (!is_compatible(seen)) {
      seen = *render::new_document("cornell");
      seen.method.integrator = info.name;
      samples = 64;
    }
    if (auto ok = out.render("integrator", info.name, seen, samples); !ok) return ok;
  }
  return {};
}

Result<void> write_samplers(const ImageWriter& out) {
  render::Document d = *render::new_document("cornell");
  for (const auto& info : sampler_infos()) {
    d.method.sampler = info.name;
    if (auto ok = out.render("sampler", info.name, d, 4); !ok) return ok;
  }
  return {};
}

Result<void> write_surfaces(const ImageWriter& out) {
  if (auto ok = out.render("surface", "gltf", surface_stage({}), 128); !ok) return ok;
  for (const auto& info : bsdf_model_infos()) {
    BsdfModelRef model;
    model.model = make_bsdf_model(info.description.name);
    if (!is_black(model->subsurface().mean_free_path))
      model.model = model->with("scale", 200.0);  // a body of the size of a hand
    if (auto ok = out.render("surface", info.description.name, surface_stage(model), 128); !ok) return ok;
  }
  return {};
}

Result<void> write_lights(const ImageWriter& out) {
  for (const auto& info : light_type_infos())
    if (auto ok = out.render("light", info.description.name, light_stage(info), 64); !ok) return ok;
  return {};
}

// A white and a metal sphere.
Result<void> write_environments(const ImageWriter& out) {
  for (const auto& environment : builtin_environments()) {
    scene::Scene scene;
    scene.environment = make_environment(environment);
    Material metal;
    metal.base_color = Rgb(0.9f);
    metal.metallic = 1;
    metal.roughness = 0.15f;
    Material white = scene::diffuse(Rgb(0.8f));
    for (const auto& [material, x] : {std::pair{white, -1.15f}, std::pair{metal, 1.15f}}) {
      Mat4 place(1);
      place[3] = Vec4(x, 1, 0, 1);
      scene::add(scene, scene::sphere(1, 64, false), material, place);
    }
    render::Document d;
    d.scene = std::make_shared<const scene::Scene>(std::move(scene));
    d.camera = look_at({0, 1.6f, 6.2f}, {0, 0.95f, 0}, {0, 1, 0}, 0.62f);
    if (d.scene->environment.sky) d.display.exposure = -14.5f;
    if (auto ok = out.render("environment", environment.name, d, 128); !ok) return ok;
  }
  return {};
}

// A built-in scene, with an integrator and a number of samples that show it without much noise.
Result<void> write_scene(const ImageWriter& out, const std::string& name) {
  render::Document d = *render::new_document(name);
  uint32_t samples = 64;
  if (name == "fire") samples = 512;
  if (name == "milk" || name == "wax") {
    samples = name == "milk" ? 160 : 400;
    d.method.integrator = "sppm";
    for (const auto& [parameter, value] :
         {std::pair("sppm.photons", "200000"), std::pair("sppm.volume-radius", name == "milk" ? "0.002" : "0.0015")})
      d = *render::with_text(d, parameter, value);
  }
  return out.render("scene", name, d, samples);
}

Result<void> write_scenes_and_cameras(const ImageWriter& out) {
  for (const auto& builtin : scene::builtins())
    if (auto ok = write_scene(out, builtin.name); !ok) return ok;
  render::Document d = *render::new_document("cornell-spheres");
  d.camera.ymag = 2.8f;  // the box fills the image of an orthographic camera
  const auto parameters = render::section_parameters(d, "camera");
  for (const auto& p : parameters)
    if (p.info.name == "camera.projection")
      for (const auto& name : p.info.options)
        if (auto ok = out.render("camera", name, *render::with_text(d, p.info.name, name), 64); !ok) return ok;
  return {};
}

// Whether the means over parts of an image of this width hardly differ, so that it shows noise at most.
bool is_uniform(const std::vector<uint8_t>& pixels, int width) {
  constexpr size_t kParts = 8;  // along each axis
  const size_t row = 3 * static_cast<size_t>(width);
  std::array<double, kParts * kParts> sum{}, count{};
  for (size_t i = 0; i < pixels.size(); ++i) {
    const size_t part = i / row * kParts / (pixels.size() / row) * kParts + i % row * kParts / row;
    sum[part] += pixels[i];
    ++count[part];
  }
  for (size_t part = 0; part < sum.size(); ++part) sum[part] /= std::max(count[part], 1.0);
  const auto [low, high] = std::ranges::minmax(sum);
  return high - low < 4;
}

// The first image of a case that shows something. Cases take long: an image that exists is kept.
Result<void> write_stress_case(const ImageWriter& out, const stress::Case& c) {
  if (out.has("stress", c.name)) return {};
  stress::TestContext test({.seed = 0, .threads = out.threads(), .size = kStressSize});
  c.run(test);
  for (const auto& result : test.take_results()) {
    const auto& [width, height, pixels] = result.image;
    if (!pixels.empty() && !is_uniform(pixels, width)) return out.write("stress", c.name, width, height, pixels);
  }
  return {};
}

// The charts of an experiment with its default parameters.
Result<void> write_experiments(const ImageWriter& out) {
  for (const auto& e : experiments::experiments()) {
    if (out.is_kept("experiment", e.description.name)) continue;
    const auto result = e.run({}, {});
    if (!result) return result.error();
    metrics::ChartOptions options;
    options.width = 720;
    options.height = 400;
    const metrics::Drawing drawing = experiments::drawing_of(*result, options);
    if (auto ok =
            out.write("experiment", e.description.name, drawing.width, drawing.height, metrics::rasterize(drawing));
        !ok)
      return ok;
  }
  return {};
}

Result<void> write_figures(const ImageWriter& out) {
  for (const figures::Figure& figure : figures::figures()) {
    if (out.is_kept("figure", figure.number)) continue;
    const auto parts = figure.make({.threads = out.threads(), .width = kFigureWidth});
    if (!parts) return parts.error();
    const figures::Picture picture = figures::rasterized(figures::composed(*parts, figure.columns));
    if (auto ok = out.write("figure", figure.number, picture.width, picture.height, picture.pixels); !ok) return ok;
  }
  return {};
}

}  // namespace

Result<void> write_manual_images(const std::filesystem::path& folder, int threads, bool only_missing) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  const ImageWriter out(folder, threads, only_missing);
  for (const auto write : {write_integrators, write_samplers, write_surfaces, write_lights, write_environments,
                           write_scenes_and_cameras, write_experiments, write_figures})
    if (auto ok = write(out); !ok) return ok;
  for (const auto& c : stress::cases())
    if (auto ok = write_stress_case(out, c); !ok) return ok;
  return {};
}

}  // namespace etendue::cli
