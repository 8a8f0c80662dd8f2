// Figures of the rays of one sample, and of the tree of points that it consists of.
#include "figures/path_pictures.h"

namespace etendue::figures {
namespace {

Result<Parts> only(Result<Part> part) {
  if (!part) return part.error();
  return Parts{std::move(*part)};
}

// Rays of one sample: `first` from the first vertex and `later` from each of the others, without shadow rays.
render::Document tree_of_rays(const char* first, const char* later, const char* depth) {
  render::Document document = document_of("cornell", {"integrator=distribution", "distribution.shadow-rays=false"});
  const auto with_number = [&](const std::string& name, const char* value) {
    document = *render::with_text(document, "distribution." + name, value);
  };
  with_number("branches-1", first);
  with_number("branches-2", later);
  with_number("branches-3", later);
  with_number("max-depth", depth);
  return document;
}

constexpr Vec2 kOnTheFloor{0.62f, 0.85f}, kOnTheGlassBall{0.72f, 0.72f};

// A path that ends at a light, with as many vertices as possible.
double reaches_light(const transport::PathRecord& record) {
  double most = 0;
  for (const auto& vertex : record.vertices)
    if (vertex.emission && !is_black(vertex.emission->radiance)) most = std::max(most, double(vertex.length));
  return most;
}

Result<Parts> whitted_rays(const MakeContext& context) {
  return only(path_part("Reflected, refracted and shadow rays", document_of("cornell-spheres", {"integrator=whitted"}),
                        kOnTheGlassBall, context));
}

}  // namespace

Figure figure_1_10() {
  return {.title = "Rays of classic ray tracing",
          .note = "A real sample of one pixel, which sees the glass sphere. Dashed shadow rays are blocked.",
          .make = whitted_rays};
}
Figure figure_8_9() {
  Figure figure = figure_1_10();
  figure.note = "The same scene as in Figure 1.10, as in the thesis.";
  return figure;
}
Figure figure_8_10() {
  return {
      .title = "The tree of rays of classic ray tracing",
      .note =
          "The caption of the thesis is lost; this is the tree of the sample of Figure 8.9. The areas of the dots are "
          "in proportion to the throughput.",
      .make = [](const MakeContext& context) {
        return only(
            tree_part("Whitted", document_of("cornell-spheres", {"integrator=whitted"}), kOnTheGlassBall, context));
      }};
}

Figure figure_2_55() {
  return {.title = "A photon in a scene with glossy surfaces",
          .note =
              "The caption of the thesis is lost. The next direction depends on the last one only, and a random number "
              "selects it. By reciprocity this is a path of pure path tracing, read from its other end.",
          .make = [](const MakeContext& context) {
            return only(path_part("Pure path tracing", document_of("cornell-spheres", {"integrator=path-pure"}),
                                  {0.3f, 0.45f}, context));
          }};
}
Figure figure_2_68() {
  return {
      .title = "A continuous random walk",
      .note = "The states are the surfaces of the Cornell box. The walk ends by Russian roulette.",
      .make = [](const MakeContext& context) {
        return only(path_part("Random walk", document_of("cornell", {"integrator=path-pure"}), {0.5f, 0.4f}, context));
      }};
}

Figure figure_6_38() {
  return {
      .title = "Samples of a tree of points",
      .note =
          "The vertices of one sample of distribution ray tracing with three and two branches. The areas of the dots "
          "are in proportion to the throughput.",
      .make = [](const MakeContext& context) {
        return only(tree_part("3 and 2 branches", tree_of_rays("3", "2", "4"), kOnTheFloor, context));
      }};
}
Figure figure_6_39() {
  return {.title = "The tree of successive substitution",
          .note =
              "Vertices of one sample with three branches each. The dots become smaller with their depth and more "
              "numerous, so that they cannot be left out.",
          .make = [](const MakeContext& context) {
            return only(tree_part("3 branches", tree_of_rays("3", "3", "4"), kOnTheFloor, context));
          }};
}
Figure figure_6_41() {
  return {.title = "Rays of a naive Monte Carlo algorithm",
          .note = "Distribution ray tracing without shadow rays: a path counts only if it hits the light.",
          .make = [](const MakeContext& context) {
            return only(path_part("3 and 2 branches", tree_of_rays("3", "2", "4"), kOnTheFloor, context));
          }};
}
Figure figure_6_42() {
  return {.title = "The throughput of the vertices of a tree",
          .note =
              "As Figure 6.39, with two branches: the throughput of a vertex is the product of the kernels on its way, "
              "divided by densities.",
          .make = [](const MakeContext& context) {
            return only(tree_part("2 branches", tree_of_rays("2", "2", "4"), kOnTheFloor, context));
          }};
}
Figure figure_6_43() {
  return {.title = "One path of the tree",
          .note = "A Markov process follows one branch at each vertex; the bold one is the strongest of this tree.",
          .make = [](const MakeContext& context) {
            return only(tree_part("One of many paths", tree_of_rays("3", "2", "4"), kOnTheFloor, context, true));
          }};
}

Figure figure_8_14() {
  return {.title = "A tree of rays of distribution ray tracing",
          .note = "Four rays from the first vertex and two from each of the next ones, without shadow rays.",
          .make = [](const MakeContext& context) {
            return only(path_part("4 and 2 branches", tree_of_rays("4", "2", "4"), kOnTheFloor, context));
          }};
}
Figure figure_8_16() {
  return {.title = "The primary estimator of a pixel",
          .note = "One point in the pixel, and the rays of distribution ray tracing behind it.",
          .make = [](const MakeContext& context) {
            return only(paths_part("1 sample", tree_of_rays("3", "1", "3"), kOnTheFloor, 1, context));
          }};
}
Figure figure_8_20() {
  return {.title = "The secondary estimator of a pixel",
          .note = "Six points in the pixel; the mean of the samples is the estimate.",
          .make = [](const MakeContext& context) {
            return only(paths_part("6 samples", tree_of_rays("3", "1", "3"), kOnTheFloor, 6, context));
          }};
}

Figure figure_9_14() {
  return {
      .title = "A path of pure light tracing",
      .note =
          "By reciprocity a path from the light that hits the lens is a path of pure path tracing that hits the light, "
          "read from its other end: one of these is drawn.",
      .make = [](const MakeContext& context) {
        return only(path_part("From the light to the camera", document_of("cornell", {"integrator=path-pure"}),
                              Vec2(0.5f, 0.4f), context, reaches_light));
      }};
}

}  // namespace etendue::figures
