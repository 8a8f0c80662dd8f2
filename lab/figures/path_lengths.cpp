// Figures of light by the number of its interactions, and of the techniques that find it.
#include "figures/tools.h"

namespace etendue::figures {
namespace {

// The light of paths with `interactions` vertices between camera and light.
Part interactions_part(const char* scene, int interactions, const MakeContext& context, float exposure) {
  render::Document document = document_of(scene, {"integrator=path"});
  document =
      *render::with_text(document, "film.paths", "E" + std::string(static_cast<size_t>(interactions), '.') + "L");
  return rendering_part(std::to_string(interactions) + " interactions", document, context,
                        {.samples = 256, .exposure = exposure, .columns = 2});
}

// Zero to three interactions; pictures of more than one are brighter by one stop each.
Result<Parts> terms_of(const char* scene, const MakeContext& context) {
  Parts parts;
  for (int k = 0; k <= 3; ++k)
    parts.push_back(interactions_part(scene, k, context, static_cast<float>(std::max(0, k - 1))));
  return parts;
}

}  // namespace

Figure figure_5_9() {
  return {.title = "Terms of the Neumann series with participating media",
          .note = "The light after zero to three applications of the transport operator, at surfaces and in fog.",
          .columns = 2,
          .make = [](const MakeContext& context) { return terms_of("fog", context); }};
}

Figure figure_5_11() {
  return {.title = "The measurement contribution of paths of length 1, 2, 3 and 4",
          .note =
              "Each picture is the integral of the measurement contribution over the paths of one length. Pictures of "
              "lengths 3 and 4 are brighter by one and two stops.",
          .columns = 2,
          .make = [](const MakeContext& context) { return terms_of("cornell", context); }};
}

Figure figure_6_44() {
  return {.title = "Direct and indirect illumination",
          .note = "Light that comes from the light sources, and light that is scattered by other surfaces.",
          .make = [](const MakeContext& context) -> Result<Parts> {
            Parts parts;
            for (const auto& [caption, paths] :
                 {std::pair{"Direct", "film.paths=E(D|G)L"}, std::pair{"Indirect", "film.paths=E(D|G).+L"}})
              parts.push_back(rendering_part(caption, document_of("cornell", {"integrator=bdpt", paths}), context,
                                             {.samples = 128, .columns = 2}));
            return parts;
          }};
}

Figure figure_9_24() {
  return {
      .title = "Sampling techniques of bidirectional path tracing",
      .note =
          "What each technique finds of the Cornell box without MIS weights, for paths of up to four segments: s "
          "vertices "
          "from the light (rows) and t from the camera. s = 0 hits the light, s = 1 samples it, t = 1 connects light "
          "paths with the lens. Pictures of paths with three and four segments are brighter by one stop.",
      .columns = 4,
      .make = [](const MakeContext& context) -> Result<Parts> {
        Parts parts;
        for (int s = 0; s <= 3; ++s)
          for (int t = 1; t <= 4; ++t) {
            const std::string caption = "s = " + std::to_string(s) + ", t = " + std::to_string(t);
            const int segments = s + t - 1;
            if (segments < 1 || segments > 4) {
              parts.push_back({.caption = caption + (segments < 1 ? ": none" : ": longer"),
                               .content = grey_picture(context.width / 2, [](double, double) { return 0.9; })});
              continue;
            }
            const auto document = render::with_text(
                document_of("cornell", {"integrator=bdpt", "bdpt.max-depth=4", "bdpt.weighted=false"}), "bdpt.only",
                std::to_string(s) + "," + std::to_string(t));
            if (!document) return document.error();
            parts.push_back(rendering_part(caption, *document, context,
                                           {.samples = 48, .exposure = segments > 2 ? 1.0f : 0.0f, .columns = 2}));
          }
        return parts;
      }};
}

}  // namespace etendue::figures
