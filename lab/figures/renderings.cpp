// Figures of chapters 1, 6, 8, 9 and 10: renderings of the built-in scenes by different methods.
#include <cmath>
#include <memory>

#include "figures/tools.h"
#include "film/film_image.h"
#include "render/session.h"
#include "scene/builtin/shapes.h"

namespace etendue::figures {
namespace {

// The Cornell box of diffuse surfaces with a spherical light of the same power.
render::Document box_with_ball_light(std::initializer_list<const char*> settings) {
  render::Document document = document_of("cornell", settings);
  scene::Scene scene = *document.scene;
  for (scene::Node& node : scene.nodes)
    if (node.name == "light") node.visible = false;
  constexpr float kRadius = 0.45f;
  Mat4 place(1);
  place[3] = Vec4(2.78f, 4.4f, 2.8f, 1);
  scene::add(scene, scene::sphere(kRadius, 32, false), scene::diffuse(Rgb(0), {9.1f, 6.4f, 2.1f}), place);
  document.scene = std::make_shared<const scene::Scene>(std::move(scene));
  return document;
}

Part by_method(const std::string& caption, const char* scene, std::initializer_list<const char*> settings,
               const MakeContext& context, uint32_t samples, bool exact_samples = false) {
  return rendering_part(caption, document_of(scene, settings), context,
                        {.samples = samples, .exact_samples = exact_samples});
}

std::string with_samples(const std::string& name, uint32_t samples) {
  return name + ", " + std::to_string(samples) + (samples == 1 ? " sample" : " samples") + " per pixel";
}

// A checkerboard on a plane that is seen under a flat angle; x and y are image coordinates in the unit square.
double checkerboard_in_perspective(double x, double y) {
  constexpr double kHorizon = 0.75, kHeight = 1.2, kSquare = 0.55;
  if (y >= kHorizon) return 0.75;
  const double distance = kHeight / (kHorizon - y), side = (x - 0.5) * distance * 1.5;
  const auto cell = static_cast<long>(std::floor(distance / kSquare)) + static_cast<long>(std::floor(side / kSquare));
  return cell % 2 == 0 ? 0.1 : 0.95;
}

}  // namespace

Figure figure_1_3() {
  return {.title = "Local and global illumination",
          .note = "Left, ray casting with direct light and no shadows. Right, path tracing.",
          .make = [](const MakeContext& context) -> Result<Parts> {
            return Parts{by_method("Local", "cornell-spheres", {"integrator=raycast"}, context, 64),
                         by_method("Global", "cornell-spheres", {"integrator=path"}, context, 512)};
          }};
}

Figure figure_1_11() {
  return {.title = "Ray tracing",
          .note = "Direct light, reflection and refraction; the light is an area light, so shadows have soft edges.",
          .make = [](const MakeContext& context) -> Result<Parts> {
            return Parts{by_method("Whitted", "cornell-spheres", {"integrator=whitted"}, context, 128)};
          }};
}

Figure figure_1_13() {
  return {.title = "Ray tracing and path tracing",
          .note = "Only path tracing lights the ceiling and shows the caustic below the glass sphere.",
          .make = [](const MakeContext& context) -> Result<Parts> {
            return Parts{by_method("Ray tracing", "cornell-spheres", {"integrator=whitted"}, context, 128),
                         by_method("Path tracing", "cornell-spheres", {"integrator=path"}, context, 1024)};
          }};
}

Figure figure_1_14() {
  return {.title = "Noise of path tracing", .make = [](const MakeContext& context) -> Result<Parts> {
            Parts parts;
            for (const uint32_t samples : {5U, 25U, 125U})
              parts.push_back(by_method(std::to_string(samples) + " paths per pixel", "cornell-spheres",
                                        {"integrator=path"}, context, samples, true));
            return parts;
          }};
}

Figure figure_1_15() {
  return {.title = "Radiosity of the Cornell box and its patches",
          .note = "Left, interpolated between the vertices of the patches; right, constant on each patch.",
          .make = [](const MakeContext& context) -> Result<Parts> {
            return Parts{
                by_method("Interpolated", "cornell",
                          {"integrator=radiosity", "radiosity.patches=6000", "radiosity.reconstruction=linear",
                           "radiosity.gather=direct"},
                          context, 64),
                by_method("Patches", "cornell", {"integrator=radiosity", "radiosity.patches=1500"}, context, 16)};
          }};
}

Figure figure_2_65() {
  return {.title = "Pure Monte Carlo path tracing", .make = [](const MakeContext& context) -> Result<Parts> {
            return Parts{by_method("Cornell box", "cornell", {"integrator=path-pure"}, context, 512)};
          }};
}

namespace {

constexpr const char* kHeuristics[] = {"constant", "balance", "cutoff", "power", "maximum", "partition"};

render::Document plates_with(const char* heuristic) {
  const std::string setting = std::string("path.heuristic=") + heuristic;
  return document_of("glossy-plates", {"integrator=path", "path.max-depth=2", setting.c_str()});
}

// Root mean square error over pixels and channels.
double rms_error(const film::Film& film, const film::Film& reference) {
  const std::vector<float> a = film::radiance_of(film), b = film::radiance_of(reference);
  double sum = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    const auto difference = static_cast<double>(a[i]) - static_cast<double>(b[i]);
    sum += difference * difference;
  }
  return std::sqrt(sum / static_cast<double>(a.size()));
}

// Errors of direct light on the plates, against a rendering of another seed.
Part errors_of_heuristics(const MakeContext& context) {
  const auto film_of = [&](const char* heuristic, uint64_t seed, uint32_t samples) {
    render::Document document = plates_with(heuristic);
    document.width = document.height = std::max(16, context.width / 2);
    document.seed = seed;
    return render::rendered(document, samples, context.threads);
  };
  const auto reference_samples = static_cast<uint32_t>(std::max(16.0, std::ceil(4096 * context.effort)));
  const film::Film reference = film_of("power", context.seed + 1, reference_samples);
  FunctionChart chart{.title = "Error of direct light",
                      .x_label = "samples per pixel",
                      .y_label = "RMSE",
                      .curves = {},
                      .logarithmic_x = true,
                      .logarithmic_y = true};
  for (const char* heuristic : kHeuristics) {
    FunctionCurve curve{.name = heuristic, .points = {}};
    for (uint32_t samples = 2; samples <= 64; samples *= 2)
      curve.points.push_back(
          {static_cast<double>(samples), rms_error(film_of(heuristic, context.seed, samples), reference)});
    chart.curves.push_back(std::move(curve));
  }
  return chart_part(chart);
}

}  // namespace

