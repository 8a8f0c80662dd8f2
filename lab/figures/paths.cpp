// Figures of paths: the samples of a pixel over a faded picture, and the parts of light transport by path classes.
#include "figures/path_pictures.h"

namespace etendue::figures {
namespace {

Result<Parts> single_part(Result<Part> part) {
  if (!part) return part.error();
  return Parts{std::move(*part)};
}

Result<Parts> path_class(const char* expression, const MakeContext& context, float exposure = 0) {
  const std::string paths = std::string("film.paths=") + expression;
  return Parts{rendering_part(expression, document_of("cornell-spheres", {"integrator=bdpt", paths.c_str()}), context,
                              {.samples = 256, .exposure = exposure})};
}

}  // namespace

Figure figure_1_12() {
  return {
      .title = "A path of Monte Carlo path tracing",
      .note = "A real sample of one pixel, in the Cornell box. Thin lines are shadow rays, dashed ones are blocked.",
      .make = [](const MakeContext& context) {
        return single_part(
            path_part("Path tracing", document_of("cornell", {"integrator=path"}), {0.62f, 0.55f}, context));
      }};
}

Figure figure_8_15() {
  return {
      .title = "Rays of distribution ray tracing in a scene",
      .note = "All rays of one sample: four from the first and two from each second vertex.",
      .make = [](const MakeContext& context) {
        return single_part(path_part("Distribution ray tracing",
                                     document_of("cornell", {"integrator=distribution", "distribution.branches-1=4",
                                                             "distribution.branches-2=2", "distribution.max-depth=4"}),
                                     {0.62f, 0.55f}, context));
      }};
}

Figure figure_9_2() {
  return {.title = "A path of pure path tracing",
          .note = "Pure path tracing has no shadow rays: a path counts only if it hits the light.",
          .make = [](const MakeContext& context) {
            return single_part(path_part("Pure path tracing", document_of("cornell", {"integrator=path-pure"}),
                                         {0.35f, 0.6f}, context));
          }};
}

Figure figure_9_8() {
  return {.title = "A path with next event estimation", .make = [](const MakeContext& context) {
            return single_part(path_part("Path tracing with shadow rays",
                                         document_of("cornell-spheres", {"integrator=path"}), {0.28f, 0.75f}, context));
          }};
}

Figure figure_9_40() {
  return {.title = "Direct illumination",
          .note = "Paths E(D|G)L. The figures up to 9.43 show the four parts of the scattering term by path classes.",
          .make = [](const MakeContext& context) { return path_class("E(D|G)L", context); }};
}
Figure figure_9_41() {
  return {.title = "Specular and glossy illumination",
          .note = "Paths that begin at a specular surface, ES.*L.",
          .make = [](const MakeContext& context) { return path_class("ES.*L", context); }};
}
Figure figure_9_42() {
  return {.title = "Caustics", .note = "Paths EDS+L.", .make = [](const MakeContext& context) {
            return path_class("EDS+L", context, 1);
          }};
}
Figure figure_9_43() {
  return {.title = "Multiple diffuse scattering",
          .note = "Paths from a diffuse surface whose light was reflected diffusely before, ED.*D.*L.",
          .make = [](const MakeContext& context) { return path_class("ED.*D.*L", context, 1); }};
}

}  // namespace etendue::figures
