// All unbiased integrators agree in pairs on the paths that both sample. The registry determines the integrators, the
// paths of each, and the variants: each option and switch of an integrator is changed once.
//
// The variants are divided among the scenes: some scenes have all of them, each of the others the integrators as they are
// and half of the variants.
//
// Every variant that samples all paths of a class renders the class once, with its own seeds. Each pair is compared
// block by block with t-tests. The false-alarm rate is 1 % for the family of all blocks of all pairs of a test.
#include <gtest/gtest.h>

#include "advisor/declared_paths.h"
#include "base/hash.h"
#include "integrator/integrator.h"
#include "support/integrator_scenes.h"
#include "support/media_scenes.h"
#include "support/moving_scenes.h"

namespace etendue::pairwise_test {
namespace {

using integrator::IntegratorInfo;
using render::Document;

// Markov chains are included: they are unbiased if their starts are chosen among enough bootstrap samples [Lang, Remark
// 9.19].
bool without_bias(const IntegratorInfo& info) {
  return info.bias == integrator::Bias::unbiased || info.group == integrator::Group::markov_chain;
}

// Relative sample count of a variant. Variants with more noise per sample use more samples, so that their block means
// are nearly normally distributed.
double effort(std::string_view form) {
  struct Effort {
    std::string_view form;
    double samples;
  };
  for (const Effort& e :
       {Effort{"path-pure", 4}, Effort{"light-pure", 16}, Effort{"light", 4}, Effort{"bdpt:reuse=false", 8},
        Effort{"pssmlt:form=multiplexed", 32}, Effort{"pssmlt", 4}, Effort{"mlt", 2}})
    if (form.starts_with(e.form)) return e.samples;
  return 1;
}

// Variants for study whose variance is large or infinite beside mirrors, glass and small lights: the weights of these
// heuristics do not fall with the density of a technique, and a constant survival probability q makes the variance infinite
// where paths keep more than the square root of q of their throughput. Twelve images are too few for a normal distribution
// there. They are compared in the Cornell box, whose surfaces are diffuse, and have closed forms in IntegratingSphere.
bool has_heavy_tails(std::string_view form) {
  return form.ends_with(":heuristic=constant") || form.ends_with(":heuristic=partition") ||
         form.ends_with(":survival-rule=constant");
}

struct Form {
  std::string name;
  Document document;
};

// The values of an option or switch other than its default.
std::vector<std::string> other_values(const ParameterInfo& parameter) {
  std::vector<std::string> values;
  if (parameter.type == ParameterType::toggle) values = {"true", "false"};
  if (parameter.type == ParameterType::choice && !parameter.validate_text) values = parameter.options;
  std::erase(values, to_string(parameter.default_value));
  return values;
}

// An integrator with default parameters, and with each of its options and switches changed.
std::vector<Form> forms_of(const IntegratorInfo& info, const Document& place) {
  Document d = test::with_integrator(place, info.name);
  // Few long chains explore more than many short ones.
  if (info.group == integrator::Group::markov_chain) d = test::with(d, "chains", "32");
  std::vector<Form> forms{{info.name, d}};
  for (const ParameterInfo& parameter : info.parameters)
    for (const std::string& value : other_values(parameter))
      if (parameter.name != info.techniques.weighted)
        forms.push_back({info.name + ':' + parameter.name + '=' + value, test::with(d, parameter.name.c_str(), value)});
  return forms;
}

bool finds_all(const Document& d, const scene::CompiledScene& scene) {
  return advisor::without(advisor::requested_paths(d), advisor::declared_paths(d, scene).paths).empty();
}

// The variants of all integrators that sample every path of the class.
std::vector<Form> complete_forms(const Document& place, const std::string& paths, const std::vector<std::string>& but) {
  const auto scene = scene::compile(place.scene, place.camera, nullptr);
  std::vector<Form> found;
  for (const IntegratorInfo& info : integrator::integrator_infos()) {
    if (!without_bias(info)) continue;
    for (Form& form : forms_of(info, place)) {
      form.document.method.paths = paths;
      if (std::ranges::count(but, form.name) == 0 && finds_all(form.document, *scene)) found.push_back(std::move(form));
    }
  }
  return found;
}

// The first seed of a variant. It depends on the name only, so that a new variant changes no other one.
uint64_t seed_of(std::string_view name) { return hash_bytes(name.data(), name.size()); }

enum class Variants { half, all };

bool is_variant(std::string_view form) { return form.find(':') != form.npos; }

// Whether a test has a form. The half of the variants depends on both names, so that a new test changes no other one.
bool takes_part(const std::string& form, Variants variants) {
  if (variants == Variants::all || !is_variant(form)) return true;
  return seed_of(form + ' ' + ::testing::UnitTest::GetInstance()->current_test_info()->name()) % 2 == 0;
}

// `but`: variants that are excluded in this scene, besides those with heavy tails where surfaces are not diffuse.
void expect_pairs_agree(const Document& place, const std::string& paths, uint32_t samples,
                        const std::vector<std::string>& but = {}, Variants variants = Variants::half,
                        bool all_diffuse = false) {
  struct Answer {
    std::string name;
    test::Estimate estimate;
  };
  std::vector<Answer> answers;
  for (const Form& form : complete_forms(place, paths, but)) {
    if (!takes_part(form.name, variants) || (!all_diffuse && has_heavy_tails(form.name))) continue;
    const auto own = static_cast<uint32_t>(samples * effort(form.name));
    answers.push_back({form.name, test::replicated(form.document, own, seed_of(form.name))});
  }
  const auto n = static_cast<int>(answers.size());
  EXPECT_GE(std::ranges::count_if(answers, [](const Answer& a) { return !is_variant(a.name); }), 7);
  for (size_t i = 0; i < answers.size(); ++i)
    for (size_t j = 0; j < i; ++j)
      test::expect_agreement(answers[i].estimate, answers[j].estimate, answers[i].name + " and " + answers[j].name,
                             n * (n - 1) / 2);
}

Document builtin(const char* name) {
  Document d = *render::new_document(name);
  d.width = d.height = test::kSize;
  return d;
}

TEST(Pairwise, Cornell) { expect_pairs_agree(builtin("cornell"), "E(D|G)*L", 48, {}, Variants::all, true); }
TEST(Pairwise, DirectLightOfCornell) { expect_pairs_agree(builtin("cornell"), "E(D|G)L", 64, {}, Variants::all, true); }

TEST(Pairwise, GlossyPlates) { expect_pairs_agree(builtin("glossy-plates"), "E(D|G)*L", 64); }

// Metal, rough and smooth glass, a thin sheet, glaze: every kind of lobe.
TEST(Pairwise, GlossyScene) { expect_pairs_agree(test::glossy_scene(), "E[(D|G).*]L", 64, {}, Variants::all); }
TEST(Pairwise, GlossySceneInMirrors) { expect_pairs_agree(test::glossy_scene(), "ES.*L", 64); }

// Non-reciprocal, anisotropic, rough, tabulated and coated models: both directions through every kind of lobe.
TEST(Pairwise, BsdfModels) { expect_pairs_agree(test::bsdf_model_scene(), "E[(D|G).*]L", 64); }

TEST(Pairwise, UnderAreaLight) { expect_pairs_agree(test::balls_under_area_light(), "E[(D|G).*]L", 64); }
TEST(Pairwise, GlassBallUnderAreaLight) { expect_pairs_agree(test::balls_under_area_light(), "ES.*L", 64); }

// A quad, a disk and a sphere, whose points are sampled differently by the integrators.
TEST(Pairwise, UnderAnalyticLights) {
  expect_pairs_agree(test::balls_under_analytic_lights(), "E[(D|G).*]L", 64, {}, Variants::all);
}

TEST(Pairwise, UnderSky) { expect_pairs_agree(test::balls_under_sky(), "E[(D|G).*]L", 64); }
// The light of the sky is hidden from the camera, which sees the backdrop instead.
TEST(Pairwise, BackdropUnderSky) {
  const Document d = test::with(test::balls_under_sky(), "environment.visible", "false");
  expect_pairs_agree(test::with(d, "environment.backdrop", "true"), "E[(D|G).*]L", 64);
}
// The multiplexed form tries one technique at a time, and only one technique samples long paths through the ball: once
// in a million samples, which then carry as much weight as all others. Twelve images are too few for a normal
// distribution.
const std::vector<std::string> kRareThroughGlass{"pssmlt:form=multiplexed"};
TEST(Pairwise, GlassBallUnderSky) { expect_pairs_agree(test::balls_under_sky(), "ES.*L", 64, kRareThroughGlass); }

// Of the paths of `light-pure`, one in some thousands hits a lens of 15 cm.
TEST(Pairwise, LensAndShutter) { expect_pairs_agree(test::motion_and_lens_scene(), "E(D|G)*L", 64, {"light-pure"}); }
TEST(Pairwise, DirectLightThroughLensAndShutter) {
  expect_pairs_agree(test::motion_and_lens_scene(), "E(D|G)L", 64, {"light-pure"});
}

TEST(Pairwise, WideLens) {
  const Document d =
      test::with(test::with(builtin("cornell"), "camera.lens-radius", "1.5"), "camera.focus-distance", "8");
  expect_pairs_agree(d, "E(D|G)*L", 48);
}
TEST(Pairwise, WideLensAndShutter) {
  expect_pairs_agree(test::with(test::motion_and_lens_scene(), "camera.lens-radius", "0.8"), "E(D|G)*L", 64);
}

// The floor of a pool that is lit and seen through water only. These paths are found by chance hits alone, so the light
// is large.
TEST(Pairwise, CausticBehindGlass) {
  Document d = builtin("caustic-pool");
  scene::Scene pool = *d.scene;
  for (scene::Node& node : pool.nodes) {
    if (node.name == "fill light") node.visible = true;
    if (node.name == "light") node.visible = false;
  }
  d.scene = std::make_shared<const scene::Scene>(std::move(pool));
  expect_pairs_agree(d, "ES+DS+L", 40);
}

// ---- Nested solids.

TEST(Pairwise, StoneInTintedWater) {
  expect_pairs_agree(test::stone_in_tinted_water(), "ES.*L", 64, kRareThroughGlass);
}
// Connecting only the ends of subpaths seldom finds light behind six boundaries: the means of twelve images are too
// small, by a quarter at 64 samples and by an eighth at 2048.
TEST(Pairwise, IceInWaterTouchesGlass) {
  expect_pairs_agree(test::ice_in_water_in_glass(false), "ES.*L", 64, {"pssmlt:form=multiplexed", "bdpt:reuse=false"});
}
TEST(Pairwise, IceInWaterOverlapsGlass) {
  expect_pairs_agree(test::ice_in_water_in_glass(true), "ES.*L", 64, kRareThroughGlass);
}
TEST(Pairwise, BesideIceInWaterInGlass) {
  expect_pairs_agree(test::ice_in_water_in_glass(true), "E[(D|G).*]L", 64, kRareThroughGlass, Variants::all);
}
TEST(Pairwise, Bubble) { expect_pairs_agree(test::bubble(), "ES.*L", 64, kRareThroughGlass); }
// Few Markov chains of path space enter the paths of the blocks that have a thousandth of the mean radiance. The mean of
// 36 images agrees with the others at 1024 samples, but most of it comes from a third of the images.
TEST(Pairwise, LightInTintedWater) {
  expect_pairs_agree(test::light_in_tinted_water(false), "ES.*L", 96, {"pssmlt:form=multiplexed", "mlt"});
}
TEST(Pairwise, LightAndCameraInTintedWater) {
  expect_pairs_agree(test::light_in_tinted_water(true), "E[(D|G).*]L", 64, kRareThroughGlass);
}
TEST(Pairwise, CameraInsideGlass) {
  expect_pairs_agree(test::camera_inside_glass(), "E[(D|G).*]L", 64, kRareThroughGlass);
}

}  // namespace
}  // namespace etendue::pairwise_test