Figure figure_6_37() {
  return {.title = "The glossy highlights problem",
          .note =
              "BSDF sampling fails on rough surfaces and small lights, light sampling on smooth surfaces and large "
              "lights. Then six heuristics of multiple importance sampling at the same number of samples, and their "
              "errors. The partition is light sampling, except where only BSDF samples find light.",
          .columns = 3,
          .make = [](const MakeContext& context) -> Result<Parts> {
            Parts parts{by_method("BSDF sampling", "glossy-plates", {"integrator=path-pure", "path-pure.max-depth=2"},
                                  context, 4, true),
                        rendering_part("Light sampling",
                                       document_of("glossy-plates", {"integrator=bdpt", "bdpt.max-depth=2",
                                                                     "bdpt.only=0,2 1,2", "bdpt.weighted=false"}),
                                       context, {.samples = 4, .exact_samples = true})};
            for (const char* heuristic : kHeuristics)
              parts.push_back(rendering_part(std::string("MIS, ") + heuristic, plates_with(heuristic), context,
                                             {.samples = 4, .exact_samples = true}));
            parts.push_back(errors_of_heuristics(context));
            return parts;
          }};
}

Figure figure_8_6() {
  return {.title = "Ray casting without and with local illumination",
          .make = [](const MakeContext& context) -> Result<Parts> {
            return Parts{
                by_method("Emission only", "cornell", {"integrator=raycast", "raycast.local=false"}, context, 32),
                by_method("Local illumination without shadows", "cornell", {"integrator=raycast"}, context, 32)};
          }};
}

Figure figure_8_12() {
  return {.title = "Ray tracing after Whitted", .make = [](const MakeContext& context) -> Result<Parts> {
            return Parts{by_method("Box with spheres", "cornell-spheres", {"integrator=whitted"}, context, 128),
                         by_method("Glass sphere", "glass-caustic", {"integrator=whitted"}, context, 128)};
          }};
}

Figure figure_8_13() {
  return {.title = "Ray tracing after Whitted with area light sources",
          .note = "Shadows of area lights have soft edges.",
          .make = [](const MakeContext& context) -> Result<Parts> {
            return Parts{by_method("Box with spheres", "cornell-spheres", {"integrator=whitted"}, context, 256)};
          }};
}

Figure figure_8_19() {
  return {.title = "Fuzzy phenomena: depth of field",
          .note = "The camera focuses on the near sphere. The motion blur of the book's billiard balls is not shown.",
          .make = [](const MakeContext& context) -> Result<Parts> {
            render::Document document = document_of("cornell-spheres", {"integrator=distribution"});
            document.camera.lens_radius = 0.35f;
            document.camera.focus_distance = 9.2f;
            return Parts{rendering_part("", document, context, {.samples = 256})};
          }};
}

Figure figure_8_21() {
  return {.title = "Aliasing",
          .note =
              "One sample at the centre of each of 512 x 512 pixels. Left, (1 + sin(x\u00b2 y\u00b2)) / 2 on [0, "
              "10.83]\u00b2: "
              "the rings away from the axes are not in the function.",
          .make = [](const MakeContext&) -> Result<Parts> {
            const auto moire = [](double u, double v) {
              const double x = 10.83 * u, y = 10.83 * v;
              return 0.5 * (1 + std::sin(x * x * y * y));
            };
            return Parts{{.caption = "Function", .content = grey_picture(512, moire)},
                         {.caption = "Checkerboard", .content = grey_picture(512, checkerboard_in_perspective)}};
          }};
}

Figure figure_9_7() {
  return {.title = "Pure path tracing with eye paths of length 5 and less",
          .make = [](const MakeContext& context) -> Result<Parts> {
            Parts parts;
            for (const uint32_t samples : {1U, 64U, 1024U})
              parts.push_back(rendering_part(with_samples("Box", samples),
                                             box_with_ball_light({"integrator=path-pure", "path-pure.max-depth=5"}),
                                             context, {.samples = samples, .exact_samples = true}));
            return parts;
          }};
}

Figure figure_9_13() {
  return {.title = "Caustics",
          .note = "Equal numbers of samples.",
          .make = [](const MakeContext& context) -> Result<Parts> {
            return Parts{
                by_method(with_samples("Path tracing", 64), "glass-caustic", {"integrator=path"}, context, 64, true),
                by_method(with_samples("Bidirectional path tracing", 64), "glass-caustic", {"integrator=bdpt"}, context,
                          64, true),
                by_method(with_samples("Progressive photon mapping", 64), "glass-caustic", {"integrator=sppm"}, context,
                          64, true)};
          }};
}

Figure figure_9_16() {
  return {.title = "Pure light tracing",
          .note = "Light paths must hit the lens, which has a radius of 0.3 m here.",
          .make = [](const MakeContext& context) -> Result<Parts> {
            Parts parts;
            const auto pixels = static_cast<double>(context.width) * context.width;
            for (const uint32_t samples : {1U, 10U, 100U, 1000U}) {
              render::Document document = box_with_ball_light({"integrator=light-pure"});
              document.camera.lens_radius = 0.3f;
              char caption[64];
              std::snprintf(caption, sizeof caption, "%.0e light paths", pixels * samples);
              parts.push_back(rendering_part(caption, document, context, {.samples = samples, .exact_samples = true}));
            }
            return parts;
          }};
}

Figure figure_9_17() {
  return {.title = "Path tracing and bidirectional path tracing",
          .note =
              "A room that is lit by a spot on the ceiling. Numbers of samples as in the book, where they took the "
              "same time.",
          .make = [](const MakeContext& context) -> Result<Parts> {
            return Parts{
                by_method(with_samples("Path tracing", 56), "spot-indirect", {"integrator=path"}, context, 56, true),
                by_method(with_samples("Bidirectional path tracing", 25), "spot-indirect", {"integrator=bdpt"}, context,
                          25, true)};
          }};
}

namespace {

// Row by row, the contributions of all techniques with at least one vertex of either subpath to paths of 2 to 6 edges.
Result<Parts> technique_pyramid(const MakeContext& context, bool weighted) {
  Parts parts;
  for (int edges = 2; edges <= 6; ++edges)
    for (int light = 1; light <= 6; ++light) {
      const int eye = edges + 1 - light;
      if (eye < 1) {
        parts.push_back(
            {.caption = {}, .content = metrics::Drawing{.width = 1, .height = 1, .title = {}, .shapes = {}}});
        continue;
      }
      const std::string technique = std::to_string(light) + "," + std::to_string(eye);
      const std::string depth = "bdpt.max-depth=" + std::to_string(edges), only = "bdpt.only=" + technique;
      render::Document document = document_of("cornell-spheres", {"integrator=bdpt", depth.c_str(), only.c_str()});
      if (!weighted) set(document, {"bdpt.weighted=false"});
      parts.push_back(rendering_part(technique, document, context,
                                     {.samples = 64, .exposure = 1.3f * static_cast<float>(edges - 1), .columns = 3}));
    }
  return parts;
}

}  // namespace

Figure figure_9_25() {
  return {.title = "Weighted contributions of bidirectional techniques",
          .note =
              "Each row shows paths with the same number of edges, from 2 at the top to 6, brightened by 1.3 stops "
              "more per "
              "row. s is the number of vertices of the light subpath, t of the eye subpath: path tracing on the left, "
              "light tracing on the right.",
          .columns = 6,
          .make = [](const MakeContext& context) -> Result<Parts> { return technique_pyramid(context, true); }};
}

Figure figure_9_26() {
  return {.title = "Contributions of bidirectional techniques without weights",
          .note = "As figure 9.25, with each technique in full: where a technique finds paths seldom, it is noisy.",
          .columns = 6,
          .make = [](const MakeContext& context) -> Result<Parts> { return technique_pyramid(context, false); }};
}

Figure figure_9_28() {
  return {.title = "A caustic by Metropolis light transport", .make = [](const MakeContext& context) -> Result<Parts> {
            return Parts{by_method("Metropolis light transport", "glass-caustic", {"integrator=mlt"}, context, 128)};
          }};
}

Figure figure_9_38() {
  return {.title = "Direct visualisation of the photon map",
          .note = "Settings as in the book.",
          .make = [](const MakeContext& context) -> Result<Parts> {
            const auto part = [&](const char* caption, const char* photons, const char* caustic_photons,
                                  const char* nearest) {
              return rendering_part(caption,
                                    document_of("cornell-spheres", {"integrator=photonmap", "photonmap.mode=direct",
                                                                    photons, caustic_photons, nearest}),
                                    context, {.samples = 16});
            };
            return Parts{part("10,000 photons, 100 in an estimate", "photonmap.photons=10000",
                              "photonmap.caustic-photons=10000", "photonmap.nearest=100"),
                         part("500,000 photons, 500 in an estimate", "photonmap.photons=500000",
                              "photonmap.caustic-photons=500000", "photonmap.nearest=500")};
          }};
}

Figure figure_9_44() {
  return {
      .title = "Direct light and photons",
      .note =
          "Right, estimates with a radius of 0.5 % of the scene show single photons. The spheres are ray traced; the "
          "book paints them black.",
      .make = [](const MakeContext& context) -> Result<Parts> {
        return Parts{by_method("Ray tracing", "cornell-spheres", {"integrator=whitted"}, context, 128),
                     by_method("Photons", "cornell-spheres",
                               {"integrator=photonmap", "photonmap.mode=direct", "photonmap.photons=4000",
                                "photonmap.caustic-photons=0", "photonmap.nearest=50", "photonmap.radius=0.005",
                                "photonmap.kernel=constant"},
                               context, 16)};
      }};
}

Figure figure_9_45() {
  return {.title = "Final gathering",
          .note = "Direct visualisation and final gathering of the same photons.",
          .make = [](const MakeContext& context) -> Result<Parts> {
            return Parts{by_method("Direct visualisation", "cornell-spheres",
                                   {"integrator=photonmap", "photonmap.mode=direct"}, context, 64),
                         by_method("Final gathering", "cornell-spheres",
                                   {"integrator=photonmap", "photonmap.mode=classic"}, context, 64)};
          }};
}

Figure figure_9_47() {
  return {.title = "Instant global illumination",
          .note = "A room lit by one bright patch on the ceiling.",
          .make = [](const MakeContext& context) -> Result<Parts> {
            return Parts{by_method("32 light paths per sample", "spot-indirect", {"integrator=igi"}, context, 64)};
          }};
}

Figure figure_9_50() {
  return {.title = "The weak singularity of instant global illumination",
          .note =
              "Without a bound, virtual lights close to a corner make bright splotches. A bound removes them and "
              "darkens corners.",
          .make = [](const MakeContext& context) -> Result<Parts> {
            return Parts{by_method("Unbounded", "cornell",
                                   {"integrator=igi", "igi.light-paths=16", "igi.renew=false", "igi.compensate=false"},
                                   context, 32),
                         by_method("Bounded", "cornell",
                                   {"integrator=igi", "igi.light-paths=16", "igi.renew=false", "igi.compensate=false",
                                    "igi.bound=0.3"},
                                   context, 32)};
          }};
}

Figure figure_10_11() {
  return {.title = "Jacobi iterations of the radiosity equation",
          .note = "After k iterations from zero, light has been reflected k - 1 times.",
          .make = [](const MakeContext& context) -> Result<Parts> {
            Parts parts;
            for (int k = 1; k <= 4; ++k) {
              const std::string depth = "radiosity.max-depth=" + std::to_string(k);
              parts.push_back(by_method(
                  std::to_string(k) + (k == 1 ? " iteration" : " iterations"), "cornell",
                  {"integrator=radiosity", "radiosity.patches=3000", "radiosity.reconstruction=linear", depth.c_str()},
                  context, 16));
            }
            return parts;
          }};
}

}  // namespace etendue::figures
